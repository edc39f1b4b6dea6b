"""Many cases inside one test: a failure names the case that it belongs to."""

import inspect
import reprlib
from collections.abc import Callable, Iterable, Iterator
from contextlib import contextmanager
from functools import wraps

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


def each(
    names: str | tuple[str, ...], rows: Iterable[object]
) -> Callable[[Callable[..., None]], Callable[..., None]]:
    """Write it like pytest.mark.parametrize: the rows are run through inside of one test.

    They share its fixtures, a temporary folder for example, and the first that fails ends the test.
    """
    listed = list(rows)
    assert listed  # a test of nothing would pass
    arguments = (names,) if isinstance(names, str) else names

    def decorate(test: Callable[..., None]) -> Callable[..., None]:
        @wraps(test)
        def through_all(*self: object, **fixtures: object) -> None:
            __tracebackhide__ = True
            for row in listed:
                values = (row,) if isinstance(names, str) else row
                given = dict(zip(arguments, values, strict=True))
                with case(**given):
                    test(*self, **fixtures, **given)

        asked = inspect.signature(test)
        left = [value for name, value in asked.parameters.items() if name not in arguments]
        through_all.__signature__ = asked.replace(parameters=left)
        return through_all

    return decorate
