"""Work-precision diagrams: error against time of a curve of 20 velocities, a panel a scene.

    python tests/benchmarks/work_precision.py [--output DIR]

Scenes and truth are those of tests/reference: rings of a scan (friction_rings.csv), known to 13
digits, then closed forms (friction_curves.csv), to 16, and not by this code. One thread; the time
is the median of a few runs, the error the worst of the curve. Each line is one method, from coarse
to fine: ours and GSL's by rtol 1e-2 to 1e-12, by parts and the graded panels by their nodes, the
logarithmic grid by its points from 30 to 1e5, nested quad by epsrel (timed on two of the
velocities; on rings it takes minutes and is left out). A line ends with the first point that takes
over a second.
"""

import warnings
from collections.abc import Iterator
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np
import timing
from curves import Curve, curves, measured_curves
from schemes import by_parts, graded_panels, log_trapezoid, nested_quad

from asperity import NotConverged
from asperity.draw.figure import new_figure, picture
from asperity.draw.style import COLOURS

RTOLS = [10.0**-k for k in range(2, 13)]
# nodes, growth, first and longest panel, as good as each number of nodes can be on these curves
PANELS = [(6, 9, 0.3, 3), (8, 6, 0.3, 3), (12, 9, 0.3, 3), (14, 6, 0.3, 3), (20, 4, 0.15, 1.5)]
PANELS += [(24, 3, 0.1, 1)]
ON_RINGS = (2, 3, 4, 6, 8, 12)  # nodes a panel, one and more a ring
LONGEST = 1.0  # seconds of a curve
FLOOR, CEILING = 1e-16, 1e3  # of the errors that are shown
STYLES: dict[str, dict[str, Any]] = {
    "ours": {"color": COLOURS[0], "marker": "o", "linewidth": 2.4, "zorder": 5},
    "by parts, fixed nodes": {"color": COLOURS[2], "marker": "s"},
    "graded panels": {"color": COLOURS[4], "marker": "D"},
    "GSL QAG": {"color": COLOURS[3], "marker": "^"},
    "GSL QAGS": {"color": COLOURS[6], "marker": "v", "linestyle": ":"},
    "GSL CQUAD": {"color": COLOURS[5], "marker": "P"},
    "logarithmic trapezoid": {"color": COLOURS[1], "marker": "x", "linestyle": "--"},
    "nested quad": {"color": "0.5", "marker": "*", "linestyle": "--"},
}


def lines(curve: Curve) -> dict[str, dict[str, timing.Call]]:
    """Calls of each method by their setting, from coarse to fine."""
    points = [30, 100, 300, 1000, 3000, 10000, 30000, 100000]
    nodes = [8, 12, 16, 24, 32, 48, 64, 96, 128]
    panels = [(n, 2, 0.03, 1) for n in ON_RINGS] if curve.measured else PANELS
    result: dict[str, dict[str, timing.Call]] = {
        "ours": {f"{rtol:.0e}": partial(curve.ours, rtol) for rtol in RTOLS},
        "by parts, fixed nodes": {str(n): partial(by_parts, curve, n) for n in nodes},
        "graded panels": {f"{p[0]} a panel": partial(graded_panels, curve, *p) for p in panels},
        "logarithmic trapezoid": {str(n): partial(log_trapezoid, curve, n) for n in points},
    }
    for name in ("QAG", "QAGS", "CQUAD"):
        result[f"GSL {name}"] = {
            f"{rtol:.0e}": partial(curve.ours, rtol, name.lower()) for rtol in RTOLS[::2]
        }
    return {name: result[name] for name in STYLES if name in result}


def measure(curve: Curve) -> Iterator[tuple[str, str, float, float]]:
    """Method, setting, seconds and error."""
    for name, calls in lines(curve).items():
        for setting, call in calls.items():
            try:
                error = curve.error(call())
            except NotConverged:  # it says so, and gives no number
                break
            elapsed = timing.typical(call, 5)
            yield name, setting, elapsed, error
            if elapsed > LONGEST:
                break
    if curve.measured:
        return
    few = curve.of_velocities(slice(3, None, 10))
    for rtol in (1e-2, 1e-5, 1e-9):
        with warnings.catch_warnings(action="ignore"):  # scipy knows where it does not converge
            elapsed, result = timing.timed(partial(nested_quad, few, rtol))
        yield (
            "nested quad",
            f"{rtol:.0e}",
            elapsed * len(curve.truth) / len(result),
            few.error(result),
        )
        if elapsed > LONGEST:
            break


def draw(rows: list[tuple[str, str, str, float, float]], path: Path) -> bytes:
    figure, panels = new_figure(8)
    for axes, case in zip(panels, dict.fromkeys(row[0] for row in rows), strict=True):
        for name, style in STYLES.items():
            points = [row[3:] for row in rows if row[:2] == (case, name)]
            time, error = np.array(points).reshape(-1, 2).T
            axes.plot(time, error.clip(FLOOR, CEILING), label=name, markersize=5, **style)
        axes.set_title(case, fontsize="medium")
        axes.set_xscale("log")
        axes.set_yscale("log")
        axes.set_xlim(2e-5, 60)
        axes.set_ylim(FLOOR / 2, 2 * CEILING)
        axes.set_yticks(10.0 ** np.arange(-16, 4, 3))
        axes.minorticks_off()
    figure.supxlabel("Time of a curve of 20 velocities [s]", fontsize="medium")
    figure.supylabel("Worst relative error of the curve [-]", fontsize="medium")
    handles, names = panels[0].get_legend_handles_labels()
    figure.legend(handles, names, loc="outside upper center", ncols=len(names), frameon=False)
    return picture(figure, path)


def summary(rows: list[tuple[str, str, str, float, float]]) -> str:
    """Least time in which each method is within 1e-3, 1e-6 and 1e-9, and stays there."""
    bounds = (1e-3, 1e-6, 1e-9)
    table = []
    for case in dict.fromkeys(row[0] for row in rows):
        for name in STYLES:
            points = [row[3:] for row in rows if row[:2] == (case, name)]
            cells = []
            for bound in bounds:
                good = [
                    time
                    for i, (time, _) in enumerate(points)
                    if all(error <= bound for _, error in points[i:])
                ]
                cells.append(f"{1e3 * min(good):.3g}" if good else "-")
            table.append([case, name, *cells])
    return timing.markdown(["scene", "method", *(f"{b:.0e} [ms]" for b in bounds)], table)


def make() -> timing.Report:
    scenes = measured_curves() | curves()
    rows = [(name, *row) for name, curve in scenes.items() for row in measure(curve.thinned())]
    names = ("scene", "method", "setting", "time_s", "error")
    columns = dict(zip(names, zip(*rows, strict=True), strict=True))
    files = {"work_precision.csv": timing.table("benchmark work_precision", columns)}
    files |= {
        f"work_precision{end}": draw(rows, Path(f"work_precision{end}")) for end in (".png", ".svg")
    }
    return timing.Report(f"Work and precision:\n\n{summary(rows)}", files)


if __name__ == "__main__":
    timing.run(make, __doc__)
