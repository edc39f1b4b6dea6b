"""ImplicitSFactor: one area for each load, its limits, and what it leaves alone."""

import numpy as np
import pytest

import asperity
from helpers.heat import LAW
from helpers.rubbers import prony, tread

ROAD = asperity.SelfAffineSpectrum(rms_height=1e-4, hurst=0.8, q0=1e3, q1=1e5, rolloff=2e3)
RUBBER = prony(1e6, np.geomspace(1e8, 1e6, 7), np.geomspace(1e-5, 10, 7))
LOADS = np.geomspace(1e2, 1e9, 29)
STICKY = asperity.Adhesion(shear_stress=8e6)
HOT = {"temperature": 293.15, "shift": LAW, "heating": tread()}


def area(pressure, correction=None, **more):
    given = {"pressure": pressure, "velocity": 0.01, "correction": correction, **more}
    return asperity.contact_area(ROAD, RUBBER, **given)


@pytest.mark.parametrize("form", ["exact", "interpolated"])
@pytest.mark.parametrize("gamma", [0.0, 0.2, 0.45, 0.9])
def test_the_area_is_that_of_theory_at_g_with_the_s_of_itself(form, gamma):
    """G falls as 1 / pressure^2: S in G is a pressure higher by 1 / sqrt(S)."""
    result = area(LOADS, asperity.ImplicitSFactor(gamma=gamma), form=form)
    s = gamma + (1 - gamma) * result
    assert result == pytest.approx(area(LOADS / np.sqrt(s), form=form), rel=1e-9)
    assert np.all(np.diff(result) >= 0)
    assert np.all((result > 0) & (result <= 1))


def test_gamma_1_is_persson():
    assert np.array_equal(area(LOADS, asperity.ImplicitSFactor(gamma=1)), area(LOADS))


def test_at_small_loads_the_area_is_proportional_to_the_load():
    light = 1e2 * np.array([1, 1e-2, 1e-4])
    result = area(light, asperity.ImplicitSFactor(gamma=0.45))
    # S is gamma to (1 - gamma) / gamma A
    assert result / light == pytest.approx(area(light) / light / np.sqrt(0.45), rel=2e-3)
    assert result[2] / light[2] == pytest.approx(
        area(light[2]) / light[2] / np.sqrt(0.45), rel=1e-6
    )


def test_full_contact_is_complete():
    assert area(1e12, asperity.ImplicitSFactor()) == 1


def test_every_magnification_has_its_own_area():
    q = np.geomspace(1e3, 1e5, 9)[1:]
    result = area(1e5, asperity.ImplicitSFactor(gamma=0.3), wavenumber=q)
    cut = [
        asperity.contact_area(
            ROAD.truncated(q1=end),
            RUBBER,
            pressure=1e5,
            velocity=0.01,
            correction=asperity.ImplicitSFactor(gamma=0.3),
        )
        for end in q[2:]
    ]
    assert result[2:] == pytest.approx(cut, rel=1e-6)


@pytest.mark.parametrize("heat", [False, True])
def test_eq_22_is_left_alone_and_the_adhesion_goes_with_the_area(heat):
    cold_interface = tread(interface_share=0)
    hot = HOT | {"heating": cold_interface} if heat else {}
    at = {"pressure": [1e5, 1e6], "velocity": 0.1, "adhesion": STICKY, **hot}
    plain = asperity.friction(ROAD, RUBBER, **at)
    result = asperity.friction(ROAD, RUBBER, correction=asperity.ImplicitSFactor(), **at)
    assert result.hysteresis == pytest.approx(plain.hysteresis, rel=1e-6)
    assert np.all(result.contact_area > 1.05 * plain.contact_area)
    ratio = result.contact_area / plain.contact_area
    assert result.adhesion == pytest.approx(ratio * plain.adhesion, rel=1e-9)
    assert np.array_equal(result.model_error, plain.model_error, equal_nan=True)


def test_heat_of_the_adhesion_finds_the_state_of_a_tight_tolerance():
    """The fixed point takes the slope of the area over the temperature."""
    correction = asperity.ImplicitSFactor(gamma=0.4)
    at = {"pressure": 1e5, "velocity": 0.3, "adhesion": STICKY, "correction": correction, **HOT}
    result, check = (asperity.friction(ROAD, RUBBER, **at, rtol=rtol) for rtol in (1e-4, 1e-9))
    assert result.mu == pytest.approx(check.mu, abs=result.error_estimate + check.error_estimate)
    assert result.temperature == pytest.approx(check.temperature, abs=0.05)
