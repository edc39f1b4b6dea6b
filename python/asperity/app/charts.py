"""Charts of the page, as options of ECharts: numbers and words, no page."""

import math
from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from asperity.app.state import Variant
from asperity.base.quantities import ZERO_CELSIUS
from asperity.draw.style import COLOURS
from asperity.prony_fit import PronyFit
from asperity.rubber import MasterCurve
from asperity.scene.model import Scene, SceneFriction
from asperity.scene.scan import surface_spectrum
from asperity.spectrum import TabulatedSpectrum

Options = dict[str, Any]
Array = NDArray[np.float64]
_GREY = "#767676"
_MOST_POINTS = 600  # of a scatter: more are not told apart


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
    return _chart(series, "sliding velocity [m/s]", "friction coefficient", y="value")


def contributions_chart(q: Array, density: Array) -> Options:
    """dmu / d ln q over the wavenumber: which roughness makes friction."""
    series = [_line("dmu / d ln q", q, density, COLOURS[2], width=2)]
    return _chart(series, "wavenumber q [1/m]", "dmu / d ln q", y="value")


def spectrum_chart(scene: Scene) -> Options:
    """C(q) as measured with its flags, the fit or the law, and the band that is used."""
    surface, spectrum = scene.surface, scene.spectrum
    series: list[Options] = []
    if surface.scan is not None:
        values = surface.values
        detrend = None if values["detrend"] == "none" else values["detrend"]
        measured = surface_spectrum(surface.scan, window=values["window"], detrend=detrend)
        measured = measured.truncated(q1=measured.q1)
        series += _scatter(measured)
    if surface.scan is None or surface.fit is not None:
        q = np.geomspace(spectrum.q0, spectrum.q1, 100)
        name = "law" if surface.fit is None else f"fit, H = {surface.fit.hurst:.3f}"
        series.append(_line(name, q, np.asarray(spectrum.at(q)), COLOURS[1], width=2))
    band = {
        "silent": True,
        "itemStyle": {"color": _GREY, "opacity": 0.12},
        "data": [[{"xAxis": float(spectrum.q0)}, {"xAxis": float(spectrum.q1)}]],
    }
    series[0]["markArea"] = band
    return _chart(series, "wavenumber q [1/m]", "C(q) [m^4]", y="log")


def _scatter(measured: TabulatedSpectrum) -> list[Options]:
    shown = measured.density > 0
    groups = (
        ("measured", measured.reliable & shown, COLOURS[0]),
        ("flagged: do not trust", ~measured.reliable & shown, _GREY),
    )
    return [
        {
            "type": "scatter",
            "name": name,
            "symbolSize": 4,
            "itemStyle": {"color": colour},
            "data": _points(*_thin(measured.wavenumber[rows], measured.density[rows])),
        }
        for name, rows, colour in groups
        if rows.any()
    ]


def rubber_chart(scene: Scene) -> Options:
    """Storage and loss modulus as they are computed with, and the points of the master curve."""
    built = scene.built_rubber
    columns = {"E' storage": COLOURS[0], "E'' loss": COLOURS[1]}
    w, *moduli = _moduli(scene)
    series = [
        _line(name, w, values, colour, width=2)
        for (name, colour), values in zip(columns.items(), moduli, strict=True)
    ]
    if built.build is not None and built.temperature is not None:
        points = built.build.points
        a_t = float(built.build.shift_factor(built.temperature))
        for (name, colour), values in zip(
            columns.items(), (points.storage_modulus, points.loss_modulus), strict=True
        ):
            data = _points(*_thin(points.angular_frequency / a_t, values))
            mark = {"itemStyle": {"color": colour}, "symbolSize": 4}
            series.append(
                {"type": "scatter", "name": f"{name.split()[0]} points", "data": data} | mark
            )
    return _chart(series, "angular frequency [rad/s]", "modulus [Pa]", y="log")


def _moduli(scene: Scene) -> tuple[Array, Array, Array]:
    """w, E' and E'' over all that the rubber knows."""
    rubber = scene.rubber
    if isinstance(rubber, MasterCurve):
        return rubber.angular_frequency, rubber.storage_modulus, rubber.loss_modulus
    if isinstance(rubber, PronyFit):
        low, high = rubber.lowest_frequency, rubber.highest_frequency
    else:
        low, high = 0.1 / rubber.relaxation_times.max(), 10 / rubber.relaxation_times.min()
    w = np.geomspace(low, high, 160)
    modulus = rubber.modulus(w)
    return w, modulus.real, modulus.imag


def shifts_chart(scene: Scene) -> Options | None:
    """log10 a_T over temperature, of sweeps; None for a rubber without them."""
    build = scene.built_rubber.build
    if build is None:
        return None
    celsius = build.temperature - ZERO_CELSIUS
    points = {"symbolSize": 7, "itemStyle": {"color": COLOURS[0]}}
    data = _points(celsius, build.log10_a_T)
    series: list[Options] = [{"type": "scatter", "name": "measured", "data": data} | points]
    chart = _chart(series, "temperature [C]", "log10 a_T", y="value")
    chart["xAxis"] = {
        **{key: one for key, one in chart["xAxis"].items() if key not in ("min", "max")},
        **{"type": "value", "scale": True, "axisLabel": {}},
    }
    return chart


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


def _thin(x: Array, y: Array) -> tuple[Array, Array]:
    step = max(1, -(-x.size // _MOST_POINTS))
    if step == 1:
        return x, y
    kept = np.unique(np.geomspace(1, x.size, _MOST_POINTS).round().astype(int)) - 1
    return x[kept], y[kept]


def _decades(series: list[Options]) -> Options:
    """The powers of ten around all points, where these are positive."""
    x = [point[0] for one in series for point in one["data"]]
    if not x or min(x) <= 0:
        return {}
    low, high = math.floor(math.log10(min(x)) + 0.01), math.ceil(math.log10(max(x)) - 0.01)
    return {"min": 10.0**low, "max": 10.0 ** max(high, low + 1)}


def _chart(series: list[Options], x_name: str, y_name: str, *, y: str) -> Options:
    names = [one["name"] for one in series if one["name"] != "band"]
    powers = {"axisLabel": _POWERS} if y == "log" else {}
    axis = {"nameLocation": "middle", "nameTextStyle": {"fontSize": 13, "color": "#333"}}
    return {
        "animation": False,
        "aria": {"enabled": False},  # its element has a name of its own
        "grid": {"left": 62, "right": 16, "top": 16 + 20 * -(-len(names) // 3), "bottom": 44},
        "legend": {"top": 0, "data": names, "type": "plain", "itemWidth": 18},
        "tooltip": {"trigger": "axis" if y == "value" else "item"},
        "xAxis": {"type": "log", "name": x_name, "nameGap": 28, **axis, "axisLabel": _POWERS}
        | _decades(series),
        "yAxis": {"type": y, "name": y_name, "nameGap": 46, **axis} | powers,
        "series": series,
    }
