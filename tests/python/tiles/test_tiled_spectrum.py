"""The spectrum by tiles: against the truth, against the whole map, and its standard errors."""

from concurrent.futures import ProcessPoolExecutor, ThreadPoolExecutor
from itertools import pairwise
from multiprocessing import get_context
from types import SimpleNamespace

import numpy as np
import pytest

from asperity import HeightMap, InvalidInput, _core, fit_self_affine, power_spectrum
from asperity.tiles.coarse import Coarse, without_blocks
from helpers.cases import long
from helpers.known_surfaces import law, ring_mean, surface, tilted, with_holes
from helpers.plain_spectrum import profile

PIXEL = 1e-6
WINDOWS = ["split-cosine-bell", "hann", "none", "blackman"]
LAWS = {
    "steep": law(0.95),
    "road": law(0.8, rolloff=1e5),
    "shallow": law(0.3),
    "white": lambda q: np.full_like(q, 1e-30),
}


def pull_of(spectrum, truth):
    """(found - true) / stated of logarithmic bins of the rows that are not flagged."""
    keep = np.asarray(spectrum.flag) == 0
    q, c = spectrum.wavenumber, truth(spectrum.wavenumber)
    edges = np.geomspace(q[keep][0], q[keep][-1] * 1.001, 13)
    pulls = []
    for low, high in pairwise(edges):
        rows = np.flatnonzero(keep & (q >= low) & (q < high))
        weight = spectrum.count[rows] / spectrum.count[rows].sum()
        error = spectrum.standard_error[rows] / c[rows] * weight
        variance = 0.0
        for a, i in enumerate(rows):
            for b, j in enumerate(rows[a : a + 1 + spectrum.correlation.shape[1]], start=a):
                tie = 1.0 if i == j else 2 * spectrum.correlation[i, j - i - 1]
                variance += tie * error[a] * error[b]
        pulls.append((np.sum(weight * spectrum.density[rows] / c[rows]) - 1) / np.sqrt(variance))
    return np.array(pulls)


def pairs_of_modes(window, shape, shift, rings):
    """Covariance of the means of rings 0, 1, ... apart of two tiles, every pair of modes by itself.

    cov(|h(k)|^2, |h'(l)|^2) is |W(k - l)|^2, W the transform of the product of the two windows.
    """
    ny, nx = shape
    whole = np.outer(profile(window, ny), profile(window, nx))
    both = np.zeros(shape)
    both[: ny - shift[0], : nx - shift[1]] = (
        whole[shift[0] :, shift[1] :] * whole[: ny - shift[0], : nx - shift[1]]
    )
    tie = np.abs(np.fft.fft2(both) / (whole**2).sum()) ** 2
    longest = max(shape)
    ky, kx = np.fft.fftfreq(ny) * longest, np.fft.fftfreq(nx) * longest
    radius = np.round(np.hypot(*np.meshgrid(ky, kx, indexing="ij")))
    masks = {r: radius == r for r in range(rings[0], rings[-1] + 4)}
    result = np.zeros(4)
    for r in rings:
        spread = np.fft.ifft2(np.fft.fft2(tie) * np.fft.fft2(masks[r])).real
        for m in range(4):
            number, other = masks[r].sum(), masks[r + m].sum()
            # a ring has a mode and its mirror image: the covariance of the mean times n / 2
            both_ways = (masks[r + m] * spread).sum() / number / other
            result[m] += both_ways * np.sqrt(number * other) / len(rings)
    return result


@pytest.mark.parametrize("shape", [(96, 96), (64, 128)])
@pytest.mark.parametrize("window", ["split-cosine-bell", "hann", "blackman"])
def test_overlapping_tiles_are_as_alike_as_every_pair_of_modes_says(window, shape):
    for part in ((0, 0), (0.5, 0), (0, 0.5), (0.5, 0.5), (0.25, 0.75)):
        shift = tuple(int(share * n) for share, n in zip(part, shape, strict=True))
        true = pairs_of_modes(window, shape, shift, range(20, 30))
        result = np.zeros(4)
        stated = _core.tile_covariances(WINDOWS.index(window), shape, (PIXEL, PIXEL), shift)
        result[: min(4, stated.size)] = stated[:4]
        alone = pairs_of_modes(window, shape, (0, 0), range(20, 30))[0]
        assert result == pytest.approx(true, abs=0.03 * alone), part


def test_one_tile_is_the_whole_map():
    z = surface(LAWS["road"], (300, 260), PIXEL, 1)
    whole = power_spectrum(HeightMap(z, pixel_size=PIXEL))
    assert power_spectrum(z, pixel_size=PIXEL) == whole
    assert power_spectrum(HeightMap(z, pixel_size=PIXEL), tiles=(300, 260)) == whole


@pytest.mark.parametrize("name", list(LAWS))
def test_rows_of_the_coarse_map_are_those_of_the_whole(name):
    z = surface(LAWS[name], (1100, 1536), PIXEL, 2)
    whole = power_spectrum(HeightMap(z, pixel_size=PIXEL))
    tiled = power_spectrum(z, pixel_size=PIXEL, tiles=512, overlap=0)
    low = tiled.wavenumber < 31.5 * 2 * np.pi / (512 * PIXEL)
    rows = np.count_nonzero(low)
    assert rows == 94
    assert tiled.wavenumber[low] == pytest.approx(whole.wavenumber[:rows], rel=0.02)
    error = whole.standard_error[:rows]
    miss = (tiled.density[low] - whole.density[:rows]) / error
    # the same modes; of white heights some of the power that is folded back and taken off again
    most, off = (0.3, 0.006) if name == "white" else (0.02, 5e-4)
    assert np.sqrt(np.mean(miss[16:] ** 2)) < most
    mean = np.average(
        tiled.density[low][48:] / whole.density[48:rows], weights=whole.count[48:rows]
    )
    assert mean == pytest.approx(1, abs=off)
    ratio = tiled.standard_error[low] / error
    assert np.median(ratio) == pytest.approx(1, abs=0.02)


class Counted(ThreadPoolExecutor):
    works = 0

    def submit(self, *call):
        self.works += 1
        return super().submit(*call)


def test_one_tile_is_computed_where_many_would_be():
    z = surface(LAWS["road"], (300, 260), PIXEL, 1)
    whole = power_spectrum(z, pixel_size=PIXEL)
    with Counted(1) as executor:
        assert power_spectrum(z, pixel_size=PIXEL, executor=executor) == whole
        assert executor.works == 1
    assert power_spectrum(z, pixel_size=PIXEL, threads=2) == whole


def test_rows_of_which_the_folded_roughness_leaves_little_are_flagged():
    # heights of a filter that takes long waves off: short ones, folded back, drown what is left
    edge = 40 * 2 * np.pi / (512 * PIXEL)
    z = surface(lambda q: np.where(q < edge, 1e-36, 1e-30), (1024, 1024), PIXEL, 3)
    result = power_spectrum(z, pixel_size=PIXEL, tiles=512)
    low = result.wavenumber < 31.5 * 2 * np.pi / (512 * PIXEL)
    nothing = result.density == 0
    assert nothing.any()
    assert low[nothing].all()
    assert not result.reliable[low].any()
    assert (np.asarray(result.flag)[low] & 4).all()
    assert (result.standard_error[nothing] > 0).all()
    assert result.reliable[~low].any()


def test_the_error_of_what_is_taken_off_is_in_that_of_the_row():
    q = np.linspace(1, 60, 40) * 2 * np.pi / (512 * PIXEL)
    other = np.linspace(21, 300, 200) * 2 * np.pi / (512 * PIXEL)
    coarse = Coarse(np.zeros((256, 256)), (2, 2), (2 * PIXEL, 2 * PIXEL), 0.0)
    ones = np.ones_like(q)
    rows = {"wavenumber": q, "density": 5 * ones, "standard_error": 0.5 * ones}
    rows["flag"] = np.zeros(q.size, np.uint8)

    def taken(density, error):
        fine = {"wavenumber": other, "density": np.full_like(other, density)}
        fine["standard_error"] = np.full_like(other, error)
        return SimpleNamespace(**without_blocks(rows, coarse, (PIXEL, PIXEL), fine))

    sure, unsure, plain = taken(1.0, 0.0), taken(1.0, 0.1), taken(0.0, 0.0)
    folded = plain.density - sure.density  # of a density of 1
    assert folded[-1] > 0.05
    assert sure.standard_error == pytest.approx(plain.standard_error, rel=1e-12)
    assert unsure.standard_error == pytest.approx(
        np.hypot(sure.standard_error, 0.1 * folded), rel=1e-12
    )
    much = taken(100.0, 0.0)
    flagged = much.standard_error > much.density / 4
    assert 0 < np.count_nonzero(flagged) < q.size
    assert (much.flag == 4 * flagged).all()
    assert (sure.flag == 0).all()


@pytest.mark.parametrize("window", ["split-cosine-bell", "hann", "blackman"])
@pytest.mark.parametrize("name", list(LAWS))
def test_the_truth_is_within_the_errors(name, window):
    z = surface(LAWS[name], (1400, 1150), PIXEL, 3, dtype=np.float32)
    result = power_spectrum(z, pixel_size=PIXEL, tiles=(512, 640), window=window)
    pulls = pull_of(result, LAWS[name])
    assert np.abs(pulls).max() < 4
    assert np.sqrt(np.mean(pulls**2)) < 1.7


def test_tilt_lay_holes_and_pixels_that_are_not_square():
    pixel, truth = (2e-6, 1e-6), law(0.8)
    z = surface(truth, (1100, 2048), pixel, 4, stretch=1.5)
    rms = np.std(z)
    z = with_holes(tilted(z, tilt=30 * rms, bow=rms), 0.03, 5, blob=3)
    result = power_spectrum(z, pixel_size=pixel, tiles=(512, 1024), detrend="quadratic")
    pulls = pull_of(result, ring_mean(truth, 1.5))
    low = pulls[:9]  # holes that are filled take from the shortest waves
    assert np.abs(low).max() < 4
    assert np.sqrt(np.mean(low**2)) < 1.7


@pytest.mark.parametrize(
    ("window", "seeds"),
    [("split-cosine-bell", 12), ("hann", 12), long("split-cosine-bell", 300), long("hann", 300)],
)
def test_standard_errors_are_the_scatter(window, seeds):
    spectra = []
    for seed in range(seeds):
        z = surface(law(0.7), (1024, 1024), PIXEL, seed, dtype=np.float32)
        spectra.append(power_spectrum(z, pixel_size=PIXEL, tiles=512, window=window))
    density = np.array([s.density for s in spectra])
    error = np.array([s.standard_error for s in spectra]).mean(axis=0) / density.mean(axis=0)
    scatter = density.std(axis=0, ddof=1) / density.mean(axis=0)
    q = spectra[0].wavenumber
    first = 2 * np.pi / (512 * PIXEL)
    for low, high in ((8, 16), (16, 31), (33, 64), (64, 128)):  # the coarse map's, then the tiles'
        rows = (q >= low * first) & (q < high * first)
        ratio = error[rows].mean() / np.sqrt(np.mean(scatter[rows] ** 2))
        # 16 rows or more, of which neighbours are alike: known to 1 / sqrt(2 seeds 16 / 2)
        assert ratio == pytest.approx(1, abs=0.05 + 2.5 / np.sqrt(16 * seeds)), (low, high)


def test_numbers_do_not_depend_on_who_computes():
    z = surface(LAWS["road"], (900, 1100), PIXEL, 6, dtype=np.float32)
    z = with_holes(z, 0.02, 1)
    given = {"pixel_size": PIXEL, "tiles": 512}
    alone = power_spectrum(z, **given)
    assert alone == power_spectrum(z, **given, threads=3)
    assert alone == power_spectrum(HeightMap(z, pixel_size=PIXEL), tiles=512)
    with ThreadPoolExecutor(2) as threads:
        assert alone == power_spectrum(z, **given, executor=threads)
    with ProcessPoolExecutor(2, mp_context=get_context("forkserver")) as processes:
        assert alone == power_spectrum(z, **given, executor=processes)


def test_tiles_go_to_a_dask_cluster(tmp_path):
    distributed = pytest.importorskip("distributed")
    dask, zarr = pytest.importorskip("dask.array"), pytest.importorskip("zarr")
    z = surface(LAWS["road"], (700, 600), PIXEL, 6)
    np.save(tmp_path / "map.npy", z)
    stored = zarr.create_array(tmp_path / "map.zarr", data=z, chunks=(256, 256))
    given = {"pixel_size": PIXEL, "tiles": 512, "overlap": 0}
    alone = power_spectrum(z, **given)
    assert power_spectrum(np.load(tmp_path / "map.npy", mmap_mode="r"), **given) == alone
    with (
        distributed.LocalCluster(
            n_workers=1, threads_per_worker=1, dashboard_address=":0", silence_logs=50
        ) as cluster,
        distributed.Client(cluster) as client,
    ):
        for array in (stored, dask.from_zarr(stored), z):
            assert power_spectrum(array, **given, executor=client) == alone


def test_a_tile_with_too_many_holes_is_left_out():
    z = surface(LAWS["road"], (1024, 1536), PIXEL, 7)
    z[:200, :200] = np.nan  # 15 % of a tile, 2.5 % of the map
    result = power_spectrum(z, pixel_size=PIXEL, tiles=512, overlap=0)
    lonely = [
        power_spectrum(HeightMap(part.copy(), pixel_size=PIXEL))
        for y in (0, 512)
        for x in (0, 512, 1024)
        if not np.isnan(part := z[y : y + 512, x : x + 512]).any()
    ]
    assert len(lonely) == 5
    mean = np.mean([s.density for s in lonely], axis=0)
    assert result.density[-300:] == pytest.approx(mean[-300:], rel=1e-12)
    error = np.sqrt(np.sum([s.standard_error**2 for s in lonely], axis=0)) / 5
    assert result.standard_error[-300:] == pytest.approx(error[-300:], rel=1e-12)
    # the rows of all tiles stand for the modes of the whole map
    assert result.count[-300:] == pytest.approx(lonely[0].count[-300:] * 6, rel=1e-12)
    everyone = power_spectrum(z, pixel_size=PIXEL, tiles=512, overlap=0, max_dropouts=0.2)
    ratio = everyone.standard_error[-300:-100] / result.standard_error[-300:-100]
    assert np.median(ratio) == pytest.approx(np.sqrt(5 / 6), abs=0.02)


def test_the_mean_square_height_is_that_of_the_map():
    z = surface(law(0.8, rolloff=3e5), (1024, 1024), PIXEL, 8)
    result = power_spectrum(z, pixel_size=PIXEL, tiles=512)
    square = np.sum(result.density * result.count) * (2 * np.pi) ** 2 / (z.size * PIXEL**2)
    assert square == pytest.approx(np.var(z), rel=0.03)


def test_a_fit_takes_it_as_any_other():
    z = surface(law(0.8), (1500, 1500), PIXEL, 9, dtype=np.float32)
    fit = fit_self_affine(power_spectrum(z, pixel_size=PIXEL, tiles=512))
    assert abs(fit.hurst - 0.8) < 4 * fit.standard_errors["hurst"] < 0.02


MAP = np.random.default_rng(1).normal(size=(600, 700))
HOLED = np.where(np.random.default_rng(2).random(MAP.shape) < 0.2, np.nan, MAP)
ENDLESS = np.where(np.arange(MAP.size).reshape(MAP.shape) == 300 * 700 + 650, np.inf, MAP)
CHECKED = with_holes(MAP, 0.09, 3)
BAD = [
    ("tiles", {"tiles": 800}),
    ("tiles", {"tiles": 256}),
    ("tiles", {"tiles": (512, 512, 1)}),
    ("tiles", {"tiles": 512.5}),
    ("tiles", {"tiles": -512}),
    ("tiles", {"tiles": "512"}),
    ("tiles", {"pixel_size": (1, 9)}),
    ("overlap", {"overlap": 0.8}),
    ("overlap", {"overlap": np.nan}),
    ("window", {"window": "none"}),
    ("part", {"part": "top"}),
    ("max_dropouts", {"max_dropouts": 1}),
    ("threads", {"threads": 2, "executor": ThreadPoolExecutor(1)}),
    ("executor", {"executor": map}),
    ("heights", {"surface": HOLED}),
    ("heights[300, 650]", {"surface": ENDLESS}),
    ("heights", {"surface": np.full((600, 700), np.nan)}),
    ("pixel_size", {"surface": HeightMap(MAP, pixel_size=1)}),
    ("surface", {"surface": MAP[0], "tiles": None}),
    ("pixel_size", {"surface": HeightMap(MAP, pixel_size=1), "tiles": None}),
    *(
        (name, {"surface": HeightMap(MAP, pixel_size=1), "pixel_size": None, "tiles": None} | given)
        for name, given in (
            ("overlap", {"overlap": 0.5}),
            ("max_dropouts", {"max_dropouts": 0.5}),
            ("executor", {"executor": ThreadPoolExecutor(1)}),
        )
    ),
]


@pytest.mark.parametrize(("argument", "given"), BAD)
def test_bad_input_is_one_line(argument, given):
    with pytest.raises(InvalidInput) as caught:
        power_spectrum(**({"surface": MAP, "pixel_size": 1.0, "tiles": 512} | given))
    assert caught.value.argument == argument
    assert "\n" not in str(caught.value)


def test_all_tiles_may_have_too_many_holes():
    corners = MAP.copy()
    corners[90:510, 190:290] = np.nan  # 10 % of the map: all four tiles have 15 % or more
    with pytest.raises(InvalidInput, match="all 4 tiles"):
        power_spectrum(corners, pixel_size=1, tiles=512, overlap=0, max_dropouts=0.1)
