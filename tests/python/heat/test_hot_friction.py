"""Friction that heats its rubber: values of two other programs, limits, honesty, refusals."""

import sys
from pathlib import Path

import numpy as np
import pytest

import asperity
from helpers.cases import case
from helpers.examples import TREAD
from helpers.heat import ASPHALT, CUT, LAW, STICKY, hot, rubber
from helpers.refusals import refused
from helpers.rubbers import curve_of, tread

sys.path.insert(0, str(Path(__file__).parents[2] / "stability"))
import random_heat

KINDS = {
    "s_factor": {"correction": asperity.SFactor(gamma=0.5)},
    "interpolated": {"form": "interpolated"},
    "box": {"heating": tread(residence="box")},
    "macro_area_0.2": {"heating": tread(macro_area=0.2)},
    "adhesion": {"adhesion": STICKY},
}


def of_row(row, **more):
    spectrum = ASPHALT.truncated(q1=row["q1"])
    at = {name: row[name] for name in ("pressure", "temperature")}
    return hot(spectrum, **at, **KINDS.get(row["kind"], {}), **more)


def test_the_table_of_two_other_programs(reference_table):
    rows = reference_table("flash")
    curves = {}
    for row in rows:
        key = tuple(row[name] for name in ("kind", "pressure", "temperature", "q1"))
        curves.setdefault(key, []).append(row)
    compared = 0
    for key, of_curve in curves.items():
        velocity = np.array([row["velocity"] for row in of_curve])
        found = of_row(of_curve[0], velocity=velocity)
        for i, row in enumerate(of_curve):
            if row["solution"] != 1:
                continue
            values = {
                "mu_h": found.hysteresis[i],
                "mu_a": found.adhesion[i],
                "area": found.contact_area[i],
                "area_macro": found.macro_area[i],
                "rise_q1": found.temperature[i] - row["temperature"],
                "mu_h_cold": found.cold.hysteresis[i],
                "mu_a_cold": found.cold.adhesion[i],
                "area_cold": found.cold.contact_area[i],
            }
            for name, value in values.items():
                with case(key=key, velocity=row["velocity"], name=name):
                    # a rise is a difference of temperatures of 300 K
                    rounding = 2e-13 if name == "rise_q1" else 0
                    assert value == pytest.approx(row[name], rel=1e-8, abs=rounding)
            with case(key=key, velocity=row["velocity"]):
                assert found.branches[i] == row["solutions"]
                assert found.gain[i] == pytest.approx(row["gain"], rel=1e-6)
                assert found.error_estimate[i] <= 1e-9 * found.mu[i]
            compared += 1
    assert compared == 71


def test_every_branch_of_the_thermal_runaway(reference_table):
    rows = [row for row in reference_table("flash") if row["solutions"] == 3]
    assert [row["solution"] for row in rows] == [1, 2, 3]
    for branch, row in (("cold", rows[0]), ("hot", rows[2])):
        found = of_row(row, velocity=row["velocity"], branch=branch)
        with case(branch=branch):
            assert found.branches == 3
            assert found.mu == pytest.approx(row["mu_h"], rel=1e-8)
            assert found.temperature - row["temperature"] == pytest.approx(row["rise_q1"], 1e-8)
            assert "several-states" in {note.code for note in found.notes}


def test_temperature_profiles(reference_table):
    rows = reference_table("flash_profile")
    curves = {}
    for row in rows:
        curves.setdefault((row["kind"], row["velocity"]), []).append(row)
    assert len(curves) == 15
    for (kind, velocity), profile in curves.items():
        row = {**profile[0], "q1": profile[-1]["wavenumber"]}
        found = of_row(row, velocity=velocity, contributions=True)
        q = np.array([one["wavenumber"] for one in profile])
        rise = np.interp(np.log(q), np.log(found.wavenumber), found.temperature_profile) - 293.15
        expected = np.array([one["rise"] for one in profile])
        with case(kind=kind, velocity=velocity):
            np.testing.assert_allclose(rise, expected, rtol=1e-3)  # linear between its wavenumbers
            np.testing.assert_allclose(rise[[0, -1]], expected[[0, -1]], rtol=1e-8)


def test_contributions_add_up_to_the_hysteresis():
    v = np.array([1e-3, 1.0])
    found = hot(velocity=v, contributions=True, adhesion=STICKY)
    plain = hot(velocity=v, adhesion=STICKY)
    np.testing.assert_allclose(found.mu, plain.mu, rtol=2e-9)
    np.testing.assert_allclose(found.decade_share.sum(axis=-1), 1, rtol=1e-12)
    total = np.trapezoid(found.dmu_dlnq, np.log(found.wavenumber), axis=-1)
    np.testing.assert_allclose(total, found.hysteresis, rtol=5e-3)
    assert (np.diff(found.temperature_profile, axis=-1) > 0).all()  # hottest at the surface
    np.testing.assert_allclose(found.temperature_profile[:, -1], found.temperature, rtol=1e-12)


def test_the_reference_of_the_law_does_not_matter():
    other = asperity.WLF(c1=8.86 * 101.6 / 121.6, c2=121.6, reference_temperature=313.15)
    warm = rubber().shifted(10 ** LAW.log10_a_T(313.15))
    v = np.geomspace(1e-3, 10, 5)
    np.testing.assert_allclose(
        hot(velocity=v, shift=other, rubber=warm).mu, hot(velocity=v).mu, rtol=2e-9
    )


def test_strong_or_quick_cooling_leads_back_to_the_cold_rubber():
    v = 1.0
    rise = [
        hot(velocity=1e-5, heating=tread(conductivity=conductivity)).temperature - 293.15
        for conductivity in (1.0, 100.0)
    ]
    assert rise[0] / rise[1] == pytest.approx(10, rel=0.03)  # as lambda^-1/2
    small = {"contact_diameter": 1e-10, "macro_wavenumber": 6283.0}
    found = hot(velocity=v, heating=tread(**small))
    assert found.mu == pytest.approx(found.cold.mu, rel=1e-6)
    smaller = asperity.Heating(**TREAD | small | {"contact_diameter": 1e-12})
    rises = found.temperature - 293.15, hot(velocity=v, heating=smaller).temperature - 293.15
    assert rises[0] / rises[1] == pytest.approx(100, rel=0.02)


def test_the_energy_arrives_at_long_waves():
    """theta(q) / (2 q) -> t_r mu sigma0 v / (rho c_v P_m), q -> 0, whatever conducts the heat."""
    long_waves = asperity.TabulatedSpectrum(
        wavenumber=[1e-2, 1999.9, 2000.0, 23339.0],
        density=[1e-60, 1e-60, *CUT.at([2000.0, 23339.0])],
    )
    found = hot(
        long_waves,
        velocity=1.0,
        contributions=True,
        rtol=1e-9,
        heating=tread(macro_wavenumber=6283.0),
    )
    residence = 8 * 5e-4 / (3 * np.pi)
    flux = found.hysteresis * 2e5 / (1200 * 1650 * found.macro_area)
    rise = found.temperature_profile[0] - 293.15
    # 2 q sqrt(D t) is 2e-7 and the rise a millionth of that of the surface
    assert rise / (2 * 1e-2) == pytest.approx(residence * flux, rel=5e-6)


@pytest.mark.parametrize("faint", [0.0, 1e-60, 1e-12, 1e-6])
def test_a_contact_may_break_up_far_beyond_the_first_wave(faint):
    """Roughness that begins at 2000 1/m, after decades of next to none."""
    table = asperity.TabulatedSpectrum(
        wavenumber=[1e-2, 1999.9, 2000.0, 23339.0],
        density=[faint * 1e-20, faint * 1e-20, *CUT.at([2000.0, 23339.0])],
    )
    at = {
        "velocity": 1.0,
        "heating": tread(macro_wavenumber=6283.0),
    }
    truth = hot(table, **at, rtol=1e-10)
    for rtol in (1e-4, 1e-7, 1e-8, 1e-9):
        found = hot(table, **at, rtol=rtol)
        with case(rtol=rtol):
            assert abs(found.mu - truth.mu) <= found.error_estimate + truth.error_estimate


def test_without_conduction_each_wave_keeps_its_heat():
    """theta = (8 / 3 pi) R q0 mu sigma0 / (rho c_v P_m) at D = 0, off by q1 / q0 - 1."""
    insulating = asperity.Heating(
        density=1e4,
        heat_capacity=1e4,
        conductivity=0.01,
        contact_diameter=1e-6,
        macro_area=0.1,
    )
    errors = []
    for width in (1e-2, 1e-4):
        narrow = asperity.SelfAffineSpectrum(
            rms_height=1e-4, hurst=0.8, q0=2000, q1=2000 * (1 + width)
        )
        found = hot(narrow, velocity=30.0, heating=insulating, contributions=True)
        expected = 8 / (3 * np.pi) * 5e-7 * 2000 * found.mu * 2e5 / (1e8 * 0.1)
        errors.append(np.abs((found.temperature_profile - 293.15) / expected - 1).max())
    assert errors[0] < 1e-2
    assert errors[1] < 2e-4  # 2 q sqrt(D t) is 1e-5, and a rise of 1e-3 K has ten digits


def test_without_conduction_heat_spreads_as_deep_as_waves_overlap():
    """theta = (2 v t_r sigma0 / (rho c_v P_m)) int q q' / (q + q') dmu, v t_r = 8 R / 3 pi."""
    rises = []
    for capacity in (2e3, 1e4):
        insulating = {"density": 1e4, "heat_capacity": capacity, "conductivity": 0.01}
        small = {"contact_diameter": 1e-6, "macro_wavenumber": 6283.0}
        found = hot(
            velocity=30.0, heating=asperity.Heating(**insulating, **small), contributions=True
        )
        q, density = found.wavenumber, found.dmu_dlnq
        overlap = q[:, None] * q / (q[:, None] + q)
        density = density * found.hysteresis / np.trapezoid(density, np.log(q))
        whole = np.trapezoid(overlap * density, np.log(q), axis=-1)
        unit = 2 * 8 * 5e-7 / (3 * np.pi) * 2e5 / (1e4 * capacity * found.macro_area)
        rises.append(found.temperature_profile - 293.15)
        # 2 q1 sqrt(D t) is 2e-4, and the sum is by the trapezoid
        np.testing.assert_allclose(rises[-1], unit * whole, rtol=3e-3)
        assert found.mu == pytest.approx(found.cold.mu, rel=1e-3)
    np.testing.assert_allclose(rises[0] / rises[1], 5, rtol=2e-3)  # as 1 / (rho c_v)


def test_slow_sliding_warms_all_waves_alike():
    """theta -> (mu sigma0 v / (rho c_v P_m)) c_h sqrt(2 R / (pi D v)), off by sqrt v."""
    diffusivity = 0.23 / (1200 * 1650)
    errors = []
    for v in (1e-6, 1e-8, 1e-10):
        found = hot(velocity=v, contributions=True)
        flux = found.mu * 2e5 * v / (1200 * 1650 * found.macro_area)
        expected = flux * 1.2204156216029011 * np.sqrt(1e-3 / (np.pi * diffusivity * v))
        rises = found.temperature_profile - 293.15
        errors.append(np.abs(rises / expected - 1).max())
    assert errors[0] < 0.04
    assert errors[1] / errors[0] == pytest.approx(0.1, rel=0.01)
    assert errors[2] / errors[1] == pytest.approx(0.1, rel=0.02)  # rises of 1e-4 K


def test_the_estimate_is_kept_on_random_scenes():
    outcomes = [random_heat.compute(2, scene, rings=0.15) for scene in range(40)]
    told = [outcome for outcome in outcomes if outcome.ratios]
    assert len(told) > 32
    assert max(max(outcome.ratios.values()) for outcome in told) <= 1
    assert not any(outcome.refused for outcome in told)


@pytest.mark.parametrize("correction", [None, asperity.PartialContact(), "rings"])
def test_points_do_not_depend_on_the_threads_that_share_them(correction):
    v = np.geomspace(1e-4, 1, 40)
    q = np.geomspace(CUT.q0, CUT.q1, 40)
    table = asperity.TabulatedSpectrum(wavenumber=q, density=CUT.at(q))
    rings = isinstance(correction, str)
    given = {"velocity": v, "rtol": 1e-4, "correction": None if rings else correction}
    one, two, three = (
        hot(table if rings else CUT, **given, adhesion=STICKY, threads=n) for n in (1, 2, 3)
    )
    assert one == two == three


@pytest.mark.parametrize(
    ("argument", "changed"),
    [
        ("heating", {"shift": None, "temperature": None}),
        ("heating", {"heating": TREAD}),
        ("method", {"method": "qag"}),
        ("interface_share", {"heating": tread(interface_share=0.2)}),
        ("macro_wavenumber", {"heating": tread(macro_wavenumber=1e3)}),
        ("branch", {"heating": None, "branch": "hot"}),
        ("branch", {"branch": "warm"}),
    ],
)
def test_what_heating_cannot_be_asked_with_is_refused(argument, changed):
    with pytest.raises(asperity.InvalidInput) as caught:
        hot(**{"velocity": 1.0} | changed)
    assert caught.value.argument == argument


def test_heat_beyond_what_is_known_is_out_of_range():
    table = asperity.ShiftFactors(
        reference_temperature=293.15,
        temperature=[283.15, 293.15, 297.15],
        log10_a_T=LAW.log10_a_T([283.15, 293.15, 297.15]),
    )
    known = hot(velocity=1e-2, shift=table)
    assert known.mu == pytest.approx(hot(velocity=1e-2).mu, rel=1e-3)
    with refused("temperature", "unknown-shift", asperity.OutOfRange):
        hot(velocity=1.0, shift=table)
    fitted = asperity.PronyFit(
        equilibrium_modulus=2e6,
        moduli=rubber().moduli,
        relaxation_times=rubber().relaxation_times,
        storage_residual=0.01,
        loss_residual=0.01,
        causal=True,
        lowest_frequency=1900.0,
        highest_frequency=1e6,
    )
    with refused("temperature", "unknown-hot-modulus", asperity.OutOfRange):
        hot(velocity=1.0, rubber=fitted)  # heat leaves the range at its low end
    hot(velocity=1.0, rubber=rubber())
    burning = {"conductivity": 0.01, "contact_diameter": 0.1, "macro_area": 1e-3}
    with refused("temperature", "too-hot", asperity.OutOfRange):
        hot(velocity=30.0, pressure=5e6, heating=tread(**burning))


def test_notes_say_where_the_model_leaves_its_range():
    def codes(**more):
        return {note.code for note in hot(**{"velocity": 1.0} | more).notes}

    assert "heat-left-out" not in codes()
    cold = asperity.friction(CUT, rubber(), pressure=2e5, velocity=1.0)
    assert "heat-left-out" in {note.code for note in cold.notes}
    assert "hot-rubber" in codes(spectrum=ASPHALT, velocity=10.0)
    small = {"contact_diameter": 2e-6, "macro_area": 1e-6}
    assert "heat-flows-sideways" in codes(heating=tread(**small))
    wide = tread(contact_diameter=4e-3)
    assert {"macro-wavenumber-held", "crowded-contacts"} <= codes(heating=wide)


def test_sliding_lengths_of_the_history_of_the_heat(reference_table):
    """Distances to 1 / e over the diameter, by brute force to 4e-4."""
    curves = {}
    for row in reference_table("sliding_length"):
        curves.setdefault(row["q1"], []).append(row)
    assert sum(map(len, curves.values())) == 7
    for q1, rows in curves.items():
        velocity = np.array([row["velocity"] for row in rows])
        found = hot(ASPHALT.truncated(q1=q1), velocity=velocity, rtol=1e-6)
        expected = [row["length_over_diameter"] for row in rows]
        # linear between steps of an eightieth of the diameter
        np.testing.assert_allclose(found.sliding_length / 1e-3, expected, atol=0.002)
        assert found.sliding_length is found.sliding_length  # computed once
        np.testing.assert_allclose(found.mu_at(0.0), found.cold.mu, rtol=1e-15)
        np.testing.assert_allclose(found.mu_at(1.0), found.mu, rtol=1e-15)
        between = found.mu_at(found.sliding_length)
        np.testing.assert_allclose(
            (between - found.mu) / (found.cold.mu - found.mu), np.exp(-1), rtol=1e-9
        )


def test_friction_without_heat_has_no_sliding_length():
    cold = asperity.friction(CUT, rubber(), pressure=2e5, velocity=1.0)
    assert cold.sliding_length is None
    assert cold.mu_at(0.1) == cold.mu
    with refused("distance"):
        cold.mu_at(-1)
    many = hot(velocity=np.array([0.1, 1.0]))
    assert many.mu_at([[0.0], [1e-4], [1e-2]]).shape == (3, 2)
    for result in (many, many.cold):
        with refused("", "invalid-input"):  # of two arguments
            result.mu_at([0.0, 1e-4, 1e-2])


def test_measured_inputs_are_heated_too():
    """A dense table of the law is the law; on rings, jumps and zero rows the estimate is kept."""
    v = np.array([1e-2, 1.0])
    q = np.geomspace(CUT.q0, CUT.q1, 200)
    density = CUT.at(q)
    law = hot(velocity=v, rtol=1e-6)
    table = hot(asperity.TabulatedSpectrum(wavenumber=q, density=density), velocity=v, rtol=1e-6)
    np.testing.assert_allclose(table.mu, law.mu, rtol=1e-8)
    scatter = np.exp(0.3 * np.random.default_rng(1).normal(size=q.size))
    steps = np.where((np.arange(q.size) // 20) % 2, 1.0, 1e-3)
    empty = np.where((np.arange(q.size) < 50) | (np.arange(q.size) // 10 == 12), 0.0, 1.0)
    for factor in (scatter, steps, empty):
        rough = asperity.TabulatedSpectrum(wavenumber=q, density=density * factor)
        found, truth = (hot(rough, velocity=v, rtol=rtol) for rtol in (1e-5, 1e-8))
        assert (np.abs(found.mu - truth.mu) <= found.error_estimate).all()
    w = np.geomspace(1e-3, 1e12, 140)
    modulus = rubber().modulus(w)
    curve = curve_of(w, modulus)
    found, truth = (hot(velocity=v, rubber=curve, rtol=rtol) for rtol in (1e-5, 1e-8))
    assert (np.abs(found.mu - truth.mu) <= found.error_estimate).all()
    np.testing.assert_allclose(found.mu, law.mu, rtol=2e-5)  # Steffen at nine rows a decade
