"""Scales no surface has: what can be told is exact, what leaves the range of doubles is refused."""

import math

import mpmath
import numpy as np
import pytest

import asperity
from helpers.cases import each

RUBBER = asperity.PronySeries(equilibrium_modulus=1e6, moduli=[1e8], relaxation_times=[1e-4])
BAND = {"hurst": 0.8, "q0": 1e3, "q1": 1e5}
ROAD = asperity.SelfAffineSpectrum(rms_height=1e-4, **BAND)
MACRO = {"rms_height": 1e-4, "q0": 1e3}


def deep_separation(load, peaks):
    """d of Eq. 16 where every asperity touches: the mean of (z - d)^1.5 by its moments."""
    h, q0 = mpmath.mpf(1e-4), mpmath.mpf(1e3)
    stiffness = 2 * q0 / (3 * mpmath.pi**2 * mpmath.sqrt(3 * mpmath.sqrt(2) * h))
    depth = (mpmath.mpf(load) / stiffness) ** (mpmath.mpf(2) / 3)
    heights = [-h, h] if peaks is None else [mpmath.mpf(z) for z in peaks]
    mean = sum(heights) / len(heights)
    variance = sum((z - mean) ** 2 for z in heights) / len(heights)
    return mean - depth + variance / (4 * depth)  # the next term is variance^2 / depth^3


@each("peaks", [None, [1e-4, 2e-4, 5e-5]])
@each("load", [1e6, 1e20, 1e40, 1e200, 1e300])
def test_asperities_deep_in_contact(load, peaks):
    found = asperity.separation(pressure=load, effective_modulus=1.0, peaks=peaks, **MACRO)
    # ln(load), up to 700, is known to 1e-16 of itself
    assert found.effective == pytest.approx(float(deep_separation(load, peaks)), rel=1e-13)


def test_a_gaussian_is_summed_by_its_moments_where_it_was_integrated_before():
    def moment(t):
        tail = mpmath.quad(
            lambda x: (x - t) ** mpmath.mpf(1.5) * mpmath.exp(-x * x / 2), [t, -10, 0, 10, 40]
        )
        return tail / mpmath.sqrt(2 * mpmath.pi)

    stiffness = 2e3 / (3 * math.pi**2 * math.sqrt(3 * math.sqrt(2) * 1e-4))
    for t in (-99.9, -100.1):
        load = stiffness * 1e-6 * float(moment(mpmath.mpf(t)))
        found = asperity.separation(pressure=load, effective_modulus=1.0, **MACRO)
        # measured: 1.1e-14 of the integration, 7e-16 of the moments
        assert found.effective == pytest.approx(t * 1e-4, rel=2e-14, abs=0)


@each(
    ("arguments", "named"),
    [
        ({"pressure": 1e300, "effective_modulus": 1e-300}, "pressure"),
        ({"pressure": 1e300, "effective_modulus": 1.0, "q0": 1e-20}, "pressure"),
        ({"pressure": 1.0, "effective_modulus": 1.0, "peaks": [1e308, 0, -1e308]}, "peaks"),
    ],
)
def test_separations_beyond_a_double_are_refused(arguments, named):
    with pytest.raises(asperity.InvalidInput, match=named):
        asperity.separation(**{**MACRO, **arguments})


FAR_APART = {
    "peaks": lambda: asperity.LocalPeaks([1e308, 1e307, -1e308]),
    "profile": lambda: asperity.GreenwoodWilliamson(z_max=1e308, z_min=-1e308),
    "peak": lambda: asperity.GreenwoodWilliamson(z_max=1e308, z_min=-1, peaks=[1, 2, -1e308]),
}


@each("name", FAR_APART)
def test_heights_further_apart_than_a_double_are_refused(name):
    with pytest.raises(asperity.InvalidInput, match="z_max = 1e\\+308"):
        asperity.friction(ROAD, RUBBER, pressure=1e5, velocity=1.0, correction=FAR_APART[name]())


STATISTICS = {
    "rms_slope": lambda s: s.rms_slope,
    "nayak_parameter": lambda s: s.nayak_parameter,
    "at": lambda s: s.at(s.q0),
    "cutoff_for_slope": lambda s: s.cutoff_for_slope(),
}


@each("name", STATISTICS)
@each("rms_height", [1e-200, 1e200])
def test_densities_that_a_double_cannot_tell_are_refused(name, rms_height):
    spectrum = asperity.SelfAffineSpectrum(rms_height=rms_height, **BAND)
    with pytest.raises(asperity.InvalidInput, match="leaves the range of a double"):
        STATISTICS[name](spectrum)


def test_a_slope_that_a_double_cannot_tell_is_refused():
    steep = asperity.SelfAffineSpectrum(rms_height=1e-4, hurst=0.8, q0=1e100, q1=1e101)
    with pytest.raises(asperity.InvalidInput, match="rms_slope"):
        _ = steep.rms_slope
    high = asperity.TabulatedSpectrum(wavenumber=[1e160, 2e160], density=[1.0, 1.0])
    with pytest.raises(asperity.InvalidInput, match="rms_height"):
        _ = high.rms_height
    assert asperity.TabulatedSpectrum(wavenumber=[1e160, 2e160], density=[0, 0]).rms_height == 0


def test_bands_too_wide_for_a_logarithm_are_refused():
    q0, q1 = 1e-200, 1e200
    with pytest.raises(asperity.InvalidInput, match="q1 = 1e\\+200: must be at most 1e300 times"):
        asperity.SelfAffineSpectrum(rms_height=1.0, hurst=0.8, q0=q0, q1=q1)
    with pytest.raises(asperity.InvalidInput, match="wavenumber"):
        asperity.TabulatedSpectrum(wavenumber=np.array([q0, q1]), density=[1.0, 1.0])
