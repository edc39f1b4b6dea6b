"""The two ways to integrate against each other, and what the error estimate promises."""

import contextlib
import copy
import dataclasses
import math
import pickle
import sys
from pathlib import Path

import numpy as np
import pytest

import asperity

sys.path.insert(0, str(Path(__file__).parents[2] / "stability"))
import random_scenes
import truth

RUBBER = asperity.PronySeries(
    equilibrium_modulus=3e6, moduli=[1e7, 1e8, 1e9], relaxation_times=[1e-2, 1e-4, 1e-6]
)


def test_the_error_estimate_is_kept_on_random_scenes():
    outcomes = [random_scenes.compute(7, scene, tables=0.05) for scene in range(300)]
    assert [i for i, outcome in enumerate(outcomes) if not outcome.kept] == []


def test_the_error_estimate_is_kept_on_fronts_of_every_shape():
    outcomes = [random_scenes.compute(6, scene, tables=0.05, edges=1) for scene in range(400)]
    assert [i for i, outcome in enumerate(outcomes) if not outcome.kept] == []


def test_the_error_estimate_is_kept_on_rings():
    outcomes = [random_scenes.compute(5, scene, tables=0, rings=1) for scene in range(150)]
    assert [i for i, outcome in enumerate(outcomes) if not outcome.kept] == []


def test_the_error_estimate_is_kept_on_rings_with_master_curves():
    outcomes = []
    for scene in range(80):
        with contextlib.suppress(random_scenes.NoTruth):
            outcomes.append(random_scenes.compute(8, scene, tables=0.2, rings=1, curves=0.8))
    assert len(outcomes) > 74
    assert [i for i, outcome in enumerate(outcomes) if not outcome.kept] == []


@pytest.mark.parametrize(
    ("rows", "octaves", "power", "pressure", "velocity", "rtol"),
    [
        # the change by halves in ln q tells a sixth of the error
        (64, 1, 12, 559288, 3, 1e-6),
        (33, 1, 16, 2467283, 30, 1e-6),
        (33, 1, 7, 1243710, 3, 1e-4),
        (20, 1, 12, 559288, 3, 1e-6),
    ],
)
def test_the_error_estimate_is_kept_on_steep_rings(rows, octaves, power, pressure, velocity, rtol):
    """Nearly all roughness is in the first rows, and a split in the middle leaves it as it is."""
    wavenumber = 1e3 * np.geomspace(1, 2**octaves, rows)
    steep = asperity.TabulatedSpectrum(wavenumber=wavenumber, density=wavenumber**-power)
    steep = steep.scaled((0.5 / steep.rms_slope) ** 2)
    rubber = asperity.PronySeries(equilibrium_modulus=1e6, moduli=[1e8], relaxation_times=[1e-4])
    scene = {"pressure": pressure, "velocity": velocity}
    result = asperity.friction(steep, rubber, **scene, rtol=rtol)
    truth = asperity.friction(steep, rubber, **scene, rtol=1e-11, method="cquad")
    assert abs(result.mu - truth.mu) <= result.error_estimate + truth.error_estimate


def test_a_polynomial_below_zero_is_not_taken_for_g():
    """Through an E that grows by e^1.5 from row to row, where only the first rings are rough."""
    wavenumber = 1e3 * np.geomspace(1, 4, 120)
    steep = asperity.TabulatedSpectrum(wavenumber=wavenumber, density=1e70 * wavenumber**-30.0)
    frequency = 1e3 * np.geomspace(0.5, 8, 16)
    storage = 1e6 * np.exp(1.5 * np.arange(frequency.size))
    rubber = asperity.MasterCurve(
        angular_frequency=frequency, storage_modulus=storage, loss_modulus=0.2 * storage
    )
    scene = {"pressure": 1e3, "velocity": 1}
    result = asperity.friction(steep, rubber, **scene, rtol=1e-3)
    truth = asperity.friction(steep, rubber, **scene, rtol=1e-9, method="cquad")
    assert abs(result.mu - truth.mu) <= result.error_estimate + truth.error_estimate


@pytest.mark.parametrize(
    "again", [copy.copy, copy.deepcopy, lambda s: pickle.loads(pickle.dumps(s))]
)
def test_a_copy_of_used_rings_gives_the_same_friction(again):
    """What is kept with the rows is shared, or made anew."""
    surface, *_ = random_scenes.draw_rings(np.random.default_rng(3))
    velocity = np.geomspace(1e-5, 1, 9)
    first = asperity.friction(surface, RUBBER, pressure=1e5, velocity=velocity)
    twin = again(surface)
    assert twin == surface
    second = asperity.friction(twin, RUBBER, pressure=1e5, velocity=velocity)
    np.testing.assert_array_equal(second.mu, first.mu)
    alone = [
        asperity.friction(again(surface), RUBBER, pressure=1e5, velocity=v).mu for v in velocity
    ]
    np.testing.assert_array_equal(alone, first.mu)


def test_rings_leave_what_they_cannot_do_to_the_panels():
    """Contributions, the interpolated form and tolerances below 1e-7: the same mu within both."""
    surface, *_ = random_scenes.draw_rings(np.random.default_rng(3))
    scene = {"pressure": 1e5, "velocity": 1e-2}
    usual = asperity.friction(surface, RUBBER, **scene)
    for options in ({"contributions": True}, {"rtol": 1e-9}):
        other = asperity.friction(surface, RUBBER, **scene, **options)
        assert other.mu != usual.mu
        assert abs(other.mu - usual.mu) <= other.error_estimate + usual.error_estimate


INTEGRALS = truth.prony(1e6, [1e8], [1e-3])
ONE_TERM = asperity.PronySeries(equilibrium_modulus=1e6, moduli=[1e8], relaxation_times=[1e-3])


@pytest.mark.parametrize(
    ("wavenumber", "density", "pressure", "velocity"),
    [
        ([1e3, 4e5], [1e-20, 1e-19], 1e11, 1e-3),  # G is as good as 0 at the first nodes
        ([1e3, 4e5], [1e-20, 1e-19], 1e6, 1e-3),
        ([1e3, 2e4], [1e-18, 1e-18], 1e11, 1e-1),  # flat
        ([1e3, 4e5, 1e6], [1e-20, 1e-20, 1e-23], 1e11, 1e-3),  # a roll-off
        ([1e3, 1.6e3], [1e-16, 0], 1e4, 1e-2),  # dR/dG has a pole at the second row
        ([1e3, 2e3], [1e-34, 1e-14], 1e4, 1e-4),  # steep
        ([1e3, 1.1e3], [1e-16, 1e-21], 1e3, 1e-2),
    ],
)
@pytest.mark.parametrize("form", ["exact", "interpolated"])
@pytest.mark.parametrize("rtol", [1e-3, 1e-6, 1e-9])
def test_the_error_estimate_is_kept_on_a_front(wavenumber, density, pressure, velocity, form, rtol):
    surface = asperity.TabulatedSpectrum(wavenumber=wavenumber, density=density)
    options = {"pressure": pressure, "velocity": velocity, "form": form}
    result = asperity.friction(surface, ONE_TERM, rtol=rtol, **options)
    exact = truth.contact(
        truth.table(wavenumber, density), INTEGRALS, pressure, velocity, form=form
    )
    rounding = 1e-14 * exact.mu
    assert abs(result.mu - exact.mu) <= result.error_estimate + rounding
    assert result.error_estimate <= rtol * result.mu
    assert result.contact_area == pytest.approx(exact.area, rel=rtol)
    # and part of the way along the front, where the area is all but one
    middle = wavenumber[0] * (wavenumber[1] / wavenumber[0]) ** np.array([1e-3, 0.1, 0.7])
    for q in middle:
        cut = surface.at(q)
        pieces = truth.table([wavenumber[0], q], [density[0], cut])
        if density[1] == 0:
            pieces = [
                dataclasses.replace(
                    truth.table(wavenumber[:2], density[:2])[0],
                    length=math.log1p((q - wavenumber[0]) / wavenumber[0]),
                )
            ]
        area = asperity.contact_area(surface, ONE_TERM, wavenumber=q, rtol=rtol, **options)
        part = truth.contact(pieces, INTEGRALS, pressure, velocity, form=form)
        assert area == pytest.approx(part.area, rel=rtol)


def test_the_error_estimate_is_kept_where_the_contact_is_whole():
    wavenumber, density = [1.14e4, 1.93e4, 9.25e5], [1.3e-25, 1.3e-25, 1.04e-30]
    moduli = [1.54e09, 3.89e04, 5.34e07, 1.26e04, 6.8e05, 2.87e09]
    moduli += [1.9e05, 1.17e06, 2.21e04, 1.2e05, 2.02e06, 1.7e04]
    times = [6.63e-10, 2.1e-08, 0.156, 2.23, 0.000162, 2.1]
    times += [3.6, 0.000122, 0.00271, 0.518, 0.000266, 1.18e-10]
    options = {"pressure": 5.75e7, "velocity": 0.0217, "poisson_ratio": 0.27}
    rubber = asperity.PronySeries(equilibrium_modulus=1.66e6, moduli=moduli, relaxation_times=times)
    surface = asperity.TabulatedSpectrum(wavenumber=wavenumber, density=density)
    result = asperity.friction(surface, rubber, rtol=6e-3, **options)
    integrals = truth.prony(1.66e6, moduli, times)
    exact = truth.contact(truth.table(wavenumber, density), integrals, **options)
    assert exact.g < 0.007  # P is 1 to rounding
    assert abs(result.mu - exact.mu) <= result.error_estimate


def test_the_error_of_a_shift_has_its_room_in_the_tolerance():
    """d~ has an error of its own, which the nodes cannot lessen."""
    road = asperity.SelfAffineSpectrum(
        rms_height=7e-5, hurst=0.726, q0=304, q1=5.21e8, rolloff=2.1e4
    )
    rubber = asperity.PronySeries(
        equilibrium_modulus=2.06, moduli=[2.24e9], relaxation_times=[5.25e-6]
    )
    scene = {"pressure": 7.15e4, "velocity": 127.0}
    asperities = asperity.GreenwoodWilliamson(z_max=2.1e-4, z_min=-2.1e-4)
    result = asperity.friction(road, rubber, **scene, correction=asperities, rtol=1e-10)
    shift = asperity.AffineShift(result.shift_factor)
    exact = asperity.friction(road, rubber, **scene, correction=shift, method="qag", rtol=1e-11)
    assert abs(result.mu - exact.mu) <= result.error_estimate + exact.error_estimate
    assert result.error_estimate <= 1e-10 * result.mu
