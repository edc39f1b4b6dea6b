"""Tables of contacts that `asperity.validation.slide` solves again: read, written, compared."""

import csv
import math
import sys
from collections.abc import Callable, Sequence
from pathlib import Path

import asperity

Row = dict[str, str]
ANOTHER_PROGRAM = Path(__file__).with_name("sliding_contacts.csv")


def rows(table: Path) -> list[Row]:
    """Return the rows of a table below its comment."""
    with table.open(encoding="ascii") as file:
        return [*csv.DictReader(line for line in file if line[0] != "#")]


def write(table: Path, comment: str, result: Sequence[Row]) -> None:
    """Write a table below its comment."""
    with table.open("w", encoding="ascii", newline="") as file:
        file.write(comment)
        writer = csv.DictWriter(file, list(result[0]), lineterminator="\n")
        writer.writeheader()
        writer.writerows(result)


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


def scene_of_another_program(
    row: Row,
) -> tuple[asperity.SelfAffineSpectrum, asperity.PronySeries, dict[str, float]]:
    """Return the spectrum at the row's rms height, the rubber, and pressure and velocity."""
    spectrum = asperity.SelfAffineSpectrum(
        rms_height=float(row["rms_height"]),
        hurst=float(row["hurst"]),
        q0=2 * math.pi * float(row["k0"]),
        q1=2 * math.pi * float(row["k1"]),
    )
    rubber = asperity.PronySeries(
        equilibrium_modulus=float(row["E_inf"]),
        moduli=[float(x) for x in row["moduli"].split()],
        relaxation_times=[float(x) for x in row["times"].split()],
    )
    return spectrum, rubber, {name: float(row[name]) for name in ("pressure", "velocity")}


def map_of_another_program(row: Row, points: int, seed: int = 1) -> asperity.HeightMap:
    """Return a map of its spectrum: the phases of that program are not known."""
    spectrum, _, _ = scene_of_another_program(row)
    shape, pixel = (points, points), 1 / points
    made = asperity.synthesize(spectrum, shape=shape, pixel_size=pixel, seed=seed)
    return asperity.HeightMap(
        made.heights * (spectrum.rms_height / made.rms_height), pixel_size=pixel
    )
