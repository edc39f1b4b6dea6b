"""The contact of a scan in any direction of sliding: that of `slide`, and of a turned scan."""

import numpy as np
import pytest

import asperity
from asperity.validation import slide
from helpers.rubbers import prony

LENGTH = 0.01
RUBBER = prony(1e6, [9e6, 3e7], [1e-3, 1e-5])
ROAD = asperity.SelfAffineSpectrum(
    rms_height=1e-4,
    hurst=0.8,
    q0=8 * np.pi / LENGTH,
    q1=32 * np.pi / LENGTH,
    axis_ratio=3.0,
    lay=np.radians(20),
)
SCAN = asperity.synthesize(ROAD, shape=(128, 128), pixel_size=LENGTH / 128, seed=1)
# a quarter of a turn from x towards y takes the point (x, y) to (-y, x)
TURNED = asperity.HeightMap(np.rot90(SCAN.heights, -1), pixel_size=LENGTH / 128)
RINGS = asperity.power_spectrum(SCAN, window="none", detrend=None).truncated(q0=ROAD.q0, q1=ROAD.q1)
AT = {"pressure": 2e5, "velocity": 0.0137}
EXACT = asperity.ScanContact(SCAN, periodic=True)


def friction(direction, correction=EXACT, spectrum=RINGS, **more):
    scene = {**AT, "correction": correction, "direction": direction} | more
    return asperity.friction(spectrum, RUBBER, **scene)


@pytest.mark.parametrize("degrees", [20, 60, 110])
def test_a_node_is_that_of_slide(degrees):
    direction = np.radians(degrees)
    between = friction(direction)
    table = EXACT.contacts.to_dataframe()
    here = table[(table.direction == direction) & (table.part == -1) & (table.coarse == 0)]
    row = here.iloc[len(here) // 2]
    result = friction(direction, velocity=row.velocity)
    truth = slide(
        SCAN,
        RUBBER,
        pressure=row.pressure,
        velocity=row.velocity,
        direction=direction,
        periodic=True,
        rtol=1e-5,
    )
    assert result.mu == pytest.approx(truth.hysteresis, rel=1e-3)
    assert result.lateral == pytest.approx(truth.lateral, abs=1e-3 * truth.hysteresis)
    assert result.lateral == pytest.approx(row.lateral, abs=1e-12)

    exact = slide(SCAN, RUBBER, **AT, direction=direction, periodic=True)
    assert between.mu == pytest.approx(exact.hysteresis, rel=0.02)
    assert between.lateral == pytest.approx(exact.lateral, abs=0.02 * exact.hysteresis)
    assert between.model_error > abs(between.mu / exact.hysteresis - 1) / 2


def test_a_turned_scan_is_a_turned_direction():
    of_turned = asperity.ScanContact(TURNED, periodic=True)
    one, other = friction(0.3), friction(0.3 + np.pi / 2, of_turned)
    for name in ("mu", "lateral", "contact_area"):
        assert getattr(other, name) == pytest.approx(getattr(one, name), rel=1e-3)
    assert friction(0.3, of_turned).mu != pytest.approx(one.mu, rel=0.1)


def test_the_scan_knows_directions_whatever_the_spectrum_does():
    result = friction([0.3, 1.1])
    assert result.direction.tolist() == [0.3, 1.1]
    for spectrum in (asperity.power_spectrum(SCAN, window="none", detrend=None, directional=True),):
        kept = spectrum.truncated(q0=ROAD.q0, q1=ROAD.q1)
        assert kept.is_directional
        same = friction([0.3, 1.1], spectrum=kept)
        np.testing.assert_array_equal(same.mu, result.mu)
        np.testing.assert_array_equal(same.lateral, result.lateral)
    area = asperity.contact_area(RINGS, RUBBER, **AT, correction=EXACT, direction=0.3)
    assert area == result.contact_area[0]
    # along the ridges and across
    along, across = friction(np.radians([20, 110])).mu
    assert along < 0.7 * across


def test_directions_are_saved(tmp_path):
    first = friction(0.3)
    EXACT.save(tmp_path / "scan.npz")
    again = asperity.ScanContact.load(tmp_path / "scan.npz")
    count = len(again.contacts)
    assert friction(0.3, again).lateral == first.lateral
    assert len(again.contacts) == count
