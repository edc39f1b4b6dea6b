"""Every public class is a value: frozen, compared by content, shown in a line, for patterns."""

import numpy as np
import pytest

import asperity
from helpers.cases import case
from helpers.examples import ALL, MADE, ROAD


def make(name, arguments):
    return getattr(asperity, name)(**arguments)


def test_equal_arguments_make_equal_values_and_others_do_not():
    for name, arguments, change in MADE:
        with case(name=name, change=change):
            assert make(name, arguments) == make(name, arguments)
            assert (make(name, arguments) != make(name, arguments)) is False
            if change is not None:
                assert make(name, arguments) != make(name, arguments | change)
            assert make(name, arguments) != arguments
            assert make(name, arguments) is not None


def test_values_of_different_examples_are_not_equal():
    for name, one in ALL.items():
        for other in (v for v in ALL.values() if type(v) is not type(one)):
            with case(name=name, other=type(other)):
                assert one != other
        with case(name=name):
            assert one == one


def test_constructor_arguments_are_attributes():
    for name, arguments, _ in MADE:
        value = make(name, arguments)
        for field, given in arguments.items():
            found = getattr(value, field)
            with case(name=name, field=field):
                if isinstance(given, list | np.ndarray):
                    np.testing.assert_array_equal(found, given)
                elif field == "pixel_size":
                    assert found == (given if isinstance(given, tuple) else (given, given))
                else:
                    assert found == given


def test_a_repr_is_one_short_line_with_the_class_and_the_numbers():
    for name, value in ALL.items():
        text = repr(value)
        with case(name=name, text=text):
            assert text.startswith(type(value).__name__ + "(")
            assert text.endswith(")")
            assert len(text.splitlines()) == 1
            assert len(text) < 300
            assert "object at 0x" not in text
            for shown in value._summary():
                assert f"{shown}=" in text


def test_what_a_person_asks_of_a_result_is_in_its_repr():
    many = repr(ALL["friction of many points"])
    assert many.startswith("Friction(shape=(2, 40), mu=<2 x 40 from ")
    assert "pressure=<2 x 40 from 1e+05 to 2e+05>, velocity=<2 x 40 from 0.001 to 1>" in many
    assert repr(ALL["friction at a point"]).startswith("Friction(mu=0.5876")
    assert repr(ALL["no slopes"]).startswith("FrictionSlopes(dmu_dlnp=[nan, nan], dmu_dlnv=")
    many_unknown = asperity.FrictionSlopes(dmu_dlnp=np.full(9, np.nan), dmu_dlnv=np.zeros(9))
    assert "dmu_dlnp=<9 from nan to nan>" in repr(many_unknown)
    scanned = repr(ALL["a measured spectrum"])
    assert scanned.startswith("TabulatedSpectrum(rows=")
    assert all(f"{name}=" in scanned for name in ("q0", "q1", "rms_height", "rms_slope"))
    assert "activation_energy: " in repr(ALL["ArrheniusFit"])


def test_notebooks_show_the_same_as_a_table():
    for name, value in ALL.items():
        page = value._repr_html_()
        with case(name=name):
            row = "<tr><th>" if value._summary() else "</table>"
            assert page.startswith(f"<table><caption>{type(value).__name__}</caption>{row}")
            assert page.count("<tr>") == len(value._summary())
            assert len(page) < 1500
    noted = asperity.Adhesion(shear_stress=8e6)
    assert "<th>shear_stress</th><td>8e+06</td>" in noted._repr_html_()
    assert "&lt;2 x 40 from" in ALL["friction of many points"]._repr_html_()


def test_fields_match_patterns_and_cannot_be_written():
    for name, value in ALL.items():
        fields = type(value).__match_args__
        assert fields or isinstance(value, asperity.PartialContact)  # which has nothing to set
        for field in fields:
            with case(name=name, field=field), pytest.raises(AttributeError):
                setattr(value, field, getattr(value, field))
        with case(name=name):
            with pytest.raises(AttributeError):
                value.something_new = 1
            with pytest.raises(AttributeError):
                delattr(value, fields[0] if fields else "_core")
            with pytest.raises(TypeError, match="unhashable"):
                hash(value)


def test_match_statements_take_values_apart():
    match asperity.SFactor(gamma=0.4, applies_to="area"):
        case asperity.SFactor(gamma=gamma, applies_to="area"):
            assert gamma == 0.4
        case _:
            pytest.fail("no match")
    match ROAD:
        case asperity.SelfAffineSpectrum(rms_height, hurst, q0, q1, rolloff):
            assert (rms_height, hurst, q0, q1, rolloff) == (1e-4, 0.8, 1e3, 1e5, 2e3)
        case _:
            pytest.fail("no match")
    match ALL["friction at a point"]:
        case asperity.Friction(mu=mu, notes=()):
            assert 0 < mu < 3
        case _:
            pytest.fail("no match")


def test_arguments_are_copied_but_for_heights():
    given = np.array([1e-4, 2e-4, 3e-4])
    kept = asperity.LocalPeaks(given)
    given[:] = 9
    assert kept.heights.max() == 3e-4
    heights = np.arange(12.0).reshape(3, 4)
    assert np.shares_memory(asperity.HeightMap(heights, pixel_size=1.0).heights, heights)
