"""Friction at temperatures: the rubber shifted by a_T(T), and nothing else."""

import numpy as np
import pytest

import asperity
from asperity import _core
from helpers.cases import case
from helpers.examples import BUILD, ROAD, RUBBER, SHIFTS, STICKY
from helpers.refusals import refused

LAW = asperity.WLF(c1=8.86, c2=101.6, reference_temperature=293.15)
FACTORS = asperity.ShiftFactors(**SHIFTS)
ARRHENIUS = FACTORS.fit_arrhenius()
WLF_FIT = asperity.ShiftFactors(
    reference_temperature=293.0,
    temperature=[263.0, 283.0, 293.0, 303.0],
    log10_a_T=[3.2, 0.9, 0.0, -0.8],
).fit_wlf()
SHIFTING = {"law": LAW, "fit": WLF_FIT, "Arrhenius": ARRHENIUS, "table": FACTORS, "build": BUILD}
V = np.geomspace(1e-4, 1.0, 7)


def a_t(shift, temperature):
    """a_T of any shift by its own formula."""
    if isinstance(shift, asperity.WLF | asperity.WlfFit):
        away = temperature - shift.reference_temperature
        return 10 ** (-shift.c1 * away / (shift.c2 + away))
    if isinstance(shift, asperity.ArrheniusFit):
        inverse = 1 / temperature - 1 / shift.reference_temperature
        return np.exp(shift.activation_energy / 8.31446261815324 * inverse)
    return shift.shift_factor(temperature)


@pytest.mark.parametrize("name", SHIFTING)
def test_a_temperature_is_the_rubber_shifted(name):
    shift = SHIFTING[name]
    hot = asperity.friction(
        ROAD,
        RUBBER,
        pressure=2e5,
        velocity=V,
        adhesion=STICKY,
        temperature=301.0,
        shift=shift,
        rtol=1e-9,
    )
    warm = RUBBER.shifted(a_t(shift, 301.0))
    by_hand = asperity.friction(ROAD, warm, pressure=2e5, velocity=V, adhesion=STICKY, rtol=1e-9)
    for column in ("mu", "hysteresis", "adhesion", "contact_area"):
        np.testing.assert_allclose(getattr(hot, column), getattr(by_hand, column), rtol=1e-12)
    assert hot.temperature.tolist() == [301.0] * 7


def test_temperatures_broadcast_and_every_point_has_its_own():
    t = np.array([[263.0], [293.15], [320.0]])
    grid = asperity.friction(
        ROAD, RUBBER, pressure=1e5, velocity=V, temperature=t, shift=LAW, contributions=True
    )
    assert grid.mu.shape == grid.temperature.shape == (3, 7)
    for i, j in ((0, 3), (1, 0), (2, 6)):
        one = asperity.friction(
            ROAD, RUBBER, pressure=1e5, velocity=V[j], temperature=t[i, 0], shift=LAW
        )
        with case(i=i, j=j):
            assert one.mu == pytest.approx(grid.mu[i, j], rel=2e-6)
            assert isinstance(one.temperature, float)
            assert one.temperature == t[i, 0]
    np.testing.assert_allclose(grid.decade_share.sum(axis=-1), 1, rtol=1e-9)
    cold = asperity.friction(
        ROAD, RUBBER.shifted(a_t(LAW, 263.0)), pressure=1e5, velocity=V, contributions=True
    )
    np.testing.assert_allclose(grid.decade_share[0], cold.decade_share, atol=1e-6)
    assert grid.to_xarray().mu.dims == ("temperature", "velocity")
    assert "temperature" in grid.to_dataframe().columns


def test_the_reference_temperature_changes_nothing():
    plain = asperity.friction(ROAD, RUBBER, pressure=1e5, velocity=V)
    same = asperity.friction(ROAD, RUBBER, pressure=1e5, velocity=V, temperature=293.15, shift=LAW)
    assert plain.temperature is None
    np.testing.assert_array_equal(same.mu, plain.mu)


def test_threads_share_points_of_several_temperatures():
    t = np.linspace(270, 310, 3)[:, None]
    v = np.geomspace(1e-5, 1, 250)
    one, two = (
        asperity.friction(
            ROAD, RUBBER, pressure=1e5, velocity=v, temperature=t, shift=LAW, threads=n
        )
        for n in (1, 2)
    )
    assert one == two


@pytest.mark.parametrize("name", SHIFTING)
def test_slopes_are_those_of_the_law(name):
    shift, t, step = SHIFTING[name], np.array([285.0, 290.0, 301.0]), 1e-3
    value, slope = _core.shift_at(shift._core, t)
    np.testing.assert_allclose(10**value, a_t(shift, t), rtol=1e-13)
    above, below = (_core.shift_at(shift._core, t + way * step)[0] for way in (1, -1))
    np.testing.assert_allclose(slope, (above - below) / (2 * step), rtol=1e-6)
    if name in ("law", "fit", "Arrhenius"):
        np.testing.assert_array_equal(shift.log10_a_T(t), value)
        np.testing.assert_array_equal(shift.log10_a_T_slope(t), slope)


@pytest.mark.parametrize(
    ("argument", "changed"),
    [
        *(("temperature", {"temperature": wrong}) for wrong in (20.0, -3.0, np.nan)),
        ("temperature", {"shift": None}),
        ("shift", {"temperature": None}),
        ("shift", {"shift": 1.0}),
        ("", {"temperature": [280.0, 281.0]}),  # shapes of several arguments
    ],
)
def test_bad_temperatures_are_refused(argument, changed):
    given = {"pressure": 1e5, "velocity": V, "temperature": 280.0, "shift": LAW} | changed
    with pytest.raises(asperity.InvalidInput) as caught:
        asperity.friction(ROAD, RUBBER, **given)
    assert caught.value.argument == argument


def test_a_shift_that_is_not_known_is_out_of_range():
    at = {"pressure": 1e5, "velocity": 0.01}
    with refused("temperature", "unknown-shift", asperity.OutOfRange):
        asperity.friction(ROAD, RUBBER, temperature=190.0, shift=LAW, **at)
    with refused("temperature", "unknown-shift", asperity.OutOfRange):
        asperity.friction(ROAD, RUBBER, temperature=320.0, shift=FACTORS, **at)
    steep = asperity.WLF(c1=7e99, c2=101.6, reference_temperature=293.15)
    with refused("temperature", "out-of-range", asperity.OutOfRange):
        asperity.friction(ROAD, RUBBER, temperature=293.15, shift=steep, **at)
    with refused("velocity", "unknown-modulus", asperity.OutOfRange):
        asperity.friction(ROAD, BUILD.master_curve, pressure=1e5, velocity=10.0, temperature=301.0)
