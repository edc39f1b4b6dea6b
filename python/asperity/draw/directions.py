"""Friction over the direction of sliding: polar axes, or plain ones where those are given."""

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from asperity.draw.style import grey

if TYPE_CHECKING:
    from matplotlib.axes import Axes

DIRECTION = "Direction of sliding, from $x$ towards $y$ [°]"
_ACROSS = "across, of either sign"
_TICKS = 45  # degrees between the angles that are named


def draw_directions(
    axes: "Axes", curves: Sequence[Any], colours: Sequence[Any], *, labelled: bool, band: str = ""
) -> None:
    """Draw mu of curves over degrees, with its band, and the force across it: in polar axes its
    size. `band` says what the band is."""
    from matplotlib.ticker import MultipleLocator

    polar = axes.name == "polar"
    for curve, colour in zip(curves, colours, strict=True):
        angle = np.radians(curve.x) if polar else curve.x
        label = curve.label if labelled else None
        marker = "o" if curve.x.size == 1 else None
        axes.plot(angle, curve.mu, color=colour, linewidth=1.8, marker=marker, label=label)
        across = np.abs(curve.lateral) if polar else curve.lateral
        axes.plot(angle, across, "--", color=colour, linewidth=1.2)
        if np.isfinite(curve.low).any():
            axes.fill_between(angle, curve.low, curve.high, color=colour, alpha=0.2, linewidth=0)
    axes.plot([], [], color=grey(0.3), linewidth=1.8, label="along the sliding, $\\mu$")
    if any(np.isfinite(curve.lateral).any() for curve in curves):
        kind = "across" if not polar else _ACROSS
        axes.plot([], [], "--", color=grey(0.3), linewidth=1.2, label=kind)
    if band and any(np.isfinite(curve.low).any() for curve in curves):
        axes.fill_between([], [], color=grey(0.3), alpha=0.2, linewidth=0, label=band)
    if polar:
        look_polar(axes)
        return
    axes.axhline(0, color=grey(0.6), linewidth=0.8, zorder=0.5)
    axes.xaxis.set_major_locator(MultipleLocator(_TICKS))
    axes.set_xlabel(DIRECTION)
    axes.set_ylabel("Force over load [-]")


def look_polar(axes: Any) -> None:
    """Angles as on pictures of maps, whose y points down, with the names of the axes at them."""
    from matplotlib.ticker import MaxNLocator

    axes.set_theta_direction(-1)
    degrees = range(0, 360, _TICKS)
    names = {0: "$x$", 90: "$y$"}
    axes.set_thetagrids(degrees, [names.get(one, f"{one}°") for one in degrees])
    axes.set_rlabel_position(22.5)
    axes.tick_params(axis="y", labelsize="small")
    axes.yaxis.set_major_locator(MaxNLocator(4))
    axes.set_rmin(0)
