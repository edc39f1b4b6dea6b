"""Error of mu against exact sliding contact, of each model that `models` times, and its panel.

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

from asperity.plot.style import COLOURS

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
BESIDE = {  # where a name stands by its point: (x, y) in points of type, alignment
    "single scale at $q_1$": (0, 10, "center"),
    "PartialContact": (8, 0, "left"),
    "exact sliding contact, $512^2$": (-8, 0, "right"),
}
LEADER = {
    "arrowstyle": "-",
    "color": "0.7",
    "linewidth": 0.7,
    "relpos": (0, 0.5),
    "shrinkB": 4,
}
CROWD = 25.0  # us, where names of a crowd stand, each at a height of its own
HEIGHTS = {
    "$p_T$ from peaks, $\\lambda_0$": 120.0,
    "S inside G, 5/9": 85.0,
    "$p_T$ from peaks, $\\lambda_0/2$": 60.0,
    "S by bandwidth (Nayak)": 42.0,
    "$p_T$ from IGW, added": 29.5,
    "$p_T$ from IGW, implicit": 20.5,
}


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


def panel(axes: Any, lines: Sequence[Any]) -> None:
    """Draws lines with `name`, `seconds` and `mu`."""
    for line in lines:
        if line.mu is None:
            continue
        exact = line.name.startswith("exact")
        style = {"marker": "D", "color": "0.4"} if exact else {"marker": "o", "color": COLOURS[0]}
        axes.plot(1e6 * line.seconds, line.mu.rms, linestyle="", **style)
        point = 1e6 * line.seconds, line.mu.rms
        x, y, side = BESIDE.get(line.name, (-8, 0, "right"))
        if line.name in HEIGHTS:
            x, y, side = CROWD, HEIGHTS[line.name], "left"
        axes.annotate(
            line.name,
            point,
            (x, y),
            textcoords="data" if line.name in HEIGHTS else "offset points",
            ha=side,
            va="center",
            fontsize="small",
            arrowprops=LEADER if line.name in HEIGHTS else None,
        )
    axes.set_xscale("log")
    axes.set_yscale("log")
    axes.set_yticks([0.3, 1, 3, 10, 30, 100], ["0.3", "1", "3", "10", "30", "100"])
    axes.set_xlim(0.05, 2e6)
    axes.set_ylim(0.2, 200)
    axes.set_title("(a) Friction, against exact sliding contact", loc="left", fontsize="medium")
    axes.set_xlabel("Cost of a velocity [$\\mu$s]")
    axes.set_ylabel("Error of $\\mu_\\mathrm{H}$, rms [%]")
    axes.grid(color="0.92", linewidth=0.6)
    axes.set_axisbelow(True)
    axes.tick_params(which="both", direction="in", top=True, right=True)
