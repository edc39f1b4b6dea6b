"""Friction over the direction of sliding: polar axes, or plain ones where those are given."""

from collections.abc import Sequence
from typing import Any

import numpy as np

from asperity.draw.style import Axes, grey

DIRECTION = "Direction of sliding, from $x$ towards $y$ [°]"
_ACROSS = "across, of either sign"
_FEW = 37  # directions, which are marked: each may be a contact that took its time
_TICKS = 45  # degrees between the angles that are named


def draw_directions(
    axes: Axes, curves: Sequence[Any], colours: Sequence[Any], *, labelled: bool, band: str = ""
) -> None:
    """Draw mu of curves over degrees, with its band, and the force across it: in polar axes its
    size. `band` says what the band is."""
    from matplotlib.ticker import MultipleLocator

    polar = axes.name == "polar"
    for curve, colour in zip(curves, colours, strict=True):
        angle = np.radians(curve.x) if polar else curve.x
        label = curve.label if labelled else None
        look = {"color": colour, "marker": "o", "markersize": 4} if curve.x.size <= _FEW else {}
        axes.plot(angle, curve.mu, label=label, **{"color": colour, "linewidth": 1.8, **look})
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
        _place_ticks(axes, curves)
        return
    axes.axhline(0, color=grey(0.6), linewidth=0.8, zorder=0.5)
    axes.xaxis.set_major_locator(MultipleLocator(_TICKS))
    axes.set(xlabel=DIRECTION, ylabel="Force over load [-]")


def _place_ticks(axes: Any, curves: Sequence[Any]) -> None:
    """Have the names of radii, which lie beyond them, where they are furthest from curves."""
    lines = [(curve.x, y) for curve in curves for y in (curve.mu, np.abs(curve.lateral))]
    beside = 0.04 * axes.get_rmax()

    def nearest(angle: float) -> float:
        away = [np.abs((x - angle + 180) % 360 - 180).min() for x, _ in lines]
        drawn = [line for line, degrees in zip(lines, away, strict=True) if degrees < _TICKS]
        at = [np.interp(angle, x, y, period=360) for x, y in drawn]
        gaps = np.subtract.outer(axes.get_yticks()[1:] + beside, at)
        return float(np.min(np.abs(gaps), initial=np.inf))

    free = [_TICKS * k + between for k in range(8) for between in (15.0, 22.5, 30.0)]
    axes.set_rlabel_position(max(free, key=nearest))


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
