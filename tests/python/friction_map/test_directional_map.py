"""Maps that take the direction of sliding: friction by direction within the certified error."""

import numpy as np
import pytest

import asperity
from asperity import FrictionMap, InvalidInput, friction, friction_map
from helpers.mapped import drawn
from helpers.ridges import RUBBER

LAW = {"rms_height": 1e-4, "hurst": 0.8, "q0": 2e3, "q1": 2e5}
ROAD = asperity.SelfAffineSpectrum(**LAW, axis_ratio=2.0, lay=0.5)
BOX = {"pressure": (5e4, 5e5), "velocity": (1e-4, 1.0)}
AXIS = 0.4
ADHESION = asperity.Adhesion(shear_stress=1e6)
CORRECTIONS = [
    asperity.PartialContact(),
    asperity.GreenwoodWilliamson(z_max=3e-4, z_min=-2e-4),
]


def built(correction, **more):
    options = {"rtol": 2e-3, "checked": 400, "direction": AXIS, "adhesion": ADHESION} | more
    return friction_map(ROAD, RUBBER, **BOX, correction=correction, **options)


@pytest.fixture(scope="module")
def road():
    return built(asperity.PartialContact())


@pytest.mark.parametrize("correction", CORRECTIONS, ids=lambda one: type(one).__name__)
def test_look_ups_are_friction_within_the_certified_error(correction):
    fmap = built(correction)
    assert fmap.directional
    assert fmap.turns
    assert fmap.exceeded == 0
    assert fmap.largest_checked_error <= fmap.max_error <= 2e-3
    pressure, velocity, angle = drawn(40, BOX, (-7, 7))
    mu, lateral, area = (
        getattr(fmap, name)(pressure, velocity, direction=angle)
        for name in ("mu", "lateral", "contact_area")
    )
    truth = friction(
        ROAD,
        RUBBER,
        pressure=pressure,
        velocity=velocity,
        direction=AXIS + angle,
        correction=correction,
        adhesion=ADHESION,
    )
    assert np.all(np.abs(mu / truth.mu - 1) <= fmap.max_error)
    assert np.all(np.abs(area / truth.contact_area - 1) <= fmap.max_error)
    size = truth.hysteresis + np.abs(truth.lateral)
    assert np.all(np.abs(lateral - truth.lateral) <= fmap.max_error * size)
    assert np.abs(truth.lateral).max() > 0.1


def test_a_look_up_without_a_direction_is_along_the_axis_of_the_map(road, tmp_path):
    at = {"pressure": 1e5, "velocity": 1e-2}
    truth = friction(
        ROAD, RUBBER, **at, direction=AXIS, correction=CORRECTIONS[0], adhesion=ADHESION
    )
    assert road.mu(**at) == pytest.approx(truth.mu, rel=road.max_error)
    assert road.lateral(**at) == pytest.approx(truth.lateral, rel=2 * road.max_error)
    for name in ("mu", "lateral"):
        look = getattr(road, name)
        assert look(**at, direction=1.1) == pytest.approx(look(**at, direction=1.1 - np.pi))
        assert look(1e5, -1e-2, direction=1.1) == look(1e5, 1e-2, direction=1.1)
        many = look(np.full(3, 1e5), 1e-2, direction=[0.0, 1.1, 1.1 + 2 * np.pi])
        assert many[1] == look(**at, direction=1.1)
    road.save(tmp_path / "road.fmap")
    again = FrictionMap.load(tmp_path / "road.fmap")
    assert again.content == road.content
    assert again.lateral(**at, direction=0.7) == road.lateral(**at, direction=0.7)


def test_slopes_are_at_the_direction(road):
    h = 1e-5
    result = road.derivatives(1e5, 1e-2, direction=0.7)
    by_p = [road.mu(1e5 * np.exp(s), 1e-2, direction=0.7) for s in (-h, h)]
    by_v = [road.mu(1e5, 1e-2 * np.exp(s), direction=0.7) for s in (-h, h)]
    assert result.dmu_dlnp == pytest.approx((by_p[1] - by_p[0]) / (2 * h), abs=1e-7)
    assert result.dmu_dlnv == pytest.approx((by_v[1] - by_v[0]) / (2 * h), abs=1e-7)


def test_temperatures_shift_it_in_every_direction(road):
    shifted = road.hysteresis(1e5, 1e-2, a_T=3.0, direction=0.7)
    assert shifted == pytest.approx(road.hysteresis(1e5, 3e-2, direction=0.7), rel=1e-14)


def test_outside_of_the_box_and_what_is_no_angle(road):
    assert np.isnan(road.lateral(1.0, 1e-2, direction=0.7, outside="nan"))
    held = road.lateral(1.0, 1e-2, direction=0.7, outside="clamp")
    assert held == road.lateral(5e4, 1e-2, direction=0.7)
    for angle in (np.nan, np.inf):
        with pytest.raises(InvalidInput, match="direction"):
            road.mu(1e5, 1e-2, direction=angle)
        assert np.isnan(road.mu(1e5, 1e-2, direction=angle, outside="nan"))


def test_an_isotropic_map_is_the_same_in_every_direction():
    mean = asperity.SelfAffineSpectrum(**LAW)
    fmap = friction_map(mean, RUBBER, **BOX, rtol=1e-3, checked=0)
    assert not fmap.directional
    assert not fmap.turns
    assert fmap.lateral(1e5, 1e-2, direction=0.7) == 0
    angles = np.linspace(0, 6, 5)
    np.testing.assert_array_equal(
        fmap.mu(1e5, 1e-2, direction=angles), np.full(5, fmap.mu(1e5, 1e-2))
    )
    elastic = asperity.PronySeries(equilibrium_modulus=3e6, moduli=[], relaxation_times=[])
    fmap = friction_map(ROAD, elastic, **BOX, rtol=1e-2, checked=0)
    assert fmap.mu(1e5, 1e-2, direction=0.7) == fmap.lateral(1e5, 1e-2, direction=0.7) == 0


def test_the_map_of_a_scan_has_its_one_direction():
    length = 0.01
    law = asperity.SelfAffineSpectrum(
        rms_height=1e-4,
        hurst=0.8,
        q0=8 * np.pi / length,
        q1=16 * np.pi / length,
        axis_ratio=3.0,
        lay=0.3,
    )
    scan = asperity.synthesize(law, shape=(64, 64), pixel_size=length / 64, seed=1)
    rubber = asperity.PronySeries(equilibrium_modulus=1e6, moduli=[9e6], relaxation_times=[1e-3])
    spectrum = asperity.power_spectrum(scan, window="none", detrend=None).truncated(
        q0=law.q0, q1=law.q1
    )
    exact = asperity.ScanContact(scan, periodic=True, tolerance=0.1)
    fmap = friction_map(
        spectrum,
        rubber,
        pressure=(1e5, 1.2e5),
        velocity=(0.1, 0.2),
        correction=exact,
        direction=0.9,
        rtol=1e-2,
        checked=0,
    )
    assert fmap.directional
    assert not fmap.turns
    # nine pressures, so that contacts are on the lattice of pressures, as those of a map
    at = {"pressure": np.geomspace(1e5, 1.2e5, 9), "velocity": np.full(9, 0.15)}
    truth = friction(spectrum, rubber, **at, correction=exact, direction=0.9)
    np.testing.assert_allclose(fmap.mu(**at), truth.mu, rtol=fmap.max_error)
    error = fmap.max_error * (truth.hysteresis + np.abs(truth.lateral))
    assert np.all(np.abs(fmap.lateral(**at) - truth.lateral) <= error)
    assert np.all(np.abs(fmap.lateral(**at)) > 0)
