"""The line of a table that names its columns, and the units below it."""

import re
from typing import NamedTuple

Lines = list[tuple[int, str]]

_MOST_LINES = 50  # in which the names of the columns are looked for
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
