"""A friction map as a picture: mu over velocity and pressure, and how far it is off."""

from collections.abc import Callable
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from asperity.draw.figure import PRESSURE, VELOCITY, new_figure, picture
from asperity.draw.style import narrow, shades
from asperity.friction_map.look_up import FrictionMap

_VELOCITIES, _PRESSURES = 241, 161
_COARSER, _COARSER_HOT = 2, 5  # the grid of errors
_Errors = Callable[[NDArray[np.float64], NDArray[np.float64]], NDArray[np.float64]]


def map_figure(made: FrictionMap, errors: _Errors, path: Path) -> bytes:
    """mu with its level lines on the left, of several temperatures at the lowest; on the right its
    relative error, which `errors` gives at pressures and velocities, in colours that end at the
    error it was certified for."""
    from matplotlib.colors import LogNorm
    from matplotlib.ticker import MaxNLocator

    # between the lattices that cells are made on
    pressure = _inside(made.pressure, _PRESSURES)[:, None]
    velocity = _inside(made.velocity, _VELOCITIES)[None, :]
    figure, (left, right) = new_figure(2)
    for axes in (left, right):  # before the levels are labelled, which need to know the scales
        axes.set(xscale="log", yscale="log", xlabel=VELOCITY, ylabel=PRESSURE)
        axes.set(xlim=made.velocity, ylim=made.pressure)
    lowest = None if made.temperature is None else made.temperature[0]
    mu = made.mu(pressure, velocity, temperature=lowest)
    ticks = MaxNLocator(8).tick_values(float(mu.min()), float(mu.max()))
    filled = left.contourf(velocity[0], pressure[:, 0], mu, 200, cmap=shades())
    filled.set_edgecolor("face")  # no hairlines between the fills of a vector picture
    label = "Friction coefficient $\\mu$ [-]"
    told = figure.colorbar(filled, ax=left, label=label, ticks=ticks, format="%.3g")
    # light lines where the fill is dark, and the other way
    middle = (float(mu.min()) + float(mu.max())) / 2
    inks = ["white" if level < middle else "black" for level in ticks]
    if made.temperature is not None:
        left.set_title(f"hot, background {lowest:.6g} K", fontsize="small")
    lines = left.contour(velocity[0], pressure[:, 0], mu, ticks, colors=inks, linewidths=0.7)
    told.add_lines(lines)
    # a point of the solver takes a thousand times as long, and with heat a hundred times that
    step = _COARSER if made.temperature is None else _COARSER_HOT
    pressure, velocity = pressure[::step], velocity[:, ::step]
    shape = pressure.size, velocity.size
    off = np.broadcast_to(errors(pressure, velocity), shape)
    worst = max(made.max_error, 1e-15)
    norm = LogNorm(worst * 1e-4, worst)
    drawn = right.pcolormesh(
        velocity[0], pressure[:, 0], np.maximum(off, worst * 1e-4), norm=norm, cmap=shades()
    )
    drawn.set_rasterized(True)
    figure.colorbar(drawn, ax=right, label="Relative error of $\\mu$ [-]", extend="both")
    beyond = f"{made.exceeded} of {made.checked:,} random points beyond"
    gap = "\n" if narrow() else " "
    right.set_title(f"{made.cells} cells, certified: {worst:.2g};{gap}{beyond}", fontsize="small")
    return picture(figure, path)


def _inside(sides: tuple[float, float], count: int) -> NDArray[np.float64]:
    shares = (np.arange(count) + 0.5) / count
    return np.asarray(sides[0] * (sides[1] / sides[0]) ** shares)
