"""Lines of a table, whatever it lies in: text in UTF-8, UTF-16 or Latin-1, or the sheets of a
workbook, whose rows become lines with cells parted by tabs."""

import codecs
import json
import os
from collections.abc import Iterator
from dataclasses import dataclass
from importlib import import_module
from itertools import takewhile
from pathlib import Path
from typing import Any

from asperity._core import InvalidInput
from asperity.base.arguments import quoted, reading
from asperity.base.diagnostics import Note, must_be
from asperity.io.archive import Archive
from asperity.io.files import check_file
from asperity.io.instrument import understood

_ZIP, _OLE = b"PK\x03\x04", b"\xd0\xcf\x11\xe0"  # how .xlsx and .xls files begin
WORKBOOKS = (".xlsx", ".xlsm", ".xls")
_SEEN = 4096  # bytes that tell the encoding
_MOSTLY = 0.3  # of the bytes of one parity being zero, text of two bytes a character shows


def _latin_1(error: UnicodeError) -> tuple[str, int]:
    if not isinstance(error, UnicodeDecodeError):
        raise error
    return error.object[error.start : error.end].decode("latin-1"), error.end


codecs.register_error("asperity-latin-1", _latin_1)  # of bytes that are no UTF-8


@dataclass(frozen=True)
class Source:
    """Lines that are neither empty nor comments, with their numbers; and where each stands."""

    lines: list[tuple[int, str]]
    sheets: tuple[tuple[int, str], ...] = ()  # of a workbook: numbers of their first lines, names

    def where(self, number: int) -> str:
        first, name = next(((n, s) for n, s in reversed(self.sheets) if n <= number), (1, ""))
        return f"row {number - first + 1} of sheet {quoted(name)}" if name else f"line {number}"

    def span(self, first: int, last: int) -> str:
        if self.sheets:
            return f"{self.where(first)} to {self.where(last)}"
        return f"lines {first} to {last}"


class Frame:
    """A table that pandas or xarray holds, in the place of a file."""

    def __init__(self, frame: Any) -> None:
        self.frame = frame

    def __str__(self) -> str:
        return "the table"


def read_source(path: Path | Frame) -> Source:
    """The lines of a file, which errors name, or of a table: one for the names, one a row."""
    if isinstance(path, Frame):
        rows = [map(str, path.frame.columns), *path.frame.to_numpy(dtype=object)]
        return Source([(at, "\t".join(map(_cell, row))) for at, row in enumerate(rows)])
    sheets: list[tuple[int, str]] = []
    with reading(path):
        check_file(path)
        numbered = enumerate(text_lines(path, sheets), start=1)
        kept = [(n, one) for n, one in numbered if one.strip() and not one.lstrip().startswith("#")]
    return Source(kept, tuple(sheets))


def text_lines(path: Path, sheets: list[tuple[int, str]] | None = None) -> Iterator[str]:
    """All lines of a file, without their ends; of a workbook `sheets` takes the names."""
    with path.open("rb") as file:
        begin = file.read(_SEEN)
    if begin.startswith((_ZIP, _OLE)):
        yield from _rows(path, begin.startswith(_ZIP), [] if sheets is None else sheets)
        return
    with path.open(encoding=_encoding(begin), errors="asperity-latin-1") as text:
        try:
            for line in text:
                yield line.rstrip("\r\n")
        except UnicodeError as error:
            raise InvalidInput(f"ends or breaks within a character: {error}") from error


def inputs_in(path: Path) -> dict[str, str]:
    """The inputs at the head of a CSV file of ours, as JSON by their keys; others have none."""
    head = takewhile(lambda line: line.startswith("#"), text_lines(path))
    parts = [line.removeprefix("# ").partition(" = ") for line in head]
    return {key: text for key, mark, text in parts if mark}


def notes_in(path: Path) -> tuple[Note, ...]:
    """The notes that a file has among its inputs."""
    try:
        lines = json.loads(inputs_in(path).get("note_lines", "[]"))
    except ValueError:
        lines = None
    if not isinstance(lines, list) or not all(isinstance(one, str) for one in lines):
        raise must_be("note_lines", "a list of texts", where=path)
    return tuple(map(Note.of_line, lines))


def _encoding(begin: bytes) -> str:
    """UTF-16 by its mark, or by the zeros that every other byte of plain text is; else UTF-8."""
    if begin.startswith((codecs.BOM_UTF16_LE, codecs.BOM_UTF16_BE)):
        return "utf-16"
    for first, encoding in ((1, "utf-16-le"), (0, "utf-16-be")):
        half = begin[first::2]
        if half and half.count(0) > _MOSTLY * len(half):
            return encoding
    return "utf-8-sig"


def _rows(path: Path, zipped: bool, sheets: list[tuple[int, str]]) -> Iterator[str]:
    number = 1
    package = "openpyxl" if zipped else "xlrd"
    with understood(f"not a sound workbook ({path.suffix or package})", package=package):
        for name, rows in (_of_xlsx if zipped else _of_xls)(path):
            sheets.append((number, name))
            for row in rows:
                number += 1
                yield "\t".join(map(_cell, row))


def _of_xlsx(path: Path) -> Iterator[tuple[str, Any]]:
    openpyxl = import_module("openpyxl")
    with path.open("rb") as file:
        Archive(file).check()
    book = openpyxl.load_workbook(path, read_only=True, data_only=True)
    try:
        for sheet in book.worksheets:
            sheet.reset_dimensions()  # some programs write wrong ones
            yield sheet.title, sheet.iter_rows(values_only=True)
    finally:
        book.close()


def _of_xls(path: Path) -> Iterator[tuple[str, Any]]:
    xlrd = import_module("xlrd")
    with open(os.devnull, "w", encoding="utf-8") as silent:
        book = xlrd.open_workbook(path, logfile=silent)
    for sheet in book.sheets():
        yield sheet.name, (sheet.row_values(row) for row in range(sheet.nrows))


def _cell(value: object) -> str:
    return "" if value is None else " ".join(str(value).split())
