"""Maps with heat of surfaces with a lay: for one direction, with the force across."""

import numpy as np
import pytest

import asperity
from asperity import FrictionMap, friction, friction_map
from helpers.cases import long
from helpers.mapped import HEAT, drawn, measured
from helpers.mapped import ROAD as ROUND
from helpers.mapped import WARM_RUBBER as RUBBER

Q = np.geomspace(2e3, 2e4, 20)
RIDGES = {"cosine": np.full((20, 1), 0.25), "sine": np.full((20, 1), 0.2)}
ROAD = asperity.TabulatedSpectrum(wavenumber=Q, density=ROUND.at(Q), **RIDGES)
BOX = {"pressure": (8e4, 1.5e5), "velocity": (0.1, 1.0)}
RANGE = (288.15, 298.15)
SCENE = HEAT | {"direction": 1.2, "adhesion": asperity.Adhesion(shear_stress=2e6)}


MAPS = {
    "one": (RUBBER, 293.15, BOX, 2e-3),
    "range": (RUBBER, RANGE, BOX, 2e-2),
    "slanted": (measured(RUBBER, 1e11, 60), (293.15, 294.15), BOX, 3e-2),
}


def points(n, temperature, box):
    return drawn(n, box, (np.min(temperature), np.max(temperature)))


@pytest.fixture(scope="module", params=["one", "range", long("slanted")])
def made(request):
    rubber, temperature, box, rtol = MAPS[request.param]
    return friction_map(
        ROAD, rubber, temperature=temperature, rtol=rtol, checked=500, **box, **SCENE
    ), MAPS[request.param]


def test_look_ups_are_hot_friction_within_the_certified_error(made):
    fmap, (rubber, temperature, box, rtol) = made
    assert fmap.directional
    assert not fmap.turns
    assert fmap.exceeded == 0
    assert fmap.largest_checked_error <= fmap.max_error <= rtol
    p, v, t = points(60, temperature, box)
    truth = friction(ROAD, rubber, pressure=p, velocity=v, temperature=t, **SCENE)
    np.testing.assert_allclose(fmap.mu(p, v, temperature=t), truth.mu, rtol=fmap.max_error)
    size = truth.hysteresis + np.abs(truth.lateral)
    off = fmap.lateral(p, v, temperature=t) - truth.lateral
    assert np.all(np.abs(off) <= fmap.max_error * size)
    assert np.all(np.abs(truth.lateral) > 0.02)


def test_sliding_that_begins_is_as_in_a_cold_contact(made):
    fmap, (rubber, temperature, box, _) = made
    p, v, t = points(60, temperature, box)
    cold = friction(
        ROAD, rubber, pressure=p, velocity=v, temperature=t, **SCENE | {"heating": None}
    )
    size = cold.hysteresis + np.abs(cold.lateral)
    off = fmap.lateral(p, v, temperature=t, distance=0.0) - cold.lateral
    assert np.all(np.abs(off) <= fmap.rtol * size)  # as the map without heat is made
    hot = fmap.lateral(p, v, temperature=t)
    between = fmap.lateral(p, v, temperature=t, distance=fmap.sliding_length(v, temperature=t))
    np.testing.assert_allclose(
        between, hot + (cold.lateral - hot) / np.e, atol=fmap.rtol * size.max()
    )


def test_the_file_keeps_them(made, tmp_path):
    fmap, (_, temperature, box, _) = made
    fmap.save(tmp_path / "hot.fmap")
    again = FrictionMap.load(tmp_path / "hot.fmap")
    p, v, t = points(20, temperature, box)
    for distance in (0.0, 1e-3, np.inf):
        at = {"temperature": t, "distance": distance}
        np.testing.assert_array_equal(again.lateral(p, v, **at), fmap.lateral(p, v, **at))


def test_another_direction_is_refused(made):
    fmap, (_, temperature, _, _) = made
    with pytest.raises(asperity.InvalidInput, match="direction"):
        fmap.mu(1e5, 0.5, temperature=np.min(temperature), direction=0.5)
