"""A window makes neighbouring rings alike: how much, and what that does to means and fits."""

import numpy as np
import pytest

import asperity
from asperity import HeightMap, InvalidInput, SelfAffineSpectrum, TabulatedSpectrum
from asperity.uncertainty.draws import _draw_rows
from helpers.plain_spectrum import profile

WINDOWS = ["split-cosine-bell", "hann", "blackman"]


def alike(window, shape, rings):
    """Correlation of the means of rings 1, 2, ... apart, every pair of modes one by one.

    cov(|h(k)|^2, |h(l)|^2) is |W(k - l)|^2, W the transform of the squared window: the mean over
    two rings is a sum over all steps of the plane.
    """
    ny, nx = shape
    square = np.outer(profile(window, ny), profile(window, nx)) ** 2
    tie = np.abs(np.fft.fft2(square) / square.sum()) ** 2
    longest = max(shape)
    ky, kx = np.fft.fftfreq(ny) * longest, np.fft.fftfreq(nx) * longest
    radius = np.round(np.hypot(*np.meshgrid(ky, kx, indexing="ij")))
    masks = {r: radius == r for r in range(rings[0], rings[-1] + 4)}
    spread = {r: np.fft.ifft2(np.fft.fft2(tie) * np.fft.fft2(masks[r])).real for r in rings}
    covariance = [
        [(masks[r + m] * spread[r]).sum() / masks[r].sum() / masks[r + m].sum() for m in range(4)]
        for r in rings
    ]
    scale = np.array([[r * (r + m) for m in range(4)] for r in rings]) ** 0.5
    mean = (np.array(covariance) * scale).mean(axis=0)
    return mean[1:] / mean[0]


def surface(seed, shape, hurst=0.8):
    """A crop of a map twice as long, which does not repeat."""
    longest = 2 * max(shape) * 1e-6
    law = SelfAffineSpectrum(
        rms_height=1e-6, hurst=hurst, q0=2 * np.pi / longest, q1=np.pi / 1e-6 * 0.999
    )
    whole = asperity.synthesize(law, shape=(2 * shape[0], 2 * shape[1]), pixel_size=1e-6, seed=seed)
    return HeightMap(heights=np.asarray(whole.heights)[: shape[0], : shape[1]], pixel_size=1e-6)


@pytest.mark.parametrize("shape", [(160, 160), (100, 160), (40, 160)])
@pytest.mark.parametrize("window", WINDOWS)
def test_the_correlation_is_that_of_every_pair_of_modes(window, shape):
    spectrum = asperity.power_spectrum(surface(1, shape), window=window)
    result = np.zeros(3)
    lags = min(3, spectrum.correlation.shape[1])
    result[:lags] = spectrum.correlation[30, :lags]
    expected = alike(window, shape, range(20, 60))
    # the mean over directions is that of rings of many modes; a strip's have a quarter of them
    np.testing.assert_allclose(result, expected, atol=0.01 if shape[0] > 40 else 0.02)
    assert (spectrum.correlation == spectrum.correlation[0]).all()


def test_a_strip_ties_few_rings():
    """Steps along its short side lead over hundreds of rings."""
    strip = HeightMap(heights=np.random.default_rng(1).normal(size=(16, 4096)), pixel_size=1e-6)
    spectrum = asperity.power_spectrum(strip, window="hann")
    assert spectrum.correlation.shape[1] <= 32


def test_without_a_window_rings_are_independent():
    assert asperity.power_spectrum(surface(1, (64, 64)), window="none").correlation is None


@pytest.mark.parametrize("window", WINDOWS)
def test_standard_errors_of_a_fit_are_its_scatter(window):
    """tests/stability/standard_errors.py takes more of them; 120 tell the scatter to 6 %."""
    fits = [
        asperity.fit_self_affine(
            asperity.power_spectrum(surface(seed, (128, 128)), window=window), rolloff="none"
        )
        for seed in range(120)
    ]
    for name in ("hurst", "rms_height"):
        scatter = np.std([getattr(fit, name) for fit in fits])
        stated = np.sqrt(np.mean([fit.standard_errors[name] ** 2 for fit in fits]))
        assert stated / scatter == pytest.approx(1, abs=0.17), name


def rows(seed, count=40, lags=2):
    """A spectrum whose rows are tied at random, and the covariance of its densities."""
    rng = np.random.default_rng(seed)
    q = np.linspace(1e3, 4e4, count)
    density = (q / 1e3) ** -3.5
    error = density * rng.uniform(0.05, 0.2, count)
    band = rng.uniform(0.05, 0.5 / lags, (count, lags))
    covariance = np.diag(error**2)
    for i in range(count):
        for m in range(lags):
            if i + m + 1 < count:
                j = i + m + 1
                covariance[i, j] = covariance[j, i] = band[i, m] * error[i] * error[j]
    spectrum = TabulatedSpectrum(
        wavenumber=q,
        density=density,
        count=rng.integers(10, 100, count),
        standard_error=error,
        correlation=band,
    )
    return spectrum, covariance


def check_errors(result, shares, covariance):
    """Errors and correlation of means that are `shares` of rows of this covariance."""
    expected = shares @ covariance @ shares.T
    error = np.sqrt(np.diag(expected))
    np.testing.assert_allclose(result.standard_error, error, rtol=1e-9)
    correlation = expected / np.outer(error, error)
    for i in range(error.size):
        for j in range(i + 1, error.size):
            m = j - i - 1
            known = result.correlation[i, m] if m < result.correlation.shape[1] else 0.0
            assert known == pytest.approx(correlation[i, j], abs=1e-9)


def test_bins_carry_the_covariance_of_their_rows():
    spectrum, covariance = rows(1)
    binned = spectrum.log_binned(per_decade=10)
    bins = np.floor(np.log10(spectrum.wavenumber / spectrum.wavenumber[0]) * 10 + 1e-9)
    shares = np.zeros((binned.density.size, spectrum.density.size))
    for b, name in enumerate(np.unique(bins)):
        weight = np.where(bins == name, spectrum.count, 0)
        # each row is brought to the mean wavenumber along q^-3.5, which the rows follow exactly
        shares[b] = weight / (weight @ (spectrum.density / binned.density[b]))
    check_errors(binned, shares, covariance)


def test_merged_scans_are_independent_of_each_other():
    one, first = rows(2)
    two, second = rows(3, lags=3)
    merged = asperity.merge_spectra([one, two])
    total = one.count + two.count
    shares = np.hstack([np.diag(one.count / total), np.diag(two.count / total)])
    both = np.block([[first, np.zeros_like(first)], [np.zeros_like(first), second]])
    check_errors(merged, shares, both)


def test_a_cut_keeps_the_correlation_of_its_rows():
    spectrum, _ = rows(4)
    cut = spectrum.truncated(q0=4.5e3, q1=2.05e4)
    inner = slice(1, cut.wavenumber.size - 1)
    first = int(np.flatnonzero(spectrum.wavenumber == cut.wavenumber[1])[0])
    same = spectrum.correlation[first : first + cut.wavenumber.size - 2]
    np.testing.assert_array_equal(cut.correlation[inner], same)


def test_draws_of_rows_have_their_deviations_and_their_correlation():
    spectrum, covariance = rows(5, count=16)
    rng = np.random.default_rng(1)
    draws = np.array([_draw_rows(spectrum, rng).density for _ in range(3000)])
    relative = draws / spectrum.density
    expected = covariance / np.outer(spectrum.density, spectrum.density)
    np.testing.assert_allclose(relative.mean(axis=0), 1, atol=0.02)
    np.testing.assert_allclose(np.cov(relative.T), expected, atol=4e-3)


@pytest.mark.parametrize(
    "correlation",
    [[0.1, 0.2], [[0.1]], [[1.1]] * 40, [[np.nan]] * 40, np.zeros((40, 0)), "alike"],
)
def test_a_correlation_has_a_row_for_each_row(correlation):
    spectrum, _ = rows(1)
    given = {**spectrum._arguments(), "correlation": correlation}
    with pytest.raises(InvalidInput, match=r"^correlation"):
        TabulatedSpectrum(**given)
    given |= {"correlation": [[0.1]] * 40, "standard_error": None}
    with pytest.raises(InvalidInput, match=r"^correlation: standard_error is missing"):
        TabulatedSpectrum(**given)
