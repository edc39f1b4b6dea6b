"""Pictures of how far each correction is from exact contact (matplotlib)."""

import math
from collections.abc import Sequence
from itertools import cycle
from pathlib import Path
from statistics import median
from typing import TYPE_CHECKING, Any

from asperity.draw.figure import COLUMN, new_figure, picture
from asperity.draw.style import colours as colours_for
from asperity.draw.style import grey, narrow, palette
from asperity_scripts.validate.contacts import Contact
from asperity_scripts.validate.predictions import (
    Prediction,
    Quantity,
    needed_shift,
    needed_shift_for_energy,
)

if TYPE_CHECKING:
    from matplotlib.axes import Axes

_LOAD = "$p^* = p / (E^* h')$ [-]"
_MARKS = ("o", "s", "^", "D", "v", "P")  # by Hurst exponent


def error_figure(
    predictions: Sequence[Sequence[Prediction]], quantity: Quantity, path: Path
) -> bytes:
    """Relative error over load, a panel a model, colours for q1/q0 and marks for H."""
    from matplotlib.figure import Figure

    predictions = _different(predictions, quantity)
    columns = 2 if narrow() else 4
    rows = -(-(len(predictions) + 1) // columns)
    size = (COLUMN, 1.4 * rows) if narrow() else (11.5, 2.7 * rows)
    figure = Figure(figsize=size, layout="constrained")
    panels = figure.subplots(rows, columns, sharex=True, sharey=True).ravel()
    contacts = [prediction.contact for prediction in predictions[0]]
    bands = sorted({contact.band for contact in contacts})
    exponents = sorted({contact.hurst for contact in contacts}, key=str)
    colours = colours_for(len(bands))
    for axes, group in zip(panels, predictions, strict=False):
        axes.axhline(0, color=grey(0.4), linewidth=0.8)
        for i, band in enumerate(bands):
            for hurst, mark in zip(exponents, cycle(_MARKS), strict=False):
                points = [p for p in group if (p.contact.band, p.contact.hurst) == (band, hurst)]
                load = [p.contact.load for p in points]
                error = [100 * p.error(quantity) for p in points]
                style = {"markersize": 3, "markeredgewidth": 0, "alpha": 0.8}
                axes.plot(load, error, mark, color=colours[i], **style)
        axes.set_title(shown(group[0].model.name), fontsize="medium")
        axes.tick_params(which="both", direction="in", top=True, right=True)
    for axes in panels[len(predictions) :]:
        axes.set_axis_off()
    for axes in panels[len(predictions) - columns : len(predictions)]:  # nothing below them
        axes.tick_params(labelbottom=True)
    legend = panels[len(predictions)]
    for i, band in enumerate(bands):
        legend.plot([], [], "s", color=colours[i], markersize=5, label=f"$q_1/q_0$ = {band:g}")
    for hurst, mark in zip(exponents, cycle(_MARKS), strict=False):
        if hurst is not None:
            legend.plot([], [], mark, color=grey(0.3), markersize=4, label=f"$H$ = {hurst:g}")
    together = {"handletextpad": 0.3, "columnspacing": 0.8} if narrow() else {}
    legend.legend(loc="center", fontsize="small", ncols=2, frameon=False, **together)
    panels[0].set_xscale("log")
    # linear up to what a theory without fitted numbers reaches, logarithmic beyond
    panels[0].set_yscale("symlog", linthresh=10, linscale=1.2, subs=range(2, 10))
    panels[0].set_yticks([-100, -10, 0, 10, 100], ["-100", "-10", "0", "10", "100"])
    largest = max(abs(p.error(quantity)) for group in predictions for p in group)
    panels[0].set_ylim(-120, max(120, 130 * largest))
    figure.supxlabel(_LOAD, fontsize="medium")
    name = "contact area" if quantity == "area" else "elastic energy"
    figure.supylabel(
        f"Error of the {name} against boundary elements [%], linear to 10", fontsize="medium"
    )
    return picture(figure, path)


def _different(
    predictions: Sequence[Sequence[Prediction]], quantity: Quantity
) -> list[Sequence[Prediction]]:
    """Without the models that say of this quantity what one before them says."""
    kept: dict[tuple[float, ...], Sequence[Prediction]] = {}
    for group in predictions:
        kept.setdefault(tuple(prediction.error(quantity) for prediction in group), group)
    return list(kept.values())


def shown(model: str) -> str:
    return model.replace("lambda0", "$\\lambda_0$")


def shift_figure(
    contacts: Sequence[Contact], predictions: Sequence[Sequence[Prediction]], path: Path
) -> bytes:
    """Which p_T the exact areas and energies ask for and which the article's methods give; beside
    it what the friction integrand makes of the energy."""
    figure, (left, right) = new_figure(2)
    figure.set_size_inches(*((COLUMN, 6.8) if narrow() else (12.5, 4.0)))
    by_name = {group[0].model.name: group for group in predictions}

    def draw(axes: "Axes", label: str, values: Sequence[float], colour: str, dashes: str) -> None:
        load, low, middle, high = _ranges(contacts, values)
        axes.plot(load, middle, dashes, color=colour, label=label)
        axes.fill_between(load, low, high, color=colour, alpha=0.2, linewidth=0)

    draw(left, "asked for by the area", [needed_shift(c) for c in contacts], palette()[0], "-")
    energetic = [needed_shift_for_energy(c) for c in contacts]
    draw(left, "asked for by the energy", energetic, palette()[1], "-")
    for label, name, colour in (
        ("IGW, implicit", "IGW implicit", palette()[2]),
        ("IGW, added", "IGW added", palette()[4]),
        ("peaks, $\\lambda_0$", "peaks, lambda0", palette()[3]),
        ("peaks, $\\lambda_0/2$", "peaks, lambda0/2", palette()[5]),
    ):
        if name in by_name:
            draw(left, label, [p.shift for p in by_name[name]], colour, "--")
    left.set_ylim(0.9, 5)
    left.set_ylabel("Shift factor $p_T$ [-]")
    left.set_title("(a) shift factors", fontsize="medium")
    right.axhline(1, color=grey(0.4), linewidth=0.8)
    for label, name, colour, dashes in (
        ("no correction", "none", grey(0.4), "-"),
        ("$S$, $\\gamma$ = 0.40", "S in Eq. 22, 0.40", palette()[0], "-"),
        ("$p_T$ = 2", "shift 2", palette()[6], "--"),
        ("IGW, implicit", "IGW implicit", palette()[2], "--"),
        ("IGW, added", "IGW added", palette()[4], "--"),
    ):
        if name in by_name:
            draw(right, label, [1 + p.energy_error for p in by_name[name]], colour, dashes)
    right.set_ylim(0, 3)
    right.set_ylabel("Elastic energy / exact [-]")
    right.set_title("(b) what the friction integrand weighs", fontsize="medium")
    for axes in (left, right):
        axes.set_xscale("log")
        axes.set_xlabel(_LOAD)
        where: dict[str, Any] = {"loc": "center left", "bbox_to_anchor": (1.02, 0.5)}
        if narrow():
            where = {"loc": "upper center", "bbox_to_anchor": (0.5, -0.2), "ncols": 2}
        axes.legend(fontsize="small", frameon=False, **where)
    return picture(figure, path)


def _ranges(
    contacts: Sequence[Contact], values: Sequence[float]
) -> tuple[list[float], list[float], list[float], list[float]]:
    """Loads, and lowest, median and highest of the known values at each."""
    groups: dict[float, list[float]] = {}
    for contact, value in zip(contacts, values, strict=True):
        if math.isfinite(value):
            groups.setdefault(float(f"{contact.load:.3g}"), []).append(value)
    loads = sorted(groups)
    lists = [groups[load] for load in loads]
    return loads, [min(g) for g in lists], [median(g) for g in lists], [max(g) for g in lists]
