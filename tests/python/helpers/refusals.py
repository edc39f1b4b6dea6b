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
    result = caught.value
    assert (result.argument, result.code) == (argument, code), result
    assert "\n" not in str(result)
