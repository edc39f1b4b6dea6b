"""Slopes of mu on random scenes; tests/stability/random_gradients.py takes 2,000 of them."""

import sys
from pathlib import Path

import pytest

sys.path.insert(0, str(Path(__file__).parents[2] / "stability"))
from random_gradients import compute

ROLLED = (71, 9)  # an ellipse whose slopes two levels had off alike
HALVED = (1, 230)  # panels beside the front so short that a double has one q for several nodes


@pytest.mark.parametrize(("seed", "scene"), [*((7, scene) for scene in range(24)), ROLLED, HALVED])
def test_slopes_are_those_of_differences_within_the_stated_error(seed, scene):
    outcome = compute(seed, scene)
    assert outcome.refused in ("", "no friction")
    for name, (error, stated, left) in outcome.errors.items():
        assert error <= stated + left, name
