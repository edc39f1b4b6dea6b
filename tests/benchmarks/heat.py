"""Models of the heat of sliding: what a velocity costs and how wrong mu is.

    python tests/benchmarks/heat.py [--output DIR]

Errors are those against the steady states of tests/reference/flash.csv, on which two other programs
agree, at 0.2 MPa and from 1 mm/s on: without heat, and with a temperature for each wavenumber at
four tolerances. The cost is that of a velocity among the 60 of a curve
from 1e-6 to 10 m/s, with 20 Prony terms, by one thread.
"""

import csv
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np
import timing

import asperity
from asperity.draw.figure import new_figure, picture
from asperity.draw.style import COLOURS

REFERENCE = Path(__file__).parents[1] / "reference/flash.csv"
PRESSURE = 2e5
SLOWEST = 1e-3  # m/s: below it is next to no heat
LAW = asperity.WLF(c1=8.86, c2=101.6, reference_temperature=293.15)
TREAD: dict[str, Any] = {
    "density": 1200,
    "heat_capacity": 1650,
    "conductivity": 0.23,
    "contact_diameter": 1e-3,
}
ASPHALT = asperity.SelfAffineSpectrum(rms_height=265.7e-6, hurst=0.87, q0=2000, q1=1e6)
SCENES = {"slope13": "rms slope 1.3", "full": "q1 = 1e6 1/m", "cold_253": "rms slope 1.3, -20 °C"}
PROFILE = "T(q)"
RTOL = (1e-2, 1e-4, 1e-6, 1e-9)


@dataclass(frozen=True)
class Line:
    """Cost of a velocity; worst error of mu by scene, 1 is 100 %."""

    name: str
    seconds: Mapping[str, float]
    error: Mapping[str, float]


@dataclass(frozen=True)
class Scene:
    road: asperity.SelfAffineSpectrum
    rubber: asperity.PronySeries
    temperature: float
    velocity: Any
    mu: Any

    def friction(self, velocity: Any, **how: Any) -> Any:
        return asperity.friction(
            self.road,
            self.rubber,
            pressure=PRESSURE,
            velocity=velocity,
            temperature=self.temperature,
            shift=LAW,
            **how,
        )


def scenes() -> Mapping[str, Scene]:
    lines = REFERENCE.read_text(encoding="utf-8").splitlines()
    kept = [line.split()[1:] for line in lines if line.startswith(("# mod", "# relax"))]
    columns = {name: [float(x) for x in numbers] for name, *numbers in kept}
    rubber = asperity.PronySeries(equilibrium_modulus=2e6, **columns)
    rows = list(csv.DictReader(line for line in lines if line[0] != "#"))
    result = {}
    for kind, name in SCENES.items():
        of_kind = [
            row
            for row in rows
            if row["kind"] == kind
            and float(row["pressure"]) == PRESSURE
            and float(row["velocity"]) >= SLOWEST
        ]
        result[name] = Scene(
            road=ASPHALT.truncated(q1=float(of_kind[0]["q1"])),
            rubber=rubber,
            temperature=float(of_kind[0]["temperature"]),
            velocity=np.array([float(row["velocity"]) for row in of_kind]),
            mu=np.array([float(row["mu_h"]) for row in of_kind]),
        )
    return result


def methods() -> Mapping[str, dict[str, Any]]:
    result: dict[str, dict[str, Any]] = {"without heat": {"rtol": 1e-6}}
    full = asperity.Heating(**TREAD)
    return result | {f"{PROFILE}, rtol {rtol:g}": {"rtol": rtol, "heating": full} for rtol in RTOL}


def measure() -> list[Line]:
    swept = np.geomspace(1e-6, 10, 60)
    lines = []
    for name, how in methods().items():
        seconds, error = {}, {}
        for which, scene in scenes().items():
            call = partial(scene.friction, swept, **how)
            seconds[which] = timing.typical(call) / swept.size
            error[which] = float(
                np.max(np.abs(scene.friction(scene.velocity, **how).mu / scene.mu - 1))
            )
        lines.append(Line(name, seconds, error))
    return lines


def draw(lines: Sequence[Line], path: Path) -> bytes:
    from matplotlib.ticker import LogLocator, NullFormatter

    figure, (axes,) = new_figure(1)
    figure.set_size_inches(7.2, 4.2)
    marks = dict(zip(SCENES.values(), "os^", strict=True))
    kinds = {"without heat": COLOURS[1], PROFILE: COLOURS[0]}
    for scene in marks:
        full = [line for line in lines if line.name.startswith(PROFILE)]
        x, y = (
            [column[scene] for column in columns]
            for columns in ([line.seconds for line in full], [line.error for line in full])
        )
        axes.plot(1e6 * np.array(x), y, "-", color=COLOURS[0], linewidth=0.8, alpha=0.5)
    for line in lines:
        colour = next(c for kind, c in kinds.items() if line.name.startswith(kind))
        for scene, mark in marks.items():
            axes.plot(1e6 * line.seconds[scene], line.error[scene], mark, color=colour)
    for kind, colour in kinds.items():
        label = f"{kind}, rtol {RTOL[0]:g} to {RTOL[-1]:g}" if kind == PROFILE else kind
        axes.plot([], [], "-", linewidth=6, color=colour, label=label)
    for scene, mark in marks.items():
        axes.plot([], [], mark, color="0.4", label=scene)
    axes.set(xscale="log", yscale="log", ylim=(1e-13, 10))
    axes.yaxis.set_major_locator(LogLocator(numticks=8))
    axes.yaxis.set_minor_formatter(NullFormatter())
    axes.axhspan(1e-13, 2e-11, color="0.93", zorder=0)
    axes.text(
        0.98,
        0.03,
        "the two other programs differ",
        transform=axes.transAxes,
        ha="right",
        color="0.4",
        fontsize="small",
    )
    axes.set_xlabel("Cost of a velocity [µs]")
    axes.set_ylabel("Worst relative error of $\\mu$ from 1 mm/s on [-]")
    figure.legend(loc="outside right upper", fontsize="small")
    return picture(figure, path)


def make() -> timing.Report:
    lines = measure()
    columns: dict[str, list[Any]] = {"model": [line.name for line in lines]}
    for kind, scene in SCENES.items():
        columns[f"{kind}_time_s"] = [line.seconds[scene] for line in lines]
        columns[f"{kind}_error"] = [line.error[scene] for line in lines]
    rows = [
        [cell if isinstance(cell, str) else f"{cell:.3g}" for cell in row]
        for row in zip(*columns.values(), strict=True)
    ]
    files = {"heat.csv": timing.table("benchmark heat", columns)}
    files |= {f"heat{end}": draw(lines, Path(f"heat{end}")) for end in (".png", ".svg")}
    return timing.Report(f"Heat:\n\n{timing.markdown(list(columns), rows)}", files)


if __name__ == "__main__":
    timing.run(make, __doc__)
