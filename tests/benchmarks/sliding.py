"""Exact sliding contact: seconds a point, over the rows that another program solved.

    python tests/benchmarks/sliding.py [--output DIR]

Every second row of 512^2 points of tests/reference/sliding_contacts.csv, maps of seed 1 of
`synthesize`, rtol 1e-6; processor time of one thread. Also one contact each of 128^2 to 2048^2
points, with the memory that the process held at most.
"""

import resource
import sys
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np
import timing

import asperity

sys.path.insert(0, str(Path(__file__).parents[1] / "reference"))
import contact_tables
from contact_tables import Row


def solve(row: Row, surface: asperity.HeightMap) -> Any:
    _, rubber, at = contact_tables.scene_of_another_program(row)
    try:
        return asperity.validation.slide(surface, rubber, **at, periodic=True)
    except asperity.NotConverged:
        return None


def make() -> timing.Report:
    listed = contact_tables.rows(contact_tables.ANOTHER_PROGRAM)
    columns: dict[str, list[object]] = {
        name: []
        for name in ("rubber", "k1", "pressure", "log10_v_q0", "points", "seconds", "error")
    }

    def add(row: Row, points: int) -> float:
        taken, result = timing.timed(
            partial(solve, row, contact_tables.map_of_another_program(row, points))
        )
        values = (row["material"], row["k1"], row["pressure"], row["log10_v_q0"], points, taken)
        for name, value in zip(columns, values, strict=False):
            columns[name].append(value)
        columns["error"].append(None if result is None else result.error)
        return taken

    times = np.array([add(row, 512) for row in [r for r in listed if r["N"] == "512"][::2]])
    failed = sum(error is None for error in columns["error"])
    text = (
        f"512^2, {times.size} contacts: median {np.median(times):.2f} s, 95 % within "
        f"{np.quantile(times, 0.95):.2f} s, longest {times.max():.1f} s, not converged {failed}\n"
    )
    one = next(r for r in listed if (r["material"], r["log10_v_q0"]) == ("sbr", "0.0000"))
    for points in (128, 256, 512, 1024, 2048):
        taken = add(one, points)
        held = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 2**20
        text += f"{points}^2: {taken:.2f} s, {held:.2f} GiB\n"
    files = {"sliding.csv": timing.table("sliding", columns)}
    return timing.Report(text, files)


if __name__ == "__main__":
    timing.run(make, __doc__)
