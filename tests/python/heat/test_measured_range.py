"""Heat of a measured modulus: its two ends, towards the low one of which heat moves, its rows."""

import sys
from pathlib import Path

import numpy as np
import pytest

import asperity
from helpers.heat import CUT, hot, rubber
from helpers.rubbers import curve_of

sys.path.insert(0, str(Path(__file__).parents[2] / "stability"))
import random_heat


def measured(lowest, highest):
    w = np.geomspace(lowest, highest, 140)
    modulus = rubber().modulus(w)
    return curve_of(w, modulus)


def test_heat_takes_the_rubber_out_at_the_low_end():
    curve = measured(1950.0, 1e12)  # rad/s; q0 at 1 m/s asks for 2000, and 3 K warmer for 1050
    cold = asperity.friction(CUT, curve, pressure=2e5, velocity=1.0)
    # |cos phi| asks for lower frequencies too, which the results tell as extrapolated
    assert cold.extrapolated_share > 0.01
    assert cold.mu == pytest.approx(1.294, rel=0.1)
    with pytest.raises(asperity.OutOfRange) as error:
        hot(velocity=1.0, rubber=curve)
    assert "the rubber heats itself to 305." in str(error.value)
    assert "known in [1950, 1e+12] rad/s" in str(error.value)
    assert "\n" not in str(error.value)
    wide = hot(velocity=1.0, rubber=measured(900.0, 1e12), rtol=1e-6)
    assert wide.mu == pytest.approx(hot(velocity=1.0).mu, rel=0.1)
    assert wide.extrapolated_share > 0.01


def test_the_high_end_is_that_of_the_cold_rubber():
    curve = measured(1.0, 2.2e4)  # rad/s; q1 at 1 m/s asks for 23340, heated for less than 10^4
    with pytest.raises(asperity.OutOfRange, match=r"23339.8 rad/s, known in \[1, 22000\] rad/s"):
        hot(velocity=1.0, rubber=curve)
    below = hot(velocity=0.94, rubber=curve, rtol=1e-6)
    assert below.mu == pytest.approx(hot(velocity=0.94).mu, rel=1e-4)


def test_the_estimate_is_kept_on_random_master_curves():
    """Rows anywhere between nodes: levels do not get better by two digits each."""
    outcomes = [random_heat.compute(3, scene, rings=0.5, curves=1.0) for scene in range(14)]
    told = [outcome for outcome in outcomes if outcome.ratios]
    assert len(told) >= 6
    assert max(max(outcome.ratios.values()) for outcome in told) <= 1


@pytest.mark.parametrize(("seed", "scene"), [(3, 447), (5, 294), (5, 548)])
def test_grids_that_are_off_alike_are_not_believed(seed, scene):
    """Two grids agreed where both were off, by 1.6, 1.4 and 2.0 times what was told."""
    outcome = random_heat.compute(seed, scene, rings=0.5, curves=1.0)
    assert len(outcome.ratios) == 3
    assert max(outcome.ratios.values()) <= 1
