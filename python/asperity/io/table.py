"""Results as CSV, JSON and terminal tables."""

import csv
import io
import json
import math
import re
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from asperity._core import __version__
from asperity.base.diagnostics import Note, fatal_first
from asperity.base.parameters import key_of, without_unit


@dataclass(frozen=True, eq=False)
class Table:
    """Columns of equal length, and what they were computed from."""

    command: str
    inputs: Sequence[Mapping[str, Any]]  # one for each scene or file
    notes: Sequence[Note]
    columns: Mapping[str, Any]

    def csv(self) -> str:
        out = io.StringIO()
        out.write(f"# asperity {__version__} {self.command}\n")
        for inputs in self.inputs:
            for line in input_lines(inputs):
                out.write(f"# {line}\n")
        for note in fatal_first(self.notes):
            out.write(f"# note: {note.with_step}\n")
        units = ", ".join(f"{name} [{unit(name)}]" for name in self.columns)
        out.write(f"# columns: {units}\n")
        writer = csv.writer(out, lineterminator="\n")
        writer.writerow(self.columns)
        rows = zip(*self.columns.values(), strict=True)
        writer.writerows([_digits(cell) for cell in row] for row in rows)
        return out.getvalue()

    def json(self) -> str:
        """The same content as one object; infinite numbers as the text "inf"."""
        columns = {name: [*map(_plain, column)] for name, column in self.columns.items()}
        content = {
            "asperity": __version__,
            "command": self.command,
            "inputs": [dict(inputs) for inputs in self.inputs],
            "notes": fatal_first(self.notes),
            "next_steps": [note.next_step for note in fatal_first(self.notes)],
            "units": {name: unit(name) for name in self.columns},
            "columns": columns,
        }
        return json_text(content, indent=1, allow_nan=False) + "\n"


def columns_of(measured: Any) -> dict[str, Any]:
    """The columns of a measured object by their names in files."""
    columns = measured._columns()
    every = {**columns.coordinates, **columns.variables}
    return {key_of(name, one.unit): one.values for name, one in every.items()}


def input_lines(inputs: Mapping[str, Any]) -> list[str]:
    """What was computed from, a line a key."""
    return [f"{key} = {json_text(value)}" for key, value in _flat(inputs)]


def json_text(value: Any, **options: Any) -> str:
    """A value as JSON that no terminal obeys: what json leaves of control characters is escaped."""
    text = json.dumps(value, ensure_ascii=False, **options)
    return re.sub("[\x7f-\x9f\u2028-\u202e]", lambda match: f"\\u{ord(match[0]):04x}", text)


def unit(column: str) -> str:
    return "file" if column == "scene" else without_unit(column)[1] or "-"


def terminal_table(columns: Mapping[str, Iterable[float]]) -> str:
    """Columns of numbers with four digits, right-aligned under their names."""
    cells = [[name, *(f"{value:.4g}" for value in column)] for name, column in columns.items()]
    widths = [max(map(len, column)) for column in cells]
    rows = zip(*cells, strict=True)
    lines = ("  ".join(c.rjust(w) for c, w in zip(row, widths, strict=True)) for row in rows)
    return "\n".join(lines) + "\n"


def _flat(inputs: Mapping[str, Any]) -> list[tuple[str, Any]]:
    lines: list[tuple[str, Any]] = []
    for key, value in inputs.items():
        if isinstance(value, Mapping):
            lines += [(f"{key}.{name}", entry) for name, entry in value.items()]
        else:
            lines.append((key, value))
    return lines


def _digits(cell: Any) -> str:
    """The shortest digits that read back as the same number."""
    return float.__repr__(cell).removesuffix(".0") if isinstance(cell, float) else str(cell)


def _plain(cell: Any) -> Any:
    if isinstance(cell, np.generic):
        cell = cell.item()
    return cell if not isinstance(cell, float) or math.isfinite(cell) else str(cell)
