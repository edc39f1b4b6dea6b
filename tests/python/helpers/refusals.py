"""A refusal is held to its class, argument and code; its sentence may change."""

from collections.abc import Iterator
from contextlib import contextmanager

import pytest

import asperity


@contextmanager
def refused(
    argument: str, code: str = "invalid-value", error: type[asperity.Error] = asperity.InvalidInput
) -> Iterator[None]:
    with pytest.raises(error) as caught:
        yield
    found = caught.value
    assert (found.argument, found.code) == (argument, code), found
    assert "\n" not in str(found)
