"""Rubber that has several steady states of its heat: which is found, and how many."""

import sys
from pathlib import Path

import numpy as np
import pytest

import asperity
from helpers.cases import case
from helpers.heat import ASPHALT, LAW, hot
from helpers.rubbers import prony, tread

sys.path.insert(0, str(Path(__file__).parents[2] / "stability"))
import random_heat


@pytest.mark.parametrize("scene", [336, 1044, 1584, 1785, 1949])
def test_of_several_states_all_tolerances_find_the_coldest(scene):
    """From the velocity before, or where cold heat takes from itself, Newton may miss it."""
    outcome = random_heat.compute(1, scene, rings=0.1)
    assert len(outcome.ratios) >= 3
    assert max(outcome.ratios.values()) <= 1


COLDEST = {  # of three states, by a march in strides of 0.08 in ln theta(q1)
    (493, 1): 0.161656,
    (508, 3): 0.117812,
    (558, 2): 0.224594,
    (634, 1): 0.0732537,
    (715, 3): 0.0311666,
    (971, 1): 0.0654848,
    (1341, 1): 0.0635398,
    (1740, 2): 0.0880876,
}


@pytest.mark.parametrize("point", list(COLDEST))
def test_states_that_are_near_each_other_or_at_a_thin_front(point):
    scene, which = point
    road, compound, at = random_heat.draw_scene(np.random.default_rng([1, scene]), rings=0.1)
    at["velocity"] = at["velocity"][which]
    for rtol in (1e-3, 1e-6):
        result = asperity.friction(road, compound, **at, rtol=rtol)
        assert result.mu == pytest.approx(COLDEST[point], rel=rtol + 2e-5)
        assert result.branches == 3


# terms, rms height, lines by row and factor, q1, velocity, temperature, correction, states
LINES = [
    (7, 5.7e-5, {10: 1e3}, 1e5, 1.0, 261.0, None, 1),
    (7, 5.6e-5, {12: 1e2}, 1e6, 3.0, 249.0, None, 5),
    (5, 2.2e-5, {3: 1e2, 27: 1e3}, 1e6, 3.0, 255.0, None, 3),
    (6, 7.6e-5, {7: 1e3}, 1e5, 1.0, 239.0, asperity.PartialContact(), 3),
]


@pytest.mark.parametrize("line", LINES)
def test_a_line_that_runs_away_by_itself(line):
    """The rise at q1 turns about along the states; PartialContact's rule has three roots there."""
    terms, height, lines, q1, v, temperature, correction, states = line
    q = np.geomspace(1e3, q1, 40)
    road = asperity.SelfAffineSpectrum(rms_height=height, hurst=0.8, q0=1e3, q1=q1)
    density = road.at(q)
    for row, times in lines.items():
        density[row] *= times
    at = {
        "rubber": prony(3e6, np.geomspace(1e9, 1e6, terms), np.geomspace(1e-9, 1e-1, terms)),
        "pressure": 1e5,
        "velocity": v,
        "temperature": temperature,
        "shift": asperity.WLF(c1=12.0, c2=80.0, reference_temperature=293.15),
        "correction": correction,
    }
    table = asperity.TabulatedSpectrum(wavenumber=q, density=density)
    result, finer = (hot(table, **at, rtol=rtol) for rtol in (1e-5, 1e-8))
    assert result.branches == finer.branches == states
    assert abs(result.mu - finer.mu) <= result.error_estimate + finer.error_estimate


@pytest.mark.parametrize("temperature", [275.6, 275.625, 275.65, 275.7, 275.725])
def test_states_about_a_gain_of_one(temperature):
    """Two of three states meet at 275.71 K, from where on the rise is 47 instead of 38 K."""
    compound = prony(3e6, [4e8, 3e8, 1e8, 3e7, 1e7], [1e-8, 1e-7, 1e-6, 1e-4, 1e-2])
    at = {
        "velocity": 0.049652395705,
        "pressure": 12863.8338001,
        "temperature": temperature,
        "rubber": compound,
    }
    result, truth = (hot(ASPHALT, **at, rtol=rtol) for rtol in (1e-4, 1e-8))
    assert truth.gain < 1
    assert result.branches == truth.branches == (3 if temperature < 275.71 else 1)
    assert abs(result.mu - truth.mu) <= result.error_estimate + truth.error_estimate


def test_a_curve_stays_on_the_coldest_state():
    """Macro-asperities that stay colder than q1 make three states where one temperature has one."""
    at = {
        "rubber": prony(1.04e6, [1.82e8, 8.34e7, 8.1e7], [1.67e-9, 1.44e-6, 1.25e-3]),
        "heating": tread(conductivity=0.49, contact_diameter=5e-4, residence="box"),
        "adhesion": asperity.Adhesion(shear_stress=3.75e5, reference_velocity=6e-3),
        "pressure": 5648.0,
        "temperature": 278.5,
        "rtol": 1e-3,
    }
    road = asperity.SelfAffineSpectrum(rms_height=8e-5, hurst=0.73, q0=2000, q1=2.9e5)
    velocity = np.geomspace(0.017, 1.6, 12)
    curve = hot(road, velocity=velocity, **at)
    assert np.all(curve.gain < 1)
    assert list(curve.branches) == [1] * 2 + [3] * 10
    for i, v in enumerate(velocity):
        alone = hot(road, velocity=v, **at)
        with case(velocity=v):
            assert alone.branches == curve.branches[i]
            assert abs(alone.mu - curve.mu[i]) <= alone.error_estimate + curve.error_estimate[i]


def test_past_a_sharp_turn_the_curve_of_states_leads_on():
    """Five states; followed back from the turn the search did not end."""
    road, compound, at = random_heat.draw_scene(np.random.default_rng([901, 975]), 0.1)
    at |= {"velocity": max(at["velocity"]), "temperature": 256.3946583}
    assert asperity.friction(road, compound, **at, rtol=1e-3).branches == 5


@pytest.mark.parametrize("temperature", [685.0, 690.0, 699.0])
def test_rubber_near_the_highest_temperature_has_a_state(temperature):
    """The search ends at twice the rise that is left, which a first stride may be longer than."""
    for branch in ("cold", "hot"):
        result = hot(velocity=1.0, temperature=temperature, rtol=1e-3, branch=branch)
        assert result.branches == 1
        assert temperature < result.temperature < temperature + 0.1


@pytest.mark.parametrize("bump", [0.0, 1.2])
def test_a_row_of_a_table_where_the_shift_is_flat(bump):
    """The slope there is 0; a few kelvin further on the rubber is another one."""
    temperature = np.arange(233.15, 354, 5.0)
    factors = LAW.log10_a_T(temperature)
    if bump:
        factors[2] = factors[1] + 0.05
    table = asperity.ShiftFactors(
        reference_temperature=293.15, temperature=temperature, log10_a_T=factors
    )
    cold, heated = (
        hot(shift=table, velocity=[1.0, 10.0], temperature=243.15, rtol=1e-3, branch=branch)
        for branch in ("cold", "hot")
    )
    assert np.all(cold.branches == 3)
    assert np.all(cold.temperature < 243.4)
    assert np.all(heated.temperature > 280)


RUNAWAY = {  # at a gain of 0.94 to 0.98, where a residual counts 15 to 50 times
    "spectrum": asperity.SelfAffineSpectrum(
        rms_height=4.45052e-05, hurst=0.925827, q0=1741.46, q1=107879
    ),
    "rubber": prony(
        4309089.67,
        [
            6.10205837e7,
            3.04874174e8,
            4.34892323e8,
            1.76497159e8,
            2.07049882e7,
            1.10946056e6,
            4.53718175e5,
            4.4759352e5,
        ],
        [
            1.6547379e-10,
            7.97568323e-9,
            3.84420537e-7,
            1.85287134e-5,
            8.93066808e-4,
            4.30449921e-2,
            2.07472871,
            100,
        ],
    ),
    "velocity": 0.0579061,
    "pressure": 508796.3,
    "correction": asperity.NayakSFactor(),
    "adhesion": asperity.Adhesion(shear_stress=5.18621e6),
    "shift": asperity.WLF(c1=8.86, c2=101.6, reference_temperature=293.15),
    "heating": asperity.Heating(
        density=1150, heat_capacity=1700, conductivity=0.2, contact_diameter=0.002274326735
    ),
}


@pytest.mark.parametrize("rtol", [3e-4, 1e-4, 3e-5, 1e-5])
def test_near_runaway_every_tolerance_is_met(rtol):
    temperature = np.linspace(285.28, 285.30, 200)
    fine = asperity.friction(**RUNAWAY, temperature=temperature, rtol=1e-7)
    assert np.all((fine.gain > 0.9) & (fine.gain < 1))
    coarse = asperity.friction(**RUNAWAY, temperature=temperature, rtol=rtol)
    assert np.all(np.abs(coarse.mu - fine.mu) <= coarse.error_estimate)
