"""Friction by direction: what is refused and noted, arrays of directions and their pictures."""

import inspect

import numpy as np
import pytest

import asperity
from asperity import InvalidInput, PartialContact, SelfAffineSpectrum, TabulatedSpectrum
from helpers.ridges import RUBBER, C, Q, ridges, rows


def test_what_directions_do_not_know_is_refused():
    spectrum = rows(0.3)
    at = {"pressure": 2e5, "velocity": 1e-2}
    with pytest.raises(InvalidInput, match="method"):
        asperity.friction(spectrum, RUBBER, **at, method="qag")
    with pytest.raises(InvalidInput, match="rtol"):
        asperity.friction(spectrum, RUBBER, **at, rtol=1e-9)
    for direction in (np.nan, None, [[1.0], [1.0, 2.0]]):
        for function in (asperity.friction, asperity.contact_area):
            with pytest.raises(InvalidInput, match="direction"):
                function(spectrum, RUBBER, **at, direction=direction)


def test_degrees_given_as_radians_are_noted():
    mean = TabulatedSpectrum(wavenumber=Q, density=C)
    notes = asperity.friction(mean, RUBBER, pressure=2e5, velocity=1e-2, direction=45.0).notes
    assert [note.code for note in notes if note.argument == "direction"] == ["large-angle"]


@pytest.mark.parametrize(
    ("ratio", "direction", "noted"),
    [(2.5, {}, True), (2.5, {"direction": [0, 1]}, False), (1.2, {}, False)],
)
@pytest.mark.parametrize("notes_of", ["friction", "contact_notes"])
def test_sliding_along_x_without_being_asked_to_is_noted(ratio, direction, noted, notes_of):
    spectrum = ridges(ratio, np.radians(115))
    found = getattr(asperity, notes_of)(spectrum, RUBBER, pressure=2e5, velocity=1e-2, **direction)
    found = [note for note in getattr(found, "notes", found) if note.code == "along-x"]
    assert bool(found) is noted
    for note in found:
        assert note.value == pytest.approx(65, abs=1)  # degrees to the ridges
        assert note.severity == "note"


def test_the_direction_is_x_by_default():
    for function in (asperity.friction, asperity.contact_area, asperity.validation.slide):
        assert inspect.signature(function).parameters["direction"].default == 0.0


@pytest.mark.parametrize(("ratio", "known"), [(1.0, True), (1.3, True), (1.7, False)])
def test_faint_ridges_are_known_at_the_loads_of_contacts_without(ratio, known):
    spectrum = SelfAffineSpectrum(rms_height=1e-4, hurst=0.8, q0=2e3, q1=2e5, axis_ratio=ratio)
    found = asperity.friction(
        spectrum, RUBBER, pressure=5e4, velocity=1e-2, correction=PartialContact()
    )
    assert np.isfinite(found.model_error) == known


def test_stronger_ridges_than_any_contact_had_are_told():
    at = {"pressure": 2e5, "velocity": 1e-2, "correction": PartialContact()}
    law = {"rms_height": 1e-4, "hurst": 0.8, "q0": 2e3, "q1": 2e4}
    known, beyond = (
        asperity.friction(SelfAffineSpectrum(**law, axis_ratio=r), RUBBER, **at) for r in (4, 9)
    )
    assert known.model_error > 0
    assert np.isnan(beyond.model_error)
    assert "unknown-model-error" in [note.code for note in beyond.notes]


def test_directions_broadcast_like_pressures():
    spectrum = rows(0.4, 0.1)
    pressure, angles = np.array([[1e5], [2e5]]), np.array([0.3, 1.1, 0.3, -0.5])
    found = asperity.friction(spectrum, RUBBER, pressure=pressure, velocity=0.1, direction=angles)
    assert found.mu.shape == (2, 4)
    np.testing.assert_array_equal(found.direction, np.broadcast_to(angles, (2, 4)))
    for i, p in enumerate(pressure[:, 0]):
        for j, angle in enumerate(angles):
            one = asperity.friction(spectrum, RUBBER, pressure=p, velocity=0.1, direction=angle)
            assert (found.mu[i, j], found.lateral[i, j]) == (one.mu, one.lateral)
            assert one.direction == angle
    table = found.to_xarray()
    assert table.mu.dims == ("pressure", "direction")
    codes = [note.code for note in found.notes]
    assert len(codes) == len(set(codes))
    for more in ({"contributions": True}, {"gradients": True}):
        with pytest.raises(InvalidInput, match="one number"):
            asperity.friction(
                spectrum, RUBBER, pressure=1e5, velocity=0.1, direction=angles, **more
            )
    with pytest.raises(InvalidInput, match="direction"):
        asperity.friction(spectrum, RUBBER, pressure=1e5, velocity=0.1, direction=[0, np.nan])


def test_the_picture_over_directions_is_polar():
    pyplot = pytest.importorskip("matplotlib.pyplot")
    angles = np.linspace(0, 2 * np.pi, 9)
    found = asperity.friction(
        rows(0.4), RUBBER, pressure=1e5, velocity=[[0.1], [0.2]], direction=angles
    )
    axes = found.plot()
    assert axes.name == "polar"
    mu, across = axes.lines[:2]
    np.testing.assert_allclose(mu.get_xdata(), angles)
    np.testing.assert_array_equal(mu.get_ydata(), found.mu[0])
    np.testing.assert_array_equal(across.get_ydata(), np.abs(found.lateral[0]))
    ticks, angle = axes.get_yticks()[1:], np.radians(axes.get_rlabel_position())
    drawn = [np.interp(angle, *line.get_data(), period=2 * np.pi) for line in axes.lines[:4]]
    apart = np.abs(np.subtract.outer(ticks, drawn)).min()
    assert apart > 0.03 * axes.get_rmax()  # the names of radii are on no curve
    plain = pyplot.figure().add_subplot()
    found.plot(plain)
    np.testing.assert_allclose(plain.lines[0].get_xdata(), np.degrees(angles))
    np.testing.assert_array_equal(plain.lines[1].get_ydata(), found.lateral[0])
    over_velocity = asperity.friction(
        rows(0.4), RUBBER, pressure=1e5, velocity=[0.1, 0.2, 0.3], direction=[[0.0], [1.0], [np.pi]]
    )
    axes = over_velocity.plot()
    texts = [text.get_text() for text in axes.get_legend().get_texts()]
    assert texts[:4] == ["100 kPa", "0°", "57.3°", "180°"]
    first, between, last = [line.get_color() for line in axes.lines if line.get_xdata().size]
    np.testing.assert_allclose(first, last, atol=1e-12)
    assert np.abs(first - between).max() > 0.2
    pyplot.close("all")


def test_no_directions_are_refused():
    for function in (asperity.friction, asperity.contact_area):
        with pytest.raises(InvalidInput) as caught:
            function(rows(0.4), RUBBER, pressure=1e5, velocity=0.1, direction=[])
        assert caught.value.argument == "direction"
