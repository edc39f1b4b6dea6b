"""What comes with a friction coefficient: contributions, states, notes, tolerance, range."""

import math

import numpy as np
import pytest

import asperity
from asperity import GreenwoodWilliamson, MasterCurve, OutOfRange, PronySeries, SelfAffineSpectrum
from helpers.rubbers import curve_of, prony

ROAD = SelfAffineSpectrum(rms_height=265.7e-6, hurst=0.87, q0=2e3, q1=2e4)  # rms slope below 1.3
STEEP = SelfAffineSpectrum(rms_height=265.7e-6, hurst=0.87, q0=2e3, q1=1e6)
RUBBER = prony(3e6, [1e9, 3e8, 1e8, 1e7], [1e-8, 1e-6, 1e-4, 1e-2])
SCENE = {"pressure": 2e5, "velocity": 0.005}


def master_curve(low, high, extrapolation=None):
    w = np.geomspace(low, high, 300)
    e = RUBBER.modulus(w)
    return curve_of(w, e, extrapolation=extrapolation)


def elastic(modulus):
    return PronySeries(equilibrium_modulus=modulus, moduli=[], relaxation_times=[])


@pytest.mark.parametrize("correction", [None, asperity.SFactor(), asperity.AffineShift(2)])
@pytest.mark.parametrize("spectrum", [ROAD, STEEP])
def test_contributions_integrate_to_the_hysteresis(spectrum, correction):
    velocity = np.array([1e-4, 1e-2, 0.3])
    result = asperity.friction(
        spectrum, RUBBER, pressure=2e7, velocity=velocity, correction=correction, contributions=True
    )
    y = np.log(result.wavenumber)
    assert result.wavenumber[0] == spectrum.q0
    assert result.wavenumber[-1] == spectrum.q1
    assert result.dmu_dlnq.shape == (3, y.size)
    total = np.sum((result.dmu_dlnq[:, 1:] + result.dmu_dlnq[:, :-1]) / 2 * np.diff(y), axis=1)
    np.testing.assert_allclose(total, result.hysteresis, rtol=2e-3)  # step 0.07: a trapezoid's own
    plain = asperity.friction(
        spectrum, RUBBER, pressure=2e7, velocity=velocity, correction=correction
    )
    np.testing.assert_allclose(plain.mu, result.mu, rtol=1e-6)
    assert plain.dmu_dlnq is plain.wavenumber is plain.decade_share is plain.decade_edges is None


def test_decade_shares_are_the_friction_between_those_frequencies():
    velocity = np.array([1e-4, 1e-2, 0.3])
    result = asperity.friction(STEEP, RUBBER, pressure=2e7, velocity=velocity, contributions=True)
    edges, share = result.decade_edges, result.decade_share
    assert share.shape == (3, edges.size - 1)
    np.testing.assert_allclose(share.sum(axis=1), 1, rtol=1e-9)
    np.testing.assert_allclose(np.log10(edges), np.round(np.log10(edges)), atol=1e-12)
    assert edges[0] <= 1e-4 * STEEP.q0
    assert edges[-1] >= 0.3 * STEEP.q1
    y = np.log(result.wavenumber)
    fine = np.linspace(y[0], y[-1], 20001)
    for i, v in enumerate(velocity):
        density = np.interp(fine, y, result.dmu_dlnq[i])
        decade = np.searchsorted(edges, v * np.exp(fine)) - 1
        sums = np.bincount(np.clip(decade, 0, None), density, minlength=edges.size - 1)
        np.testing.assert_allclose(share[i], sums / sums.sum(), atol=3e-3)


def test_tightening_the_tolerance_does_not_change_a_friction_already_found():
    # a coarse master curve with a steep step, as between two glued measurements
    rubber = MasterCurve(
        angular_frequency=[1.0, 639.0, 1359.0, 1e8],
        storage_modulus=[3.9e6, 1.94e7, 9.767e8, 1.4529e9],
        loss_modulus=[2.39e6, 7.4e6, 1.9486e8, 3.0038e8],
    )
    conditions = {"pressure": 81e3, "velocity": 0.01}
    loose = asperity.friction(STEEP, rubber, **conditions, rtol=1e-3)
    for rtol in (1e-4, 1e-5, 1e-6, 1e-7, 1e-9):
        tight = asperity.friction(STEEP, rubber, **conditions, rtol=rtol)
        assert abs(tight.mu - loose.mu) <= loose.error_estimate + tight.error_estimate, rtol


@pytest.mark.parametrize("correction", [None, asperity.SFactor(gamma=0.4, applies_to="both")])
@pytest.mark.parametrize("rtol", [1e-2, 1e-4, 1e-8, 1e-11])
def test_error_estimate_of_the_total_keeps_the_tolerance_asked_for(rtol, correction):
    options = {"correction": correction, "adhesion": asperity.Adhesion(shear_stress=5e6)}
    result = asperity.friction(STEEP, RUBBER, **SCENE, **options, rtol=rtol)
    exact = asperity.friction(STEEP, RUBBER, **SCENE, **options, rtol=1e-12)
    assert 0 < result.error_estimate <= rtol * result.mu
    assert abs(result.mu - exact.mu) <= result.error_estimate + exact.error_estimate


def test_a_prony_series_extrapolates_nothing_and_a_table_says_how_much():
    assert asperity.friction(ROAD, RUBBER, **SCENE).extrapolated_share == 0
    shares = []
    for low in (9.9, 3.0, 1.0, 1e-2):
        rubber = master_curve(low, 1e8)
        result = asperity.friction(ROAD, rubber, pressure=2e7, velocity=0.005, contributions=True)
        outside = rubber.extrapolated_shares(0.005 * result.wavenumber)[0]
        part = np.trapezoid(result.dmu_dlnq * outside, np.log(result.wavenumber))
        shares.append(result.extrapolated_share)
        assert result.extrapolated_share == pytest.approx(
            part / result.hysteresis, rel=5e-2, abs=1e-6
        )
    assert np.all(np.diff(shares) < 0)
    assert shares[0] > 0.01
    assert shares[-1] < 1e-3


@pytest.mark.parametrize("extrapolation", ["clamp", "power-law"])
def test_extrapolation_is_by_name_reported_and_a_decade_at_most(extrapolation):
    measured = {"low": 10.0, "high": 200.0}
    with pytest.raises(OutOfRange, match=r"velocity = 0\.05"):
        asperity.friction(ROAD, master_curve(**measured), pressure=2e5, velocity=0.05)
    rubber = master_curve(**measured, extrapolation=extrapolation)
    half = asperity.friction(ROAD, rubber, pressure=2e5, velocity=0.05)  # 100 to 1000 rad/s
    whole = asperity.friction(ROAD, rubber, pressure=2e5, velocity=0.1)  # 200 to 2000 rad/s
    assert 0.1 < half.extrapolated_share < whole.extrapolated_share <= 1 + 1e-12
    with pytest.raises(OutOfRange, match=r"velocity = 0\.11"):
        asperity.friction(ROAD, rubber, pressure=2e5, velocity=0.11)
    end, beyond = rubber.modulus([200.0, 2000.0])
    if extrapolation == "clamp":
        assert beyond == pytest.approx(end, rel=1e-12)
    else:
        near = rubber.modulus(200 * (1 - 1e-6))
        for part in (np.real, np.imag):
            slope = np.log(part(end) / part(near)) / -np.log1p(-1e-6)
            assert np.log10(part(beyond) / part(end)) == pytest.approx(slope, rel=1e-3)


def gw(z_max, z_min=-1e-3):
    return GreenwoodWilliamson(z_max=z_max, z_min=z_min)


# d~ of this scene is -1.36e-4 m, or half an rms height below the mean plane
STATES = {
    "partial": (gw(9e-4), {}),
    "full": (gw(9e-4, z_min=-1e-9), {}),
    "no contact": (gw(1e-4), {"pressure": 10.0}),
}


def state(correction, pressure):
    return asperity.separation(
        pressure=pressure,
        effective_modulus=1e7 / 0.75,
        rms_height=ROAD.rms_height,
        q0=ROAD.q0,
        z_max=correction.z_max,
        z_min=correction.z_min,
    ).state


@pytest.mark.parametrize("expected", STATES)
def test_states_of_contact_are_numbers_and_never_nan(expected):
    correction, changed = STATES[expected]
    scene = {"pressure": 1e6, "velocity": 1.0} | changed
    assert state(correction, scene["pressure"]) == expected
    rubber = PronySeries(equilibrium_modulus=1e7, moduli=[1.0], relaxation_times=[1.0])
    result = asperity.friction(
        ROAD, rubber, **scene, correction=correction, adhesion=asperity.Adhesion(shear_stress=1e6)
    )
    area = asperity.contact_area(ROAD, rubber, **scene, correction=correction)
    waves = {**scene, "wavenumber": [3e3, 2e4], "correction": correction}
    factor = asperity.correction_factor(ROAD, rubber, **waves)
    mean = asperity.mean_pressure(ROAD, rubber, **waves)
    density = asperity.pressure_distribution(1e6, ROAD, rubber, **scene, correction=correction)
    assert area == pytest.approx(result.contact_area, rel=1e-8)
    if expected == "no contact":
        assert (result.mu, result.hysteresis, result.adhesion, result.contact_area) == (0, 0, 0, 0)
        assert (result.shift_factor, result.error_estimate, density) == (math.inf, 0, 0)
        np.testing.assert_array_equal(factor, 0)
        np.testing.assert_array_equal(mean, np.inf)
    else:
        plain = asperity.friction(ROAD, rubber, **scene)
        assert (result.shift_factor == 1) == (expected == "full")
        assert (result.hysteresis == pytest.approx(plain.hysteresis, rel=1e-6, abs=0)) == (
            expected == "full"
        )
        assert np.all(np.isfinite([result.mu, area, density, *factor, *mean]))


WIDE = SelfAffineSpectrum(rms_height=2e-5, hurst=0.87, q0=2e3, q1=1e6)  # rms slope 0.2
NOTES = [
    (["unmeasured-bandwidth"], WIDE, 0.005, asperity.SFactor(), 2e5),
    (["area-further-off"], ROAD, 0.005, asperity.AffineShift(2), 2e5),
    (["no-correction", "steep-spectrum"], STEEP, 0.005, None, 2e5),
    (["heat-left-out", "no-correction"], ROAD, [0.005, 0.0101], None, 2e5),
    (["full-conformity"], ROAD, 0.005, gw(9e-4, z_min=-1e-9), 2e6),
    (
        ["separation-too-large", "unmeasured-load", "unusual-value"],
        ROAD,
        0.005,
        gw(2e-3, z_min=-2e-6),
        1.0,
    ),
    (["unmeasured-load"], ROAD, 0.005, asperity.SFactor(), 1e3),
    (["no-contact", "unusual-value"], ROAD, 0.005, gw(1e-4), 1.0),
    ([], ROAD, [1e-6, 0.01], gw(2e-3), 2e5),
    (["no-correction"], WIDE, 0.005, None, 2e5),
    (["no-correction"], STEEP.truncated(q1=STEEP.cutoff_for_slope()), 0.005, None, 2e5),
]


@pytest.mark.parametrize(("codes", "spectrum", "velocity", "correction", "pressure"), NOTES)
def test_a_note_appears_exactly_when_its_reason_does(
    codes, spectrum, velocity, correction, pressure
):
    arguments = {"pressure": pressure, "velocity": velocity, "correction": correction}
    notes = asperity.friction(spectrum, RUBBER, **arguments).notes
    assert sorted(note.code for note in notes) == codes
    for form in ("exact", "interpolated"):
        whole = asperity.friction(spectrum, RUBBER, form=form, **arguments).notes
        assert asperity.contact_notes(spectrum, RUBBER, form=form, **arguments) == whole


@pytest.mark.parametrize("p", [1.0, 1.05, 1.3, 1.6, 2.5])
def test_the_shift_is_worse_than_none_where_its_area_is_further_from_the_best(p):
    def area(correction):
        return asperity.contact_area(ROAD, RUBBER, **SCENE, correction=correction)

    none, best, shifted = area(None), area(asperity.NayakSFactor()), area(asperity.AffineShift(p))
    worse = abs(shifted - best) > abs(none - best)
    correction = asperity.AffineShift(p)
    for notes in (
        asperity.friction(ROAD, RUBBER, **SCENE, correction=correction).notes,
        asperity.contact_notes(ROAD, RUBBER, **SCENE, correction=correction),
    ):
        assert ("area-further-off" in {note.code for note in notes}) == worse


def test_an_elastic_solid_has_no_hysteresis():
    result = asperity.friction(ROAD, elastic(1e7), **SCENE, contributions=True)
    assert (result.mu, result.hysteresis, result.error_estimate, result.extrapolated_share) == (
        0,
    ) * 4
    np.testing.assert_array_equal(result.dmu_dlnq, 0)
    assert np.all(np.isfinite(result.decade_share))
