"""Every public class is a value: fields read-only, ==, repr, pickle, patterns, documented units."""

import inspect
import re

import numpy as np
import pytest

import asperity
from helpers.examples import EVERY, IDS, MADE, ROAD, VALUES


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
        found = getattr(value, field)
        if isinstance(given, list | np.ndarray):
            np.testing.assert_array_equal(found, given)
        elif field == "pixel_size":
            assert found == (given if isinstance(given, tuple) else (given, given))
        else:
            assert found == given


@pytest.mark.parametrize("name", EVERY)
def test_repr_names_every_field_and_reads_back(name):
    value = EVERY[name]
    text = repr(value)
    assert text.startswith(type(value).__name__ + "(")
    assert text.endswith(")")
    for field in type(value).__match_args__:
        assert f"{field}=" in text
    if "..." not in text:
        names = vars(asperity) | {"array": np.array, "nan": np.nan, "inf": np.inf} | vars(np)
        assert type(eval(text, dict(names))) is type(value)


@pytest.mark.parametrize("name", EVERY)
def test_fields_match_patterns_and_cannot_be_written(name):
    value = EVERY[name]
    fields = type(value).__match_args__
    assert fields
    for field in fields:
        with pytest.raises(AttributeError):
            setattr(value, field, getattr(value, field))
    with pytest.raises(AttributeError):
        value.something_new = 1
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


@pytest.mark.parametrize(  # a result's arrays belong to whoever asked for it
    "value", [*(v for v in VALUES if not isinstance(v, asperity.HeightMap))]
)
def test_writing_into_an_array_that_was_handed_out_changes_no_value(value):
    before = repr(value)
    for field in type(value).__match_args__:
        found = getattr(value, field)
        if isinstance(found, np.ndarray) and found.flags.writeable:
            found *= 2
    assert repr(value) == before


CLASSES = [c for c in vars(asperity).values() if inspect.isclass(c)]
FUNCTIONS = [
    getattr(asperity, name)
    for name in asperity.__all__
    if callable(getattr(asperity, name)) and not inspect.isclass(getattr(asperity, name))
]
UNITLESS = {
    "SFactor",
    "NayakSFactor",
    "SelfAffineFit",
    "Error",
    "InvalidInput",
    "OutOfRange",
    "NotConverged",
}
UNIT = r"\[(K|m|1/m|m\^4|m\^2|Pa|Pa\^2|1/Pa|rad/s|s|m/s|N|-)\]"


@pytest.mark.parametrize("thing", [*CLASSES, *FUNCTIONS], ids=lambda t: t.__name__)
def test_docstring_says_what_it_is_and_in_which_units(thing):
    text = inspect.getdoc(thing)
    assert text is not None
    assert len(text) > 20
    unitless = UNITLESS | {"fit_self_affine", "read_surface"}
    assert thing.__name__ in unitless or re.search(UNIT, text)


@pytest.mark.parametrize("cls", [c for c in CLASSES if not issubclass(c, Exception)])
def test_every_property_and_method_is_documented(cls):
    undocumented = [
        name
        for name, member in vars(cls).items()
        if not name.startswith("_")
        and not inspect.getdoc(member)
        and name not in (cls.__doc__ or "")
    ]
    assert undocumented == []
