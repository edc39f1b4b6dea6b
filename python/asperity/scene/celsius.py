"""Temperatures of a scene in the unit that they were given in."""

from collections.abc import Container
from contextlib import AbstractContextManager
from functools import partial

from asperity.base.diagnostics import Argument, Sentence, Unit, Value
from asperity.base.quantities import ZERO_CELSIUS
from asperity.io.fields import saying

_NAMES = ("[conditions] temperature", "[rubber] temperature", "[rubber] reference_temperature")


def celsius_in_errors(keys: Container[str]) -> AbstractContextManager[None]:
    """Let errors have temperatures in C where `keys`, those of the scene, are in C.

    Behind the keys the scene's temperatures are in K, and so are errors that come from there.
    """
    return saying(partial(_in_celsius, keys=keys))


def all_in_celsius(sentence: Sentence) -> Sentence:
    return tuple(_in_celsius_of(phrase, ".4g") for phrase in sentence)


def _in_celsius_of(phrase: str, form: str) -> str:
    if isinstance(phrase, Value) and phrase.tag == "K":
        return phrase.saying(format(phrase.numbers[0] - ZERO_CELSIUS, form))
    return phrase.saying(" C") if isinstance(phrase, Unit) and phrase.tag == "K" else phrase


def _in_celsius(sentence: Sentence, keys: Container[str]) -> Sentence:
    """A sentence in which temperatures behind a key that was given in C are so too."""
    said: list[str] = []
    names = {f"{name}_k": f"{name}_c" for name in _NAMES if f"{name}_k" not in keys}
    celsius = False
    for phrase in sentence:
        if isinstance(phrase, Argument):
            key = names.get(phrase, "")
            celsius = key in keys
            phrase = phrase.saying(key) if celsius else phrase
        elif celsius:
            phrase = _in_celsius_of(phrase, ".6g")
        said.append(phrase)
    return tuple(said)
