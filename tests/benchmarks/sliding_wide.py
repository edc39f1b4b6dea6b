"""What corrections make of mu and A/A0 in wide bands, q1/q0 from 128 on.

    python tests/benchmarks/sliding_wide.py [--output DIR]

Rows of tests/reference/exact_sliding_wide.csv. Those that one grid holds judge by its contact; the
wider ones by nested contacts, whose figures are divided by their mean excess over the contact of
one grid where both are known. The theory is given the closed form of the spectrum.
"""

import sys
from pathlib import Path
from typing import Any

import numpy as np
import timing

import asperity
from asperity.correction import Correction

sys.path.insert(0, str(Path(__file__).parents[1] / "reference"))
import make_exact_sliding
import make_exact_sliding_wide

Row = dict[str, str]
CORRECTIONS: dict[str, Correction | None] = {
    "none": None,
    "S, 0.40": asperity.SFactor(gamma=0.4),
    "Nayak S": asperity.NayakSFactor(),
    "partial contact": asperity.PartialContact(),
}


def theory(row: Row, correction: Correction | None) -> tuple[float, float]:
    """mu and A/A0."""
    spectrum = asperity.SelfAffineSpectrum(
        rms_height=1,
        hurst=float(row["hurst"]),
        q0=2 * np.pi * float(row["k0"]),
        q1=2 * np.pi * float(row["k1"]),
    )
    found: Any = asperity.friction(
        spectrum.scaled(1 / spectrum.rms_slope**2),
        make_exact_sliding.rubber(row["rubber"]),
        pressure=float(row["pressure"]),
        velocity=float(row["velocity"]) or 1e-12,
        correction=correction,
    )
    return float(found.hysteresis), float(found.contact_area)


def make() -> timing.Report:
    rows = make_exact_sliding_wide.rows()
    header: tuple[str, ...] = ("contacts", "correction", "number")
    header += tuple(f"{of} {what}" for of in ("mu", "A") for what in ("rms", "mean", "min", "max"))
    lines: list[tuple[str, ...]] = []
    groups = {
        "one grid": lambda row: row["points"] and row["rubber"] != "elastic",
        "one grid, elastic": lambda row: row["rubber"] == "elastic",
        "nested": lambda row: not row["points"],
    }
    judged = [*zip(rows, make_exact_sliding_wide.truths(rows), strict=True)]
    for group, belongs in groups.items():
        chosen = [one for one in judged if belongs(one[0])]
        for name, correction in CORRECTIONS.items():
            found = np.array([theory(row, correction) for row, _ in chosen])
            exact = np.array([truth for _, truth in chosen])
            cells = []
            for i in (0, 1):
                if exact[0, i] == 0:
                    cells += [""] * 4
                    continue
                e = 100 * (found[:, i] / exact[:, i] - 1)
                cells += [f"{x:.1f}" for x in (np.sqrt(np.mean(e**2)), e.mean(), e.min(), e.max())]
            lines.append((group, name, str(len(chosen)), *cells))
    columns = {name: [line[i] for line in lines] for i, name in enumerate(header)}
    text = timing.markdown(header, lines)
    for name in ("mu", "A"):
        e = 100 * (make_exact_sliding_wide.excess(rows, name) - 1)
        text += f"nested over one grid, {name}: {e.size}, {e.min():+.1f} to {e.max():+.1f} %, "
        text += f"mean {e.mean():+.1f}, standard deviation {e.std(ddof=1):.1f}\n"
    return timing.Report(text, {"sliding_wide.csv": timing.table("sliding_wide", columns)})


if __name__ == "__main__":
    timing.run(make, __doc__)
