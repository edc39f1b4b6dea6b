"""Bands on mu of a scan's own contact: they hold what other scans of the surface have."""

from functools import cache
from typing import Any

import numpy as np
import pytest

import asperity
from helpers.rubbers import prony

PIXEL, SIDE, SCANS = 1e-4, 128, 4
Q0, Q1 = 2 * np.pi / (SIDE * PIXEL / 3), 2 * np.pi / (8 * PIXEL)
RUBBER = prony(1e6, np.geomspace(1e6, 1e8, 6), np.geomspace(1e-1, 1e-6, 6))
SCENE = {"pressure": np.array([5e4, 5e5]), "velocity": np.array([1e-2, 1e-2])}


@cache
def scans():
    """Crops of one worn surface, and their spectra."""
    n = SIDE * SCANS
    road = asperity.SelfAffineSpectrum(rms_height=1e-4, hurst=0.8, q0=Q0, q1=Q1)
    z = asperity.synthesize(road, shape=(n, n), pixel_size=PIXEL, seed=3).heights / 1e-4
    k = 2 * np.pi * np.fft.fftfreq(n, PIXEL)
    q = np.hypot(k, k[:, None])
    inside = (q > Q0 * (1 - 1e-9)) & (q < Q1 * (1 + 1e-9))
    h = np.fft.ifft2(np.where(inside, np.fft.fft2(-np.logaddexp(0, -1.5 * z)), 0)).real
    crops = []
    for y in range(0, n, SIDE):
        for x in range(0, n, SIDE):
            crop = 1e-4 / h.std() * h[y : y + SIDE, x : x + SIDE]
            scan = asperity.HeightMap(crop, pixel_size=PIXEL)
            spectrum = asperity.power_spectrum(scan).truncated(q0=Q0, q1=Q1)
            crops.append((scan, spectrum))
    return crops


def test_bands_of_one_scan_hold_the_mean_of_the_others():
    mu: list[Any] = []
    bands: dict[float, list[Any]] = {0.95: [], 0.5: []}
    for scan, spectrum in scans():
        scene = {**SCENE, "correction": asperity.ScanContact(scan)}
        mu.append(asperity.friction(spectrum, RUBBER, **scene).mu)
        for level, result in bands.items():
            band = asperity.friction_band(spectrum, RUBBER, level=level, **scene)
            result.append([band.lower, band.upper])
    of_all = np.array(mu)
    others = (of_all.sum(axis=0) - of_all) / (len(of_all) - 1)
    held = {
        level: np.mean((np.array(result)[:, 0] <= others) & (others <= np.array(result)[:, 1]))
        for level, result in bands.items()
    }
    assert held[0.95] >= 0.85
    assert 0.3 < held[0.5] < 0.8
    # the rule alone, with the errors of the rings, is far off
    scan, spectrum = scans()[0]
    rule = asperity.friction_band(spectrum, RUBBER, correction=asperity.PartialContact(), **SCENE)
    assert (rule.lower > 1.2 * others[0]).all()


def test_a_band_solves_no_more_contacts_than_its_curve():
    scan, spectrum = scans()[0]
    exact = asperity.ScanContact(scan)
    mu = asperity.friction(spectrum, RUBBER, correction=exact, **SCENE).mu
    count = len(exact.contacts)
    adhesion = asperity.Adhesion(shear_stress=2e5)
    scene: dict[str, Any] = {**SCENE, "correction": exact, "adhesion": adhesion}
    one, two = (asperity.friction_band(spectrum, RUBBER, seed=seed, **scene) for seed in (1, 2))
    assert len(exact.contacts) == count
    assert (one.lower < asperity.friction(spectrum, RUBBER, **scene).mu).all()
    assert (one.upper > mu).all()
    assert one.upper == pytest.approx(two.upper, rel=0.02)
    threaded = asperity.friction_band(spectrum, RUBBER, seed=1, threads=2, **scene)
    assert threaded.upper.tolist() == one.upper.tolist()


def test_beyond_the_scan_the_spectrum_is_drawn():
    scan, spectrum = scans()[0]
    known = spectrum.wavenumber[-1]
    q = np.concatenate([spectrum.wavenumber, known * np.geomspace(1.05, 30, 40)])
    density = spectrum.density[-1] * (q / known) ** -3.6
    density[: len(spectrum.density)] = spectrum.density
    scene = {**SCENE, "correction": asperity.ScanContact(scan)}

    def width(error):
        longer = asperity.TabulatedSpectrum(
            wavenumber=q,
            density=density,
            standard_error=np.where(q > known, error, 0.01) * density,
        )
        band = asperity.friction_band(longer, RUBBER, **scene)
        return np.log(band.upper / band.lower)

    assert (width(0.9) > 1.05 * width(0.01)).all()
