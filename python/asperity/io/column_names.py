"""Lines of a text file with columns, and the line that names them."""

from pathlib import Path
from typing import NamedTuple

from asperity._core import InvalidInput
from asperity.io.files import check_file

_MOST_LINES = 50  # in which the names of the columns are looked for

Lines = list[tuple[int, str]]


class Header(NamedTuple):
    """The line that names the columns, and the units below it where there are any."""

    number: int
    names: list[str]
    units: list[str]


def numbered_lines(path: Path) -> Lines:
    """Lines that are neither empty nor comments, with their numbers; UTF-8 or Latin-1."""
    try:
        check_file(path)
        data = path.read_bytes()
    except OSError as error:
        raise InvalidInput(f"cannot be read: {error.strerror or error}", where=path) from error
    except InvalidInput as error:
        raise error.within(path) from error
    try:
        text = data.decode("utf-8-sig")
    except UnicodeDecodeError:
        text = data.decode("latin-1")
    return [
        (number, line)
        for number, line in enumerate(text.splitlines(), start=1)
        if line.strip() and not line.lstrip().startswith("#")
    ]


def separator_of(line: str) -> str | None:
    """The mark between cells; None for blanks."""
    return next((mark for mark in ";\t," if mark in line), None)


def cells_of(line: str) -> list[str]:
    """The cells of a line without the quotes around them; those of G" stay."""
    cells = [cell.strip() for cell in line.split(separator_of(line))]
    return [cell.strip('"') if cell.count('"') > 1 else cell for cell in cells]


def find_header(lines: Lines) -> Header | None:
    """The line of words above the numbers; where the one above it has as many cells, parted by the
    same mark, that one has the names and the lower one the units."""
    words: list[tuple[int, str | None, list[str]]] = []
    for number, line in lines[:_MOST_LINES]:
        cells = cells_of(line)
        wordy = sum(any(one.isalpha() for one in cell) for cell in cells)
        if 2 * wordy > len(cells) > 1:
            words.append((number, separator_of(line), cells))
        elif words and len(cells) > 1:
            break
    if not words:
        return None
    number, mark, names = words[-1]
    if len(words) > 1:
        above, its_mark, its_names = words[-2]
        if (above, its_mark, len(its_names)) == (number - 1, mark, len(names)):
            return Header(above, its_names, names)
    return Header(number, names, [])
