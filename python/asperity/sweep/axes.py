"""Axes of a sweep: what a user wrote as `over`, and the lists of the scene itself, checked."""

import re
from array import array
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from asperity.base.arguments import brief
from asperity.base.diagnostics import Argument, InvalidInput, must_be, must_have, refusal, valued
from asperity.io import plausible
from asperity.io.fields import Field, angles, nearest, read_table, sweep
from asperity.scene.keys import KEYS
from asperity.scene.parts import CORRECTIONS

PRESSURE, VELOCITY = "conditions.pressure_pa", "conditions.velocity_m_s"
POINTS = (PRESSURE, VELOCITY)  # what changes from point to point of a scene
_SWEEP = {"from", "to", "points"}
_TEMPERATURES = ("conditions.temperature_k", "conditions.temperature_c")
_LISTS = (*_TEMPERATURES, "conditions.direction_deg", *POINTS)  # lists that scenes have
_WITHOUT = "none"  # the kind of no correction
_NUMBERS = (int, float, np.integer, np.floating)
_NAME = re.compile(r"[A-Za-z0-9][A-Za-z0-9_.-]*")


@dataclass(frozen=True)
class Axis:
    """A dimension: its name, and of each key the values along it."""

    name: str
    values: Mapping[str, Sequence[Any]]

    @property
    def size(self) -> int:
        return len(next(iter(self.values.values())))

    @property
    def of_points(self) -> bool:
        """Whether it moves points of a scene alone, which one call computes together."""
        return all(key in POINTS for key in self.values)

    def part(self, where: slice) -> "Axis":
        return Axis(self.name, {key: values[where] for key, values in self.values.items()})


def axes_of(path: Path, over: object, tables: Mapping[str, Any]) -> list[Axis]:
    """The axes of a sweep: those of `over`, then a list of the scene each.

    `path` is whose errors they are.
    """
    axes = [_axis(path, name, entry) for name, entry in _entries(path, over)]
    taken: dict[str, str] = {}
    for axis in axes:
        for key in axis.values:
            if key in taken:
                raise InvalidInput(
                    f"{key} is in two axes, {taken[key]} and {axis.name}", where=path
                )
            taken[key] = axis.name
    own = {
        key: values for key in _LISTS if key not in taken and (values := _listed(path, tables, key))
    }
    if taken.keys() & set(_TEMPERATURES):  # the one takes the place of the other
        own = {key: values for key, values in own.items() if key not in _TEMPERATURES}
    return [*axes, *(Axis(key, {key: values}) for key, values in own.items())]


def _entries(path: Path, over: object) -> Iterator[tuple[str, Any]]:
    """Names with what was given for each; keys of TOML may be dotted without quotation marks."""
    if not isinstance(over, Mapping):
        raise refusal("over", over, "a table of keys with lists", where=path)
    for name, values in over.items():
        if not isinstance(name, str):
            raise must_be("over", "the name of a key", f": {brief(name)}", where=path)
        if name in KEYS and isinstance(values, Mapping):
            yield from _flat(name, values).items()
        else:
            yield name, values


def _flat(table: str, entries: Mapping[str, Any]) -> dict[str, Any]:
    return {f"{table}.{key}": values for key, values in entries.items()}


def _axis(path: Path, name: str, entry: object) -> Axis:
    if not isinstance(entry, Mapping) or _SWEEP & entry.keys():
        return Axis(name, {name: _values(path, name, entry, name)})
    _check_name(path, name)
    zipped: dict[str, Any] = {}
    for key, values in entry.items():
        nested = key in KEYS and isinstance(values, Mapping)
        zipped |= _flat(key, values) if nested else {key: values}
    if not zipped:
        raise must_be(f"over {name}", "keys with lists", ": has no keys", where=path)
    values = {key: _values(path, key, one, name) for key, one in zipped.items()}
    lengths = {key: len(one) for key, one in values.items()}
    if len(set(lengths.values())) > 1:
        sizes = ", ".join(f"{key} has {length}" for key, length in lengths.items())
        raise must_be(f"over {name}", "equally long", f": {sizes}", where=path)
    return Axis(name, values)


def _check_name(path: Path, name: str) -> None:
    problem = None
    if not _NAME.fullmatch(name):
        problem = "must be of letters, digits, _, - and points, a letter or digit first"
    elif name.partition(".")[2] in KEYS.get(name.partition(".")[0], ()):
        problem = "is a key of a scene, which has values alone: must be a name of your own"
    if problem:
        raise InvalidInput(Argument(f"over {brief(name)}"), f": {problem}", where=path)


def _values(path: Path, key: str, entry: object, axis: str) -> Sequence[Any]:
    """The values along an axis, each of the kind that the key takes."""
    table, _, field = key.partition(".")
    if field not in KEYS.get(table, ()):
        inside = "" if axis == key else f"{axis}: "
        raise InvalidInput(f"over {inside}{key}: is no key of a scene, {_meant(key)}", where=path)
    fields = KEYS[table]
    if isinstance(entry, Mapping):
        spread = angles if fields[field].read is angles else sweep
        one = read_table(path, table, {field: entry}, {field: Field(spread)})
        entry = one[field]
    if isinstance(entry, str | bytes) or not hasattr(entry, "__iter__"):
        raise refusal(f"over {key}", entry, "a list", where=path)
    if not isinstance(entry, np.ndarray):
        entry = tuple(entry)
    if fields[field].read is sweep and (numbers := _numbers(entry)):
        return _checked(path, key, numbers, fields[field])
    values = tuple(map(_plain, entry))
    if not values:
        raise must_have(f"over {key}", "one value or more", ": is empty", where=path)
    for value in values:
        if value is None and key not in POINTS:
            continue
        if key == "correction.kind" and value == _WITHOUT:
            continue
        if key == "correction.kind" and value not in CORRECTIONS:
            allowed = nearest(str(value), {**CORRECTIONS, _WITHOUT: {}})
            raise InvalidInput(
                Argument(f"over {key}"), " = ", valued(value), f": {allowed}", where=path
            )
        if fields[field].read is sweep and not isinstance(value, int | float):
            raise refusal(f"over {key}", value, "a number", where=path)
        read_table(path, table, {field: value}, fields)
    return values


def _numbers(entry: Any) -> "array[float] | None":
    """Values that are all numbers, in 8 bytes each; None of others."""
    if isinstance(entry, np.ndarray):
        plain = entry.ndim == 1 and entry.dtype.kind in "fiu"
        return array("d", entry.astype("d").tobytes()) if plain else None
    if not all(issubclass(kind, _NUMBERS) and kind is not bool for kind in {*map(type, entry)}):
        return None
    try:
        return array("d", entry)
    except OverflowError:
        return None


def _checked(path: Path, key: str, numbers: "array[float]", field: Field) -> "array[float]":
    """Numbers along an axis, all at once: there may be many."""
    values = np.asarray(numbers)
    if field.quantity is not None:
        table, _, name = key.partition(".")
        plausible.check(f"[{table}] {name}", values, field.quantity, field.unit, path=path)
    if key in POINTS and not (sound := (values > 0) & (values < np.inf)).all():
        wrong = values[~sound][0]
        raise refusal(f"over {key}", wrong, "positive and finite", text=wrong, where=path)
    return numbers


def _meant(key: str) -> str:
    """What to try instead of an unknown key: another of its table, of any, or the tables."""
    table, _, field = key.partition(".")
    if table in KEYS:
        return nearest(field, KEYS[table], f"{table}.{{}}")
    hint = nearest(key, {f"{one}.{name}": None for one, names in KEYS.items() for name in names})
    return hint if hint.startswith("did") else nearest("", KEYS, "{}.")


def _plain(value: Any) -> Any:
    """A value without NumPy, and files as texts."""
    if isinstance(value, np.generic | np.ndarray):
        return value.tolist()
    return str(value) if isinstance(value, Path) else value


def _listed(path: Path, tables: Mapping[str, Any], key: str) -> Sequence[Any]:
    table, _, field = key.partition(".")
    entries = tables.get(table)
    if not isinstance(entries, Mapping) or not isinstance(entries.get(field), Mapping | list):
        return ()
    values = read_table(path, table, {field: entries[field]}, KEYS[table])[field]
    return _values(path, key, values, key)


def with_values(tables: Mapping[str, Any], values: Mapping[str, Any]) -> dict[str, Any]:
    """Tables of a scene with keys set to `values`; None takes a key out.

    A kind of correction takes the keys of [correction] that it knows; the kind "none" or None
    takes the table.
    """
    changed = {name: dict(table) for name, table in tables.items()}
    for key, value in values.items():
        table, _, field = key.partition(".")
        if value is None:
            changed.get(table, {}).pop(field, None)
        else:
            changed.setdefault(table, {})[field] = value
    if "correction.kind" in values:
        kind = values["correction.kind"]
        if kind in (None, _WITHOUT):
            changed.pop("correction", None)
        else:
            known = CORRECTIONS[kind]
            own = {key.removeprefix("correction.") for key in values}
            settings = changed["correction"]
            changed["correction"] = {k: v for k, v in settings.items() if k in known or k in own}
    return changed
