"""Charts of the page, as options of ECharts: numbers and words, no page."""

import math
from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from asperity.app.state import Variant
from asperity.draw.style import COLOURS
from asperity.scene.model import Scene, SceneFriction

Options = dict[str, Any]
Array = NDArray[np.float64]
_GREY = "#767676"


def friction_chart(
    scene: Scene, curves: SceneFriction, cold: SceneFriction | None, variants: Sequence[Variant]
) -> Options:
    """mu over velocity: this scene with its parts, its band and itself without heat; variants."""
    v = scene.velocity
    series: list[Options] = []
    if curves.band is not None:
        low, high = (bound[0] for bound in curves.band)
        hidden = {"lineStyle": {"opacity": 0}, "stack": "band", "silent": True, "tooltip": _NO_TIP}
        series.append(_line("band", v, low, COLOURS[0]) | hidden)
        filled = {"areaStyle": {"color": COLOURS[0], "opacity": 0.2}}
        series.append(_line("band of the inputs", v, high - low, COLOURS[0]) | hidden | filled)
    series.append(_line("mu", v, curves.mu[0], COLOURS[0], width=3))
    series.append(_line("hysteresis", v, curves.hysteresis[0], COLOURS[0], kind="dashed"))
    if scene.adhesion is not None:
        series.append(_line("adhesion", v, curves.adhesion[0], COLOURS[0], kind="dotted"))
    if np.any(curves.lateral):
        across = _line("across, of either sign", v, np.abs(curves.lateral[0]), COLOURS[1])
        series.append(across)
    if cold is not None and scene.heating is not None:
        series.append(_line("without heat", v, cold.mu[0], _GREY, kind="dashed"))
    for variant, colour in zip(variants, (*COLOURS[1:], _GREY), strict=False):
        series.append(_line(variant.name, variant.scene.velocity, variant.curves.mu[0], colour))
    return _chart(series, "sliding velocity [m/s]", "friction coefficient")


def contributions_chart(q: Array, density: Array) -> Options:
    """dmu / d ln q over the wavenumber: which roughness makes friction."""
    series = [_line("dmu / d ln q", q, density, COLOURS[2], width=2)]
    return _chart(series, "wavenumber q [1/m]", "dmu / d ln q")


_NO_TIP = {"show": False}
_POWERS = {
    ":formatter": "v => Math.abs(Math.log10(v)) < 2.5 ? String(v) : v.toExponential(0)",
    "hideOverlap": True,
}


def _line(
    name: str, x: Array, y: Array, colour: str, *, kind: str = "solid", width: float = 1.5
) -> Options:
    order = np.argsort(x)
    return {
        "type": "line",
        "name": name,
        "showSymbol": x.size == 1,
        "symbol": "circle",
        "lineStyle": {"color": colour, "type": kind, "width": width},
        "itemStyle": {"color": colour},
        "data": _points(x[order], y[order]),
    }


def _points(x: Array, y: Array) -> list[list[float]]:
    """Pairs of as many digits as a screen can show; what is no number is left out."""
    pairs = np.column_stack([x, y])
    pairs = pairs[np.isfinite(pairs).all(axis=1)]
    return [[float(f"{a:.6g}"), float(f"{b:.6g}")] for a, b in pairs.tolist()]


def _decades(series: list[Options]) -> Options:
    """The powers of ten around all points, where these are positive."""
    x = [point[0] for one in series for point in one["data"]]
    if not x or min(x) <= 0:
        return {}
    low, high = math.floor(math.log10(min(x)) + 0.01), math.ceil(math.log10(max(x)) - 0.01)
    return {"min": 10.0**low, "max": 10.0 ** max(high, low + 1)}


def _chart(series: list[Options], x_name: str, y_name: str) -> Options:
    names = [one["name"] for one in series if one["name"] != "band"]
    axis = {"nameLocation": "middle", "nameTextStyle": {"fontSize": 13, "color": "#333"}}
    return {
        "animation": False,
        "aria": {"enabled": False},  # its element has a name of its own
        "grid": {"left": 62, "right": 16, "top": 16 + 20 * -(-len(names) // 3), "bottom": 44},
        "legend": {"top": 0, "data": names, "type": "plain", "itemWidth": 18},
        "tooltip": {"trigger": "axis"},
        "xAxis": {"type": "log", "name": x_name, "nameGap": 28, **axis, "axisLabel": _POWERS}
        | _decades(series),
        "yAxis": {"type": "value", "name": y_name, "nameGap": 46, **axis},
        "series": series,
    }
