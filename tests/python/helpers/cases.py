"""Many cases inside one test: a failure names the case that it belongs to."""

import reprlib
from collections.abc import Iterator
from contextlib import contextmanager

import pytest


def long(*values: object) -> object:
    """A row of pytest.mark.parametrize that is left to the long run."""
    return pytest.param(*values, marks=pytest.mark.long)


@contextmanager
def case(**values: object) -> Iterator[None]:
    """Whatever fails inside, an assertion too, says which case it was."""
    try:
        yield
    except BaseException as error:  # pytest.fail() raises no Exception
        shown = (f"{name} = {reprlib.repr(value)}" for name, value in values.items())
        error.add_note(f"case: {', '.join(shown)}")
        raise
