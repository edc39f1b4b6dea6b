"""Reference tables, read where they lie; every row brings its own tolerance."""

import csv
from pathlib import Path

import numpy as np

REFERENCE = Path(__file__).parents[1] / "reference"


def reference(name: str) -> list[dict[str, object]]:
    """Rows of tests/reference/<name>.csv: numbers, lists (`;`), None for an empty cell."""
    with (REFERENCE / f"{name}.csv").open(encoding="utf-8") as file:
        rows = csv.DictReader(line for line in file if not line.startswith("#"))
        return [{key: value_of(key, cell) for key, cell in row.items()} for row in rows]


def value_of(column: str, cell: str) -> object:
    if column in ("case", "form"):
        return cell
    if column in LISTS:
        return np.array([float(x) for x in cell.split(";") if x])
    return float(cell) if cell else None


LISTS = {
    "moduli",
    "relaxation_times",
    "peaks",
    "table_frequency",
    "table_storage",
    "table_loss",
    "table_wavenumber",
    "table_density",
}
