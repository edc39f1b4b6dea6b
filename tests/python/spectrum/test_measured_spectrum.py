"""From a map to its spectrum and back: power_spectrum, synthesize, fit_self_affine."""

import numpy as np
import pytest

from asperity import (
    HeightMap,
    SelfAffineSpectrum,
    TabulatedSpectrum,
    fit_self_affine,
    power_spectrum,
    synthesize,
)
from helpers.plain_spectrum import modes, plain

RNG = np.random.default_rng(11)
GRIDS = [
    ((64, 64), (1e-6, 1e-6)),
    ((48, 80), (1e-6, 1e-6)),
    ((80, 48), (3e-6, 1e-6)),
    ((33, 51), (1e-6, 2.5e-6)),
    ((40, 51), (0.7e-6, 1e-6)),
    ((51, 40), (1e-6, 1e-6)),
    ((2, 90), (1e-6, 1e-6)),
    ((7, 5), (1e-6, 4e-6)),
    ((127, 131), (1e-6, 1e-6)),  # prime
    ((211, 64), (1e-6, 3e-6)),
]


@pytest.mark.parametrize("detrend", ["plane", "quadratic", "offset", None])
@pytest.mark.parametrize("window", ["split-cosine-bell", "hann", "none", "blackman"])
@pytest.mark.parametrize(("shape", "pixel"), GRIDS)
def test_every_ring_is_that_of_a_plain_transform(shape, pixel, window, detrend):
    z = RNG.normal(size=shape) * 1e-6 + 2e-6
    result = power_spectrum(HeightMap(z, pixel_size=pixel), window=window, detrend=detrend)
    q, density, count = plain(z, pixel, window, detrend)
    np.testing.assert_allclose(result.wavenumber, q, rtol=1e-12)
    np.testing.assert_array_equal(result.count, count)
    # a ring that the detrending all but empties keeps the rounding of the whole transform
    np.testing.assert_allclose(result.density, density, rtol=1e-12, atol=1e-14 * density.max())


@pytest.mark.parametrize("window", ["split-cosine-bell", "hann"])
def test_the_window_takes_no_variance_from_white_noise(window):
    shape, pixel = (400, 500), 1e-6
    density = [
        power_spectrum(
            HeightMap(np.random.default_rng(seed).normal(size=shape), pixel_size=pixel),
            window=window,
        )
        for seed in range(4)
    ]
    mean = np.mean([np.average(s.density, weights=s.count) for s in density])
    assert mean == pytest.approx(
        pixel**2 / (2 * np.pi) ** 2, rel=5e-3, abs=0
    )  # sqrt(2 / 800 000) = 0.0016


@pytest.mark.parametrize("offset", [0, 1e4])
def test_a_float32_map_has_the_spectrum_of_its_own_numbers_in_single_precision(offset):
    z = (RNG.normal(size=(40, 60)) + offset).astype("f4")
    result = power_spectrum(HeightMap(z, pixel_size=1e-6)).density
    expected = power_spectrum(HeightMap(z.astype(float), pixel_size=1e-6)).density
    # rounding of some ten butterflies at 6e-8 each, squared
    np.testing.assert_allclose(result, expected, rtol=2e-6)


@pytest.mark.parametrize("threads", [2, 3, 7])
def test_threads_share_the_work_without_changing_the_result(threads):
    surface = HeightMap(RNG.normal(size=(37, 53)), pixel_size=(1e-6, 2e-6))
    one, many = power_spectrum(surface), power_spectrum(surface, threads=threads)
    np.testing.assert_array_equal(many.count, one.count)
    np.testing.assert_allclose(many.wavenumber, one.wavenumber, rtol=1e-14)
    np.testing.assert_allclose(many.density, one.density, rtol=1e-13)


def test_a_large_offset_and_tilt_do_not_reach_the_spectrum():
    z = RNG.normal(size=(60, 50))
    y, x = np.indices(z.shape)
    tilted = HeightMap(z + 1e6 + 300 * y - 200 * x, pixel_size=1e-6)
    expected = power_spectrum(HeightMap(z, pixel_size=1e-6)).density
    np.testing.assert_allclose(power_spectrum(tilted).density, expected, rtol=1e-7)


BAND = SelfAffineSpectrum(rms_height=3e-5, hurst=0.8, q0=2e4, q1=8e5, rolloff=5e4)
TABLE = TabulatedSpectrum(wavenumber=[2e4, 1e5, 8e5], density=[1e-18, 1e-20, 0.0])


@pytest.mark.parametrize("spectrum", [BAND, TABLE])
@pytest.mark.parametrize(("shape", "pixel"), GRIDS[:6])
def test_a_synthesized_map_has_exactly_the_spectrum_asked_for(spectrum, shape, pixel):
    surface = synthesize(spectrum, shape=shape, pixel_size=pixel, seed=3)
    q, ring = modes(shape, pixel)
    inside = (q >= spectrum.q0) & (q <= spectrum.q1)
    c = np.zeros(shape)
    c[inside] = spectrum.at(q[inside])
    count = np.bincount(ring.ravel())
    expected = np.bincount(ring.ravel(), c.ravel())[1:][count[1:] > 0] / count[1:][count[1:] > 0]
    result = power_spectrum(surface, window="none", detrend=None)
    np.testing.assert_allclose(result.density, expected, rtol=1e-9, atol=1e-12 * c.max())
    area = q.size * pixel[0] * pixel[1]
    rms_height = np.sqrt(np.sum(c) * (2 * np.pi) ** 2 / area)
    assert surface.rms_height == pytest.approx(rms_height, rel=1e-12, abs=0)
    assert surface.heights.shape == shape
    assert surface.pixel_size == pixel
    assert abs(surface.heights.mean()) < 1e-12 * rms_height


def test_one_seed_gives_one_map():
    options = {"shape": (64, 96), "pixel_size": 2e-6}
    first, again = (synthesize(BAND, **options, seed=12) for _ in range(2))
    np.testing.assert_array_equal(first.heights, again.heights)
    others = [synthesize(BAND, **options, seed=seed).heights for seed in (0, 1, 13, 2**40)]
    correlations = np.corrcoef([first.heights.ravel(), *(z.ravel() for z in others)])
    assert np.max(np.abs(correlations - np.eye(5))) < 0.5


def exact_rows(hurst, q):
    spectrum = SelfAffineSpectrum(rms_height=1e-5, hurst=hurst, q0=q[0], q1=q[-1])
    return spectrum, spectrum.at(q)


@pytest.mark.parametrize("hurst", [0.05, 0.5, 0.87, 1.0])
def test_fit_restores_an_exact_power_law(hurst):
    q = np.geomspace(1e3, 1e6, 40)
    spectrum, density = exact_rows(min(hurst, 1 - 1e-12), q)
    fit = fit_self_affine(TabulatedSpectrum(wavenumber=q, density=density))
    assert fit.hurst == pytest.approx(spectrum.hurst, rel=1e-9)
    assert fit.rms_height == pytest.approx(1e-5, rel=1e-9, abs=0)
    assert (fit.q0, fit.q1, fit.rows) == (q[0], q[-1], 40)
    assert max(fit.standard_errors.values()) < 1e-9


def test_fit_uses_only_the_rows_asked_for():
    q = np.geomspace(1e3, 1e6, 40)
    density = exact_rows(0.7, q)[1]
    density[:10] *= 5
    table = TabulatedSpectrum(wavenumber=q, density=density)
    fit = fit_self_affine(table, q_min=q[10], q_max=q[30])
    assert (fit.q0, fit.q1, fit.rows) == (q[10], q[30], 21)
    assert fit.hurst == pytest.approx(0.7, rel=1e-9)
    assert fit_self_affine(table).hurst > 0.75
    assert fit.spectrum.at(q[10:31]) == pytest.approx(density[10:31], rel=1e-9, abs=0)
