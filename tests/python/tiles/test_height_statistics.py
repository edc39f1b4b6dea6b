"""Height statistics of maps that need not fit in memory: they are those of a HeightMap."""

from concurrent.futures import ProcessPoolExecutor, ThreadPoolExecutor
from multiprocessing import get_context

import numpy as np
import pytest

from asperity import HeightMap, InvalidInput, height_statistics
from asperity.tiles import statistics
from helpers.known_surfaces import law, surface, tilted, with_holes

PIXEL = (2e-6, 1e-6)
SHARED = ("rms_height", "rms_slope", "skewness", "kurtosis", "z_max", "z_min", "dropout_fraction")


@pytest.fixture
def small_pieces(monkeypatch):
    """Pieces of 100 points a side: the map below has edges, corners and rests of pieces."""
    monkeypatch.setattr(statistics, "DEFAULT", 100)


def scan(dtype=np.float64, *, holes=0.05):
    z = surface(law(0.8, rolloff=2e5), (301, 453), PIXEL, 1)
    return with_holes(tilted(1e-3 + z, tilt=1e-4, bow=1e-5), holes, 2).astype(dtype)


@pytest.mark.parametrize("holes", [0, 0.05])
@pytest.mark.parametrize("detrend", ["offset", "plane", "quadratic"])
@pytest.mark.parametrize("dtype", [np.float64, np.float32])
def test_they_are_those_of_the_map_in_memory(small_pieces, detrend, dtype, holes):
    z = scan(dtype, holes=holes)
    result = height_statistics(z, pixel_size=PIXEL, detrend=detrend)
    kept = HeightMap(z.astype(float), pixel_size=PIXEL).detrend(detrend)
    for name in SHARED:
        assert getattr(result, name) == pytest.approx(getattr(kept, name), rel=1e-9, abs=1e-12), (
            name
        )
    assert result.mean == pytest.approx(np.nanmean(z.astype(float)), rel=1e-12)


def test_they_are_those_of_the_definition(small_pieces):
    z = scan(holes=0)
    result = height_statistics(z, pixel_size=PIXEL)
    h = z - z.mean()
    rms = np.sqrt(np.mean(h**2))
    slope_y, slope_x = (z[2:] - z[:-2]) / (2 * PIXEL[0]), (z[:, 2:] - z[:, :-2]) / (2 * PIXEL[1])
    assert result.rms_height == pytest.approx(rms, rel=1e-12)
    assert result.skewness == pytest.approx(np.mean(h**3) / rms**3, rel=1e-9)
    assert result.kurtosis == pytest.approx(np.mean(h**4) / rms**4, rel=1e-11)
    slope = np.sqrt(np.mean(slope_y**2) + np.mean(slope_x**2))
    assert result.rms_slope == pytest.approx(slope, rel=1e-12)
    assert (result.z_max, result.z_min) == pytest.approx((h.max(), h.min()), rel=1e-10)


def test_they_do_not_depend_on_who_computes(small_pieces):
    z = scan()
    alone = height_statistics(z, pixel_size=PIXEL, detrend="quadratic")
    assert alone == height_statistics(z, pixel_size=PIXEL, detrend="quadratic", threads=3)
    with ThreadPoolExecutor(2) as threads:
        shared = height_statistics(z, pixel_size=PIXEL, detrend="quadratic", executor=threads)
    with ProcessPoolExecutor(2, mp_context=get_context("forkserver")) as processes:
        sent = height_statistics(z, pixel_size=PIXEL, detrend="quadratic", executor=processes)
    assert alone == shared == sent


def test_a_flat_map_has_no_skewness():
    flat = height_statistics(np.full((5, 6), 2.0), pixel_size=1)
    assert (flat.rms_height, flat.skewness, flat.kurtosis, flat.rms_slope) == (0, 0, 0, 0)
    assert flat.mean == 2


FLAT = np.ones((9, 9))
LONELY = np.full((9, 9), np.nan)  # no point has both neighbours
LONELY[::4, 2::4] = LONELY[2::4, ::4] = 1.0
ENDLESS = np.where(np.arange(81).reshape(9, 9) == 40, -np.inf, 1.0)


@pytest.mark.parametrize(
    ("argument", "given"),
    [
        ("surface", {"surface": [1.0, 2.0, 3.0]}),
        ("heights", {"surface": np.ones((2, 9))}),
        ("surface", {"surface": FLAT + 1j}),
        ("surface", {"surface": "scan.npy"}),
        ("heights", {"surface": np.full((9, 9), np.nan)}),
        ("heights", {"surface": LONELY}),
        ("heights[4, 4]", {"surface": ENDLESS}),
        ("pixel_size", {"pixel_size": None}),
        ("pixel_size", {"pixel_size": 0}),
        ("pixel_size", {"pixel_size": (1, 2, 3)}),
        ("pixel_size", {"surface": HeightMap(FLAT, pixel_size=1)}),
        ("detrend", {"detrend": "cubic"}),
        ("detrend", {"detrend": None}),
        ("threads", {"threads": 0}),
        ("executor", {"executor": 3}),
    ],
)
def test_what_has_no_statistics(argument, given):
    with pytest.raises(InvalidInput) as caught:
        height_statistics(**{"surface": FLAT, "pixel_size": 1} | given)
    assert caught.value.argument == argument
    assert "\n" not in str(caught.value)
