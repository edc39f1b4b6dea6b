"""Measured friction from files."""

import math
import os
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from asperity.base import quantities
from asperity.base.arguments import Array, choice, path_of, real_array
from asperity.base.diagnostics import MUST_BE, InvalidInput, must_be
from asperity.io import plausible
from asperity.io.columns import cells_of, read_columns
from asperity.io.instrument import brief
from asperity.io.source import read_source

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

    velocity: Array  # [m/s]
    mu: Array  # [-]
    pressure: Array | None = None  # [Pa], None where the file has none
    temperature: Array | None = None  # [K], so too


def measured_friction(measured: Any) -> tuple[MeasuredFriction, Path]:
    """The points of a file, or of a mapping of their columns, and what errors on them name."""
    if not isinstance(measured, Mapping):
        path = path_of(measured, "measured")
        return read_friction(path), path
    for name in measured:
        choice(name, "measured", tuple(_COLUMNS))
    for name in ("velocity", "mu"):
        if name not in measured:
            raise must_be("measured", f"a mapping that has {name}")
    given = {name: real_array(one, f"measured: {name}") for name, one in measured.items()}
    shape = given["mu"].shape
    for name, column in given.items():
        if column.ndim > 1 or column.shape not in ((), shape):
            result = f" has shape {column.shape}"
            raise must_be(f"measured: {name}", f"{shape}, as mu", result)
        if not ((column > 0) & (column < math.inf)).all():
            raise must_be(f"measured: {name}", "positive and finite")
    flat = {name: np.array(np.broadcast_to(one, shape)).ravel() for name, one in given.items()}
    return MeasuredFriction(**flat), Path("measured")


def read_friction(path: str | os.PathLike[str]) -> MeasuredFriction:
    """Measured mu(v) from a text file: a header line, a row a point, repeats as further rows.

    Columns, in any order and among others: ``mu``; ``velocity_m_s``, ``velocity_mm_s`` or
    ``velocity_km_h``; where pressures differ, ``pressure_pa``, ``pressure_kpa`` or
    ``pressure_mpa``; where temperatures do, ``temperature_k`` or ``temperature_c``. Lines, cells
    and workbooks are read as by `read_isotherms`.

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
    (_, first), *_ = read_source(path).lines or [(1, "")]
    header = cells_of(first)
    columns = {kind: _column(path, header, kind) for kind in _COLUMNS}
    names = {name: name for name in columns.values() if name is not None}
    table = read_columns(path, names, {})
    arrays = {}
    for kind, name in columns.items():
        if name is None:
            continue
        values = table.values[name]
        known = values > (-math.inf if name == "temperature_c" else 0)
        if not known.all():
            row = int(np.argmin(known))
            problem = f"{table.where(row)}: {name} = {values[row]:g}"
            raise InvalidInput(problem, MUST_BE, "positive and finite", where=path)
        if kind in _QUANTITIES:
            unit = _COLUMNS[kind][name]
            plausible.check(name, values, _QUANTITIES[kind], unit, path=path)
            values = _QUANTITIES[kind].to_si(values, unit)
        arrays[kind] = values
    return MeasuredFriction(**arrays)


def _column(path: Path, header: list[str], kind: str) -> str | None:
    """The name of a column; None of what a file may leave out, where it does."""
    known: Mapping[str, str] = _COLUMNS[kind]
    names = [name for name in header if name in known]
    if len(names) > 1:
        raise must_be("", f"one of {', '.join(known)}", f"has two columns of {kind}", where=path)
    if names:
        return names[0]
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
