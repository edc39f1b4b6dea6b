"""Docstrings name every argument, say units, and their examples run."""

import doctest
import importlib
import inspect
import pkgutil
import re
from functools import cached_property

import asperity
from helpers.cases import case
from helpers.examples import CLASSES, FUNCTIONS

# "Arguments are those of `contact_area`": where a short docstring leaves them to another.
ELSEWHERE = re.compile(r"\b(?:Arguments|The others)\b[^.]*? are\s+those\s+of\s+`(\w+)`")
UNIT = re.compile(r"\[(K|m|1/m|m\^[234]|Pa|Pa\^2|1/Pa|J/mol|rad/s|s|m/s|N|-)\]")


def named(text, *sections):
    """The names that stand at the margin of a section of a NumPy docstring."""
    found = set()
    for section in sections:
        match = re.search(rf"^{section}\n-+\n(.*?)(?=^\w[\w ]*\n---|\Z)", text + "\n", re.M | re.S)
        for line in match[1].splitlines() if match else ():
            if line and not line.startswith(" "):
                found.update(re.findall(r"\w+", line.split(" : ")[0]))
    return found


def arguments(function):
    return set(inspect.signature(function).parameters) - {"self"}


def test_functions_name_every_argument_in_their_parameters():
    for name, function in FUNCTIONS.items():
        text = inspect.getdoc(function)
        with case(name=name):
            assert text.splitlines()[0].endswith((".", "]", ")"))
            assert re.match(r"[A-Z]", text)
            given = named(text, "Parameters")
            if elsewhere := ELSEWHERE.search(text):
                given |= named(inspect.getdoc(FUNCTIONS[elsewhere[1]]), "Parameters")
                given |= set(re.findall(r"`(\w+)`", text))
            assert arguments(function) <= given


def test_classes_name_every_argument_in_their_parameters_or_attributes():
    for name, cls in CLASSES.items():
        text = cls.__doc__
        with case(name=name):
            assert text.count("Parameters\n") <= 1
            assert arguments(cls) <= named(inspect.cleandoc(text), "Parameters", "Attributes")


def test_methods_and_properties_say_what_they_return_and_take():
    for kind, cls in CLASSES.items():
        fields = named(inspect.cleandoc(cls.__doc__), "Parameters", "Attributes")
        for name in (name for name in dir(cls) if not name.startswith("_")):
            member = inspect.getattr_static(cls, name)
            with case(cls=kind, name=name):
                if isinstance(member, property | cached_property):
                    assert name in fields or inspect.getdoc(member)
                elif callable(member) or isinstance(member, classmethod):
                    text = inspect.getdoc(getattr(cls, name))
                    assert text
                    for argument in arguments(getattr(cls, name)):
                        assert re.search(rf"\b{argument}\b", text + cls.__doc__), argument
                else:
                    assert name in fields


UNITLESS = {
    "SFactor",
    "NayakSFactor",
    "ImplicitSFactor",
    "PartialContact",
    "fit_self_affine",
    "FrictionMap",
    "contact_notes",
    "report",
    "sweep",
}


def test_docstrings_have_units():
    for name, thing in (FUNCTIONS | CLASSES).items():
        with case(name=name):
            assert name in UNITLESS or UNIT.search(inspect.getdoc(thing))


def test_examples_run():
    tried = 0
    for module in pkgutil.walk_packages(asperity.__path__, "asperity."):
        if module.name.endswith(("__main__", "_core")):
            continue
        try:
            imported = importlib.import_module(module.name)
        except ImportError:
            continue  # what draws or solves with a library that is not installed
        with case(module=module.name):
            failed, run = doctest.testmod(imported)
            assert failed == 0
            tried += run
    assert tried >= 25
