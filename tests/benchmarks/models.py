"""The models of contact that there are to choose from: what a point costs and how wrong it is.

    python tests/benchmarks/models.py [--output DIR]

Errors are those of mu against exact sliding contacts that no fit has seen, of Gaussian maps
(models_sliding.py) and worn ones (models_worn.py), and of the area and the elastic energy against
the 177 boundary-element contacts of `asperity validate`. The cost of a theory is that of a velocity
in a curve of 60, called from Python, on Table 1's surface and 20 Prony terms, at the default rtol;
of the estimate on a single scale, A/A0 = min(1, sqrt(8 / pi) sigma0 / (E* h')) with the rms slope
h' and E* at q1, and mu from it, the arithmetic in NumPy; of boundary elements one load, p / (E* h')
= 0.1, on 256 x 256 points (q1/q0 = 8, elastic); of exact sliding the median of sliding.py over 512
x 512 points, of `ScanContact` a first curve of 60 velocities over six decades on as many. One
thread, processor time.
"""

import csv
import math
from dataclasses import dataclass, replace
from functools import partial
from pathlib import Path
from typing import Any

import models_sliding
import models_worn
import numpy as np
import timing
from curves import Curve, curves
from models_sliding import MuError

import asperity
from asperity.correction import Correction
from asperity.draw.figure import picture
from asperity.draw.style import COLOURS
from asperity.validation.boundary_elements import contact
from asperity.validation.contacts import Contact, shipped
from asperity.validation.predictions import MODELS, Model, predict

VELOCITIES = np.geomspace(1e-6, 10, 60)
SHOWN = {  # models of asperity.validation by the name that the chart gives them
    "none": "Persson, exact",
    "S in Eq. 22, 0.40": "S on the integrand, 0.40",
    "S in Eq. 22, 0.50": "S on the integrand, 0.50",
    "S in G, 5/9": "S inside G, 5/9",
    "Nayak S": "S by bandwidth (Nayak)",
    "peaks, lambda0": "$p_T$ from peaks, $\\lambda_0$",
    "peaks, lambda0/2": "$p_T$ from peaks, $\\lambda_0/2$",
    "IGW implicit": "$p_T$ from IGW, implicit",
    "IGW added": "$p_T$ from IGW, added",
}
EQ_7 = Model("Persson, Eq. 7", "", lambda _: None, form="interpolated")
PARTIAL = Model("PartialContact", "", lambda _: asperity.PartialContact())
SLIDING = "exact sliding contact, $512^2$"
QUANTITIES = ("area", "energy")
TRUTH = {"area": 0.5, "energy": 0.3}  # %, what the shipped rows are known to


@dataclass(frozen=True)
class Line:
    """Cost of a velocity, and of what is done once before; errors in %, mean and worst."""

    name: str
    seconds: float
    errors: dict[str, tuple[float, float]]
    once: float | None = None
    mu: MuError | None = None
    worn: MuError | None = None


def single_scale(road: Any, modulus: float, pressure: float) -> float:
    """A/A0 of light contact on the rms slope, which holds while it is small."""
    return min(1.0, math.sqrt(8 / math.pi) * pressure / (modulus * road.rms_slope))


def estimate(curve: Curve) -> Any:
    """mu of all velocities from the same."""
    modulus = curve.rubber.modulus(VELOCITIES * curve.road.q1) / (1 - 0.5**2)
    return models_sliding.friction_of_a_single_scale(
        curve.road.rms_slope, modulus, curve.inputs["pressure"]
    )


def typical_contact(curve: Curve) -> Contact:
    """What asperities of Table 1's surface are like: a contact whose corrections can be timed."""
    rms = curve.inputs["rms_height"]
    return Contact(
        case="Table 1",
        spectrum=curve.road,
        hurst=curve.inputs["hurst"],
        q0=curve.inputs["q0"],
        rms_height=rms,
        z_max=3.7 * rms,
        z_min=-3.7 * rms,
        peaks={"lambda0": 2.2 * rms, "lambda0/2": 1.7 * rms},
        effective_modulus=1.0,
        pressure=1.0,
        area=1.0,
        energy=1.0,
    )


def statistics(errors: list[float]) -> tuple[float, float]:
    sizes = [100 * abs(error) for error in errors]
    return sum(sizes) / len(sizes), max(sizes)


def cost(curve: Curve, model: Model) -> float:
    correction: Correction | None = model.correction(typical_contact(curve))
    call = partial(
        asperity.friction,
        curve.road,
        curve.rubber,
        pressure=curve.inputs["pressure"],
        velocity=VELOCITIES,
        correction=correction,
        form=model.form,
    )
    return timing.typical(call, 15) / VELOCITIES.size


def theory(curve: Curve, model: Model, name: str, contacts: list[Contact]) -> Line:
    found = [predict(each, model) for each in contacts]
    errors = {kind: statistics([p.error(kind) for p in found]) for kind in QUANTITIES}
    return Line(name, cost(curve, model), errors)


def exact_sliding() -> Line:
    """What sliding.py has found."""
    with models_sliding.TIMES.open(encoding="utf-8") as file:
        rows = [*csv.DictReader(line for line in file if line[0] != "#")]
    times = [float(row["seconds"]) for row in rows if row["points"] == "512"]
    known = MuError(models_sliding.MESH, math.nan, 0)
    return Line(SLIDING, timing.median(times), {}, mu=known, worn=known)


def scan_contact() -> Line:
    of_gaussian = models_worn.errors(("Gaussian",))[models_worn.SCAN]
    of_worn = models_worn.errors(models_worn.WORN)[models_worn.SCAN]
    return Line(models_worn.SCAN, models_worn.seconds(), {}, mu=of_gaussian, worn=of_worn)


def boundary_elements() -> tuple[float, float]:
    """Seconds of one load on 256 x 256 points, and of finding the peaks of that map."""
    road = asperity.SelfAffineSpectrum(rms_height=0.01, hurst=0.8, q0=8 * math.pi, q1=64 * math.pi)
    surface = asperity.synthesize(road, shape=(256, 256), pixel_size=1 / 256, seed=1)
    press = partial(contact, surface, p_over_Eh=[0.1], periodic=True)
    peaks = partial(surface.local_peaks, min_distance=0.25, periodic=True)
    press()  # the first loads the solver
    return timing.median([timing.seconds(press) for _ in range(3)]), timing.typical(peaks)


def measure() -> list[Line]:
    """Cheapest first."""
    curve, contacts = curves()["Table 1"], shipped()
    scales = [
        single_scale(c.spectrum, c.effective_modulus, c.pressure) / c.area - 1 for c in contacts
    ]
    single = timing.typical(partial(estimate, curve), 15) / VELOCITIES.size
    lines = [
        Line("single scale at $q_1$", single, {"area": statistics(scales)}),
        theory(curve, EQ_7, EQ_7.name, contacts),
        Line(PARTIAL.name, cost(curve, PARTIAL), {}),
    ]
    known = {model.name: model for model in MODELS}
    lines += [theory(curve, known[key], name, contacts) for key, name in SHOWN.items()]
    pressing, peaks = boundary_elements()
    of_mu, of_worn = models_sliding.errors(), models_worn.errors(models_worn.WORN)
    lines = [
        replace(
            line,
            once=peaks if "peaks" in line.name else None,
            mu=of_mu.get(line.name),
            worn=of_worn.get(line.name),
        )
        for line in lines
    ]
    lines += [Line("boundary elements, $256^2$", pressing, {}), exact_sliding(), scan_contact()]
    return sorted(lines, key=lambda line: line.seconds)


def draw(lines: list[Line], path: Path) -> bytes:
    from matplotlib.figure import Figure

    figure = Figure(figsize=(11.5, 9.2), layout="constrained")
    above, below = figure.subfigures(2, 1, height_ratios=(4.6, 4.6), hspace=0.03)
    gaussian, worn = above.subplots(1, 2, sharey=True)
    for axes, key, title in (
        (gaussian, "mu", "(a) Friction on Gaussian surfaces, against exact contact"),
        (worn, "worn", "(b) Friction on worn surfaces"),
    ):
        known = [line for line in lines if getattr(line, key) is not None]
        points = [(line.name, line.seconds, getattr(line, key).rms) for line in known]
        models_sliding.panel(axes, points, title)
    gaussian.set_ylabel("Error of $\\mu_\\mathrm{H}$, rms [%]")
    lines = [line for line in lines if line.errors or line.mu is None]  # known in elastic contact
    below.suptitle(
        "(c) Area and energy, against boundary elements in elastic contact",
        x=0.05,
        ha="left",
        fontsize="medium",
    )
    cost, *panels = below.subplots(1, 3, sharey=True)
    for row, line in enumerate(lines):
        cost.plot(1e6 * line.seconds, row, "o", color=COLOURS[0])
        if line.once is not None:
            cost.plot(1e6 * line.once, row, "o", color=COLOURS[0], markerfacecolor="white")
        for axes, kind in zip(panels, QUANTITIES, strict=True):
            if kind in line.errors:
                axes.plot(line.errors[kind], [row, row], "-", color="0.75", zorder=1)
                axes.plot(line.errors[kind][0], row, "o", color=COLOURS[0])
                axes.plot(line.errors[kind][1], row, "o", color=COLOURS[1], markerfacecolor="white")
            elif not line.errors:
                axes.plot(TRUTH[kind], row, "D", color="0.4")
            else:
                axes.text(1, row, "none", ha="center", va="center", color="0.4", fontsize="small")
    titles = (
        "Cost of a velocity [$\\mu$s]",
        "Error of the area [%]",
        "Error of the elastic energy [%]",
    )
    for axes, title in zip((cost, *panels), titles, strict=True):
        axes.set_xscale("log")
        axes.set_xlabel(title)
        axes.grid(axis="y", color="0.9", linewidth=0.6)
        axes.set_axisbelow(True)
        axes.tick_params(which="both", direction="in", top=True, right=True)
    for axes in panels:
        axes.set_xlim(0.2, 400)
        axes.set_xticks([1, 10, 100], ["1", "10", "100"])
    cost.set_yticks(range(len(lines)), [line.name for line in lines])
    cost.invert_yaxis()
    marks: list[tuple[str, dict[str, Any]]] = [
        ("a velocity", {"color": COLOURS[0], "marker": "o"}),
        ("once: finding the peaks", {"color": COLOURS[0], "marker": "o", "markerfacecolor": "w"}),
        ("mean", {"color": COLOURS[0], "marker": "o"}),
        ("worst", {"color": COLOURS[1], "marker": "o", "markerfacecolor": "w"}),
        ("what the truth is known to", {"color": "0.4", "marker": "D"}),
    ]
    for axes, some in ((cost, marks[:2]), (panels[0], marks[2:4]), (panels[1], marks[4:])):
        handles = [axes.plot([], [], linestyle="", label=name, **style)[0] for name, style in some]
        axes.legend(
            handles=handles,
            loc="lower center",
            bbox_to_anchor=(0.5, 1.0),
            ncols=2,
            fontsize="small",
            frameon=False,
        )
    return picture(figure, path)


def plain(name: str) -> str:
    """A name without TeX."""
    for tex, text in (
        ("\\lambda_0", "lambda0"),
        ("256^2", "256 x 256"),
        ("512^2", "512 x 512"),
        ("$", ""),
    ):
        name = name.replace(tex, text)
    return name


def make() -> timing.Report:
    lines = measure()
    columns: dict[str, list[Any]] = {
        "model": [plain(line.name) for line in lines],
        "time_s": [line.seconds for line in lines],
        "once_s": ["" if line.once is None else line.once for line in lines],
    }
    for kind in QUANTITIES:
        for k, name in enumerate(("mean", "worst")):
            columns[f"{kind}_error_{name}_percent"] = [
                line.errors[kind][k] if kind in line.errors else "" for line in lines
            ]
    for key, known in (("mu", [x.mu for x in lines]), ("worn_mu", [x.worn for x in lines])):
        columns[f"{key}_error_rms_percent"] = ["" if mu is None else mu.rms for mu in known]
        columns[f"{key}_error_worst_percent"] = [
            "" if not mu or not mu.contacts else mu.worst for mu in known
        ]
        columns[f"{key}_contacts"] = [
            "" if not mu or not mu.contacts else mu.contacts for mu in known
        ]
    rows = [
        [str(cell) if isinstance(cell, str) else f"{cell:.3g}" for cell in row]
        for row in zip(*columns.values(), strict=True)
    ]
    files = {"models.csv": timing.table("benchmark models", columns)}
    files |= {f"models{end}": draw(lines, Path(f"models{end}")) for end in (".png", ".svg")}
    return timing.Report(f"Models:\n\n{timing.markdown(list(columns), rows)}", files)


if __name__ == "__main__":
    timing.run(make, __doc__)
