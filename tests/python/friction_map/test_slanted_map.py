"""Friction maps with heat over a range of temperatures of measured rubber: slanted ones."""

import numpy as np
import pytest

import asperity
from asperity import Adhesion, friction, friction_map
from helpers.cases import long
from helpers.map_layout import ByLayout
from helpers.mapped import HEAT, LAW, ROAD, measured
from helpers.mapped import WARM_RUBBER as SERIES

RANGE = (288.15, 298.15)
# ln a_T goes over 2.0: the first box is longer than that in ln v, the second shorter
BOXES = {
    "wide": {"pressure": (1e5, 3e5), "velocity": (0.3, 4.0)},
    "narrow": {"pressure": (1e5, 3e5), "velocity": (1.5, 4.0)},
}
GIVEN = HEAT | {"adhesion": Adhesion(shear_stress=8.3e6)}
TABLE = asperity.ShiftFactors(  # whose a_T has kinks of its own
    reference_temperature=293.15, temperature=[280, 294, 310, 400], log10_a_T=[1.0, -0.1, -1, -4]
)
PARTS = ("mu", "hysteresis", "adhesion", "contact_area")


CURVE = measured(SERIES, 1e11, 57)  # four rows a decade: the modulus has a kink at each


@pytest.fixture(scope="module", params=BOXES)
def result(request):
    return friction_map(
        ROAD, CURVE, temperature=RANGE, **BOXES[request.param], **GIVEN, rtol=1e-3, checked=1000
    )


def points(result, count, seed=1):
    """The corners of the box, points on its sides, and random ones."""
    sides = (result.pressure, result.velocity, result.temperature)
    corners = [a.ravel() for a in np.meshgrid(*sides, indexing="ij")]
    draws = np.random.default_rng(seed)
    drawn = []
    for side, corner in zip(sides, corners, strict=True):
        column = np.exp(draws.uniform(*np.log(side), count))
        edge = draws.random(count)
        column[edge < 0.1], column[edge > 0.9] = side
        drawn.append(np.concatenate((corner, column.clip(*side))))
    return dict(zip(("pressure", "velocity", "temperature"), drawn, strict=True))


def test_it_is_as_good_as_it_says_to_the_corners_of_the_box(result):
    assert 0 < result.max_error <= result.rtol
    assert (result.checked, result.exceeded) == (1000, 0)
    assert result.to_bytes()[152] == 3
    assert asperity.FrictionMap.from_bytes(result.to_bytes()) == result
    at = points(result, 200)
    truth = friction(ROAD, CURVE, **at, **GIVEN, rtol=1e-7)
    assert np.ptp(np.log(truth.mu / truth.cold.mu)) > 0.5  # heat has its say
    for part in PARTS:
        exact = getattr(truth, part)
        np.testing.assert_array_less(
            np.abs(getattr(result, part)(**at) - exact), result.max_error * exact, err_msg=part
        )
        begun = getattr(result, part)(**at, distance=0.0)
        cold = getattr(truth.cold, part)
        np.testing.assert_array_less(
            np.abs(begun - cold), result.cold.max_error * cold + 1e-6 * cold, err_msg=part
        )


def test_slopes_are_those_of_mu_to_the_corners_of_the_box(result):
    at = points(result, 200, seed=3)
    slopes, h = result.derivatives(**at), 1e-5
    for column, slope in (("velocity", slopes.dmu_dlnv), ("pressure", slopes.dmu_dlnp)):
        side = getattr(result, column)
        higher, lower = ((at[column] * np.exp(sign * h)).clip(*side) for sign in (1, -1))
        rise = result.mu(**at | {column: higher}) - result.mu(**at | {column: lower})
        # on a side of the box the difference is one of first order
        np.testing.assert_allclose(
            slope, rise / np.log(higher / lower), rtol=1e-4, atol=1e-4, err_msg=column
        )


def test_on_the_way_from_cold_to_hot(result):
    at = points(result, 100, seed=4)
    s0 = result.sliding_length(at["velocity"], temperature=at["temperature"])
    begun, long_ago = result.mu(**at, distance=0.0), result.mu(**at)
    expected = long_ago + (begun - long_ago) / np.e
    np.testing.assert_allclose(result.mu(**at, distance=s0), expected, rtol=1e-12)


def test_outside_is_held_at_the_box(result):
    v = result.velocity[1]
    beyond = result.mu(2e5, 2 * v, temperature=400.0, outside="clamp")
    assert beyond == pytest.approx(result.mu(2e5, v, temperature=RANGE[1]), rel=1e-14)
    with pytest.raises(asperity.OutOfRange, match=r"velocity = .*the map covers"):
        result.mu(2e5, 2 * v, temperature=290.0)


@pytest.mark.parametrize(
    ("rubber", "shift", "flags"), [(SERIES, LAW, 1), long(CURVE, TABLE, 1), long(CURVE, LAW, 3)]
)
def test_which_maps_are_slanted(rubber, shift, flags):
    box = {"pressure": (1e5, 1.2e5), "velocity": (0.98, 1.0), "temperature": (290.0, 290.2)}
    made = friction_map(ROAD, rubber, **box, **GIVEN | {"shift": shift}, rtol=0.1, checked=0)
    assert made.to_bytes()[152] == flags


def test_one_temperature_of_a_box_that_is_rough_throughout():
    """The polynomials that it begins with are all halved before one is held against points."""
    box = {"pressure": (1e5, 1.2e5), "velocity": (0.6, 4.0)}
    made = friction_map(ROAD, CURVE, temperature=293.15, **box, **GIVEN, rtol=1e-3, checked=400)
    assert (made.to_bytes()[152], made.exceeded) == (1, 0)


def test_the_documentation_is_enough_to_read_a_file(result):
    read, at = ByLayout(result.to_bytes()), points(result, 100, seed=5)
    exact = np.array([read.slanted_look_up(*point) for point in zip(*at.values(), strict=True)])
    np.testing.assert_allclose(result.hysteresis(**at), exact[:, 0], rtol=1e-11)
    np.testing.assert_allclose(result.contact_area(**at), exact[:, 1], rtol=1e-11)
