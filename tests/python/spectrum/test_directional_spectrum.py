"""Spectra that know directions: elliptic laws, harmonics of rings, and maps made of them."""

import numpy as np
import pytest

from asperity import (
    HeightMap,
    InvalidInput,
    LineScan,
    SelfAffineSpectrum,
    power_spectrum,
    synthesize,
)

N, PIXEL = 256, 1e-6
DQ = 2 * np.pi / (N * PIXEL)
LAW = {"rms_height": 1e-6, "hurst": 0.8, "q0": 4 * DQ, "q1": 100 * DQ}


def k_of(ratio, lay, q, phi):
    return q * np.sqrt(ratio * np.cos(phi - lay) ** 2 + np.sin(phi - lay) ** 2 / ratio)


@pytest.mark.parametrize("rolloff", [None, 12 * DQ, 60 * DQ])
@pytest.mark.parametrize("ratio", [1.5, 3.0, 8.0])
def test_an_elliptic_law_is_that_of_k(ratio, rolloff):
    spectrum = SelfAffineSpectrum(**LAW, rolloff=rolloff, axis_ratio=ratio, lay=0.3)
    phi = np.linspace(0, np.pi, 7)
    q = np.array([5.0, 11.0, 30.0, 90.0])[:, None] * DQ
    k = k_of(ratio, 0.3, q, phi)
    law = np.maximum(k, rolloff or 0) ** -3.6
    result = spectrum.toward(q, phi)
    np.testing.assert_allclose(result / result[0, 0], law / law[0, 0], rtol=1e-9)
    # the mean over directions is C, and the rms height that of the plane
    angles = np.pi * np.arange(20000) / 20000
    for one in (5 * DQ, 30 * DQ):
        mean = spectrum.toward(one, angles).mean()
        assert spectrum.at(one) == pytest.approx(mean, rel=2e-6)
    q = np.geomspace(spectrum.q0, spectrum.q1, 100001)
    variance = np.trapezoid(2 * np.pi * q**2 * spectrum.at(q), np.log(q))
    assert variance == pytest.approx(spectrum.rms_height**2, rel=2e-6)


def test_changes_of_band_and_scale_keep_the_direction():
    spectrum = SelfAffineSpectrum(**LAW, rolloff=12 * DQ, axis_ratio=2.0, lay=0.3)
    table = power_spectrum(
        synthesize(spectrum, shape=(N, N), pixel_size=PIXEL, seed=3),
        window="none",
        detrend=None,
        directional=True,
    )
    for one in (spectrum, table):
        for changed, factor in (
            (one.scaled(4.0), 4),
            (one.truncated(q0=6 * DQ), 1),
            (one.truncated(q0=30.5 * DQ, q1=70 * DQ), 1),
        ):
            assert changed.is_directional
            phi = np.array([0.1, 1.0, 2.0])
            np.testing.assert_allclose(
                changed.toward(40.25 * DQ, phi), factor * one.toward(40.25 * DQ, phi), rtol=2e-6
            )
    extended = spectrum.extended(q0=2 * DQ)
    assert extended.toward(40 * DQ, 1.0) == pytest.approx(spectrum.toward(40 * DQ, 1.0), rel=2e-6)
    with pytest.raises(InvalidInput, match="q0"):
        spectrum.truncated(q0=13 * DQ)  # some directions are flat there, others not


@pytest.mark.parametrize(("ratio", "lay"), [(1.0, 0.0), (2.0, 0.5), (3.0, -1.2)])
@pytest.mark.parametrize("shape", [(N, N), (N, 192)])
def test_harmonics_of_a_ridged_map_are_those_of_its_law(ratio, lay, shape):
    spectrum = SelfAffineSpectrum(**LAW, axis_ratio=ratio, lay=lay)
    height_map = synthesize(spectrum, shape=shape, pixel_size=PIXEL, seed=11)
    table = power_spectrum(height_map, window="none", detrend=None, directional=True)
    inside = (table.wavenumber > 20 * DQ) & (table.wavenumber < 90 * DQ)
    phi = 2 * np.pi * np.arange(720) / 720
    shape_of = k_of(ratio, lay, 1.0, phi) ** -3.6
    shape_of /= shape_of.mean()
    m = np.arange(1, table.cosine.shape[1] + 1)[:, None]
    for result, law in ((table.cosine, np.cos), (table.sine, np.sin)):
        expected = (law(2 * m * phi) * shape_of).mean(axis=1)
        np.testing.assert_allclose(result[inside].mean(axis=0), expected, atol=0.01)
    assert (table.cosine.shape[1] > 1) == (ratio > 1)


def test_harmonics_scatter_as_their_errors_say():
    """Of isotropic noise, whose modes are exponential."""
    rng = np.random.default_rng(5)
    off = []
    for _ in range(12):
        noise = rng.normal(size=(N, N))
        table = power_spectrum(HeightMap(noise, pixel_size=PIXEL), directional=True)
        good = table.reliable
        first = table.cosine[good, 0] / table.harmonic_error[good, 0]
        off += [*first, *(table.sine[good, 0] / table.harmonic_error[good, 0])]
    assert np.std(off) == pytest.approx(1, abs=0.1)
    assert abs(np.mean(off)) < 0.1


def test_a_line_has_no_directions():
    line = LineScan(np.sin(np.arange(64.0)), spacing=1e-6)
    with pytest.raises(InvalidInput, match="directional"):
        power_spectrum(line, directional=True)


@pytest.mark.parametrize(
    ("option", "value"),
    [("pixel_size", 1e-6), ("overlap", 0.5), ("max_dropouts", 0.2), ("executor", "threads")],
)
def test_directions_take_no_option_of_tiles(option, value):
    scan = HeightMap(np.random.default_rng(1).normal(size=(32, 32)), pixel_size=PIXEL)
    with pytest.raises(InvalidInput, match=option):
        power_spectrum(scan, directional=True, **{option: value})
