"""Temperatures of a scene in the unit that they were given in."""

import re
from collections.abc import Container, Iterator
from contextlib import contextmanager

from asperity._core import InvalidInput, OutOfRange
from asperity.base.celsius import ZERO_CELSIUS

_NAMES = ("[conditions] temperature", "[rubber] temperature", "[rubber] reference_temperature")
_NUMBER = r"[-+]?\d+\.?\d*(?:e[-+]?\d+)?"


@contextmanager
def celsius_in_errors(keys: Container[str]) -> Iterator[None]:
    """Let errors tell temperatures in C where `keys`, those of the scene, are in C.

    Behind the keys the scene's temperatures are in K, and so are errors that come from there.
    """
    try:
        yield
    except (InvalidInput, OutOfRange) as error:
        message = str(error)
        for name in _NAMES:
            if f"{name}_c" in keys and f"{name}_k" not in keys and f"{name}_k" in message:
                message = _in_celsius(message, name)
        raise type(error)(message) from error


def _in_celsius(message: str, name: str) -> str:
    """What `message` says in K of one key, and the range that it names as allowed, in C."""
    value = rf"(?<={re.escape(name)}_k = ){_NUMBER}"
    message = re.sub(value, lambda told: _degrees(told[0]), message)
    message = message.replace(f"{name}_k", f"{name}_c")
    least = rf"at least ({_NUMBER}); its unit is kelvin"
    message = re.sub(least, lambda told: f"at least {_degrees(told[1])} C", message)
    known = rf"\[({_NUMBER}), ({_NUMBER})\] K"
    return re.sub(known, lambda told: f"[{_degrees(told[1])}, {_degrees(told[2])}] C", message)


def _degrees(kelvin: str) -> str:
    return f"{float(kelvin) - ZERO_CELSIUS:.6g}"
