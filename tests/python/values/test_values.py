"""Every public class is a value: frozen, compared by content, shown in a line, for patterns."""

import numpy as np
import pytest

import asperity
from helpers.examples import ALL, IDS, MADE, ROAD


def make(name, arguments):
    return getattr(asperity, name)(**arguments)


@pytest.mark.parametrize(("name", "arguments", "change"), MADE, ids=IDS)
def test_equal_arguments_make_equal_values_and_others_do_not(name, arguments, change):
    assert make(name, arguments) == make(name, arguments)
    assert (make(name, arguments) != make(name, arguments)) is False
    if change is not None:
        assert make(name, arguments) != make(name, arguments | change)
    assert make(name, arguments) != arguments
    assert make(name, arguments) is not None


@pytest.mark.parametrize(("name", "arguments", "change"), MADE, ids=IDS)
def test_constructor_arguments_are_attributes(name, arguments, change):
    value = make(name, arguments)
    for field, given in arguments.items():
        result = getattr(value, field)
        if isinstance(given, list | np.ndarray):
            np.testing.assert_array_equal(result, given)
        elif field == "pixel_size":
            assert result == (given if isinstance(given, tuple) else (given, given))
        else:
            assert result == given


@pytest.mark.parametrize("name", ALL)
def test_a_repr_is_one_short_line_and_a_table_in_notebooks(name):
    value = ALL[name]
    text, page = repr(value), value._repr_html_()
    assert text.startswith(type(value).__name__ + "(")
    assert len(text.splitlines()) == 1
    assert len(text) < 300
    assert "object at 0x" not in text
    assert all(f"{shown}=" in text for shown in value._summary())
    assert page.startswith(f"<table><caption>{type(value).__name__}</caption>")
    assert page.count("<tr>") == len(value._summary())
    assert len(page) < 1500


@pytest.mark.parametrize("name", ALL)
def test_fields_match_patterns_and_cannot_be_written(name):
    value = ALL[name]
    fields = type(value).__match_args__
    assert fields or isinstance(value, asperity.PartialContact)  # which has nothing to set
    for field in (*fields, "something_new"):
        with pytest.raises(AttributeError):
            setattr(value, field, getattr(value, field, 1))
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
        case asperity.Friction(mu=mu, notes=(note,)):
            assert 0 < mu < 3
            assert note.code == "no-correction"
        case _:
            pytest.fail("no match")


def test_arguments_are_copied_but_for_heights():
    given = np.array([1e-4, 2e-4, 3e-4])
    kept = asperity.LocalPeaks(given)
    given[:] = 9
    assert kept.heights.max() == 3e-4
    heights = np.arange(12.0).reshape(3, 4)
    assert np.shares_memory(asperity.HeightMap(heights, pixel_size=1.0).heights, heights)
