"""Columns of a table by their names or places: numbers, where each stands, and stated units."""

import re
from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from asperity.base.diagnostics import MUST_BE, InvalidInput, Note
from asperity.io import plausible
from asperity.io.instrument import brief
from asperity.io.source import Frame, Source, read_source

Column = NDArray[np.float64]
Names = Mapping[str, str | int]  # in the file, by ours; whole numbers count columns from 1
Lines = list[tuple[int, str]]

_MOST_LINES = 50  # in which the names of the columns are looked for
_MOST_UNIT_LINES = 2  # between the names of the columns and the first numbers
_NOTHING = {"", "-", "--", "---", "n/a", "na"}  # what programs write where they have no number
# What units are called, by what they are of; those of the first line are what can be declared.
_UNITS = {
    "frequency": {"Hz": r"hz|hertz", "rad/s": r"rad[ ./·]*s(ec)?([-⁻]?[1¹])?"},
    "modulus": {
        "Pa": "pa|pascal|n/m(2|²|\\^2)",
        "kPa": "kpa",
        "MPa": "mpa|n/mm(2|²|\\^2)",
        "GPa": "gpa",
        "psi": "psi",
        "bar": "bar",
        "dyn/cm2": "dyne?s?/cm(2|²|\\^2)",
    },
    "temperature": {
        "C": "([°º�]|deg\\.?)? ?c(elsius)?",
        "K": "k(elvin)?",
        "F": "([°º�]|deg\\.?)? ?f(ahrenheit)?",
    },
    "strain": {"%": "%|percent", "1": "-|1|m/m|mm/mm"},
}


class Header(NamedTuple):
    """The line that names the columns, and the units below it where there are any."""

    number: int
    names: list[str]
    units: list[str]


def separator_of(line: str) -> str | None:
    """The mark between cells; None for blanks."""
    return next((mark for mark in "\t;," if mark in line), None)


def cells_of(line: str) -> list[str]:
    """The cells of a line without the quotes around them; those of G" stay."""
    cells = [cell.strip() for cell in line.split(separator_of(line))]
    return [cell.strip('"') if cell.count('"') > 1 else cell for cell in cells]


def is_wordy(cells: list[str]) -> bool:
    """Whether cells are words, as names of columns or units are."""
    wordy = sum(any(one.isalpha() for one in cell) for cell in cells)
    return 2 * wordy > len(cells) > 1


def find_header(lines: Lines) -> Header | None:
    """The line of words above the numbers; where the one above it has as many cells, parted by the
    same mark, that one has the names and the lower one the units."""
    words: list[tuple[int, str | None, list[str]]] = []
    for number, line in lines[:_MOST_LINES]:
        cells = cells_of(line)
        if is_wordy(cells):
            words.append((number, separator_of(line), cells))
        elif words and len(cells) > 1:
            break
    if not words:
        return None
    number, mark, names = words[-1]
    if len(words) > 1:
        above, its_mark, its_names = words[-2]
        if number - above <= 2 and (its_mark, len(its_names)) == (mark, len(names)):
            return Header(above, its_names, names)
    return Header(number, names, [])


def unit_in(kind: str, text: str) -> str | None:
    """The unit that a cell below a name is, or a name ends in: "[kPa]", "G' (kPa)", "E'/MPa"."""
    inside = re.search(r"[\[(]([^\[\]()]*)[\])]\s*$", text)
    tail = re.search(r"[/,_ ]\s*([^/,_ ]+(?:/s)?)\s*$", text)
    for candidate in (text, *(match[1] for match in (inside, tail) if match)):
        for unit, pattern in _UNITS.get(kind, {}).items():
            if re.fullmatch(pattern, candidate.strip(" []()"), re.IGNORECASE):
                return unit
    return None


@dataclass
class _Block:
    """Rows under one line of names; programs write one for each step of a test."""

    places: Mapping[str, int]
    separator: str | None
    most: int | None  # cells of a row
    units: list[list[str]] = field(default_factory=list)  # the lines below the names
    rows: int = 0


@dataclass(frozen=True)
class Columns:
    """Columns by our names, as numbers, and where they stand."""

    path: Path | Frame
    values: dict[str, Column]
    block: NDArray[np.int64]  # of each row
    units: Mapping[str, str]  # what the file calls the units, where it does
    _lines: NDArray[np.int64]
    _source: Source

    def where(self, row: int) -> str:
        return self._source.where(int(self._lines[row]))

    def span(self) -> str:
        return self._source.span(int(self._lines[0]), int(self._lines[-1]))

    def taken(self, rows: NDArray[Any]) -> "Columns":
        values = {name: column[rows] for name, column in self.values.items()}
        of_rows = self.block[rows], self.units, self._lines[rows]
        return Columns(self.path, values, *of_rows, self._source)


def read_columns(path: Path | Frame, names: Names, kinds: Mapping[str, str]) -> Columns:
    """Columns of a table of text or of a workbook.

    A line with the names precedes the numbers; rows below other names are left out, which a note
    says, and so are rows that have a number in none of the columns. Where `names` are places,
    counted from 1, whatever precedes the first row of numbers is passed over.

    `kinds` says what units are of, for those that the file states. Raises InvalidInput.
    """
    source = read_source(path)
    reader = _Reader(path, source, names)
    digits = all(f"{name}".isdigit() for name in names.values())
    if digits and not any(reader.places(cells_of(line)) for _, line in source.lines):
        reader = _Reader(path, source, {ours: int(name) for ours, name in names.items()})
    for number, line in source.lines:
        reader.take(number, line)
    return reader.columns(kinds)


class _Reader:
    def __init__(self, path: Path | Frame, source: Source, names: Names) -> None:
        self.path, self.source, self.names = path, source, names
        self.blocks: list[_Block] = []
        self.block: _Block | None = None
        self.numbers: dict[str, list[float]] = {name: [] for name in names}
        self.lines: list[int] = []
        self.of: list[int] = []
        self.left: list[int] = []  # lines of numbers of other columns
        self.tested = names.keys() - {"temperature"} or names.keys()  # a row of another test has T
        self.named = {ours: name for ours, name in names.items() if isinstance(name, str)}

    def take(self, number: int, line: str) -> None:
        separator, cells = separator_of(line), cells_of(line)
        places = self.places(cells)
        if places is not None:
            most = len(cells) if separator == "," else None
            self.block = _Block(places, separator, most)
            self.blocks.append(self.block)
        elif self.block is not None:
            self._row(number, line, cells, self.block)
        elif not self.named:
            self._first(number, line, separator)
        elif self.blocks and not is_wordy(cells) and len(cells) > 1:
            self.left.append(number)

    def places(self, cells: list[str]) -> dict[str, int] | None:
        if not self.named or not all(name in cells for name in self.named.values()):
            return None
        return {
            ours: cells.index(name) if isinstance(name, str) else name - 1
            for ours, name in self.names.items()
        }

    def _first(self, number: int, line: str, separator: str | None) -> None:
        """Begin at the first line that has numbers at all the places."""
        places = {ours: int(place) - 1 for ours, place in self.names.items()}
        block = _Block(places, separator, None)
        if all(isinstance(one, float) for one in self._cells(line, block).values()):
            self.block = block
            self.blocks.append(block)
            self._row(number, line, cells_of(line), block)

    def _cells(self, line: str, block: _Block) -> dict[str, float | str | None]:
        """Numbers; texts that are none; None beyond the last cell."""
        separator = block.separator
        # names parted by tabs may stand over numbers parted by blanks
        number = line.lstrip()[:1] in set("+-.0123456789")
        blanks = separator == "\t" and separator not in line and number
        cells = line.split(None if blanks else separator)
        values: dict[str, float | str | None] = {}
        for name, place in block.places.items():
            if place >= len(cells):
                values[name] = None
                continue
            cell = cells[place].strip().strip('"')
            try:
                values[name] = float((cell if separator == "," else cell.replace(",", ".")) or "?")
            except ValueError:
                values[name] = "" if cell.lower() in _NOTHING else cell
            if "_" in cell:  # which Python takes for a part of a number
                values[name] = cell
        return values

    def _row(self, number: int, line: str, cells: list[str], block: _Block) -> None:
        values = self._cells(line, block)
        if not any(isinstance(one, float) for one in values.values()):
            self._no_row(cells, block)
            return
        if all(values[name] == "" for name in self.tested):
            self.left.append(number)
            return
        where = self.source.where(number)
        # decimal commas between commas make more cells: their numbers would be others
        if block.most is not None and any(one.strip() for one in line.split(",")[block.most :]):
            counted = f"has {line.count(',') + 1} cells, the names {block.most}"
            self._refuse(f"{where} {counted}: numbers have a decimal point")
        for name, one in values.items():
            if isinstance(one, float):
                if not np.isfinite(one):
                    wrong = f"{where}: {name} = {one}"
                    raise InvalidInput(wrong, MUST_BE, "finite", where=self.path)
                self.numbers[name].append(one)
            elif one is None:
                least = f"must have {block.places[name] + 1} or more"
                self._refuse(f"{where} has {len(cells)} cells, {least} ({name})")
            else:
                problem = f"= {brief(one)!r} is not a number" if one else "is empty"
                self._refuse(f"{where}: {name} {problem}")
        self.lines.append(number)
        self.of.append(len(self.blocks) - 1)
        block.rows += 1

    def _no_row(self, cells: list[str], block: _Block) -> None:
        """A line without a number in the columns: units, a remark, or other names."""
        if not block.rows and len(block.units) < _MOST_UNIT_LINES:
            block.units.append(cells)
        elif is_wordy(cells):
            self.block = None

    def columns(self, kinds: Mapping[str, str]) -> Columns:
        if not self.blocks:
            self._refuse_names()
        if not self.lines:
            self._refuse("no numbers below the names of the columns")
        if self.left:
            where = self.source.span(self.left[0], self.left[-1])
            tested = ", ".join(sorted(self.tested))
            text = f"{where}: {len(self.left)} rows without {tested} were left out"
            plausible.tell_again([Note(text, code="rows-left-out", where=self.path)])
        values = {name: np.array(numbers) for name, numbers in self.numbers.items()}
        lines, block = np.array(self.lines), np.array(self.of)
        return Columns(self.path, values, block, self._units(kinds), lines, self.source)

    def _units(self, kinds: Mapping[str, str]) -> dict[str, str]:
        units: dict[str, str] = {}
        for block in self.blocks:
            for name, place in block.places.items():
                below = [one[place] for one in block.units if place < len(one)]
                said = [str(self.names[name]), *below]
                stated = [unit for text in said if (unit := unit_in(kinds.get(name, ""), text))]
                if stated and units.setdefault(name, stated[-1]) != stated[-1]:
                    self._refuse(f"{name} is in {units[name]} above and in {stated[-1]} below")
        return units

    def _refuse(self, problem: str) -> Any:
        raise InvalidInput(problem, where=self.path)

    def _refuse_names(self) -> Any:
        lines = self.source.lines
        wanted = [str(name) for name in self.names.values()]
        missing = [name for name in wanted if not any(name in line for _, line in lines)]
        named = ", ".join(map(repr, missing or wanted))
        header = find_header(lines)
        if not self.named:
            self._refuse(f"no line has numbers in the columns {named}")
        there = "; columns without names are given by their places, as in frequency = 1"
        if header is not None:
            words = [name for name in header.names if any(one.isalpha() for one in name)]
            place = self.source.where(header.number)
            there = f"; {place} has {brief(', '.join(map(repr, words)))}"
        hint = ""
        if missing == [self.names.get("temperature")]:
            hint = "; temperatures = [...] has one for each file without a column of them"
        problem = f"no line names the columns {named}{there}{hint}"
        raise InvalidInput(problem, code="unknown-columns", where=self.path)
