"""Maps and line scans: what they take, their statistics, filling, detrending, peaks."""

import numpy as np
import pytest

from asperity import HeightMap, InvalidInput, LineScan

RNG = np.random.default_rng(7)
PIXEL = (2e-6, 5e-6)
ROUGH = RNG.normal(size=(23, 37)) * 1e-6
PROFILE = RNG.gumbel(size=301) * 1e-6 + 4e-6
EPS = np.finfo(float).eps


def surface_of(heights):
    """A map or a line scan, by the axes of the heights."""
    if np.ndim(heights) == 2:
        return HeightMap(heights, pixel_size=PIXEL)
    return LineScan(heights, spacing=PIXEL[1])


def grid(shape):
    """x and y [m] of the points of a map with PIXEL."""
    y, x = np.indices(shape)
    return y * PIXEL[0], x * PIXEL[1]


def plane(shape):
    y, x = grid(shape)
    return 3e-6 + 0.2 * y - 0.11 * x


LAYOUTS = {
    "float64": ROUGH,
    "float32": ROUGH.astype("f4"),
    "float16": (ROUGH * 1e6).astype("f2"),
    "big-endian": ROUGH.astype(">f8"),
    "big-endian float32": ROUGH.astype(">f4"),
    "int16": (ROUGH * 1e9).astype("i2"),
    "uint8": np.arange(240, dtype="u1").reshape(12, 20),
    "bool": ROUGH > 0,
    "list": ROUGH.tolist(),
    "Fortran order": np.asfortranarray(ROUGH),
    "negative strides": ROUGH[::-1, ::-2],
    "transposed": ROUGH.T,
    "every third": ROUGH.astype("f4")[::3, 1::3],
    "broadcast": np.broadcast_to(ROUGH[0], (5, 37)),
    "field of records": np.rec.fromarrays([ROUGH, ROUGH > 0])["f0"],
    "unaligned": np.frombuffer(b"\0" + ROUGH.tobytes(), offset=1).reshape(ROUGH.shape),
    "line": PROFILE,
    "line, float32": PROFILE.astype("f4"),
    "line, big-endian": PROFILE.astype(">f8"),
    "line, list": PROFILE.tolist(),
    "line, backwards": PROFILE[::-1],
    "line, every third float32": PROFILE.astype("f4")[::3],
    "line, column": np.tile(PROFILE[:, None], (1, 4))[:, 2],
}


@pytest.mark.parametrize("name", LAYOUTS)
def test_any_real_dtype_and_layout_is_read_as_it_stands(name):
    given = LAYOUTS[name]
    expected = np.asarray(given, dtype=float)
    result = surface_of(given)
    assert result.heights.shape == expected.shape
    np.testing.assert_array_equal(result.heights, expected)
    rounding = 1e-6 if name.startswith("line") and "32" in name else 1e-12
    assert result.rms_height == pytest.approx(expected.std(), rel=rounding, abs=0)
    assert result.detrend("plane").rms_height <= result.rms_height


@pytest.mark.parametrize("change", ["fill_dropouts", "detrend", "affine_shift"])
@pytest.mark.parametrize("dtype", ["f4", "f8"])
def test_maps_keep_their_precision(dtype, change):
    surface = HeightMap(ROUGH.astype(dtype), pixel_size=1)
    changed = {
        "fill_dropouts": lambda: surface.fill_dropouts(),
        "detrend": lambda: surface.detrend("plane"),
        "affine_shift": lambda: surface.affine_shift(2),
    }[change]()
    assert surface.heights.dtype == changed.heights.dtype == np.dtype(dtype)


@pytest.mark.parametrize("given", ["f4", ">f4"])
@pytest.mark.parametrize("masked", [False, True])
def test_every_float32_map_stays_float32(given, masked):
    heights = ROUGH.astype(given)
    if masked:
        heights = np.ma.masked_array(heights, mask=heights > 2e-6)
    assert HeightMap(heights, pixel_size=1).heights.dtype == np.float32


@pytest.mark.parametrize("dtype", ["f4", "f8", "i2"])
def test_masked_points_are_dropouts(dtype):
    values = (ROUGH * 1e6).astype(dtype)
    mask = RNG.random(ROUGH.shape) < 0.2
    surface = HeightMap(np.ma.masked_array(values, mask=mask), pixel_size=1)
    np.testing.assert_array_equal(np.isnan(surface.heights), mask)
    assert surface.dropout_fraction == mask.mean()
    np.testing.assert_array_equal(surface.heights[~mask], values[~mask].astype(float))


@pytest.mark.parametrize(
    "mine",
    [ROUGH, PROFILE, PROFILE.astype("f4")[::3], PROFILE[::-1], np.frombuffer(PROFILE.tobytes())],
)
def test_heights_are_a_view_that_nobody_can_write_to(mine):
    heights = surface_of(mine).heights
    assert np.shares_memory(heights, mine)
    assert heights.dtype == mine.dtype
    with pytest.raises(ValueError, match="read-only"):
        heights[0] = 1


def test_heights_outlive_the_map_and_the_array():
    view = HeightMap(ROUGH.copy(), pixel_size=1).heights
    np.testing.assert_array_equal(view, ROUGH)
    made = HeightMap(ROUGH.copy(), pixel_size=1).affine_shift(1).heights
    assert made.max() == pytest.approx(ROUGH.max() - ROUGH.mean(), rel=1e-12, abs=0)


@pytest.mark.parametrize("pixel_size", [3e-6, (3e-6, 3e-6), [3e-6, 3e-6], np.array([3e-6, 3e-6])])
def test_pixel_size_is_one_number_or_dy_dx(pixel_size):
    assert HeightMap(ROUGH, pixel_size=pixel_size).pixel_size == (3e-6, 3e-6)


@pytest.mark.parametrize("offset", [0.0, 1.0])
@pytest.mark.parametrize("holes", [0, 0.3])
@pytest.mark.parametrize("shape", [(60, 41), (301,)])
def test_statistics_are_those_of_the_measured_points(shape, offset, holes):
    heights = np.where(RNG.random(shape) < holes, np.nan, RNG.gumbel(size=shape)) * 1e-6
    surface = surface_of(heights + offset)
    z = heights[~np.isnan(heights)] - np.nanmean(heights)
    tolerance = 1e-12 + 20 * EPS * offset / z.std()
    assert surface.rms_height == pytest.approx(z.std(), rel=tolerance, abs=0)
    assert surface.skewness == pytest.approx((z**3).mean() / z.std() ** 3, rel=20 * tolerance)
    assert surface.kurtosis == pytest.approx((z**4).mean() / z.std() ** 4, rel=20 * tolerance)
    assert surface.z_max == pytest.approx(z.max(), rel=tolerance, abs=0)
    assert surface.z_min == pytest.approx(z.min(), rel=tolerance, abs=0)
    assert surface.dropout_fraction == np.isnan(heights).mean()


@pytest.mark.parametrize("bins", [1, 7, 100])
@pytest.mark.parametrize("heights", [PROFILE, PROFILE.reshape(7, 43)])
def test_the_histogram_is_numpys(heights, bins):
    edges, density = surface_of(heights).height_histogram(bins=bins)
    z = heights - heights.mean()
    expected, expected_edges = np.histogram(z, bins=bins, density=True)
    np.testing.assert_allclose(edges, expected_edges, rtol=1e-10, atol=1e-12 * np.ptp(z))
    np.testing.assert_allclose(density, expected, rtol=1e-10)


def test_rms_slope_of_a_line_is_that_of_central_differences():
    heights = np.where(RNG.random(PROFILE.size) < 0.3, np.nan, PROFILE)
    slope = (heights[2:] - heights[:-2]) / (2 * PIXEL[1])
    expected = np.sqrt(np.nanmean(slope**2))
    assert surface_of(heights).rms_slope == pytest.approx(expected, rel=1e-12)


def test_rms_slope_is_that_of_central_differences():
    dx = (ROUGH[:, 2:] - ROUGH[:, :-2]) / (2 * PIXEL[1])
    dy = (ROUGH[2:] - ROUGH[:-2]) / (2 * PIXEL[0])
    expected = np.sqrt((dx**2).mean() + (dy**2).mean())
    assert HeightMap(ROUGH, pixel_size=PIXEL).rms_slope == pytest.approx(expected, rel=1e-13, abs=0)


def test_rms_slope_of_a_plane_is_its_gradient_whatever_is_missing():
    heights = np.where(RNG.random((40, 50)) < 0.1, np.nan, plane((40, 50)))
    result = HeightMap(heights, pixel_size=PIXEL).rms_slope
    assert result == pytest.approx(np.hypot(0.2, 0.11), rel=1e-9)


@pytest.mark.parametrize(("count", "accepted"), [(100, True), (101, False)])
def test_ten_per_cent_is_the_most_that_is_filled_unasked(count, accepted):
    heights = RNG.normal(size=(20, 50))
    heights.flat[RNG.choice(1000, count, replace=False)] = np.nan
    surface = HeightMap(heights, pixel_size=1)
    if accepted:
        assert surface.fill_dropouts().dropout_fraction == 0
    else:
        with pytest.raises(InvalidInput, match=r"^heights: 10\.1 % .* at most 10 %"):
            surface.fill_dropouts()
        assert surface.fill_dropouts(max_fraction=0.2).dropout_fraction == 0
    assert surface.dropout_fraction == count / 1000


SHAPES = {
    "offset": lambda u, v: 3 + 0 * u,
    "plane": lambda u, v: 3 + 2 * u - 5 * v,
    "quadratic": lambda u, v: 3 + 2 * u - 5 * v + u * u - 7 * u * v + 4 * v * v,
}


@pytest.mark.parametrize("gaps", [False, True])
@pytest.mark.parametrize("order", SHAPES)
def test_detrend_takes_out_exactly_its_own_shape(order, gaps):
    v, u = (k / k.max() for k in grid((40, 50)))
    shape = SHAPES[order](u, v)
    rough = RNG.normal(size=shape.shape)
    if gaps:
        rough[RNG.random(shape.shape) < 0.08] = np.nan
    np.testing.assert_allclose(
        HeightMap(shape + 0 * rough, pixel_size=PIXEL).detrend(order).heights,
        0 * rough,
        atol=1e-13,
    )
    terms = {"offset": [1 + 0 * u], "plane": [1 + 0 * u, u, v]}
    terms["quadratic"] = [*terms["plane"], u * u, u * v, v * v]
    matrix, known = np.stack(terms[order], axis=-1), ~np.isnan(rough)
    fit = np.linalg.lstsq(matrix[known], (shape + rough)[known], rcond=None)[0]
    result = HeightMap(shape + rough, pixel_size=PIXEL).detrend(order).heights
    np.testing.assert_allclose(result, shape + rough - matrix @ fit, atol=1e-12)


@pytest.mark.parametrize("gaps", [False, True])
@pytest.mark.parametrize(("order", "degree"), [("offset", 0), ("plane", 1), ("quadratic", 2)])
def test_detrend_takes_a_polynomial_out_of_a_line(order, degree, gaps):
    u = np.linspace(-1, 1, PROFILE.size)
    heights = PROFILE + 1e-6 * (3 - 7 * u + 5 * u**2)
    heights[RNG.random(PROFILE.size) < 0.08 * gaps] = np.nan
    known = ~np.isnan(heights)
    line = np.polyval(np.polyfit(u[known], heights[known], degree), u)
    result = surface_of(heights).detrend(order)
    assert isinstance(result, LineScan)
    np.testing.assert_allclose(result.heights, heights - line, atol=1e-18)


def test_a_line_is_filled_linearly_and_by_the_nearest_beyond_its_ends():
    heights = PROFILE.copy()
    heights[[0, 1, 5, 40, 41, 42, 100, 300]] = np.nan
    known, at = ~np.isnan(heights), np.arange(PROFILE.size)
    filled = surface_of(heights).fill_dropouts().heights
    np.testing.assert_array_equal(filled[known], heights[known])
    np.testing.assert_allclose(filled, np.interp(at, at[known], heights[known]), rtol=1e-13)


def test_an_affine_shift_keeps_the_highest_point():
    z = PROFILE - PROFILE.mean()
    expected = (z - z.max()) / 2.5 + z.max()
    np.testing.assert_allclose(surface_of(PROFILE).affine_shift(2.5).heights, expected, atol=1e-18)


def test_an_offset_of_a_million_rms_heights_costs_no_more_than_its_own_rounding():
    offset = 1e6 * ROUGH.std()
    near = HeightMap(ROUGH, pixel_size=PIXEL).detrend("quadratic").heights
    far = HeightMap(ROUGH + offset, pixel_size=PIXEL).detrend("quadratic").heights
    np.testing.assert_allclose(far, near, atol=2 * EPS * offset)


def greedy(z, pixel, min_distance, periodic):
    """Eq. 13's peaks the plain way: all maxima, from the highest down, of a map or a line."""
    ny, nx = z.shape
    edge = {"mode": "wrap"} if periodic else {"constant_values": np.inf}
    around = np.pad(z, ((0, 0), (1, 1)), **edge)
    around = np.pad(around, ((1, 1), (0, 0)), **({"constant_values": -np.inf} if ny == 1 else edge))
    maxima = np.ones_like(z, bool)
    for dy in (0, 1, 2):
        for dx in (0, 1, 2):
            if (dy, dx) != (1, 1):
                maxima &= z > around[dy : dy + ny, dx : dx + nx]
    taken = []
    for y, x in sorted(np.argwhere(maxima).tolist(), key=lambda p: -z[p[0], p[1]]):
        for oy, ox in taken:
            ly, lx = abs(y - oy), abs(x - ox)
            if periodic:
                ly, lx = min(ly, ny - ly), min(lx, nx - lx)
            if np.hypot(ly * pixel[0], lx * pixel[1]) < min_distance:
                break
        else:
            taken.append((y, x))
    return np.array([z[y, x] for y, x in taken]) - z.mean()


@pytest.mark.parametrize("periodic", [False, True])
@pytest.mark.parametrize("min_distance", [1e-9, 7.1e-6, 1.31e-5, 4.03e-5, 1e-3])  # no ties
@pytest.mark.parametrize("shape", [(40, 41), (12, 90), (3, 3), (301,)])
def test_peaks_are_those_of_the_plain_greedy_search(shape, min_distance, periodic):
    z = RNG.normal(size=shape) + 0.5
    result = surface_of(z).local_peaks(min_distance=min_distance, periodic=periodic)
    expected = greedy(np.atleast_2d(z), PIXEL, min_distance, periodic)
    assert len(result) == len(expected)
    np.testing.assert_allclose(result, expected, rtol=1e-12, atol=1e-15)


@pytest.mark.parametrize("apart", [3, 8])
@pytest.mark.parametrize("axis", [0, 1])
def test_peaks_exactly_the_minimum_distance_apart_both_count_wherever_they_lie(apart, axis):
    pixel, counts = 5e-6, []
    for first in range(1, 80):
        z = np.zeros((5, 100))
        z[2, first], z[2, first + apart] = 2.0, 1.0
        surface = HeightMap(z.T if axis == 0 else z, pixel_size=pixel)
        counts.append(np.sum(surface.local_peaks(min_distance=apart * pixel) > 0.5))
    assert set(counts) == {2}


def test_a_plateau_counts_once_and_not_beside_a_higher_point():
    z = np.zeros((9, 12))
    z[2:4, 2:5] = 1.0  # a plateau
    z[6, 3:6], z[7, 6] = 2.0, 3.0  # a ledge below a summit
    z[1:3, 8] = z[3, 9] = 4.0  # a bent ridge, joined by a corner
    result = HeightMap(z, pixel_size=1).local_peaks(min_distance=0.1)
    np.testing.assert_allclose(result + z.mean(), [4.0, 3.0, 1.0])
    assert (
        HeightMap(np.ones((5, 5)), pixel_size=1).local_peaks(min_distance=1, periodic=True).size
        == 0
    )


def test_the_edge_counts_only_where_the_map_goes_on():
    z = np.zeros((8, 8))
    z[0, 3] = z[7, 7] = 1.0
    surface = HeightMap(z, pixel_size=1)
    assert surface.local_peaks(min_distance=1).size == 0
    assert surface.local_peaks(min_distance=1, periodic=True).size == 2
    z[0, 7] = 2.0  # a neighbour of (7, 7) across the edge
    np.testing.assert_allclose(
        HeightMap(z, pixel_size=1).local_peaks(min_distance=1, periodic=True) + z.mean(), [2.0, 1.0]
    )
