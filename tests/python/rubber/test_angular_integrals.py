"""I1 and I2 of tabulated moduli against their definition, wherever a table can be awkward."""

import numpy as np
import pytest

from asperity import InvalidInput, MasterCurve, NotConverged
from helpers.awkward_moduli import RNG, TABLES
from helpers.by_definition import Definition


@pytest.mark.parametrize("extrapolation", [None, "power-law", "clamp"])
@pytest.mark.parametrize("name", TABLES)
def test_angular_integrals_are_those_of_the_definition(name, extrapolation):
    w, storage, loss = TABLES[name]
    curve = MasterCurve(
        angular_frequency=w, storage_modulus=storage, loss_modulus=loss, extrapolation=extrapolation
    )
    reach = 9.99 if extrapolation else 1
    inside = np.exp(RNG.uniform(np.log(w[0] / reach), np.log(w[-1] * reach), 20))
    at = np.concatenate([inside, w[:3], w[1:3] * (1 - 1e-9), w[:-1][:2] * (1 + 1e-9), w[-2:]])
    definition = Definition(w, storage, loss, extrapolation)
    expected = np.array([definition(one) for one in at]).T
    # measured: 2e-14 at worst
    np.testing.assert_allclose(curve.angular_integrals(at), expected[:2], rtol=1e-12)
    # the shares are kept to 1e-10
    np.testing.assert_allclose(curve.extrapolated_shares(at), expected[2:], rtol=0, atol=1e-10)


def test_frequencies_in_any_order_have_the_integrals_that_each_has_alone():
    w, storage, loss = TABLES["uneven"]
    curve = MasterCurve(angular_frequency=w, storage_modulus=storage, loss_modulus=loss)
    at = RNG.permutation(np.concatenate([w, np.geomspace(w[0], w[-1], 999)[1:-1]]))
    alone = np.array([curve.angular_integrals(one) for one in at]).T
    np.testing.assert_array_equal(curve.angular_integrals(at.reshape(-1, 1)), alone[:, :, None])


def test_a_step_steeper_than_frequencies_can_tell_is_refused_not_smoothed():
    curve = MasterCurve(
        angular_frequency=[1, 10, 10 * (1 + 1e-12), 100, 1e4],
        storage_modulus=[1e6, 2e6, 3e6, 4e6, 4e8],
        loss_modulus=[1, 2, 2e9, 3e9, 4e9],
    )
    with pytest.raises(NotConverged, match=r"^angular integrals between w = 10 and .*tolerance$"):
        curve.angular_integrals(11)
    assert np.isfinite(curve.angular_integrals([5, 200])).all()  # off the step


def test_a_power_law_that_overflows_is_refused():
    curve = {"angular_frequency": [1, 1.0001], "storage_modulus": [1, 2], "loss_modulus": [1, 2]}
    MasterCurve(**curve, extrapolation="clamp")
    with pytest.raises(InvalidInput, match=r"^extrapolation: beyond angular_frequency = 1 rad/s"):
        MasterCurve(**curve, extrapolation="power-law")


@pytest.mark.parametrize("storage", [[1e-130, 1], [1e130, 1]])
def test_a_power_law_whose_square_leaves_the_range_of_doubles_is_refused(storage):
    curve = {"angular_frequency": [1, 10], "storage_modulus": storage, "loss_modulus": storage}
    inside = MasterCurve(**curve, extrapolation="clamp").angular_integrals([0.2, 2, 9, 99])
    assert np.isfinite(inside).all()
    with pytest.raises(InvalidInput, match=r"^extrapolation: beyond .*1e-140, 1e140"):
        MasterCurve(**curve, extrapolation="power-law")


@pytest.mark.parametrize("frequency_scale", [1e-280, 1e-140, 1, 1e140, 1e280])
@pytest.mark.parametrize("modulus_scale", [1e-140, 1, 1e129])
@pytest.mark.parametrize("extrapolation", [None, "clamp", "power-law"])
def test_units_far_from_one_leave_the_integrals_as_they_are(
    frequency_scale, modulus_scale, extrapolation
):
    w, storage, loss = np.geomspace(1, 1e6, 9), np.geomspace(1e3, 1e9, 9), np.geomspace(1e2, 1e9, 9)
    curve = MasterCurve(
        angular_frequency=w, storage_modulus=storage, loss_modulus=loss, extrapolation=extrapolation
    )
    scaled = MasterCurve(
        angular_frequency=frequency_scale * w,
        storage_modulus=modulus_scale * storage,
        loss_modulus=modulus_scale * loss,
        extrapolation=extrapolation,
    )
    at = np.geomspace(1, 1e6, 40)[1:-1]
    i1, i2 = scaled.angular_integrals(frequency_scale * at)
    expected = np.asarray(curve.angular_integrals(at))
    np.testing.assert_allclose([i1 / modulus_scale, i2 / modulus_scale**2], expected, rtol=2e-12)


@pytest.mark.parametrize("apart", [1e-13, 2e-12, 1e-11, 1e-9])
@pytest.mark.parametrize("seed", range(5))
def test_rows_that_nearly_meet_leave_the_integrals_between_their_neighbours(seed, apart):
    """A part of a panel shorter than what doubles tell apart asked polynomials far outside."""
    rng = np.random.default_rng(seed)
    w = np.geomspace(1e-2, 1e6, 41)
    w = np.sort(np.append(w, w[rng.integers(41)] * (1 + apart)))
    storage = 1e6 * (w / 1e-2) ** 0.25 * np.exp(rng.normal(0, 0.03, w.size))
    curve = MasterCurve(angular_frequency=w, storage_modulus=storage, loss_modulus=0.3 * storage)
    for integral in curve.angular_integrals(w):
        assert np.all(integral[1:] / integral[:-1] > 0.8)
        assert np.all(integral[1:] / integral[:-1] < 2)
