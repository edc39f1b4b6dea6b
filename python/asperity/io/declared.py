"""Columns of DMA in SI units: names, units and kind of modulus as they are declared."""

import os
from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np

from asperity._core import InvalidInput
from asperity.base import quantities
from asperity.base.arguments import brief, choice, path_of, vector
from asperity.base.arguments import number as real
from asperity.base.diagnostics import MUST_BE, Argument, Must, must_be, refusal, valued
from asperity.io import plausible
from asperity.io.columns import Columns, Names, read_columns
from asperity.io.objects import frame_of
from asperity.io.source import Frame

Paths = str | os.PathLike[str] | Iterable[str | os.PathLike[str]] | Any

KINDS = {
    "frequency": quantities.FREQUENCY,
    "modulus": quantities.MODULUS,
    "temperature": quantities.TEMPERATURE,
    "strain": quantities.STRAIN,
}
_KINDS = {"storage": "modulus", "loss": "modulus"}  # columns whose unit has another name


def young(modulus: str, poisson_ratio: float) -> float:
    """What makes Young's moduli of those of a file, E = 2 (1 + nu) G."""
    shear = choice(modulus, "modulus", ("E", "G")) == 1
    ratio = real(poisson_ratio, "poisson_ratio")
    if not 0 <= ratio <= 0.5:
        raise refusal("poisson_ratio", ratio, "in [0, 0.5]", text=f"{ratio!r}")
    return 2 * (1 + ratio) if shear else 1.0


def file_of(path: Any, name: str) -> Path | Frame:
    frame = frame_of(path)
    return path_of(path, name) if frame is None else Frame(frame)


def files_of(paths: Paths) -> list[Path | Frame]:
    one: Any = paths
    if frame_of(one) is not None:
        return [file_of(one, "paths")]
    try:
        several = None if isinstance(one, str | os.PathLike) else list(one)
    except TypeError:
        several = None
    if several is None:
        return [file_of(one, "paths")]
    files = [file_of(path, f"paths[{i}]") for i, path in enumerate(several)]
    if not files:
        raise InvalidInput(Argument("paths"), ": is empty", Must(", must have "), "1 file or more")
    return files


def read_declared(
    files: Sequence[Path | Frame],
    columns: Names,
    units: Mapping[str, str],
    wanted: Sequence[str],
    factor: float,
    temperatures: Sequence[float] | None = None,
    *,
    reduced: bool = False,
) -> list[Columns]:
    """The wanted columns of each file, in rad/s, Pa, K and 1.

    `factor` makes Young's moduli of the file's; `reduced` frequencies may be of any size.
    """
    _check_declared(columns, units, wanted, temperatures is not None)
    by_file = None if temperatures is None else vector(temperatures, "temperatures")
    if by_file is not None and by_file.size != len(files):
        sizes = f" ({by_file.size}) and ", Argument("paths"), f" ({len(files)})"
        raise InvalidInput(Argument("temperatures"), *sizes, " must have equal length")
    tables = []
    for at, file in enumerate(files):
        table = read_columns(file, columns, {name: _KINDS.get(name, name) for name in columns})
        _check_stated(table, columns, units)
        values = table.values
        if by_file is not None:
            values["temperature"] = np.full(table.block.size, by_file[at])
        for name in wanted:
            if name != "temperature" and not np.all(values[name] > 0):
                row = int(np.argmin(values[name] > 0))
                problem = f"{name} = {values[name][row]:g}: must be positive"
                raise InvalidInput(f"{table.where(row)}: {problem}", where=file)
        _check_sizes(table, units, factor, reduced)
        for name in values:
            kind = _KINDS.get(name, name)
            values[name] = KINDS[kind].to_si(values[name], units[kind])
            if name in _KINDS:
                values[name] = factor * values[name]
        tables.append(table)
    return tables


def _check_declared(
    columns: Names, units: Mapping[str, str], wanted: Sequence[str], by_file: bool
) -> None:
    names = {*wanted} - ({"temperature"} if by_file else set())
    without = "" if by_file else " without shift"
    _check_keys("columns", columns, names, without, "of str, or of int for places", str, int)
    _check_keys("units", units, {_KINDS.get(one, one) for one in wanted}, without, "of str", str)
    for key, place in columns.items():
        if isinstance(place, int) and place < 1:
            raise must_be("columns", "1 or more, or a name", f": {key} = {place}")
    for key, unit in units.items():
        if unit not in KINDS[key].units:
            allowed = f"one of {', '.join(KINDS[key].units)}"
            raise must_be("units", allowed, f": {key} = {brief(unit)}")


def _check_keys(
    name: str, declared: Any, known: set[str], without: str, kinds: str, *types: type
) -> None:
    """Refuse what is no mapping of these types, keys that are not known, and those missing."""
    if not isinstance(declared, Mapping) or not all(
        isinstance(x, types) and not isinstance(x, bool) for x in declared.values()
    ):
        raise refusal(name, declared, f"a dict {kinds}")
    for key in declared:
        if key not in known:
            unknown = f": {brief(key)} is unknown" + without * (key == "temperature")
            allowed = f"of {', '.join(sorted(known))}"
            raise InvalidInput(Argument(name), unknown, Must(", must be "), allowed)
    for key in sorted(known - declared.keys()):
        alone = (name, key) == ("columns", "temperature")
        hint = "; or temperatures has one for each file" if alone else ""
        raise InvalidInput(Argument(name), f": {key!r} is missing{hint}")


def _check_stated(table: Columns, columns: Names, units: Mapping[str, str]) -> None:
    """Refuse units that are not those of the file's own row, or of its names."""
    for name, stated in table.units.items():
        kind = _KINDS.get(name, name)
        if stated != units[kind]:
            unit = valued(units[kind], repr(units[kind]))
            allowed = f"{stated!r}, as the file says of {columns[name]!r}"
            about = Argument("units"), f": {kind} = ", unit, MUST_BE, allowed
            raise InvalidInput(*about, code="other-unit", where=table.path)


def _check_sizes(table: Columns, units: Mapping[str, str], factor: float, reduced: bool) -> None:
    """Refuse what the declared units, in which the numbers still are, make absurd."""
    values = table.values
    largest = factor * np.max(np.hypot(values["storage"], values["loss"]))
    numbers = {**values, "modulus": largest}
    for kind in ("temperature", *(() if reduced else ("frequency",)), "strain", "modulus"):
        if kind in numbers:
            name = "largest |E|" if kind == "modulus" else kind
            plausible.check(name, numbers[kind], KINDS[kind], units[kind], path=table.path)
