"""Friction over velocity, pressure or temperature: of results that Python has, and of scenes."""

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from asperity._core import FATAL_EXTRAPOLATION
from asperity.base.quantities import ZERO_CELSIUS, temperature_text
from asperity.draw.directions import DIRECTION, draw_directions
from asperity.draw.figure import (
    MOST_ENTRIES,
    PRESSURE,
    VELOCITY,
    legend,
    named,
    pressure_text,
    shaded,
    turned,
)
from asperity.draw.style import Axes, colours, grey

TEMPERATURE = "Temperature $T_0$"
_MOST_SHADED = 3  # curves whose model error can be told apart
_KINDS = {"total": "-", "hysteresis": "--", "adhesion": ":"}
_COLD = "-."  # mu without heat
_NAMES = {
    VELOCITY: "velocity",
    PRESSURE: "pressure",
    TEMPERATURE: "temperature",
    DIRECTION: "direction",
}
TOO_NARROW = ",\ntoo narrow to see"  # ends the entry of a band that cannot be seen
_WIDTH = 1.8  # points, of the line of mu
_HALO = 0.03  # of mu, to either side of a part that is guessed
_SAME = 0.01  # relative, of two curves that lie on one another
_FAR_APART = 30  # times; curves whose largest mu are so far apart share no linear axis
_PARTS = ("mu", "lateral", "hysteresis", "adhesion")
_COLUMNS = (*_PARTS, "extrapolated_share", "model_error", "error_estimate")


@dataclass(frozen=True, eq=False)
class Curve:
    """One curve of a picture, arrays along its abscissa; what is not known is NaN."""

    label: str
    shared: str  # what is said of all curves, where they differ in their directions alone
    pressure: float
    direction: float  # [degrees]
    x: NDArray[np.float64]
    mu: NDArray[np.float64]
    lateral: NDArray[np.float64]
    hysteresis: NDArray[np.float64]
    adhesion: NDArray[np.float64]
    extrapolated_share: NDArray[np.float64]  # of the hysteresis
    model_error: NDArray[np.float64]  # relative, of the hysteresis
    error_estimate: NDArray[np.float64]
    low: NDArray[np.float64]  # of a band on mu
    high: NDArray[np.float64]
    cold: NDArray[np.float64]  # mu without heat
    rise: NDArray[np.float64]  # of the temperature at q1 [K]


def abscissa_of(results: Sequence[Any], *, temperatures: bool) -> str:
    """What a picture is drawn over: the velocity, or what else varies where it does not, and the
    direction where that has more values. `temperatures` tells whether the results are those of
    several each."""
    directions = np.unique(np.concatenate([np.ravel(_direction(one)) for one in results]))
    fewer = max(2, *(np.unique(result.velocity).size for result in results))
    if np.isfinite(directions).sum() > fewer:
        return DIRECTION
    if any(np.ptp(result.velocity) > 0 for result in results):
        return VELOCITY
    if temperatures or all(np.ptp(_background(result)) > 0 for result in results):
        return TEMPERATURE
    return PRESSURE if all(np.ptp(result.pressure) > 0 for result in results) else VELOCITY


def is_polar(result: Any) -> bool:
    return abscissa_of([result], temperatures=False) == DIRECTION


def curves_of(
    results: Sequence[Any],
    names: Sequence[str],
    abscissa: str,
    temperatures: Sequence[float | None],
    *,
    celsius: bool,
) -> Iterator[Curve]:
    """The curves of results, of which those of one name are one sweep; `temperatures` are theirs
    where they do not know them themselves."""
    over = _NAMES[abscissa]
    for name in dict.fromkeys(names):
        each = zip(results, names, temperatures, strict=True)
        parts = [_columns(result, at) for result, one, at in each if one == name]
        flat = {key: np.concatenate([part[key] for part in parts]) for key in parts[0]}
        keys = [key for key in ("temperature", "pressure", "velocity", "direction") if key != over]
        points = np.stack([np.nan_to_num(flat[key]) for key in keys], axis=-1)
        varied = {key for key, entries in zip(keys, points.T, strict=True) if np.ptp(entries) > 0}
        told = [key for key in keys if key in ("pressure", "velocity") or key in varied]
        first = np.unique(points, axis=0, return_index=True)[1]
        alone = varied == {"direction"} and len(set(names)) == 1
        for start in sorted(first):
            at = np.flatnonzero((points == points[start]).all(axis=1))
            at = at[np.argsort(flat[over][at], kind="stable")]
            texts = {key: _text(key, float(flat[key][start]), celsius=celsius) for key in told}
            label = texts.pop("direction") if alone else ""
            x = flat[over][at] - (ZERO_CELSIUS if celsius and over == "temperature" else 0.0)
            rest = {key: flat[key][at] for key in (*_COLUMNS, "low", "high", "cold", "rise")}
            told_once = ", ".join(filter(None, (name, *texts.values())))
            pressure, direction = (float(flat[k][start]) for k in ("pressure", "direction"))
            label, shared = (label, told_once) if alone else (told_once, "")
            yield Curve(label, shared, pressure, direction, x, **rest)


def _text(key: str, value: float, *, celsius: bool) -> str:
    if key == "pressure":
        return pressure_text(value)
    if key == "temperature":
        return temperature_text(value, celsius=celsius)
    return f"{value:.4g}°" if key == "direction" else f"{value:.3g} m/s"


def _background(result: Any) -> NDArray[np.float64]:
    """The temperature around a result [K]; NaN where it has none."""
    given = getattr(result, "cold", None) or result
    temperature = getattr(given, "temperature", None)
    return np.asarray(np.nan if temperature is None else temperature, dtype=np.float64)


def _direction(result: Any) -> NDArray[np.float64]:
    """The direction of sliding of a result [degrees]; NaN where it has none."""
    return np.degrees(np.asarray(getattr(result, "direction", None), dtype=np.float64))


def _columns(result: Any, temperature: float | None) -> dict[str, NDArray[np.float64]]:
    """Everything that curves take from a result, flat."""
    unknown = np.full(np.shape(result.mu), np.nan)
    background = _background(result) if temperature is None else np.asarray(float(temperature))
    band = getattr(result, "band", None) or (unknown, unknown)
    columns = {"pressure": result.pressure, "velocity": result.velocity, "temperature": background}
    columns |= {"direction": _direction(result)}
    columns |= {name: getattr(result, name, unknown) for name in _COLUMNS}
    columns |= {"low": band[0], "high": band[1], "cold": unknown, "rise": unknown}
    if getattr(result, "cold", None) is not None:
        columns |= {"cold": result.cold.mu, "rise": result.temperature - background}
    return {key: np.broadcast_to(one, unknown.shape).ravel() for key, one in columns.items()}


def draw_friction(
    axes: Axes,
    curves: Sequence[Curve],
    abscissa: str,
    *,
    celsius: bool = False,
    band: str = "",
    model: str = "",
    bar: str = PRESSURE,
) -> Sequence[Any]:
    """Draw mu, its parts, its bands and mu without heat; return the colours of the curves.

    `band` and `model` say what the band and the model error are; where curves are many, a bar of
    pressures tells them, or of names where `bar` is empty.
    """
    tints: Sequence[Any] = colours(len(curves))
    many = len(curves) > MOST_ENTRIES
    shared = curves[0].shared if curves else ""
    if shared:
        axes.plot([], [], linestyle="", label=shared)
        degrees = np.array([curve.direction for curve in curves])
        tints = list(turned(axes, degrees, DIRECTION if many else ""))
    elif many and bar:
        tints = list(shaded(axes, np.array([curve.pressure for curve in curves]), bar))
    elif many:
        named(axes, [curve.label for curve in curves])
    kinds = dict(_KINDS)
    if not any(np.any(curve.adhesion > 0) for curve in curves):
        kinds = {"total": "-"}
    if abscissa == DIRECTION:
        draw_directions(axes, curves, tints, labelled=not many, band=band)
        return tints
    known = [c for c in curves if np.isfinite(c.model_error).any()]
    hatched = bool(model) and bool(known) and len(curves) <= _MOST_SHADED
    for curve, colour in zip(curves, tints, strict=True):
        _draw(axes, curve, colour, kinds, labelled=not many, hatched=hatched)
    _tell_heat(axes, curves, parts=len(kinds) > 1)
    if len(kinds) > 1:
        for kind, dashes in kinds.items():
            axes.plot([], [], dashes, color=grey(0.3), label=kind)
    label_abscissa(axes, abscissa, celsius=celsius)
    _scale(axes, curves)
    if band:
        shown = any(_shows(axes, c.low, c.high) for c in curves)
        _tell_band(axes, band, seen=shown, color=grey(0.3), alpha=0.2, linewidth=0)
    _mark_guesses(axes, curves)
    if hatched:
        _tell_errors(axes, curves, model)
    alone = len(kinds) == 1 and any(np.isfinite(curve.hysteresis).any() for curve in curves)
    axes.set_ylabel("Friction coefficient $\\mu$ [-]" + "\nof hysteresis alone" * alone)
    return tints


def label_abscissa(axes: Axes, abscissa: str, *, celsius: bool) -> None:
    if abscissa == TEMPERATURE:
        axes.set_xlabel(f"{abscissa} [{'°C' if celsius else 'K'}]")
    elif abscissa == DIRECTION:
        axes.set_xlabel(DIRECTION)
    else:
        axes.set(xscale="log", xlabel=abscissa)


def draw_result(axes: Axes, result: Any, *, band: str = "") -> None:
    abscissa = abscissa_of([result], temperatures=False)
    curves = list(curves_of([result], [""], abscissa, [None], celsius=False))
    model = "model error (rms),\nfrom exact contacts"
    draw_friction(axes, curves, abscissa, band=band, model=model)
    legend(axes)


def band_text(level: float) -> str:
    return f"{100 * level:.4g} % band of the\nmeasured inputs' errors"


def _draw(
    axes: Axes,
    curve: Curve,
    colour: Any,
    kinds: dict[str, str],
    *,
    labelled: bool,
    hatched: bool,
) -> None:
    if hatched:
        axes.fill_between(curve.x, *_around(curve), **_hatch(colour))
    axes.fill_between(curve.x, curve.low, curve.high, color=colour, alpha=0.2, linewidth=0)
    marker = "o" if curve.x.size == 1 else None
    lines = (curve.mu, curve.hysteresis, curve.adhesion)
    for y, (kind, dashes) in zip(lines, kinds.items(), strict=False):
        label = curve.label if kind == "total" and labelled else None
        width = _WIDTH if kind == "total" and labelled else 1.2
        axes.plot(curve.x, y, dashes, color=colour, linewidth=width, marker=marker, label=label)
    if np.isfinite(curve.cold).any():
        axes.plot(curve.x, curve.cold, linestyle=_COLD, color=colour, linewidth=1.2)


def _around(curve: Curve) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    off = curve.model_error * curve.hysteresis
    return np.maximum(curve.mu - off, 0), curve.mu + off


def _tell_heat(axes: Axes, curves: Sequence[Curve], *, parts: bool) -> None:
    """Entries of the legend for mu with and without heat."""
    heated = [curve for curve in curves if np.isfinite(curve.cold).any()]
    if not heated:
        return
    same = all(np.allclose(curve.cold, curve.mu, rtol=_SAME) for curve in heated)
    if not same:
        axes.plot([], [], linestyle=_COLD, color=grey(0.3), linewidth=1.2, label="without heat")
    if not parts:
        name = "with and without heat" if same else "with heat"
        axes.plot([], [], color=grey(0.3), linewidth=_WIDTH, label=name)


def _mark_guesses(axes: Axes, curves: Sequence[Curve]) -> None:
    """Grey around what no measured modulus carries, half of the way to points that one does."""
    label: str | None = "most of the hysteresis from\nan extrapolated modulus"
    for curve in curves:
        beyond = curve.extrapolated_share > FATAL_EXTRAPOLATION
        if not beyond.any():
            continue
        at = np.arange(curve.x.size)
        halves = np.arange(0, curve.x.size - 0.5, 0.5)
        x, mu = np.interp(halves, at, curve.x), np.interp(halves, at, curve.mu)
        guessed = np.interp(halves, at, beyond) > 0
        around = (1 - _HALO) * mu, (1 + _HALO) * mu
        look: dict[str, Any] = {"color": grey(0.4), "alpha": 0.45, "linewidth": 0, "zorder": 0.5}
        axes.fill_between(x, *around, where=guessed, label=label, **look)
        label = None  # one entry for all


def _scale(axes: Axes, curves: Sequence[Curve]) -> None:
    """From zero, or over decades where a linear axis would lay a whole curve on its foot."""
    mu = np.concatenate([y[np.isfinite(y)] for curve in curves for y in (curve.mu, curve.cold)])
    largest = [float(np.nanmax(curve.mu)) for curve in curves]
    if 0 < min(largest) < max(largest) / _FAR_APART:
        axes.set_yscale("log", nonpositive="clip")
        lowest = float(np.min(mu, where=mu > 0, initial=np.inf))
        axes.set_ylim(lowest / 1.5, float(np.max(mu)) * 1.5)
    else:
        axes.set_ylim(bottom=0)


def _shows(axes: Axes, low: NDArray[np.float64], high: NDArray[np.float64]) -> bool:
    """Whether a band is anywhere seen beside the line that runs through it."""
    x = np.zeros_like(low)
    ends = [axes.transData.transform(np.column_stack([x + 1, y]))[:, 1] for y in (low, high)]
    width = (ends[1] - ends[0]) * 72 / axes.figure.dpi
    return bool(np.max(width, where=np.isfinite(width), initial=0) > 2 * _WIDTH)


def _tell_band(axes: Axes, label: str, *, seen: bool, **look: Any) -> None:
    """An entry of the legend with a swatch, or words alone where the band cannot be seen."""
    if seen:
        axes.fill_between([], [], **look, label=label)
    else:
        axes.plot([], [], linestyle="", label=label + TOO_NARROW)


def _tell_errors(axes: Axes, curves: Sequence[Curve], model: str) -> None:
    """Entries of the legend for the error of the model and that of the numbers."""
    seen = any(_shows(axes, *_around(curve)) for curve in curves)
    _tell_band(axes, model, seen=seen, **_hatch(grey(0.3)))
    numerical = max(float(np.max(c.error_estimate / np.fmax(c.mu, 1e-300))) for c in curves)
    power = f"$10^{{{math.ceil(math.log10(max(numerical, 1e-16)))}}}$"
    axes.plot([], [], linestyle="", label=f"numerical error below {power},\ntoo small to see")


def _hatch(colour: Any) -> dict[str, Any]:
    look = {"facecolor": "none", "edgecolor": colour, "hatch": "//////"}
    return {**look, "alpha": 0.4, "linewidth": 0}
