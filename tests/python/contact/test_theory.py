"""What the theory promises of spectra, contact area and pressure: closed forms and limits."""

import math

import numpy as np
import pytest

import asperity
from asperity import HeightMap, PronySeries, SelfAffineSpectrum, TabulatedSpectrum
from helpers.rubbers import prony

NODES, WEIGHTS = np.polynomial.legendre.leggauss(20)
ROAD = SelfAffineSpectrum(rms_height=265.7e-6, hurst=0.87, q0=2e3, q1=1e6)
RUBBER = prony(3e6, [1e9, 3e8, 1e8, 1e7], [1e-8, 1e-6, 1e-4, 1e-2])
SCENE = {"velocity": 0.01, "pressure": 1e6}


def elastic(modulus):
    return PronySeries(equilibrium_modulus=modulus, moduli=[], relaxation_times=[])


def gauss(f, edges):
    """Integral of f over panels, 20 Gauss points each."""
    edges = np.asarray(edges)
    half = np.diff(edges)[:, None] / 2
    return float(np.sum(half * WEIGHTS * f(edges[:-1, None] + half * (1 + NODES))))


def exact_area(g):
    return math.erf(0.5 / math.sqrt(g))


@pytest.mark.parametrize("rolloff", [None, 2e4])
def test_a_spectrum_has_the_height_and_slope_that_it_claims(rolloff):
    spectrum = SelfAffineSpectrum(rms_height=265.7e-6, hurst=0.87, q0=2e3, q1=1e6, rolloff=rolloff)
    edges = np.sort(np.append(np.linspace(np.log(2e3), np.log(1e6), 60), np.log(2e4)))
    for power, expected in ((2, spectrum.rms_height), (4, spectrum.rms_slope)):
        moment = gauss(lambda y, n=power: np.exp(n * y) * spectrum.at(np.exp(y)), edges)
        assert math.sqrt(2 * math.pi * moment) == pytest.approx(expected, rel=1e-12, abs=0)
    np.testing.assert_array_equal(spectrum.at([1e3, 1999.9, 1.0001e6, 1e9]), 0)


@pytest.mark.parametrize("table", [False, True])
def test_truncation_keeps_densities_and_scaling_multiplies_them(table):
    spectrum = ROAD
    if table:
        q = np.geomspace(2e3, 1e6, 30)
        spectrum = TabulatedSpectrum(wavenumber=q, density=ROAD.at(q))
    inside = np.geomspace(5.1e3, 2.9e5, 40)
    cut = spectrum.truncated(q0=5e3, q1=3e5)
    assert (cut.q0, cut.q1) == (5e3, 3e5)
    np.testing.assert_allclose(cut.at(inside), spectrum.at(inside), rtol=1e-12)
    np.testing.assert_allclose(spectrum.scaled(7).at(inside), 7 * spectrum.at(inside), rtol=1e-12)
    assert spectrum.scaled(4).rms_height == pytest.approx(2 * spectrum.rms_height, rel=1e-12, abs=0)


def test_a_spectrum_and_its_table_make_the_same_contact():
    q = np.geomspace(2e3, 1e6, 200)
    table = TabulatedSpectrum(wavenumber=q, density=ROAD.at(q))
    for function in (asperity.contact_area, lambda *a, **k: asperity.friction(*a, **k).mu):
        expected = function(ROAD, RUBBER, **SCENE)
        assert function(table, RUBBER, **SCENE) == pytest.approx(expected, rel=1e-6)


def test_full_contact_under_a_crushing_load_and_at_q0():
    assert asperity.contact_area(ROAD, RUBBER, pressure=1e12, velocity=0.01) == 1
    assert asperity.contact_area(ROAD, RUBBER, **SCENE, wavenumber=2e3) == 1


def test_interpolation_of_the_area_is_as_far_off_as_stated():
    g = np.geomspace(1e-4, 1e6, 400)
    pressure = 1e7 * ROAD.rms_slope / np.sqrt(8 * g) / 0.75
    exact, interpolated = (
        asperity.contact_area(ROAD, elastic(1e7), pressure=pressure, velocity=1, form=form)
        for form in ("exact", "interpolated")
    )
    np.testing.assert_allclose(exact, [exact_area(x) for x in g], rtol=1e-9)
    np.testing.assert_allclose(interpolated, (1 + (np.pi * g) ** 1.5) ** (-1 / 3), rtol=1e-9)
    error = interpolated / exact - 1
    assert -0.029 < error.min() < -0.027
    assert 0.025 < error.max() < 0.027
    assert 0.08 < g[error.argmin()] < 0.12
    assert 0.8 < g[error.argmax()] < 1.1


@pytest.mark.parametrize("p", [1.0, 2.0, 3.7])
def test_affine_shift_of_a_map(p):
    heights = np.random.default_rng(3).gumbel(size=(40, 50)) * 1e-6
    surface = HeightMap(heights, pixel_size=2e-6)
    shifted = surface.affine_shift(p)
    z_max, z_min = surface.z_max, surface.z_min
    assert shifted.heights.mean() == pytest.approx(z_max * (1 - 1 / p), rel=1e-9, abs=1e-20)
    assert shifted.heights.max() == pytest.approx(
        z_max, rel=1e-12, abs=0
    )  # the highest point is kept
    assert shifted.heights.min() == pytest.approx((z_min - z_max) / p + z_max, rel=1e-9, abs=0)
    assert shifted.rms_height == pytest.approx(surface.rms_height / p, rel=1e-12, abs=0)
    before, after = (asperity.power_spectrum(s).density for s in (surface, shifted))
    np.testing.assert_allclose(after, before / p**2, rtol=1e-10)


def test_autocorrelation_and_spectrum_are_a_pair_both_ways():
    spectrum = SelfAffineSpectrum(rms_height=1e-5, hurst=0.8, q0=1e5, q1=6e5)
    shape, pixel = (24, 30), (4e-6, 3e-6)
    z = asperity.synthesize(spectrum, shape=shape, pixel_size=pixel, seed=1).heights
    average = np.array(
        [[np.mean(z * np.roll(z, (-y, -x), (0, 1))) for x in range(30)] for y in range(24)]
    )
    qy, qx = (2 * np.pi * np.fft.fftfreq(n, d) for n, d in zip(shape, pixel, strict=True))
    ry, rx = (d * np.arange(n) for n, d in zip(shape, pixel, strict=True))
    wave_y, wave_x = np.exp(1j * np.outer(qy, ry)), np.exp(1j * np.outer(qx, rx))
    # Eq. 6: C(q) = (2 pi)^-2 int <h(x) h(x + r)> exp(-i q r) d2r
    c = (wave_y.conj() @ average @ wave_x.conj().T).real * pixel[0] * pixel[1] / (2 * np.pi) ** 2
    q = np.hypot(qy[:, None], qx)
    inside = (q >= spectrum.q0) & (q <= spectrum.q1)
    expected = np.where(inside, spectrum.at(np.clip(q, spectrum.q0, spectrum.q1)), 0)
    np.testing.assert_allclose(c, expected, atol=1e-12 * expected.max())
    # Eq. 5 back: <h(x) h(x + r)> = int C(q) exp(i q r) d2q
    cell = (2 * np.pi) ** 2 / (24 * 30 * pixel[0] * pixel[1])
    back = (wave_y.T @ expected @ wave_x).real * cell
    np.testing.assert_allclose(back, average, atol=1e-12 * average[0, 0])


def test_isotropic_autocorrelation_is_that_of_a_large_map():
    side, n = 2 * np.pi / 500, 512
    spectrum = SelfAffineSpectrum(rms_height=1e-4, hurst=0.8, q0=8e3, q1=4e4)
    q = 500 * np.fft.fftfreq(n, 1 / n)
    mode = np.hypot(q[:, None], q)
    c = spectrum.at(np.clip(mode, 1, None))
    r = np.arange(0, 60) * side / n
    # along one axis, over all modes of the map
    direct = [np.sum(c * np.cos(q * x)) * 500**2 for x in r]
    result = spectrum.autocorrelation(r)
    np.testing.assert_allclose(result, direct, atol=0.02 * spectrum.rms_height**2)
    assert result[0] == pytest.approx(spectrum.rms_height**2, rel=1e-8, abs=0)
