"""Line scans: what they take, what they share, their statistics, filling, detrending, peaks."""

import numpy as np
import pytest

from asperity import HeightMap, InvalidInput, LineScan

RNG = np.random.default_rng(17)
ROUGH = RNG.gumbel(size=301) * 1e-6 + 4e-6
SPACING = 0.5e-6
LAYOUTS = {
    "float64": ROUGH,
    "float32": ROUGH.astype("f4"),
    "float16": (ROUGH * 1e6).astype("f2"),
    "int16": (ROUGH * 1e9).astype("i2"),
    "big-endian": ROUGH.astype(">f8"),
    "list": ROUGH.tolist(),
    "backwards": ROUGH[::-1],
    "every third": ROUGH[1::3],
    "every third float32": ROUGH.astype("f4")[::3],
    "column": np.tile(ROUGH[:, None], (1, 4))[:, 2],
    "read-only": np.frombuffer(ROUGH.tobytes()),
}


@pytest.mark.parametrize("name", LAYOUTS)
def test_any_real_dtype_and_layout_is_read_as_it_stands(name):
    given = LAYOUTS[name]
    expected = np.asarray(given, dtype=float)
    scan = LineScan(given, spacing=SPACING)
    np.testing.assert_array_equal(scan.heights, expected)
    assert scan.rms_height == pytest.approx(
        expected.std(), rel=1e-6 if "32" in name else 1e-12, abs=0
    )
    assert scan.spacing == SPACING


@pytest.mark.parametrize(
    "name", ["float64", "float32", "backwards", "every third", "column", "read-only"]
)
def test_float_scans_are_shared_and_never_written_to(name):
    given = LAYOUTS[name]
    scan = LineScan(given, spacing=SPACING)
    assert np.shares_memory(scan.heights, given)
    assert scan.heights.dtype == given.dtype
    with pytest.raises(ValueError, match="read-only"):
        scan.heights[0] = 1


@pytest.mark.parametrize("holes", [0, 0.3])
def test_statistics_are_those_of_the_measured_points(holes):
    heights = np.where(RNG.random(ROUGH.size) < holes, np.nan, ROUGH)
    scan = LineScan(heights, spacing=SPACING)
    z = heights[~np.isnan(heights)]
    z = z - z.mean()
    assert scan.rms_height == pytest.approx(z.std(), rel=1e-12, abs=0)
    assert scan.skewness == pytest.approx((z**3).mean() / z.std() ** 3, rel=1e-10)
    assert scan.kurtosis == pytest.approx((z**4).mean() / z.std() ** 4, rel=1e-10)
    assert scan.z_max == pytest.approx(z.max(), rel=1e-12, abs=0)
    assert scan.z_min == pytest.approx(z.min(), rel=1e-12, abs=0)
    assert scan.dropout_fraction == np.isnan(heights).mean()
    slope = (heights[2:] - heights[:-2]) / (2 * SPACING)
    assert scan.rms_slope == pytest.approx(np.sqrt(np.nanmean(slope**2)), rel=1e-12)


@pytest.mark.parametrize("bins", [1, 7, 100])
def test_the_histogram_is_numpys(bins):
    for surface in (LineScan(ROUGH, spacing=1), HeightMap(ROUGH.reshape(7, 43), pixel_size=1)):
        edges, density = surface.height_histogram(bins=bins)
        z = ROUGH - ROUGH.mean()
        expected, expected_edges = np.histogram(z, bins=bins, density=True)
        np.testing.assert_allclose(edges, expected_edges, rtol=1e-10, atol=1e-12 * np.ptp(z))
        np.testing.assert_allclose(density, expected, rtol=1e-10)
        assert np.sum(density * np.diff(edges)) == pytest.approx(1, rel=1e-12)


@pytest.mark.parametrize("gaps", [False, True])
@pytest.mark.parametrize(("order", "degree"), [("offset", 0), ("plane", 1), ("quadratic", 2)])
def test_detrend_takes_out_a_polynomial(order, degree, gaps):
    u = np.linspace(-1, 1, ROUGH.size)
    heights = ROUGH + 1e-6 * (3 - 7 * u + 5 * u**2)
    if gaps:
        heights[RNG.random(ROUGH.size) < 0.08] = np.nan
    known = ~np.isnan(heights)
    line = np.polyval(np.polyfit(u[known], heights[known], degree), u)
    result = LineScan(heights, spacing=SPACING).detrend(order)
    assert isinstance(result, LineScan)
    np.testing.assert_allclose(result.heights, heights - line, atol=1e-18)


def test_filling_is_linear_between_neighbours_and_nearest_beyond_the_ends():
    heights = ROUGH.copy()
    heights[[0, 1, 5, 40, 41, 42, 100, 300]] = np.nan
    filled = LineScan(heights, spacing=SPACING).fill_dropouts()
    known = ~np.isnan(heights)
    at = np.arange(ROUGH.size)
    expected = np.interp(at, at[known], heights[known])
    np.testing.assert_array_equal(filled.heights[known], heights[known])
    np.testing.assert_allclose(filled.heights, expected, rtol=1e-13)
    with pytest.raises(InvalidInput, match=r"^heights: 2\.658 % .* at most 1 %"):
        LineScan(heights, spacing=SPACING).fill_dropouts(max_fraction=0.01)


def greedy(z, min_distance, periodic):
    """All maxima, from the highest down, none closer than min_distance to one taken before."""
    n = z.size
    around = np.pad(z, 1, mode="wrap") if periodic else np.pad(z, 1, constant_values=np.inf)
    maxima = np.flatnonzero((z > around[:-2]) & (z > around[2:]))
    taken = []
    for i in sorted(maxima, key=lambda i: -z[i]):
        steps = np.abs(i - np.array(taken, int))
        steps = np.minimum(steps, n - steps) if periodic else steps
        if not np.any(steps * SPACING < min_distance):
            taken.append(i)
    return z[taken] - z.mean()


@pytest.mark.parametrize("periodic", [False, True])
@pytest.mark.parametrize("min_distance", [1e-9, 1.7e-6, 9.3e-6, 1e-3])
def test_peaks_are_those_of_the_plain_greedy_search(min_distance, periodic):
    result = LineScan(ROUGH, spacing=SPACING).local_peaks(
        min_distance=min_distance, periodic=periodic
    )
    expected = greedy(ROUGH, min_distance, periodic)
    assert len(result) == len(expected) > 0
    np.testing.assert_allclose(result, expected, rtol=1e-10)


def test_an_affine_shift_keeps_the_highest_point():
    scan = LineScan(ROUGH, spacing=SPACING)
    z = ROUGH - ROUGH.mean()
    shifted = scan.affine_shift(2.5)
    expected = (z - z.max()) / 2.5 + z.max()
    np.testing.assert_allclose(shifted.heights, expected, atol=1e-18)
