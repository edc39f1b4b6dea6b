"""Heat with the corrections for partial contact that have a fixed point of their own."""

import numpy as np
import pytest

import asperity
from helpers.cases import case, each
from helpers.examples import TREAD
from helpers.heat import ASPHALT, CUT, STICKY, hot

PEAKS = np.random.default_rng(0).normal(3e-4, 8e-5, 300)
HEIGHTS = {"z_max": 1.2e-3, "z_min": -1.5e-3}
CORRECTIONS = {
    "partial": asperity.PartialContact(),
    "gw": asperity.GreenwoodWilliamson(**HEIGHTS),
    "gw added": asperity.GreenwoodWilliamson(**HEIGHTS, reading="added"),
    "gw q0 below the band": asperity.GreenwoodWilliamson(**HEIGHTS, q0=500.0),
    "gw q0 in the band": asperity.GreenwoodWilliamson(**HEIGHTS, q0=5000.0),
    "gw peaks": asperity.GreenwoodWilliamson(**HEIGHTS, peaks=PEAKS),
    "peaks then gw": asperity.PeaksThenGreenwoodWilliamson(PEAKS, **HEIGHTS),
    "nayak": asperity.NayakSFactor(),
}
SPEEDS = np.array([1e-3, 0.1, 10.0])


@each("name", list(CORRECTIONS))
def test_without_a_shift_in_the_modulus_heat_changes_nothing(name):
    still = asperity.ArrheniusFit(
        activation_energy=0.0,
        reference_temperature=293.15,
        standard_errors={"activation_energy": 0.0},
        residual=0.0,
    )
    for spectrum in (CUT, ASPHALT):
        found = hot(
            spectrum,
            velocity=[1e-3, 0.3],
            shift=still,
            correction=CORRECTIONS[name],
            adhesion=STICKY,
            rtol=1e-8,
        )
        np.testing.assert_allclose(found.mu, found.cold.mu, rtol=2e-8)
        np.testing.assert_allclose(found.contact_area, found.cold.contact_area, rtol=2e-8)
        np.testing.assert_allclose(found.shift_factor, found.cold.shift_factor, rtol=1e-11)
        assert (found.temperature > 293.2).all()
        np.testing.assert_array_equal(found.gain, 0)


@each("name", list(CORRECTIONS))
def test_the_profile_is_what_the_heat_of_the_contributions_makes(name):
    """theta(q) = (2 v sigma0 / (rho c_v P_m)) int q' g(q, q') dmu_H(q'), by the trapezoid."""
    for velocity in (0.01, 3.0):
        found = hot(velocity=velocity, correction=CORRECTIONS[name], contributions=True, rtol=1e-6)
        order = np.argsort(found.wavenumber)
        q, density = found.wavenumber[order], found.dmu_dlnq[order]
        heating = asperity.Heating(**TREAD)
        g = asperity.heat_kernel(q[:, None], q[None, :], velocity=velocity, heating=heating)
        unit = 2 * velocity * 2e5 / (1200 * 1650 * found.macro_area)
        rise = unit * np.trapezoid(q * g * density, np.log(q), axis=-1)
        with case(velocity=velocity):
            found_rise = found.temperature_profile[order] - 293.15
            np.testing.assert_allclose(found_rise, rise, rtol=0.01)
            hysteresis = np.trapezoid(density, np.log(q))
            assert hysteresis == pytest.approx(found.hysteresis, rel=0.01)
            np.testing.assert_allclose(found.decade_share.sum(), 1, rtol=1e-12)


@each("name", list(CORRECTIONS))
def test_the_estimate_is_kept_and_tight_solutions_agree(name):
    for adhesion in (None, STICKY):
        given = {"velocity": SPEEDS, "correction": CORRECTIONS[name], "adhesion": adhesion}
        for spectrum in (CUT, ASPHALT):
            truth = hot(spectrum, **given, rtol=1e-10)
            for rtol in (1e-3, 1e-6):
                found = hot(spectrum, **given, rtol=rtol)
                assert (found.error_estimate <= rtol * found.mu).all()
                off = np.abs(found.mu - truth.mu)
                assert (off <= found.error_estimate + truth.error_estimate).all()


def test_the_separation_follows_the_temperature_of_q0():
    """p_T of Greenwood and Williamson at the modulus that the rubber has at T(q0)."""
    correction = CORRECTIONS["gw"]
    found = hot(velocity=3.0, correction=correction, adhesion=STICKY, contributions=True)
    at_q0 = found.temperature_profile[0]
    assert at_q0 > 296
    as_warm = hot(velocity=3.0, correction=correction, temperature=at_q0).cold
    assert found.shift_factor == pytest.approx(as_warm.shift_factor, rel=1e-9)
    assert found.shift_factor < found.cold.shift_factor * (1 - 1e-3)


def test_no_contact_makes_no_heat():
    aloft = asperity.GreenwoodWilliamson(z_max=1e-5, z_min=-1e-5)
    found = hot(velocity=1.0, pressure=1e3, correction=aloft, adhesion=STICKY)
    assert (found.mu, found.contact_area, found.temperature) == (0, 0, 293.15)
    assert np.isinf(found.shift_factor)
