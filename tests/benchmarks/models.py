"""The models of contact that there are to choose from: what a point costs and how wrong it is.

    python tests/benchmarks/models.py [--output DIR]

Errors are those against the 177 boundary-element contacts of `asperity validate`, of the area and
of the elastic energy, which the friction integrand weighs. The cost of a theory is one call of
`friction` from Python, on Table 1's surface and 20 Prony terms, at the default rtol; of the
estimate on a single scale, A/A0 = min(1, sqrt(8 / pi) sigma0 / (E* h')) with the rms slope h' and
E* at q1, the arithmetic in Python; of boundary elements one load, p / (E* h') = 0.1, on 256 x 256
points (q1/q0 = 8, elastic). One thread. pip install asperity[bem].
"""

import math
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import Any

import timing
from curves import Curve, curves

import asperity
from asperity.correction import Correction
from asperity.plot.curves import picture
from asperity.plot.style import COLOURS
from asperity.validation.boundary_elements import contact
from asperity.validation.contacts import Contact, shipped
from asperity.validation.predictions import MODELS, Model, predict

VELOCITY = 1e-2
SHOWN = {  # models of asperity.validation by the name that the chart gives them
    "none": "Persson, exact",
    "S in Eq. 22, 0.40": "S on the integrand, 0.40",
    "S in G, 5/9": "S inside G, 5/9",
    "Nayak S": "S by bandwidth (Nayak)",
    "peaks, lambda0": "$p_T$ from peaks, $\\lambda_0$",
    "peaks, lambda0/2": "$p_T$ from peaks, $\\lambda_0/2$",
    "IGW implicit": "$p_T$ from IGW, implicit",
    "IGW added": "$p_T$ from IGW, added",
}
EQ_7 = Model("Persson, Eq. 7", "", lambda _: None, form="interpolated")
QUANTITIES = ("area", "energy")
TRUTH = {"area": 0.5, "energy": 0.3}  # %, what the shipped rows are known to


@dataclass(frozen=True)
class Line:
    """Cost of a point, and of what is done once before; errors in %, mean and worst."""

    name: str
    seconds: float
    errors: dict[str, tuple[float, float]]
    once: float | None = None


def single_scale(road: Any, modulus: float, pressure: float) -> float:
    """A/A0 of light contact on the rms slope, which holds while it is small."""
    return min(1.0, math.sqrt(8 / math.pi) * pressure / (modulus * road.rms_slope))


def estimate(curve: Curve) -> float:
    """The same from a rubber."""
    modulus = abs(curve.rubber.modulus(VELOCITY * curve.road.q1)) / (1 - 0.5**2)
    return single_scale(curve.road, modulus, curve.inputs["pressure"])


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


def theory(curve: Curve, model: Model, name: str, contacts: list[Contact]) -> Line:
    correction: Correction | None = model.correction(typical_contact(curve))
    call = partial(
        asperity.friction,
        curve.road,
        curve.rubber,
        pressure=curve.inputs["pressure"],
        velocity=VELOCITY,
        correction=correction,
        form=model.form,
    )
    found = [predict(each, model) for each in contacts]
    errors = {kind: statistics([p.error(kind) for p in found]) for kind in QUANTITIES}
    return Line(name, timing.typical(call, 15), errors)


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
    lines = [
        Line(
            "single scale at $q_1$",
            timing.typical(partial(estimate, curve), 15),
            {"area": statistics(scales)},
        ),
        theory(curve, EQ_7, EQ_7.name, contacts),
    ]
    known = {model.name: model for model in MODELS}
    lines += [theory(curve, known[key], name, contacts) for key, name in SHOWN.items()]
    pressing, peaks = boundary_elements()
    lines = [
        Line(line.name, line.seconds, line.errors, peaks if "peaks" in line.name else None)
        for line in lines
    ]
    lines.append(Line("boundary elements, $256^2$", pressing, {}))
    return sorted(lines, key=lambda line: line.seconds)


def draw(lines: list[Line], path: Path) -> bytes:
    from matplotlib.figure import Figure

    figure = Figure(figsize=(11.5, 4.4), layout="constrained")
    cost, *panels = figure.subplots(1, 3, sharey=True)
    for row, line in enumerate(lines):
        cost.plot(line.seconds, row, "o", color=COLOURS[0])
        if line.once is not None:
            cost.plot(line.once, row, "o", color=COLOURS[0], markerfacecolor="white")
        for axes, kind in zip(panels, QUANTITIES, strict=True):
            if kind in line.errors:
                axes.plot(line.errors[kind], [row, row], "-", color="0.75", zorder=1)
                axes.plot(line.errors[kind][0], row, "o", color=COLOURS[0])
                axes.plot(line.errors[kind][1], row, "o", color=COLOURS[1], markerfacecolor="white")
            elif not line.errors:
                axes.plot(TRUTH[kind], row, "D", color="0.4")
            else:
                axes.text(1, row, "none", ha="center", va="center", color="0.4", fontsize="small")
    titles = ("Cost of a point [s]", "Error of the area [%]", "Error of the elastic energy [%]")
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
        ("a point", {"color": COLOURS[0], "marker": "o"}),
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
    for tex, text in (("\\lambda_0", "lambda0"), ("256^2", "256 x 256"), ("$", "")):
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
    rows = [
        [str(cell) if isinstance(cell, str) else f"{cell:.3g}" for cell in row]
        for row in zip(*columns.values(), strict=True)
    ]
    files = {"models.csv": timing.table("benchmark models", columns)}
    files |= {f"models{end}": draw(lines, Path(f"models{end}")) for end in (".png", ".svg")}
    return timing.Report(f"Models:\n\n{timing.markdown(list(columns), rows)}", files)


if __name__ == "__main__":
    timing.run(make, __doc__)
