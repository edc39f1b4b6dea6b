"""Error of mu against exact sliding contact, of each model that `models` times, and a panel of it.

The contacts are rows judge and curve of tests/reference/exact_sliding.csv: Gaussian heights, which
no fit has seen. The single scale is mu = h'^2 E*'' / (pi sigma0) in complete contact, and at light
load 2 A/A0 = 2 sqrt(8 / pi) sigma0 / (|E*| h') of it (Eq. 22 on a narrow band), which is 1.02 h'
times the sine of the loss angle: all of the slope h' is in waves of q1.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np
from sliding_corrections import CORRECTIONS, judged, make_exact_sliding, spectrum_of

from asperity.draw.style import COLOURS

SETS = ("judge", "curve")
MESH = 0.3  # %, by how much twice as many pixels change mu of exact contacts
TIMES = Path(__file__).parents[2] / "docs" / "benchmarks" / "sliding.csv"
NAMES = {  # of sliding_corrections, by the name that the chart gives them
    "Persson, exact": "none",
    "S on the integrand, 0.40": "S, 0.40",
    "S on the integrand, 0.50": "S, 0.50",
    "S inside G, 5/9": "S in G, 5/9",
    "S by bandwidth (Nayak)": "Nayak S",
    "$p_T$ from peaks, $\\lambda_0$": "peaks, lambda0",
    "$p_T$ from peaks, $\\lambda_0/2$": "peaks, lambda0/2",
    "$p_T$ from IGW, implicit": "IGW implicit",
    "$p_T$ from IGW, added": "IGW added",
    "PartialContact": "partial contact",
}
LEADER = {"arrowstyle": "-", "color": "0.75", "linewidth": 0.7, "relpos": (0, 0.5), "shrinkB": 4}
COLUMN = 40.0  # us, where the names of theories stand in a column
STEP = 1.36  # from a name to the next one below it
HIGHEST = 900.0  # %, of the panels


@dataclass(frozen=True)
class MuError:
    """Over the contacts for which the model can be made, in %."""

    rms: float
    worst: float
    contacts: int


def of(errors: Sequence[float]) -> MuError:
    known = 100 * np.abs([error for error in errors if math.isfinite(error)])
    return MuError(float(np.sqrt(np.mean(known**2))), float(known.max()), known.size)


def friction_of_a_single_scale(slope: float, modulus: Any, pressure: float) -> Any:
    """mu of a surface with all of its rms slope at q1; the modulus is E* there."""
    share = np.minimum(1.0, 2 * math.sqrt(8 / math.pi) * pressure / (abs(modulus) * slope))
    return slope**2 * modulus.imag * share / (math.pi * pressure)


def single_scale_error(row: dict[str, str]) -> float:
    spectrum = spectrum_of(row, None)  # a closed form: heights are Gaussian
    rubber = make_exact_sliding.rubber(row["rubber"])
    modulus = rubber.modulus(float(row["velocity"]) * spectrum.q1) / (1 - 0.5**2)
    found = friction_of_a_single_scale(spectrum.rms_slope, modulus, float(row["pressure"]))
    return float(found) / float(row["mu"]) - 1


@cache
def errors() -> dict[str, MuError]:
    """By the chart's names; maps are made once more, as peaks are found on them."""
    rows = [
        row
        for row in make_exact_sliding.rows()
        if row["set"] in SETS and row["rubber"] != "elastic"
    ]
    found = judged(rows)
    assert set(NAMES.values()) <= set(CORRECTIONS)
    result = {name: of([e.mu[key] for e in found]) for name, key in NAMES.items()}
    result["single scale at $q_1$"] = of([single_scale_error(row) for row in rows])
    return result


def panel(axes: Any, points: Sequence[tuple[str, float, float]], title: str) -> None:
    """Draws (name, seconds, rms error in %); names of theories in a column, the worst on top."""
    height = 2 * HIGHEST
    for name, seconds, error in sorted(points, key=lambda point: -point[2]):
        exact = name.startswith("exact")
        style = {"marker": "D", "color": "0.4"} if exact else {"marker": "o", "color": COLOURS[0]}
        if name == "ScanContact":
            style = {"marker": "o", "color": COLOURS[1]}
        axes.plot(1e6 * seconds, error, linestyle="", **style)
        theory = seconds < 1e-3
        height = min(height / STEP, 1.4 * error) if theory else height
        axes.annotate(
            name,
            (1e6 * seconds, error),
            (COLUMN, height) if theory else (6, -12 if exact else 12),
            textcoords="data" if theory else "offset points",
            ha="left" if theory else "right",
            va="center",
            fontsize="small",
            arrowprops=LEADER if theory else None,
        )
    axes.set_xscale("log")
    axes.set_yscale("log")
    ticks = (0.3, 1, 3, 10, 30, 100, 300)
    axes.set_yticks(ticks, [f"{tick:g}" for tick in ticks])
    axes.set_xlim(0.1, 2e6)
    axes.set_ylim(0.15, HIGHEST)
    axes.set_title(title, loc="left", fontsize="medium")
    axes.set_xlabel("Cost of a velocity [$\\mu$s]")
    axes.grid(color="0.92", linewidth=0.6)
    axes.set_axisbelow(True)
    axes.tick_params(which="both", direction="in", top=True, right=True)
