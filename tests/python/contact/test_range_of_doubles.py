"""Scales no surface has: what can be told is exact, what leaves the range of doubles is refused."""

import math

import mpmath
import pytest

import asperity

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


@pytest.mark.parametrize("peaks", [None, [1e-4, 2e-4, 5e-5]])
@pytest.mark.parametrize("load", [1e6, 1e20, 1e40, 1e200, 1e300])
def test_asperities_deep_in_contact(load, peaks):
    result = asperity.separation(pressure=load, effective_modulus=1.0, peaks=peaks, **MACRO)
    # ln(load), up to 700, is known to 1e-16 of itself
    assert result.effective == pytest.approx(float(deep_separation(load, peaks)), rel=1e-13)


def test_a_gaussian_is_summed_by_its_moments_where_it_was_integrated_before():
    def moment(t):
        tail = mpmath.quad(
            lambda x: (x - t) ** mpmath.mpf(1.5) * mpmath.exp(-x * x / 2), [t, -10, 0, 10, 40]
        )
        return tail / mpmath.sqrt(2 * mpmath.pi)

    stiffness = 2e3 / (3 * math.pi**2 * math.sqrt(3 * math.sqrt(2) * 1e-4))
    for t in (-99.9, -100.1):
        load = stiffness * 1e-6 * float(moment(mpmath.mpf(t)))
        result = asperity.separation(pressure=load, effective_modulus=1.0, **MACRO)
        # measured: 1.1e-14 of the integration, 7e-16 of the moments
        assert result.effective == pytest.approx(t * 1e-4, rel=2e-14, abs=0)


def separated(**changed):
    return asperity.separation(**{"pressure": 1.0, "effective_modulus": 1.0, **MACRO, **changed})


def rubbed(correction):
    scene = {"pressure": 1e5, "velocity": 1.0}
    return asperity.friction(ROAD, RUBBER, correction=correction, **scene)


def table(wavenumber, density=1.0):
    return asperity.TabulatedSpectrum(wavenumber=wavenumber, density=[density] * 2)


FLAT, TALL = (asperity.SelfAffineSpectrum(rms_height=h, **BAND) for h in (1e-200, 1e200))
SHORT = asperity.SelfAffineSpectrum(rms_height=1e-4, hurst=0.8, q0=1e100, q1=1e101)
GW = asperity.GreenwoodWilliamson
REFUSED = [
    ("pressure", lambda: separated(pressure=1e300, effective_modulus=1e-300)),
    ("pressure", lambda: separated(pressure=1e300, q0=1e-20)),
    ("peaks: their highest", lambda: separated(peaks=[1e308, 0, -1e308])),
    ("z_max", lambda: rubbed(asperity.LocalPeaks([1e308, 1e307, -1e308]))),
    ("z_max", lambda: rubbed(GW(z_max=1e308, z_min=-1e308))),
    ("z_max", lambda: rubbed(GW(z_max=1e308, z_min=-1, peaks=[1, 2, -1e308]))),
    *(("rms_height", lambda s=s: s.rms_slope) for s in (FLAT, TALL)),
    *(("rms_height", lambda s=s: s.nayak_parameter) for s in (FLAT, TALL)),
    *(("rms_height", lambda s=s: s.at(s.q0)) for s in (FLAT, TALL)),
    *(("rms_height", lambda s=s: s.cutoff_for_slope()) for s in (FLAT, TALL)),
    ("q0", lambda: SHORT.rms_slope),
    ("q0", lambda: table([1e160, 2e160]).rms_height),
    ("q1", lambda: asperity.SelfAffineSpectrum(rms_height=1.0, hurst=0.8, q0=1e-200, q1=1e200)),
    ("wavenumber: its last entry", lambda: table([1e-200, 1e200])),
]


@pytest.mark.parametrize(("argument", "call"), REFUSED)
def test_what_a_double_cannot_hold_is_refused_by_its_argument(argument, call):
    with pytest.raises(asperity.InvalidInput) as caught:
        call()
    assert caught.value.argument == argument


def test_a_table_without_roughness_has_no_height_at_any_scale():
    assert table([1e160, 2e160], 0.0).rms_height == 0
