"""GSL's adaptive integration, by name: the independent check of the panels."""

import numpy as np
import pytest

import asperity
from helpers import table_rows
from helpers.rubbers import prony

METHODS = ("qag", "qags", "cquad")
ROAD = asperity.SelfAffineSpectrum(rms_height=265.7e-6, hurst=0.87, q0=2000, q1=1e6)
RUBBER = prony(3e6, [1e7, 1e8, 1e9], [1e-2, 1e-4, 1e-6])
W = np.geomspace(1e-2, 1e8, 21)
MEASURED = asperity.MasterCurve(  # with steps, as of a bad master curve
    angular_frequency=W,
    storage_modulus=1e6 * (1 + W**0.35) * np.where(np.arange(21) % 5 == 0, 1.2, 1.0),
    loss_modulus=3e5 * W**0.3,
)
Q = np.geomspace(2000, 1e6, 60)
SCAN = asperity.TabulatedSpectrum(
    wavenumber=Q, density=ROAD.at(Q) * np.where(np.arange(60) % 13 == 7, 0, 1 + np.sin(9 * Q))
)
IGW = asperity.GreenwoodWilliamson(z_max=6e-4, z_min=-6e-4)
SCENES = {
    "Table 1": (ROAD, RUBBER, {}),
    "weak contact": (ROAD, RUBBER, {"pressure": 1e2, "correction": asperity.SFactor()}),
    "nearly full contact": (ROAD, RUBBER, {"pressure": 1e9, "form": "interpolated"}),
    "steps in the modulus": (ROAD, MEASURED, {"correction": asperity.AffineShift(2)}),
    "gaps in the spectrum": (SCAN, RUBBER, {"correction": asperity.NayakSFactor()}),
    "both measured": (SCAN, MEASURED, {"correction": IGW, "pressure": 1e6}),
}


def rubber_of(row):
    part = table_rows.prony if row["moduli"].size else table_rows.master_curve
    return part(row)


@pytest.mark.parametrize("scene", SCENES)
@pytest.mark.parametrize("method", METHODS)
@pytest.mark.parametrize("rtol", [1e-3, 1e-6, 1e-9])
def test_methods_agree_within_their_estimates(scene, method, rtol):
    spectrum, rubber, more = SCENES[scene]
    options = {"pressure": 81e3, "velocity": [1e-4, 0.1, 2.0], "rtol": rtol} | more
    ours = asperity.friction(spectrum, rubber, **options)
    other = asperity.friction(spectrum, rubber, method=method, **options)
    assert np.all(np.abs(ours.mu - other.mu) <= ours.error_estimate + other.error_estimate)
    assert np.all(other.error_estimate <= rtol * other.mu)
    np.testing.assert_allclose(ours.contact_area, other.contact_area, rtol=rtol)


def meets(row, spectrum, method, rtol, some):
    """Hold some of the velocities of a row within the estimate, and that within the tolerance."""
    result = asperity.friction(
        spectrum,
        rubber_of(row),
        pressure=row["pressure"],
        velocity=row["velocities"][some],
        correction=asperity.SFactor(gamma=row["gamma"]),
        rtol=rtol,
        method=method,
    )
    rounding = row["rtol"] * result.mu
    assert np.all(np.abs(result.mu - row["hystereses"][some]) <= result.error_estimate + rounding)
    assert np.all(result.error_estimate <= rtol * result.mu)


@pytest.mark.reference("friction_curves")
@pytest.mark.parametrize("method", ["gauss", *METHODS])
@pytest.mark.parametrize("rtol", [1e-3, 1e-6, 1e-9, 1e-10])
def test_methods_meet_curves_known_to_sixteen_digits(row, method, rtol):
    spectrum = table_rows.self_affine({**row, "rolloff": None})
    meets(row, spectrum, method, rtol, slice(None))


@pytest.mark.reference("friction_rings")
@pytest.mark.parametrize("rtol", [1e-2, 1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-9, 1e-11])
def test_ours_meets_curves_on_rings(row, rtol):
    meets(row, table_rows.tabulated(row), "gauss", rtol, slice(None))


@pytest.mark.reference("friction_rings")
@pytest.mark.parametrize("method", METHODS)
def test_gsl_meets_curves_on_rings(row, method):
    meets(row, table_rows.tabulated(row), method, 1e-9, slice(None, None, 7))


@pytest.mark.parametrize("method", METHODS)
@pytest.mark.parametrize(
    "call", [asperity.contact_area, asperity.mean_pressure, asperity.correction_factor]
)
def test_methods_agree_at_every_magnification(call, method):
    options = {"pressure": 81e3, "velocity": [1e-4, 1.0], "wavenumber": np.geomspace(2000, 1e6, 7)}
    ours = call(ROAD, RUBBER, rtol=1e-9, **options)
    np.testing.assert_allclose(ours, call(ROAD, RUBBER, rtol=1e-9, method=method, **options), 1e-9)


@pytest.mark.parametrize("method", METHODS)
def test_methods_agree_on_contributions(method):
    options = {"pressure": 81e3, "velocity": [1e-4, 1.0], "contributions": True, "rtol": 1e-9}
    ours = asperity.friction(ROAD, RUBBER, **options)
    other = asperity.friction(ROAD, RUBBER, method=method, **options)
    np.testing.assert_allclose(ours.decade_share, other.decade_share, rtol=0, atol=1e-9)
    np.testing.assert_allclose(ours.dmu_dlnq, other.dmu_dlnq, rtol=1e-8)


@pytest.mark.parametrize("method", METHODS)
def test_methods_agree_on_what_is_made_of_them(method):
    options = {"pressure": 81e3, "velocity": np.geomspace(1e-5, 1, 20), "rtol": 1e-9}
    mu = asperity.friction(ROAD, RUBBER, adhesion=asperity.Adhesion(shear_stress=8e6), **options).mu
    fits = [
        asperity.fit_adhesion(ROAD, RUBBER, mu=mu, method=name, **options)
        for name in ("gauss", method)
    ]
    # the fit amplifies a part in 1e9 of mu by what share the adhesion has in it, above 1/1000 here
    assert fits[1].shear_stress == pytest.approx(fits[0].shear_stress, rel=1e-6)
    densities = [
        asperity.pressure_distribution([1e5, 1e6, 1e7], ROAD, RUBBER, method=name, **scene)
        for name in ("gauss", method)
        for scene in [{**options, "velocity": 0.1}]
    ]
    # exp(-(x - 1)^2 / (4 G)): relative errors of G grow by the exponent, below 10 here
    np.testing.assert_allclose(*densities, rtol=1e-8)
    options |= {"correction": asperity.AffineShift(2), "pressure": 10.0}
    notes = asperity.contact_notes(ROAD, RUBBER, method=method, **options)
    assert notes == asperity.contact_notes(ROAD, RUBBER, **options) != ()
