"""Measured friction from files."""

import math
import os
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from asperity._core import InvalidInput
from asperity.base import quantities
from asperity.base.arguments import choice, path_of, real_array
from asperity.base.diagnostics import MUST_BE, Argument, Must
from asperity.io import plausible
from asperity.io.instrument import brief
from asperity.io.read_surface import cell, filled_lines

# by the name of the column, which carries the unit
_COLUMNS = {
    "velocity": {"velocity_m_s": "m/s", "velocity_mm_s": "mm/s", "velocity_km_h": "km/h"},
    "mu": {"mu": ""},
    "pressure": {"pressure_pa": "Pa", "pressure_kpa": "kPa", "pressure_mpa": "MPa"},
    "temperature": {"temperature_k": "K", "temperature_c": "C"},
}
_QUANTITIES = {
    "velocity": quantities.VELOCITY,
    "pressure": quantities.PRESSURE,
    "temperature": quantities.TEMPERATURE,
}
_OPTIONAL = ("pressure", "temperature")


@dataclass(frozen=True, eq=False)
class MeasuredFriction:
    """Points of a friction measurement, arrays of shape (n,)."""

    velocity: NDArray[np.float64]  # [m/s]
    mu: NDArray[np.float64]  # [-]
    pressure: NDArray[np.float64] | None  # [Pa], None where the file has none
    temperature: NDArray[np.float64] | None = None  # [K], so too


def measured_friction(measured: Any) -> tuple[MeasuredFriction, Path]:
    """The points of a file, or of a mapping of their columns, and what errors on them name."""
    if not isinstance(measured, Mapping):
        path = path_of(measured, "measured")
        return read_friction(path), path
    for name in measured:
        choice(name, "measured", tuple(_COLUMNS))
    for name in ("velocity", "mu"):
        if name not in measured:
            raise InvalidInput(Argument("measured"), MUST_BE, f"a mapping that has {name}")
    given = {name: real_array(one, f"measured: {name}") for name, one in measured.items()}
    shape = given["mu"].shape
    for name, column in given.items():
        if column.ndim > 1 or column.shape not in ((), shape):
            found = f" has shape {column.shape}"
            raise InvalidInput(Argument(f"measured: {name}"), found, MUST_BE, f"{shape}, as mu")
        if not ((column > 0) & (column < math.inf)).all():
            raise InvalidInput(Argument(f"measured: {name}"), MUST_BE, "positive and finite")
    flat = {name: np.array(np.broadcast_to(one, shape)).ravel() for name, one in given.items()}
    points = MeasuredFriction(
        flat["velocity"], flat["mu"], flat.get("pressure"), flat.get("temperature")
    )
    return points, Path("measured")


def read_friction(path: str | os.PathLike[str]) -> MeasuredFriction:
    """Measured mu(v) from a text file: a header line, a row a point, repeats as further rows.

    Columns, in any order and among others: ``mu``; ``velocity_m_s``, ``velocity_mm_s`` or
    ``velocity_km_h``; where pressures differ, ``pressure_pa``, ``pressure_kpa`` or
    ``pressure_mpa``; where temperatures do, ``temperature_k`` or ``temperature_c``. Lines beginning
    with ``#`` are passed over. Cells are parted by semicolons, tabs, commas or blanks; where they
    are not parted by commas, a comma is a decimal one.

    Returns
    -------
    MeasuredFriction
        velocity [m/s], mu [-], pressure [Pa] or None, temperature [K] or None.

    Raises
    ------
    InvalidInput
        Naming file and line: no column of a known unit, a cell that is no positive number.
    """
    path = path_of(path, "path")
    table = filled_lines(path)
    if len(table) < 2:
        raise InvalidInput(
            f"has {max(0, len(table) - 1)} rows below its header",
            Must(": must have "),
            "1 or more",
            where=path,
        )
    header = [name.strip() for name in table[0][1]]
    columns = {kind: _column(path, header, kind) for kind in _COLUMNS}
    arrays = {}
    for kind, (place, unit) in ((k, c) for k, c in columns.items() if c is not None):
        values = [_value(path, number, cells, header, place) for number, cells in table[1:]]
        factor, offset = 1.0, 0.0
        if kind in _QUANTITIES:
            plausible.check(header[place], values, _QUANTITIES[kind], unit, path=path)
            factor, offset = _QUANTITIES[kind].units[unit]
        arrays[kind] = np.array([value * factor + offset for value in values])
    return MeasuredFriction(
        arrays["velocity"], arrays["mu"], arrays.get("pressure"), arrays.get("temperature")
    )


def _column(path: Path, header: list[str], kind: str) -> tuple[int, str] | None:
    """Place and unit of a column; None of what a file may leave out, where it does."""
    known: Mapping[str, str] = _COLUMNS[kind]
    places = [(i, known[name]) for i, name in enumerate(header) if name in known]
    if len(places) > 1:
        raise InvalidInput(
            f"has two columns of {kind}", MUST_BE, f"one of {', '.join(known)}", where=path
        )
    if places:
        return places[0]
    bare = [name for name in header if name.lower().startswith(kind)]
    if kind in _OPTIONAL and not bare:
        return None
    allowed = " or ".join(known) if len(known) == 1 else f"one of {', '.join(known)}"
    problem = (
        f"column {bare[0]!r} names no unit known here"
        if bare
        else f"header {brief(','.join(header))!r} has no {kind}"
    )
    raise InvalidInput(problem, MUST_BE, allowed, where=path)


def _value(path: Path, number: int, cells: list[str], header: list[str], place: int) -> float:
    if len(cells) != len(header):
        problem = f"has {len(cells)} cells: must be {len(header)}, as the header"
        if len(cells) == 2 * len(header):  # which decimal commas among commas make
            problem += " (numbers have a decimal point)"
        raise InvalidInput(f"line {number} {problem}", where=path)
    try:
        value = cell(cells[place])
    except ValueError as error:
        raise InvalidInput(f"line {number}: {header[place]}: {error}", where=path) from error
    lowest = -math.inf if header[place] == "temperature_c" else 0
    if not lowest < value < math.inf:
        shown = cells[place].strip() or "nothing"
        allowed = "positive and finite" if lowest == 0 else "finite"
        raise InvalidInput(
            f"line {number}: {header[place]} = {shown}", MUST_BE, allowed, where=path
        )
    return value
