"""What crops that are not periodic do to spectra and fits: biases, errors, roll-offs."""

import sys
from functools import lru_cache
from pathlib import Path

import numpy as np
import pytest

from asperity import (
    HeightMap,
    InvalidInput,
    SelfAffineSpectrum,
    TabulatedSpectrum,
    fit_self_affine,
    power_spectrum,
    synthesize,
)
from helpers.cases import long

sys.path.insert(0, str(Path(__file__).parents[2] / "stability"))
from fit_coverage import fitted, scans

WINDOWS = ["split-cosine-bell", "hann"]
PAIRS = [(0.3, "hann"), (0.8, "split-cosine-bell")]
PAIRS += [long(0.3, "split-cosine-bell"), long(0.8, "hann")]
PIXEL = 1e-6


@lru_cache(maxsize=1)
def crops(hurst):
    """Five crops of 1024^2 points from periodic maps of 2048^2."""
    spectrum = SelfAffineSpectrum(
        rms_height=1e-5, hurst=hurst, q0=2 * np.pi / (2048 * PIXEL), q1=np.pi / PIXEL
    )
    result = []
    for seed in range(5):
        whole = synthesize(spectrum, shape=(2048, 2048), pixel_size=PIXEL, seed=seed)
        crop = whole.heights[512:1536, 300:1324].copy()
        result.append(HeightMap(crop, pixel_size=PIXEL))
    return result


def misses(surfaces, hurst, window, **band):
    spectra = [power_spectrum(surface, window=window) for surface in surfaces]
    return np.array([fit_self_affine(s, **band).hurst for s in spectra]) - hurst


@pytest.mark.parametrize("window", WINDOWS)
@pytest.mark.parametrize("hurst", [long(0.3), long(0.5), 0.87])
def test_hurst_exponent_of_crops_has_no_bias(hurst, window):
    for band in ({}, {"q_min": 16 * 2 * np.pi / (1024 * PIXEL), "q_max": np.pi / PIXEL}):
        miss = misses(crops(hurst), hurst, window, **band)
        assert abs(miss.mean()) < 0.005
        assert miss.std(ddof=1) < 0.02
        assert np.abs(miss).max() < 0.02


def test_without_a_window_a_crop_has_the_slope_of_its_own_edges():
    # H = 0.87 comes out as 0.49 over all reliable rows, as 0.30 from k = 16 to Nyquist
    assert misses(crops(0.87), 0.87, "none").max() < -0.2
    band = {"q_min": 16 * 2 * np.pi / (1024 * PIXEL), "q_max": np.pi / PIXEL}
    assert misses(crops(0.87), 0.87, "none", **band).max() < -0.5


def gaussian(hurst, seed, *, size=512, knee=1):
    """A Gaussian map, periodic, flat below `knee` modes a side: filtered noise."""
    k = np.fft.fftfreq(size) * size
    q = np.maximum(np.hypot(k[:, None], k[: size // 2 + 1]), knee)
    noise = np.random.default_rng(seed).normal(size=(size, size))
    return np.fft.irfft2(np.fft.rfft2(noise) * q ** -(1 + hurst), s=(size, size))


def quarters(hurst, seeds, **options):
    """Two crops of each map that do not touch."""
    for seed in range(seeds):
        z = gaussian(hurst, seed, **options)
        half = len(z) // 2
        yield from (
            HeightMap(part.copy(), pixel_size=1) for part in (z[:half, :half], z[half:, half:])
        )


@pytest.mark.parametrize(("hurst", "window"), PAIRS)
def test_standard_errors_of_rings_are_their_scatter(hurst, window):
    spectra = [power_spectrum(surface, window=window) for surface in quarters(hurst, 60)]
    density = np.array([s.density for s in spectra])
    error = np.array([s.standard_error for s in spectra]).mean(axis=0) / density.mean(axis=0)
    scatter = density.std(axis=0, ddof=1) / density.mean(axis=0)
    k = np.arange(1, density.shape[1] + 1)
    for low, high in ((8, 16), (16, 32), (32, 64), (64, 128)):
        octave = (k >= low) & (k < high)
        # 120 maps, 8 rings or more: the scatter is known to 1 / sqrt(2 120 8) = 2 %
        ratio = error[octave].mean() / np.sqrt(np.mean(scatter[octave] ** 2))
        assert ratio == pytest.approx(1, abs=0.1), (low, high)


def test_standard_errors_of_logarithmic_bins_are_their_scatter():
    binned = [power_spectrum(surface).log_binned() for surface in quarters(0.3, 60)]
    density = np.array([s.density for s in binned])
    error = np.array([s.standard_error for s in binned]).mean(axis=0)
    ratio = (error / density.std(axis=0, ddof=1))[binned[0].reliable]
    assert ratio.mean() == pytest.approx(1, abs=0.1)
    assert np.all((ratio > 0.75) & (ratio < 1.25))  # each scatter is known to 6 %


@pytest.mark.parametrize("window", WINDOWS)
def test_errors_of_fits_cover_the_truth(window):
    pulls = []
    for surface in quarters(0.8, 40):
        fit = fit_self_affine(power_spectrum(surface, window=window))
        assert fit.rolloff is None  # 80 maps without one
        pulls.append((fit.hurst - 0.8) / fit.standard_errors["hurst"])
    rms = np.sqrt(np.mean(np.square(pulls)))
    assert 0.5 < rms < 2
    assert abs(np.mean(pulls)) < 0.5


@pytest.mark.parametrize(("hurst", "window"), PAIRS)
def test_a_roll_off_is_found_where_it_is(hurst, window):
    pulls = {"rolloff": [], "hurst": []}
    for surface in quarters(hurst, 8, size=1024, knee=80):
        fit = fit_self_affine(power_spectrum(surface, window=window), rolloff="require")
        truth = {"rolloff": 80 * 2 * np.pi / 1024, "hurst": hurst}
        assert fit.rolloff == pytest.approx(truth["rolloff"], rel=0.1)
        for name, pull in pulls.items():
            pull.append((getattr(fit, name) - truth[name]) / fit.standard_errors[name])
        level = fit.spectrum.at(fit.q0)
        assert level == fit.spectrum.at(fit.rolloff * (1 - 1e-9))
    for name, pull in pulls.items():
        assert 0.5 < np.sqrt(np.mean(np.square(pull))) < 2, name
        assert np.abs(np.mean(pull)) < 3 * 1.5 / np.sqrt(len(pull)), name
    assert np.abs(pulls["rolloff"]).max() < 4


def test_a_roll_off_of_an_exact_spectrum_comes_back():
    spectrum = SelfAffineSpectrum(rms_height=1e-5, hurst=0.8, q0=1e3, q1=1e6, rolloff=2e4)
    q = np.unique([*np.geomspace(1e3, 1e6, 80), 2e4])
    table = TabulatedSpectrum(wavenumber=q, density=spectrum.at(q))
    fit = fit_self_affine(table)
    assert fit.rolloff == pytest.approx(2e4, rel=1e-6)
    assert fit.hurst == pytest.approx(0.8, rel=1e-6)
    assert fit.rms_height == pytest.approx(1e-5, rel=1e-6)
    assert fit_self_affine(table, rolloff="none").rolloff is None


def test_no_roll_off_is_found_where_none_is():
    result = [fit_self_affine(power_spectrum(s)).rolloff for s in quarters(0.5, 15)]
    assert result == [None] * 30


def test_a_roll_off_that_the_scan_does_not_reach_is_refused_with_the_reason():
    z = gaussian(0.8, 1, size=1024, knee=3)  # lambda_0 a third of the whole, the scan a quarter
    spectrum = power_spectrum(HeightMap(z[:256, :256].copy(), pixel_size=1))
    assert fit_self_affine(spectrum).rolloff is None
    with pytest.raises(InvalidInput, match=r"no roll-off between .* smaller than lambda_0"):
        fit_self_affine(spectrum, rolloff="require")
    with pytest.raises(InvalidInput, match=r"^rolloff: cannot be required of method \"slope\""):
        fit_self_affine(spectrum, rolloff="require", method="slope")


@pytest.mark.parametrize("counted", [False, True])
def test_the_slope_method_is_the_plain_line_through_all_rows(counted):
    q = np.geomspace(1e3, 1e6, 50)
    density = q**-3.4 * np.random.default_rng(3).gamma(10, 0.1, size=50)
    count = {"count": q} if counted else {}
    fit = fit_self_affine(TabulatedSpectrum(wavenumber=q, density=density, **count), method="slope")
    line, covariance = np.polyfit(np.log(q), np.log(density), 1, cov=True)
    assert fit.hurst == pytest.approx(-line[0] / 2 - 1, rel=1e-10)
    assert fit.standard_errors["hurst"] == pytest.approx(np.sqrt(covariance[0, 0]) / 2, rel=1e-8)
    assert fit.spectrum.at(q) == pytest.approx(np.exp(np.polyval(line, np.log(q))), rel=1e-9, abs=0)
    left = np.log(density) - np.polyval(line, np.log(q))
    assert fit.residual == pytest.approx(np.sqrt(np.mean(left**2)), rel=1e-9)


BESIDE = [("split-cosine-bell", 22, 0), ("split-cosine-bell", 22, 16), ("hann", 14, 0)]


@pytest.mark.parametrize(("window", "periods", "first"), [*BESIDE, ("blackman", 18, 0)])
def test_errors_of_fits_cover_the_truth_beside_a_roll_off(window, periods, first):
    """From the reliable rows, or from `first` periods a scan on, below which no row then tells.

    tests/stability/fit_coverage.py takes 400 crops, of more roll-offs."""
    band = {"q_min": 2 * np.pi / 256 * first} if first else {}
    result = [
        (h, *fitted(s, window, **band)[:2]) for h, s in scans("filtered", periods, 256, 45, 3)
    ]
    truth, hurst, error = np.array(result).T
    # 95 % of 45: 43, and below 38 once in 300 draws of a binomial
    assert np.sum(np.abs(hurst - truth) < 1.96 * error) >= 38
    assert np.sqrt(np.mean((hurst - truth) ** 2)) < 1.3 * np.median(error)


def test_a_choice_that_the_rows_leave_open_is_in_the_error():
    """Few rows below the roll-off, none of them known to be flat from those before."""
    spectra = [power_spectrum(s) for _, s in scans("filtered", 18, 256, 45, 4)]
    low = {"q_min": 2 * np.pi / 256 * 15.9}
    both = [(fit_self_affine(s, **low), fit_self_affine(s, rolloff="none", **low)) for s in spectra]
    assert {fit.rolloff is None for fit, _ in both} == {True, False}
    errors = [[fit.standard_errors["hurst"] for fit in pair] for pair in both]
    ratio = np.array([result / straight for result, straight in errors])
    doubtful = np.array([fit.rolloff is None for fit, _ in both])
    # a line that is taken for the truth has the error of its own scatter alone
    assert (ratio[doubtful] >= 1).all()
    assert ratio[doubtful].max() > 1.2
    assert all(fit.covariance[2].any() == (fit.rolloff is not None) for fit, _ in both)
