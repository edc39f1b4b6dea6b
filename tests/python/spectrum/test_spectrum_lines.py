"""Spectra of profiles and of the surface behind them: line_density, line_spectrum, isotropic."""

from math import gamma

import numpy as np
import pytest

from asperity import (
    HeightMap,
    LineScan,
    LineSpectrum,
    SelfAffineSpectrum,
    TabulatedSpectrum,
    line_spectrum,
    power_spectrum,
    synthesize,
)
from helpers.cases import long
from helpers.plain_spectrum import profile


def abel_factor(hurst):
    """B(1/2, H + 1/2): C1D = B q C of a power law (THEORY.md section 1)."""
    return gamma(0.5) * gamma(hurst + 0.5) / gamma(hurst + 1)


@pytest.mark.reference("line_density")
def test_line_density_is_the_integral_of_its_definition(row):
    if row["rms_height"] is not None:
        names = ("rms_height", "hurst", "q0", "q1", "rolloff")
        spectrum = SelfAffineSpectrum(**{name: row[name] for name in names})
    else:
        spectrum = TabulatedSpectrum(
            wavenumber=row["table_wavenumber"], density=row["table_density"]
        )
    result = spectrum.line_density(row["wavenumber"])
    assert result == pytest.approx(row["line_density"], rel=row["rtol"], abs=0)


@pytest.mark.parametrize("hurst", [0.01, 0.3, 0.5, 0.8, 1.0])
def test_line_density_of_a_power_law_without_end_is_its_closed_form(hurst):
    # what is cut off at q1 is (q / q1)^(2 H + 1) of the whole or less
    spectrum = SelfAffineSpectrum(rms_height=1e-5, hurst=hurst, q0=1e3, q1=1e22)
    q = np.geomspace(1e3, 1e6, 7)
    expected = abel_factor(hurst) * q * spectrum.at(q)
    np.testing.assert_allclose(spectrum.line_density(q), expected, rtol=1e-12)


def test_line_density_integrates_to_the_mean_square_height():
    spectrum = SelfAffineSpectrum(rms_height=1e-5, hurst=0.8, q0=1e3, q1=1e5, rolloff=4e3)
    nodes, weights = np.polynomial.legendre.leggauss(40)
    total = 0.0
    for low, high in ((0, 1e3), (1e3, 4e3), (4e3, 2e4), (2e4, 1e5)):
        # roots sqrt(end - q) at the ends: q = low + (high - low) sin^2(t)
        t = np.pi / 4 * (nodes + 1)
        q = low + (high - low) * np.sin(t) ** 2
        dq = np.pi / 4 * (high - low) * np.sin(2 * t)
        total += np.sum(weights * dq * spectrum.line_density(q))
    assert 2 * total == pytest.approx(spectrum.rms_height**2, rel=1e-9, abs=0)


@pytest.mark.parametrize("rows", [2, 40, 300])
@pytest.mark.parametrize("hurst", [0.3, 0.5, 0.8, 1.0])
def test_isotropic_restores_a_power_law(hurst, rows):
    q = np.geomspace(1e3, 1e6, rows)
    c = 1e-5 * q ** (-2 * hurst - 2)
    profiles = LineSpectrum(wavenumber=q, density=abel_factor(hurst) * q * c)
    result = profiles.isotropic(per_decade=None)
    np.testing.assert_array_equal(result.wavenumber, q)
    np.testing.assert_allclose(result.density, c, rtol=1e-11)


def round_trip(hurst, per_decade):
    """Wavenumbers over the roll-off, and the relative error of isotropic(line_density)."""
    knee = 1e5
    spectrum = SelfAffineSpectrum(rms_height=1e-5, hurst=hurst, q0=1.0, q1=1e16, rolloff=knee)
    q = np.geomspace(knee / 100, knee * 10, 3 * per_decade + 1)
    profiles = LineSpectrum(wavenumber=q, density=spectrum.line_density(q))
    result = profiles.isotropic(per_decade=None).density
    return q / knee, np.abs(result / spectrum.at(q) - 1)


@pytest.mark.parametrize("hurst", [long(0.3), 0.8, long(1.0)])
def test_isotropic_restores_a_roll_off(hurst):
    # Above the roll-off C1D is a power law, so exact. In the flat part the chords between rows h
    # apart in ln q are off by h^2 / 8 of the curvature, which grows like (knee - q)^(-1/2) there.
    q, error = round_trip(hurst, 300)
    assert error[q > 1.0001].max() < 1e-11
    assert error[q < 0.1].max() < 1e-4
    assert error[q < 0.9].max() < 1e-3
    coarser = round_trip(hurst, 100)[1]
    assert coarser.max() < 0.02
    order = np.log(coarser[0] / error[0]) / np.log(3)
    assert order > 1.7  # of h, where the curvature is bounded


PIXEL = 1e-6
CROPS = [(slice(0, 1024), slice(0, 1024)), (slice(1024, 2048), slice(1024, 2048))]


@pytest.mark.parametrize("hurst", [long(0.3), 0.8, long(1.0)])
def test_rows_of_a_map_tell_the_spectrum_of_the_surface(hurst):
    truth = SelfAffineSpectrum(
        rms_height=1e-5, hurst=hurst, q0=2 * np.pi / (2048 * PIXEL), q1=np.pi / PIXEL
    )
    ratios = {"isotropic": [], "map": [], "short cut": []}
    errors = {"isotropic": [], "map": []}
    for seed in range(3):
        whole = synthesize(truth, shape=(2048, 2048), pixel_size=PIXEL, seed=seed)
        for crop in CROPS:
            surface = HeightMap(whole.heights[crop], pixel_size=PIXEL)
            lines = line_spectrum(surface)
            rings = power_spectrum(surface).log_binned()
            result = {"isotropic": lines.isotropic(), "map": rings}
            for name, spectrum in result.items():
                # the surface ends at Nyquist, a power law does not: its last rows differ
                ok = spectrum.reliable & (spectrum.wavenumber < 0.45 * truth.q1)
                expected = truth.at(spectrum.wavenumber[ok])
                ratios[name].append(spectrum.density[ok] / expected)
                errors[name].append(spectrum.standard_error[ok] / expected)
            binned = lines.log_binned()
            ok = binned.reliable & (binned.wavenumber < 0.2 * truth.q1)
            one_sided = 2 * binned.density[ok] / (2 * np.pi * binned.wavenumber[ok])
            ratios["short cut"].append(one_sided / truth.at(binned.wavenumber[ok]))
    for name, relative in errors.items():
        miss = np.abs(np.mean(ratios[name], axis=0) - 1)
        allowed = 3 * np.mean(relative, axis=0) / np.sqrt(len(relative))
        assert np.all(miss < np.maximum(allowed, 0.01)), (name, miss, allowed)
        assert len(miss) >= 11
    wrong = np.mean(ratios["short cut"])
    assert wrong == pytest.approx(abel_factor(hurst) / np.pi, rel=0.04)
    assert wrong < 0.75


@pytest.mark.parametrize("rows", [0, 1, 6])  # 0: a LineScan
@pytest.mark.parametrize("n", [4, 5, 64, 97, 210])
@pytest.mark.parametrize("window", ["split-cosine-bell", "hann", "none", "blackman"])
@pytest.mark.parametrize("detrend", ["plane", "quadratic", "offset", None])
def test_line_spectrum_is_that_of_a_plain_transform(window, detrend, n, rows):
    z = np.random.default_rng(n + rows).normal(size=(max(rows, 1), n)) * 1e-6 + 2e-6
    dx = 0.7e-6
    scan = HeightMap(z, pixel_size=(3e-6, dx)) if rows else LineScan(z[0], spacing=dx)
    result = line_spectrum(scan, window=window, detrend=detrend)
    w, u = profile(window, n), np.linspace(-1, 1, n)
    degree = {"offset": 0, "plane": 1, "quadratic": 2}.get(detrend)
    flat = z if degree is None else z - [np.polyval(np.polyfit(u, row, degree), u) for row in z]
    power = np.abs(np.fft.rfft(flat * w)) ** 2
    expected = (power * n * dx / (2 * np.pi * n**2) / np.mean(w**2)).mean(axis=0)[1:]
    q = 2 * np.pi * np.fft.rfftfreq(n, dx)[1:]
    np.testing.assert_allclose(result.wavenumber, q, rtol=1e-14)
    np.testing.assert_allclose(result.density, expected, rtol=1e-10, atol=1e-13 * expected.max())
    if window == "none" and detrend is not None:
        total = np.sum(result.density * result.count) / len(z) * 2 * np.pi / (n * dx)
        assert total == pytest.approx(np.mean(flat**2), rel=1e-9, abs=0)


@pytest.mark.parametrize("part", ["top", "bottom"])
@pytest.mark.parametrize("rows", [0, 3])
@pytest.mark.parametrize("detrend", ["plane", None])
def test_a_part_of_a_profile_is_its_clipped_heights_over_their_share(detrend, rows, part):
    z = np.random.default_rng(rows).gumbel(size=(max(rows, 1), 210)) * 1e-6 + 2e-6
    scan = HeightMap(z, pixel_size=1e-6) if rows else LineScan(z[0], spacing=1e-6)
    result = line_spectrum(scan, detrend=detrend, part=part)
    u = np.arange(210)
    flat = z if detrend is None else z - [np.polyval(np.polyfit(u, row, 1), u) for row in z]
    about = flat - flat.mean(axis=1, keepdims=True)
    clipped = np.maximum(about, 0) if part == "top" else np.minimum(about, 0)
    whole = line_spectrum(HeightMap(clipped, pixel_size=1e-6), detrend="offset")
    np.testing.assert_allclose(result.density, whole.density / np.mean(clipped != 0), rtol=1e-9)
    assert result.skewness is None
    assert np.array_equal(result.count, whole.count)


def test_a_flat_profile_has_no_top():
    assert np.all(line_spectrum(LineScan(np.ones(64), spacing=1.0), part="top").density == 0)


def test_line_spectrum_of_a_float32_scan_is_that_of_its_own_numbers():
    z = np.random.default_rng(2).normal(size=500).astype("f4")
    result = line_spectrum(LineScan(z, spacing=1e-6))
    assert result == line_spectrum(LineScan(z.astype(float), spacing=1e-6))


def test_line_spectrum_looks_along_the_rows():
    y, x = np.indices((64, 256))
    along_x = line_spectrum(HeightMap(np.sin(2 * np.pi * 20 * x / 256), pixel_size=1))
    assert np.argmax(along_x.density) == 19  # 20 periods
    along_y = line_spectrum(HeightMap(np.sin(2 * np.pi * 8 * y / 64), pixel_size=1))
    assert along_y.density.max() < 1e-25 * along_x.density.max()
