"""Tables of contacts that `asperity.validation.slide` solves again: read, written, compared."""

import csv
import sys
from collections.abc import Callable, Sequence
from pathlib import Path

Row = dict[str, str]


def rows(table: Path) -> list[Row]:
    """Return the rows of a table below its comment."""
    with table.open(encoding="ascii") as file:
        return [*csv.DictReader(line for line in file if line[0] != "#")]


def write(table: Path, comment: str, found: Sequence[Row]) -> None:
    """Write a table below its comment."""
    with table.open("w", encoding="ascii", newline="") as file:
        file.write(comment)
        writer = csv.DictWriter(file, list(found[0]), lineterminator="\n")
        writer.writeheader()
        writer.writerows(found)


def figures(**values: float) -> Row:
    """Return what was found in five digits."""
    return {name: f"{value:.5g}" for name, value in values.items()}


def solve_again(
    table: Path, comment: str, solved: Callable[[Row], Row], compared: Sequence[str]
) -> None:
    """Write all rows anew, or say of those whose cases are named how far they are from theirs."""
    known, named = rows(table), sys.argv[1:]
    if not named:
        write(table, comment, [solved(row) for row in known])
        return
    for row in known:
        if row["case"] in named:
            new = solved(row)
            apart = {n: float(new[n]) / float(row[n]) - 1 for n in compared if float(row[n] or 0)}
            print(row["case"], {name: f"{value:+.1e}" for name, value in apart.items()})
