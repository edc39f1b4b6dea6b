"""Numbers that keep the text they were typed as, and messages that tell them so."""

import re
from collections.abc import Iterator, Mapping
from contextlib import suppress
from typing import Any

_NUMBER = r"[-+]?(?:\d+\.?\d*(?:e[-+]?\d+)?|inf|nan)"
_TOLD = rf"{_NUMBER}|\({_NUMBER}, {_NUMBER}\)"
_DIGITS = range(4, 18)  # significant ones that messages have


class Typed(float):
    """A number that shows as it was typed; files get the shortest digits that read back."""

    text: str

    def __new__(cls, text: str) -> "Typed":
        typed = super().__new__(cls, text)
        typed.text = text
        return typed

    def __getnewargs__(self) -> tuple[str]:  # type: ignore[override]
        return (self.text,)

    def __str__(self) -> str:
        return self.text


class TypedWhole(int):
    """The same of whole numbers."""

    text: str

    def __new__(cls, text: str) -> "TypedWhole":
        typed = super().__new__(cls, text)
        typed.text = text
        return typed

    def __str__(self) -> str:
        return self.text


def as_typed(message: str, given: Mapping[str, Any]) -> str:
    """A message with its numbers as they were typed.

    `given` has what was typed by what messages call it, as in "--q-max" or "[rubber] moduli_pa":
    a number, or numbers in lists and tables. A number, or a pair of them in parentheses, is told
    after that name, with an index or not. It is known by its value, of which messages have few
    digits. A number that nobody typed has the digits that a scene is written with.
    """
    for name, value in given.items():
        if name not in message:
            continue
        texts = [*_texts(value)]
        told = re.compile(rf"((?<![\w-]){re.escape(name)}(?:\[\d+\])?(?: =)? )({_TOLD})(?![\w.])")

        def typed(found: re.Match[str], texts: list[tuple[float, str]] = texts) -> str:
            return found[1] + _typed(found[2], texts)

        message = told.sub(typed, message)
    return message


def typed_in(tables: Mapping[str, Any]) -> dict[str, Any]:
    """What `as_typed` takes of a scene's tables."""
    return {
        f"[{name}] {key}": value
        for name, table in tables.items()
        if isinstance(table, Mapping)
        for key, value in table.items()
    }


def _typed(told: str, texts: list[tuple[float, str]]) -> str:
    """A number or a pair as it was typed, or as it is told where none of `texts` is meant."""
    one_by_one = [
        next((text for number, text in texts if _tells(one, number)), None)
        for one in told.strip("()").split(", ")
    ]
    known = [text for text in one_by_one if text is not None]
    if len(known) < len(one_by_one):
        return told
    return ",".join(known[:1] if len(texts) == 1 else known)


def _texts(value: Any) -> Iterator[tuple[float, str]]:
    if isinstance(value, Mapping):
        value = list(value.values())
    if isinstance(value, list | tuple):
        for one in value:
            yield from _texts(one)
    elif isinstance(value, int | float) and not isinstance(value, bool):
        with suppress(OverflowError):
            yield float(value), str(value)


def _tells(told: str, number: float) -> bool:
    return any(float(f"{number:.{digits}g}") == float(told) for digits in _DIGITS) or (
        number != number and told == "nan"
    )
