"""Heat by GSL's adaptive rules, which know none of the grids."""

import pickle

import numpy as np
import pytest

import asperity
from asperity import _core
from asperity.contact import contact_model
from helpers.cases import case, each
from helpers.heat import ASPHALT, CUT, HEATING, LAW, STICKY, hot, rubber

RTOL = 1e-7
SCENES = {
    "plain": {},
    "full spectrum": {"spectrum": ASPHALT},
    "adhesion": {"adhesion": STICKY},
    "s-factor": {"correction": asperity.SFactor(gamma=0.5)},
    "nayak": {"correction": asperity.NayakSFactor()},
    "interpolated": {"form": "interpolated"},
    "gw": {"correction": asperity.GreenwoodWilliamson(z_max=1.2e-3, z_min=-1.5e-3)},
    "gw q0 below": {
        "correction": asperity.GreenwoodWilliamson(z_max=1.2e-3, z_min=-1.5e-3, q0=500.0)
    },
}


def both(velocity, method="qag", **given):
    spectrum = given.pop("spectrum", CUT)
    by_grid = hot(spectrum, velocity=velocity, rtol=RTOL, **given)
    return by_grid, hot(spectrum, velocity=velocity, rtol=RTOL, method=method, **given)


@each("name", list(SCENES))
def test_gsl_finds_what_the_grids_find(name):
    velocity = [0.01, 3.0] if name == "plain" else 1.0
    by_grid, found = both(velocity, **SCENES[name])
    told = by_grid.error_estimate + found.error_estimate
    assert np.all(found.error_estimate <= RTOL * found.mu)
    assert np.all(np.abs(found.mu - by_grid.mu) <= told)
    assert np.all(np.abs(found.mu / found.cold.mu - 1) > 0.02)
    for quantity in ("contact_area", "macro_area", "hysteresis"):
        ours, gsl = (np.asarray(getattr(f, quantity)) for f in (by_grid, found))
        with case(quantity=quantity):
            np.testing.assert_allclose(gsl, ours, rtol=3 * RTOL)
    np.testing.assert_allclose(found.temperature, by_grid.temperature, rtol=0, atol=1e-5)
    np.testing.assert_array_equal(found.branches, by_grid.branches)


def test_a_master_curve_too():
    w = np.geomspace(1e-2, 1e12, 60)
    e = rubber().modulus(w)
    curve = asperity.MasterCurve(angular_frequency=w, storage_modulus=e.real, loss_modulus=e.imag)
    by_grid, found = both(1.0, rubber=curve)
    assert abs(found.mu - by_grid.mu) <= by_grid.error_estimate + found.error_estimate


def test_rings_too():
    q = np.geomspace(CUT.q0, CUT.q1, 40)
    rings = asperity.TabulatedSpectrum(wavenumber=q, density=CUT.at(q))
    by_grid, found = both(0.3, spectrum=rings, shift=LAW)
    assert abs(found.mu - by_grid.mu) <= by_grid.error_estimate + found.error_estimate


def test_rows_of_a_modulus_are_not_missed_alike():
    """G at q_m had the same nodes on all grids, and mu was off by 4.5 times what they told."""
    q, w = np.geomspace(700, 1.4e5, 38), np.geomspace(1e-8, 1e16, 70)
    rings = asperity.TabulatedSpectrum(wavenumber=q, density=8.9e-5 * q**-3.6)
    terms = {"moduli": [1e9, 1e8], "relaxation_times": [1e-7, 1e-3]}
    e = asperity.PronySeries(equilibrium_modulus=2e6, **terms).modulus(w)
    curve = asperity.MasterCurve(angular_frequency=w, storage_modulus=e.real, loss_modulus=e.imag)
    at = {"spectrum": rings, "rubber": curve, "velocity": np.array([0.1, 0.14, 0.3])}
    found, gsl = hot(**at, rtol=RTOL), hot(**at, rtol=0.1 * RTOL, method="qag")
    assert np.all(np.abs(found.mu - gsl.mu) <= found.error_estimate + gsl.error_estimate)
    np.testing.assert_allclose(found.macro_area, gsl.macro_area, rtol=RTOL)


def test_a_wrong_start_is_left():
    """GSL's temperatures keep themselves up, whatever those of a loose tolerance were."""
    exact = hot(velocity=1.0, rtol=1e-10)
    loose = hot(velocity=1.0, rtol=1e-3, method="qags")
    assert loose.mu == pytest.approx(exact.mu, rel=1e-3)


@each("method", ["qag", "qags", "cquad"])
def test_the_history_of_the_heat_is_ours_alone(method):
    """Nothing that GSL did not compute is given where its methods are asked for."""
    found = hot(velocity=1.0, rtol=1e-3, method=method)
    assert found.sliding_length is None
    assert pickle.loads(pickle.dumps(found)) == found
    with pytest.raises(asperity.InvalidInput, match="distance: needs the sliding_length"):
        found.mu_at(0.1)
    parts = CUT._core, rubber()._core, contact_model(0.5, None, "exact", 1e-3, method), None
    with pytest.raises(asperity.InvalidInput, match=f"method = {method}: must be gauss for slid"):
        _core.sliding_length(*parts, [2e5], [1.0], LAW._core, [293.15], HEATING._core)
    box = {"pressure": (1e5, 2e5), "velocity": (0.1, 1.0), "temperature": 293.15, "shift": LAW}
    with pytest.raises(asperity.InvalidInput, match=f"method = {method}: must be gauss in a map"):
        asperity.friction_map(CUT, rubber(), **box, heating=HEATING, method=method)
