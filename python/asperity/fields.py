"""Fields of a scene file: their types, and messages that name file, table and key."""

import difflib
import re
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import Any, NoReturn

import numpy as np

from asperity._core import InvalidInput, NotConverged, OutOfRange


@dataclass(frozen=True)
class Field:
    """What a key may hold, and the argument of the core that it sets."""

    read: Callable[[object], Any]
    argument: str = ""


class _WrongValueError(Exception):
    """Says what is allowed."""


def number(value: object) -> float:
    if isinstance(value, bool) or not isinstance(value, int | float):
        raise _WrongValueError("a number")
    try:
        return float(value)
    except OverflowError:
        raise _WrongValueError("a finite number") from None


def numbers(value: object) -> list[float]:
    try:
        return [number(entry) for entry in value]  # type: ignore[attr-defined]
    except (TypeError, _WrongValueError):
        raise _WrongValueError("a list of numbers") from None


def text(value: object) -> str:
    if not isinstance(value, str):
        raise _WrongValueError("a text")
    return value


def count(value: object) -> int:
    if isinstance(value, bool) or not isinstance(value, int):
        raise _WrongValueError("a whole number")
    return value


def pixel_size(value: object) -> float | tuple[float, float]:
    if isinstance(value, list) and len(value) == 2:
        return number(value[0]), number(value[1])
    try:
        return number(value)
    except _WrongValueError:
        raise _WrongValueError("a number or [dy, dx]") from None


def sweep(value: object) -> Any:
    """Array of the values that a number, a list or a logarithmic sweep stands for."""
    allowed = "a number, a list, or {from = 1e-6, to = 10, points = 60}"
    if isinstance(value, dict):
        if set(value) != {"from", "to", "points"}:
            raise _WrongValueError(allowed)
        low, high = number(value["from"]), number(value["to"])
        points = count(value["points"])
        if not (0 < low < np.inf and 0 < high < np.inf) or points < 2:
            raise _WrongValueError("a sweep between two positive numbers in at least 2 points")
        return np.geomspace(low, high, points)
    if isinstance(value, list):
        if not value:
            raise _WrongValueError(f"{allowed}, and not empty")
        return np.array(numbers(value))
    try:
        return np.array([number(value)])
    except _WrongValueError:
        raise _WrongValueError(allowed) from None


def anything(value: object) -> object:
    return value


def refuse(path: Path, field: str, problem: str) -> NoReturn:
    raise InvalidInput(f"{path}: {field}: {problem}")


def require(
    path: Path, section: str, values: Mapping[str, object], keys: tuple[str, ...], hint: str = ""
) -> None:
    """Refuse a table that lacks one of `keys`."""
    for key in keys:
        if key not in values:
            refuse(path, f"[{section}] {key}", "missing" + (hint and f"; {hint}"))


def nearest(name: str, known: Mapping[str, object], form: str = "{}") -> str:
    """What to try instead of an unknown name."""
    close = difflib.get_close_matches(name, known, n=1, cutoff=0.5)
    if close:
        return "did you mean " + form.format(close[0]) + "?"
    return "allowed are " + ", ".join(form.format(key) for key in known)


def read_table(
    path: Path, section: str, table: object, fields: Mapping[str, Field]
) -> dict[str, Any]:
    """Values of a TOML table whose keys are all known and whose types are right."""
    if not isinstance(table, dict):
        refuse(path, f"[{section}]", "must be a table")
    for key in table:
        if key not in fields:
            refuse(path, f"[{section}] {key}", f"unknown key, {nearest(key, fields)}")
    values = {}
    for key, value in table.items():
        try:
            values[key] = fields[key].read(value)
        except _WrongValueError as wrong:
            raise InvalidInput(f"{path}: [{section}] {key} = {value!r}: must be {wrong}") from None
    return values


def arguments(values: Mapping[str, Any], fields: Mapping[str, Field]) -> dict[str, Any]:
    """Keyword arguments of the core from those of `values` that are in `fields`."""
    return {f.argument: values[key] for key, f in fields.items() if f.argument and key in values}


@contextmanager
def named(path: Path | None, names: Mapping[str, str]) -> Iterator[None]:
    """Let errors of the core name the file and its fields: `names` is argument -> [table] key."""
    try:
        yield
    except (InvalidInput, OutOfRange, NotConverged) as error:
        message = " ".join(str(error).split())
        for argument, field in names.items():
            message = re.sub(rf"(^|: ){argument}(?!\w)", rf"\g<1>{field}", message)
        raise type(error)(message if path is None else f"{path}: {message}") from error


def names_of(section: str, fields: Mapping[str, Field]) -> dict[str, str]:
    """The `names` of one table, for `named`."""
    return {f.argument: f"[{section}] {key}" for key, f in fields.items() if f.argument}
