"""Results as CSV, JSON and terminal tables, written all or not at all."""

import csv
import io
import json
import math
import os
import shutil
import tempfile
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager, suppress
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from asperity._core import Error, InvalidInput, __version__

# Endings of columns that are no pure numbers; the first that fits holds.
UNITS = {
    "scene": "file",
    "_per_pa": "1/Pa",
    "_pa": "Pa",
    "_m_s": "m/s",
    "_rad_s": "rad/s",
    "_per_m": "1/m",
    "_m4": "m^4",
    "_m": "m",
}


@dataclass(frozen=True, eq=False)
class Table:
    """Columns of equal length, and what they were computed from."""

    command: str
    inputs: Sequence[Mapping[str, Any]]  # one for each scene or file
    notes: Sequence[str]
    columns: Mapping[str, Sequence[Any]]

    def csv(self) -> str:
        """Comment lines with inputs, notes and units, a header line, a row a point."""
        out = io.StringIO()
        out.write(f"# asperity {__version__} {self.command}\n")
        for inputs in self.inputs:
            for line in input_lines(inputs):
                out.write(f"# {line}\n")
        for note in self.notes:
            out.write(f"# note: {note}\n")
        units = ", ".join(f"{name} [{unit(name)}]" for name in self.columns)
        out.write(f"# columns: {units}\n")
        writer = csv.writer(out, lineterminator="\n")
        writer.writerow(self.columns)
        writer.writerows(
            [_digits(cell) for cell in row] for row in zip(*self.columns.values(), strict=True)
        )
        return out.getvalue()

    def json(self) -> str:
        """The same content as one object; infinite numbers as the text "inf"."""
        content = {
            "asperity": __version__,
            "command": self.command,
            "inputs": [dict(inputs) for inputs in self.inputs],
            "notes": list(self.notes),
            "units": {name: unit(name) for name in self.columns},
            "columns": {
                name: [_plain(cell) for cell in column] for name, column in self.columns.items()
            },
        }
        return json.dumps(content, indent=1, ensure_ascii=False, allow_nan=False) + "\n"


def input_lines(inputs: Mapping[str, Any]) -> list[str]:
    """What was computed from, a line a key."""
    return [f"{key} = {json.dumps(value, ensure_ascii=False)}" for key, value in _flat(inputs)]


def unit(column: str) -> str:
    """The unit that a column's name ends in."""
    return next((u for ending, u in UNITS.items() if column.endswith(ending)), "-")


def terminal_table(columns: Mapping[str, Sequence[float]]) -> str:
    """Columns of numbers with four digits, right-aligned under their names."""
    cells = [[name, *(f"{value:.4g}" for value in column)] for name, column in columns.items()]
    widths = [max(map(len, column)) for column in cells]
    rows = zip(*cells, strict=True)
    lines = ("  ".join(c.rjust(w) for c, w in zip(row, widths, strict=True)) for row in rows)
    return "\n".join(lines) + "\n"


def check_output(path: Path) -> None:
    """Refuse, before any work, a path that cannot be written."""
    try:
        target = path.resolve()
        if not target.parent.is_dir():
            raise InvalidInput(f"{path}: cannot be written: no directory {target.parent.name}")
        if target.exists() and not target.is_file():
            raise InvalidInput(f"{path}: cannot be written: not a regular file")
        with tempfile.TemporaryFile(dir=target.parent):
            pass  # a trial: permissions alone say little about /proc, or to root
    except OSError as error:
        raise InvalidInput(f"{path}: cannot be written: {error.strerror or error}") from error


def check_writable(directory: Path) -> Path:
    """Refuse, before any work, a directory that cannot be written or made; which of its parents, or
    itself, is there."""
    try:
        existing = next(d for d in (directory, *directory.absolute().parents) if d.exists())
        if not existing.is_dir():
            raise InvalidInput(f"{directory}: cannot be written: {existing} is not a directory")
        with tempfile.TemporaryFile(dir=existing):
            pass
    except OSError as error:
        raise InvalidInput(f"{directory}: cannot be written: {error.strerror or error}") from error
    return existing


def write_directory(directory: Path, contents: Mapping[str, bytes]) -> None:
    """Write all files or none, into a directory that is made where it is missing."""
    made = [d for d in (directory, *directory.parents) if not d.exists()]
    try:
        directory.mkdir(parents=True, exist_ok=True)
        write_files({directory / name: data for name, data in contents.items()})
    except BaseException:
        for empty in made:
            with suppress(OSError):
                empty.rmdir()
        raise


def write_files(contents: Mapping[Path, bytes]) -> None:
    """Write all files or none: each beside its place first, then moved onto it.

    When a move fails, those before it are undone. What cannot be undone, a process killed between
    two moves or a second failure, leaves the earlier content beside its place as `.asperity-*.old`.

    Raises
    ------
    Error
        Names the file that could not be written, and why.
    """
    mark = f".asperity-{os.getpid()}"  # not the file's own name, which may be as long as can be
    moves = []
    for i, (path, data) in enumerate(contents.items()):
        target = path.resolve()
        part, old = (target.with_name(f"{mark}-{i}.{kind}") for kind in ("part", "old"))
        moves.append((path, data, target, part, old))
    begun = []
    try:
        for path, data, _, part, _ in moves:
            with _named(path):
                part.write_bytes(data)
        for path, _, target, part, old in moves:
            begun.append((target, part, old))
            with _named(path):
                _keep(target, old)
                os.replace(part, target)
    except BaseException:
        for target, part, old in reversed(begun):
            with suppress(OSError):
                _undo(target, part, old)
        raise
    else:
        for _, _, old in begun:
            old.unlink(missing_ok=True)
    finally:
        for _, _, _, part, _ in moves:
            part.unlink(missing_ok=True)


@contextmanager
def _named(path: Path) -> Iterator[None]:
    """Let a failure name the file that the user named."""
    try:
        yield
    except OSError as error:
        raise Error(f"{path}: cannot be written: {error.strerror or error}") from error


def _keep(target: Path, old: Path) -> None:
    """Let `old` be what `target` is, if that is there."""
    if target.exists():
        try:
            os.link(target, old)
        except OSError:  # a file system without hard links
            shutil.copy2(target, old)


def _undo(target: Path, part: Path, old: Path) -> None:
    """Undo a move that may not have happened: then `part` is still there."""
    if part.exists():
        old.unlink(missing_ok=True)
    elif old.exists():
        os.replace(old, target)
    else:
        target.unlink(missing_ok=True)


def _flat(inputs: Mapping[str, Any]) -> list[tuple[str, Any]]:
    lines: list[tuple[str, Any]] = []
    for key, value in inputs.items():
        if isinstance(value, Mapping):
            lines += [(f"{key}.{name}", entry) for name, entry in value.items()]
        else:
            lines.append((key, value))
    return lines


def _digits(cell: Any) -> str:
    return f"{cell:.17g}" if isinstance(cell, float) else str(cell)


def _plain(cell: Any) -> Any:
    if isinstance(cell, np.generic):
        cell = cell.item()
    return cell if not isinstance(cell, float) or math.isfinite(cell) else str(cell)
