"""Docstrings name every argument, say units, and their examples run."""

import doctest
import importlib
import inspect
import pkgutil
import re
from functools import cached_property

import pytest

import asperity
from helpers.examples import CLASSES, FUNCTIONS

# "Arguments are those of `contact_area`": where a short docstring leaves them to another.
ELSEWHERE = re.compile(r"\b(?:Arguments|The others)\b[^.]*? are\s+those\s+of\s+`(\w+)`")
UNIT = re.compile(r"\[(K|m|1/m|m\^[234]|Pa|Pa\^2|1/Pa|J/mol|rad/s|s|m/s|N|-)\]")


def named(text, *sections):
    """The names that stand at the margin of a section of a NumPy docstring."""
    result = set()
    for section in sections:
        match = re.search(rf"^{section}\n-+\n(.*?)(?=^\w[\w ]*\n---|\Z)", text + "\n", re.M | re.S)
        for line in match[1].splitlines() if match else ():
            if line and not line.startswith(" "):
                result.update(re.findall(r"\w+", line.split(" : ")[0]))
    return result


def arguments(function):
    return set(inspect.signature(function).parameters) - {"self"}


@pytest.mark.parametrize("name", FUNCTIONS)
def test_functions_name_every_argument_in_their_parameters(name):
    text = inspect.getdoc(FUNCTIONS[name])
    assert text.splitlines()[0].endswith((".", "]", ")"))
    assert re.match(r"[A-Z]", text)
    given = named(text, "Parameters")
    if elsewhere := ELSEWHERE.search(text):
        given |= named(inspect.getdoc(FUNCTIONS[elsewhere[1]]), "Parameters")
        given |= set(re.findall(r"`(\w+)`", text))
    assert arguments(FUNCTIONS[name]) <= given


@pytest.mark.parametrize("kind", CLASSES)
def test_classes_name_every_argument_and_say_what_methods_return_and_take(kind):
    cls = CLASSES[kind]
    assert cls.__doc__.count("Parameters\n") <= 1
    fields = named(inspect.cleandoc(cls.__doc__), "Parameters", "Attributes")
    assert arguments(cls) <= fields
    for name in (name for name in dir(cls) if not name.startswith("_")):
        member = inspect.getattr_static(cls, name)
        if isinstance(member, property | cached_property):
            assert name in fields or inspect.getdoc(member), name
        elif callable(member) or isinstance(member, classmethod):
            text = inspect.getdoc(getattr(cls, name))
            assert text, name
            for argument in arguments(getattr(cls, name)):
                assert re.search(rf"\b{argument}\b", text + cls.__doc__), (name, argument)
        else:
            assert name in fields, name


UNITLESS = {
    "SFactor",
    "NayakSFactor",
    "ImplicitSFactor",
    "PartialContact",
    "fit_self_affine",
    "FrictionMap",
    "contact_notes",
    "read_master_curve",
    "report",
    "sweep",
}


@pytest.mark.parametrize("name", sorted((FUNCTIONS | CLASSES).keys() - UNITLESS))
def test_docstrings_have_units(name):
    assert UNIT.search(inspect.getdoc((FUNCTIONS | CLASSES)[name]))


def test_examples_run():
    tried = 0
    for module in pkgutil.walk_packages(asperity.__path__, "asperity."):
        if module.name.endswith(("__main__", "_core")):
            continue
        try:
            imported = importlib.import_module(module.name)
        except ImportError:
            continue  # what draws or solves with a library that is not installed
        failed, run = doctest.testmod(imported)
        assert failed == 0, module.name
        tried += run
    assert tried >= 25
