"""Numbers that keep the text they were typed as, and sentences that have them so."""

from collections.abc import Iterator, Mapping
from contextlib import suppress
from typing import Any, Self

from asperity.base.diagnostics import Argument, Sentence, Value


class _AsTyped:
    """What a number that knows its text does beside the number's own."""

    text: str

    def __new__(cls, text: str) -> Self:
        typed = super().__new__(cls, text)  # type: ignore[call-arg]
        typed.text = text
        return typed

    def __getnewargs__(self) -> tuple[str]:
        return (self.text,)

    def __str__(self) -> str:
        return self.text


class Typed(_AsTyped, float):  # type: ignore[misc]
    """A number that shows as it was typed; files get the shortest digits that read back."""


class TypedWhole(_AsTyped, int):  # type: ignore[misc]
    """The same of whole numbers."""


def as_typed(sentence: Sentence, inputs: Mapping[str, Any]) -> Sentence:
    """A sentence with its numbers as they were typed.

    `inputs` has what was typed by the names of arguments, as in "--q-max" or "[rubber] moduli_pa":
    a number, or numbers in lists and tables. A value, which may be a pair of numbers, is known
    behind its argument. A number that nobody typed has the digits that a scene is written with.
    """
    said = []
    texts: dict[float, str] = {}
    for phrase in sentence:
        if isinstance(phrase, Argument):
            texts = dict(_texts(inputs.get(phrase)))
        elif isinstance(phrase, Value) and phrase.numbers and texts.keys() >= {*phrase.numbers}:
            typed = [texts[number] for number in phrase.numbers]
            phrase = phrase.saying(",".join(typed[:1] if len(texts) == 1 else typed))
        said.append(phrase)
    return tuple(said)


def typed_in(tables: Mapping[str, Any]) -> dict[str, Any]:
    """What `as_typed` takes of a scene's tables."""
    return {
        f"[{name}] {key}": value
        for name, table in tables.items()
        if isinstance(table, Mapping)
        for key, value in table.items()
    }


def _texts(value: Any) -> Iterator[tuple[float, str]]:
    if isinstance(value, Mapping):
        value = list(value.values())
    if isinstance(value, list | tuple):
        for one in value:
            yield from _texts(one)
    elif isinstance(value, int | float) and not isinstance(value, bool):
        with suppress(OverflowError):
            yield float(value), str(value)
