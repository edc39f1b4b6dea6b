"""Friction maps with heat: the certified error, the way from cold to hot, what is refused."""

import numpy as np
import pytest

from asperity import (
    Adhesion,
    FrictionMap,
    GreenwoodWilliamson,
    InvalidInput,
    NayakSFactor,
    NotConverged,
    OutOfRange,
    PronySeries,
    SFactor,
    friction,
    friction_map,
)
from helpers.cases import long
from helpers.mapped import HEAT, LAW, ROAD, drawn, measured
from helpers.mapped import WARM_RUBBER as RUBBER

ADHESION = Adhesion(shear_stress=8.3e6)
BOX = {"pressure": (1e5, 3e5), "velocity": (0.05, 10.0)}
RANGE = (288.15, 298.15)
PARTS = ("mu", "hysteresis", "adhesion", "contact_area")


def made(temperature=293.15, rubber=RUBBER, adhesion=ADHESION, box=BOX, **options):
    options = {"checked": 0, "rtol": 1e-3, **HEAT, **options}
    return friction_map(ROAD, rubber, temperature=temperature, adhesion=adhesion, **box, **options)


@pytest.fixture(scope="module")
def one():
    return made(checked=1000)


@pytest.fixture(scope="module")
def several():
    return made(RANGE, checked=1000)


SCENES = {
    "none": {},
    "s-factor": {"correction": SFactor(applies_to="both")},
    "nayak": {"correction": NayakSFactor()},
    "no adhesion": {"adhesion": None},
    "interpolated": {"form": "interpolated"},
    "master curve": {"rubber": measured(RUBBER, 1e11, 300)},
}


SLOW = "master curve"  # ten milliseconds a point


@pytest.mark.parametrize(
    ("name", "rtol"),
    [*((name, 1e-3) for name in SCENES if name != SLOW), ("none", 1e-5), long(SLOW, 1e-2)],
)
def test_a_hot_map_is_as_good_as_it_says(name, rtol):
    scene = {"rubber": RUBBER, "adhesion": ADHESION, "correction": None, "form": "exact"}
    scene |= SCENES[name]
    result = made(**scene, rtol=rtol)
    assert 0 < result.max_error <= rtol
    assert result.temperature == (293.15, 293.15)
    p, v, _ = drawn(300, BOX, RANGE)
    at = {"pressure": p, "velocity": v, "temperature": 293.15}
    truth = friction(ROAD, scene.pop("rubber"), **at, **HEAT, **scene, rtol=1e-9)
    assert (np.abs(truth.mu / truth.cold.mu - 1) > 0.1).any()
    for quantity in PARTS:
        exact, cold = getattr(truth, quantity), getattr(truth.cold, quantity)
        look_up = getattr(result, quantity)
        assert (np.abs(look_up(p, v) - exact) <= result.max_error * exact).all(), quantity
        begun = look_up(p, v, distance=0.0)
        assert (np.abs(begun - cold) <= result.cold.max_error * cold).all(), quantity
        np.testing.assert_allclose(getattr(result.cold, quantity)(p, v), begun, rtol=1e-12)


def test_so_is_one_with_an_axis_of_temperature(several):
    assert several.temperature == RANGE
    assert several.max_error <= several.rtol
    p, v, t = drawn(300, BOX, RANGE)
    at = {"pressure": p, "velocity": v, "temperature": t}
    truth = friction(ROAD, RUBBER, **at, **HEAT, adhesion=ADHESION, rtol=1e-9)
    begun = several.cold.mu(p, v, a_T=10 ** (LAW.log10_a_T(t) - LAW.log10_a_T(RANGE[0])))
    for quantity in PARTS:
        exact, cold = getattr(truth, quantity), getattr(truth.cold, quantity)
        look_up = getattr(several, quantity)
        assert (np.abs(look_up(**at) - exact) <= several.max_error * exact).all(), quantity
        first = look_up(**at, distance=0.0)
        # a_T between the nodes of temperature is off by less than a tenth of rtol
        assert (np.abs(first - cold) <= (several.cold.max_error + 1e-4) * cold).all(), quantity
    np.testing.assert_allclose(several.mu(**at, distance=0.0), begun, rtol=1e-4)


def test_hysteresis_is_as_good_where_adhesion_is_25_000_times_as_much():
    """An estimate for the whole mu, over mu_H, would be 1 % of mu_H before any cell is made."""
    nearly_elastic = PronySeries(
        equilibrium_modulus=3e7, moduli=[3e3, 3e3], relaxation_times=[1e-5, 1e-3]
    )
    box = {"pressure": (1e5, 4e5), "velocity": (1e-2, 0.1)}
    result = made(rubber=nearly_elastic, box=box, checked=400)
    assert (result.max_error <= result.rtol, result.exceeded) == (True, 0)
    p, v, _ = drawn(100, box, RANGE)
    at = {"pressure": p, "velocity": v, "temperature": 293.15}
    truth = friction(ROAD, nearly_elastic, **at, **HEAT, adhesion=ADHESION, rtol=1e-10)
    assert (truth.adhesion > 2e4 * truth.hysteresis).all()
    assert (np.abs(result.hysteresis(p, v) / truth.hysteresis - 1) <= result.max_error).all()
    assert (np.abs(result.contact_area(p, v) / truth.contact_area - 1) <= result.max_error).all()


def test_what_heat_hardly_changes_is_the_error_of_its_memory():
    told = []
    result = made(adhesion=None, box=BOX | {"velocity": (1e-6, 1e-5)}, progress=told.append)
    assert (told == sorted(told), told[-1]) == (True, 1)
    at = {"pressure": np.geomspace(*BOX["pressure"], 20)[:, None], "velocity": [1e-6, 3e-6, 1e-5]}
    truth = friction(ROAD, RUBBER, temperature=293.15, **at, **HEAT, rtol=1e-10)
    change = np.abs(truth.mu / truth.cold.mu - 1).max()
    assert 0 < change < 0.1 * result.rtol
    assert 0.9 * change < result.memory_error < 1.01 * change


@pytest.mark.parametrize("which", ["one", "several"])
def test_sliding_that_begins_heats_up_over_the_sliding_length(which, request):
    result = request.getfixturevalue(which)
    p, v, t = drawn(200, BOX, RANGE, seed=2)
    if which == "one":
        t = np.full_like(t, 293.15)
    at = {"pressure": p, "velocity": v, "temperature": t}
    truth = friction(ROAD, RUBBER, **at, **HEAT, adhesion=ADHESION)
    distance = truth.sliding_length * np.random.default_rng(3).uniform(0, 3, p.size)
    error = np.abs(result.mu(**at, distance=distance) / truth.mu_at(distance) - 1)
    # 99 % of points keep memory_error, beside the map's own error
    assert np.mean(error <= result.memory_error + result.max_error) >= 0.99
    begun, long_ago = result.mu(**at, distance=0.0), result.mu(**at)
    # and all keep what the heat changes, whatever s0 is
    largest = np.maximum(truth.mu, truth.cold.mu)
    off = np.abs(result.mu(**at, distance=distance) - truth.mu_at(distance))
    assert (off <= np.abs(truth.cold.mu - truth.mu) + 1.1 * result.max_error * largest).all()
    np.testing.assert_array_equal(result.mu(**at, distance=1.0), long_ago)
    s0 = result.sliding_length(v, temperature=t)
    between = result.mu(**at, distance=s0)
    np.testing.assert_allclose(between, long_ago + (begun - long_ago) / np.e, rtol=1e-12)


def test_the_grid_of_the_sliding_length_is_halved_where_it_is_steep():
    """Steps of 0.25 in ln v alone leave 2 % of mu."""
    box = {"pressure": (8e4, 4e5), "velocity": (1e-2, 20.0)}
    result = made(adhesion=None, rtol=1e-2, box=box)
    assert 0 < result.memory_error < 0.01


def test_a_map_is_the_same_for_any_number_of_threads():
    box = {"pressure": (8e4, 1.2e5), "velocity": (0.8, 1.2)}
    options = {"rtol": 1e-2, "checked": 800, "box": box}
    single, pair = (made((292.0, 294.0), threads=n, **options) for n in (1, 2))
    assert single.to_bytes() == pair.to_bytes()


def test_a_map_is_saved_and_comes_back(several, tmp_path):
    several.save(tmp_path / "hot.fmap")
    loaded = FrictionMap.load(tmp_path / "hot.fmap")
    assert loaded == several
    assert loaded.cold == several.cold
    table = loaded.to_xarray()
    assert table.attrs["temperature_k"] == RANGE[0]
    p, v = table.pressure.values[3], table.velocity.values[5]
    assert table.mu.values[3, 5] == pytest.approx(loaded.mu(p, v, temperature=RANGE[0]), rel=1e-14)


@pytest.mark.parametrize(
    ("argument", "value", "error"),
    [
        ("a_T", 2.0, InvalidInput),
        ("shift_adhesion", True, InvalidInput),
        ("temperature", 310.0, OutOfRange),
        ("temperature", float("nan"), InvalidInput),
        ("temperature", None, InvalidInput),
        ("distance", -1e-3, InvalidInput),
        ("distance", float("nan"), InvalidInput),
    ],
)
def test_look_ups_refuse_what_would_lie(several, argument, value, error):
    for name in (*PARTS, "derivatives"):
        with pytest.raises(error) as caught:
            getattr(several, name)(2e5, 0.3, **({"temperature": 293.0} | {argument: value}))
        assert caught.value.argument == argument
    if argument == "a_T":
        for outside in ("nan", "clamp"):  # it is no place
            with pytest.raises(InvalidInput):
                several.mu(2e5, 0.3, temperature=293.0, outside=outside, a_T=value)


def test_a_map_without_heat_knows_no_temperature():
    cold = friction_map(ROAD, RUBBER, **BOX, checked=0, rtol=1e-2)
    assert (cold.temperature, cold.cold, cold.memory_error) == (None, None, None)
    with pytest.raises(InvalidInput, match=r"temperature = 293: must be left out"):
        cold.mu(2e5, 0.3, temperature=293)
    assert cold.sliding_length(0.3) is None
    assert cold.mu(2e5, 0.3, distance=0.0) == pytest.approx(cold.mu(2e5, 0.3), rel=1e-14)


def test_without_heating_the_rubber_is_shifted_to_the_temperature():
    options = {"checked": 0, "rtol": 1e-2, **BOX}
    result = friction_map(ROAD, RUBBER, temperature=303.15, shift=LAW, **options)
    by_hand = friction_map(ROAD, RUBBER.shifted(10 ** LAW.log10_a_T(303.15)), **options)
    p, v, _ = drawn(50, BOX, RANGE)
    np.testing.assert_array_equal(result.mu(p, v), by_hand.mu(p, v))


GLASS = {  # the rubber's glass transition is at -30 C, where heat runs away from 1 m/s on
    "moduli": [2e8, 3e8, 3e8, 1e8, 2e7, 2e6, 5e5],
    "relaxation_times": [1e-9, 1e-8, 1e-7, 1e-6, 1e-5, 1e-4, 1e-2],
}


def test_a_fold_is_refused_with_its_temperature_and_velocity():
    rubber = PronySeries(equilibrium_modulus=2e6, **GLASS)
    at = {"pressure": 2e5, "velocity": np.geomspace(1, 20, 30), "temperature": 238.0}
    result = friction(ROAD, rubber, **at, **HEAT)
    assert result.branches.max() > 1
    with pytest.raises(InvalidInput) as caught:
        made((238.0, 250.0), rubber=rubber, adhesion=None, box=BOX | {"velocity": (0.1, 20.0)})
    text = str(caught.value)
    assert text.startswith("temperature = 238: at velocity = ")
    assert "the heat has 3 steady states" in text


@pytest.mark.parametrize(
    ("argument", "given"),
    [
        ("correction", {"correction": GreenwoodWilliamson(z_max=9e-4, z_min=-8e-4)}),
        ("heating", {"temperature": None}),
        ("heating", {"shift": None}),
        ("heating", {"heating": 3}),
        ("shift", {"heating": None, "temperature": None}),
        ("temperature", {"heating": None, "shift": None}),
        ("temperature", {"heating": None, "temperature": (280, 290)}),
        ("temperature", {"temperature": (290.0, 280.0)}),
        ("temperature", {"temperature": (280, 290, 300)}),
        ("temperature", {"temperature": 20.0}),
    ],
)
def test_what_no_map_is_made_of_is_refused(argument, given):
    with pytest.raises(InvalidInput) as caught:
        made(**given)
    assert caught.value.argument == argument


@pytest.mark.long
def test_a_tolerance_out_of_reach_says_what_was_reached():
    with pytest.raises(NotConverged, match=r"rtol = 1e-08: .* between \d+ temperatures"):
        made((263.15, 323.15), rtol=1e-8, box={"pressure": (1e5, 1.1e5), "velocity": (0.1, 0.12)})
