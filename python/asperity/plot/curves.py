"""Contact area over magnification, and the distribution of the pressure (matplotlib)."""

from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from asperity.draw.figure import (
    MOST_ENTRIES,
    PRESSURE,
    VELOCITY,
    legend,
    new_figure,
    picture,
    pressure_text,
    shaded,
)
from asperity.draw.style import Axes, grey, palette
from asperity.scene.model import Scene

_DASHES = ("-", "--", ":", "-.")
_MOST_CURVES = 9  # of many, so that each can be followed


def area_figure(
    scene: Scene, wavenumber: NDArray[np.float64], area: NDArray[np.float64], path: Path
) -> bytes:
    """A/A0 over magnification, colours for the velocities and line styles for the pressures, or the
    other way where there are more pressures; beside it the distribution of the pressure at three
    magnifications, as in the article's Fig. 1. Of many curves some are drawn, the ends among
    them."""
    figure, (axes, right) = new_figure(2)
    sweeps = [
        (scene.velocity, VELOCITY, "{:.3g} m/s".format),
        (scene.pressure, PRESSURE, pressure_text),
    ]
    if scene.pressure.size > scene.velocity.size:
        sweeps.reverse()
        area = area.swapaxes(0, 1)
    (coloured, title, colour_name), (dashed, _, dash_name) = sweeps
    rows = _some(coloured.size, _MOST_CURVES)
    dashes = _some(dashed.size, len(_DASHES))
    entries = rows.size + (dashes.size if dashed.size > 1 else 0)
    many = rows.size > len(palette()) or entries > MOST_ENTRIES
    tints = shaded(axes, coloured, title)[rows] if many else palette()
    for dash, place in zip(_DASHES, dashes, strict=False):
        for row, colour in zip(rows, tints, strict=False):
            label = None if many or place else colour_name(float(coloured[row]))
            x = wavenumber / wavenumber[0]
            axes.plot(x, area[place, row], dash, color=colour, linewidth=1.2, label=label)
    if dashed.size > 1:
        for value, dash in zip(dashed[dashes], _DASHES, strict=False):
            axes.plot([], [], dash, color=grey(0.3), label=dash_name(float(value)))
    axes.set(xscale="log", yscale="log", xlabel="Magnification $q / q_0$ [-]")
    axes.set_ylabel("Relative contact area $A / A_0$ [-]")
    _draw_distributions(right, scene, float(area[0, 0, -1]))
    some = [
        f"{drawn.size} of {sweep.size} {what}"
        for drawn, sweep, what in ((rows, coloured, "colours"), (dashes, dashed, "line styles"))
        if drawn.size < sweep.size
    ]
    axes.set_title(", ".join(some), fontsize="medium")
    legend(axes)
    return picture(figure, path)


def _some(count: int, most: int) -> NDArray[np.int_]:
    """At most so many of the entries of a sweep."""
    return np.unique(np.linspace(0, count - 1, most).round().astype(int))


def _draw_distributions(axes: Axes, scene: Scene, smallest_area: float) -> None:
    """P(sigma) at magnifications that are a third, two thirds and all of the way in ln q."""
    q0, q1 = scene.spectrum.q0, scene.spectrum.q1
    nominal = float(scene.pressure[0])
    highest = 10 / max(smallest_area, 1e-12)  # mean pressure is 1 / area
    stress = np.geomspace(1e-2, highest, 900) * nominal
    for share, colour in zip((1 / 3, 2 / 3, 1.0), palette(), strict=False):
        q = q0 * (q1 / q0) ** share if share < 1 else q1
        density = scene.pressure_distribution(stress, q) * stress
        axes.plot(stress / nominal, density, color=colour, label=f"$q/q_0$ = {q / q0:.3g}")
    axes.axvline(1, color=grey(0.4), linestyle="--", linewidth=1, label="$q/q_0$ = 1")
    axes.set_xscale("log")
    axes.set_ylim(bottom=0)
    axes.ticklabel_format(axis="y", style="sci", scilimits=(-3, 4), useMathText=True)
    axes.set_xlabel("Local pressure $\\sigma / \\sigma_0$ [-]")
    # per ln(sigma), so that the area under a curve is the share in contact
    axes.set_ylabel("Pressure distribution $\\sigma\\, P(\\sigma)$ [-]")
    title = f"{pressure_text(nominal)}, {float(scene.velocity[0]):.3g} m/s"
    if scene.options["form"] != "exact":
        title += ", exact form"  # the other has no distribution
    axes.set_title(title, fontsize="medium")
    legend(axes)
