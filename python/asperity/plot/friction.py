"""Friction over velocity, pressure or temperature; beside it what heat makes of it."""

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from asperity._core import FATAL_EXTRAPOLATION
from asperity.base.celsius import ZERO_CELSIUS
from asperity.plot.curves import (
    MOST_ENTRIES,
    PRESSURE,
    VELOCITY,
    band_text,
    named,
    new_figure,
    picture,
    pressure_text,
    shaded,
)
from asperity.plot.labels import legend_beside, legend_with_room
from asperity.plot.style import colours, grey, shades
from asperity.scan_contact import ScanContact
from asperity.scene.model import Scene, SceneFriction

if TYPE_CHECKING:
    from matplotlib.axes import Axes

_MOST_SHADED = 3  # curves whose model error can be told apart
_PROFILES = 5  # velocities at which the temperature of each roughness is drawn
_TEMPERATURE = "Temperature $T_0$"
_KINDS = {"total": "-", "hysteresis": "--", "adhesion": ":"}
_COLD = "-."  # mu without heat
_WIDTH = 1.8  # points, of the line of mu
_HALO = 0.03  # of mu, to either side of a part that is guessed
_SAME = 0.01  # relative, of two curves that lie on one another
_FAR_APART = 30  # times; curves whose largest mu are so far apart share no linear axis


@dataclass(frozen=True, eq=False)
class _Curve:
    """One curve of the picture, arrays along its abscissa."""

    label: str
    x: NDArray[np.float64]
    kinds: Sequence[NDArray[np.float64]]  # mu, hysteresis, adhesion
    band: Sequence[NDArray[np.float64]]  # lower and upper mu, or nothing
    off: NDArray[np.float64]  # how far the model may be
    guessed: NDArray[np.bool_]  # where most of the hysteresis is that of an extrapolated modulus
    heat: Sequence[NDArray[np.float64]]  # mu without heat and the rise at q1, or nothing


def friction_figure(scenes: Sequence[Scene], results: Sequence[SceneFriction], path: Path) -> bytes:
    """mu over velocity, or over what else alone varies, a colour a pressure, temperature or scene;
    with heat also mu without it, a panel of the rise of the temperature, and over velocity one of
    the rise that each roughness feels."""
    abscissa = _abscissa(scenes)
    curves = list(_curves(scenes, results, abscissa))
    heated = any(curve.heat for curve in curves)
    profiled = next((s for s in scenes if s.heating is not None and s.velocity.size > 1), None)
    figure, (axes, *beside) = new_figure(1 + heated + (profiled is not None))
    many = len(curves) > MOST_ENTRIES
    tints: Sequence[Any] = colours(len(curves))
    if many and len(scenes) == 1:
        tints = list(shaded(axes, scenes[0].pressure, PRESSURE))
    elif many:
        named(axes, [curve.label for curve in curves])
    kinds = _KINDS if any(scene.adhesion is not None for scene in scenes) else {"total": "-"}
    hatched = len(curves) <= _MOST_SHADED and any(np.isfinite(c.off).any() for c in curves)
    for curve, colour in zip(curves, tints, strict=True):
        _draw(axes, curve, colour, kinds, labelled=not many, hatched=hatched)
    if beside:
        same = all(np.allclose(c.heat[0], c.kinds[0], rtol=_SAME) for c in curves if c.heat)
        if not same:
            axes.plot([], [], linestyle=_COLD, color=grey(0.3), linewidth=1.2, label="without heat")
        if len(kinds) == 1:
            name = "with and without heat" if same else "with heat"
            axes.plot([], [], color=grey(0.3), linewidth=_WIDTH, label=name)
        _draw_rises(beside[0], curves, tints)
    if len(kinds) > 1:
        for kind, dashes in kinds.items():
            axes.plot([], [], dashes, color=grey(0.3), label=kind)
    _label(axes, abscissa, scenes)
    _scale_friction(axes, curves)
    drawn = zip(scenes, results, strict=True)
    for level in sorted({s.sampling["level"] for s, r in drawn if r.band is not None}):
        seen = any(_shows(axes, *curve.band) for curve in curves if curve.band)
        _tell_band(axes, band_text(level), seen=seen, color=grey(0.3), alpha=0.2, linewidth=0)
    _mark_guesses(axes, curves)
    if hatched:
        _tell_errors(axes, curves, results, scenes)
    alone = "" if len(kinds) > 1 else "\nof hysteresis alone"
    axes.set_ylabel(f"Friction coefficient $\\mu$ [-]{alone}")
    if beside:
        _label(beside[0], abscissa, scenes)
        beside[0].set_ylim(bottom=0)
        beside[0].set_ylabel("Temperature rise at $q_1$ [K]")
    if profiled is not None:
        _draw_profiles(beside[1], profiled)
    entries = axes.get_legend_handles_labels()
    if entries[1]:
        legend_beside(figure, *entries)
    if profiled is not None:  # where that left it
        at = [pressure_text(float(profiled.pressure[0])), profiled.temperature_text]
        legend_with_room(beside[1], title=", ".join(at), title_fontsize="small")
    return picture(figure, path)


def _abscissa(scenes: Sequence[Scene]) -> str:
    """What the picture is drawn over: the velocity, or what alone varies."""
    if any(scene.velocity.size > 1 for scene in scenes):
        return VELOCITY
    files = {scene.path for scene in scenes}
    if all(sum(s.path == file for s in scenes) > 1 for file in files):
        return _TEMPERATURE
    return PRESSURE if all(scene.pressure.size > 1 for scene in scenes) else VELOCITY


def _curves(
    scenes: Sequence[Scene], results: Sequence[SceneFriction], abscissa: str
) -> Iterator[_Curve]:
    """The curves of all scenes, each in the order of its abscissa."""
    if abscissa != _TEMPERATURE:
        for name, scene, result in zip(_names(scenes), scenes, results, strict=True):
            over_pressure = abscissa == PRESSURE
            x = scene.pressure if over_pressure else scene.velocity
            loads = [pressure_text(float(pressure)) for pressure in scene.pressure]
            if over_pressure:
                loads = [f"{float(scene.velocity[0]):.4g} m/s"]
            columns = _columns(scene, result)
            for row, load in enumerate(loads):
                lines = [c.T[row] if over_pressure else c[row] for c in columns]
                yield _curve(f"{_plain(name)}, {load}" if name else load, x, lines, result)
        return
    for file in dict.fromkeys(scene.path for scene in scenes):
        of_file = [(s, r) for s, r in zip(scenes, results, strict=True) if s.path == file]
        columns = [np.stack(one) for one in zip(*(_columns(s, r) for s, r in of_file), strict=True)]
        x = np.array([scene.temperature for scene, _ in of_file]) - _zero(scenes)
        first, result = of_file[0]
        several = len({scene.path for scene in scenes}) > 1
        for row, pressure in enumerate(first.pressure):
            load = f"{pressure_text(float(pressure))}, {float(first.velocity[0]):.3g} m/s"
            label = f"{_plain(file.name)}, {load}" if several else load
            yield _curve(label, x, [c[:, row, 0] for c in columns], result)


def _columns(scene: Scene, result: SceneFriction) -> list[NDArray[np.float64]]:
    """Everything that a curve takes from a result, of shape (pressures, velocities)."""
    assert result.model_error is not None
    share = result.extrapolated_share
    columns = [result.mu, result.hysteresis, result.adhesion]
    columns += [np.zeros_like(result.mu) if share is None else share]
    columns += [result.model_error * result.hysteresis, *(result.band or ())]
    if result.cold is not None:
        columns += [result.cold.mu, result.temperature - (scene.temperature or 0.0)]
    return columns


def _curve(
    label: str, x: NDArray[np.float64], lines: Sequence[NDArray[np.float64]], result: SceneFriction
) -> _Curve:
    order = np.argsort(x)
    mu, hysteresis, adhesion, share, off, *rest = (line[order] for line in lines)
    band = [rest.pop(0), rest.pop(0)] if result.band else []
    guessed = share > FATAL_EXTRAPOLATION
    return _Curve(label, x[order], (mu, hysteresis, adhesion), band, off, guessed, rest)


def _draw(
    axes: "Axes",
    curve: _Curve,
    colour: Any,
    kinds: dict[str, str],
    *,
    labelled: bool,
    hatched: bool,
) -> None:
    mu = curve.kinds[0]
    if hatched:
        around = (np.maximum(mu - curve.off, 0), mu + curve.off)
        axes.fill_between(curve.x, *around, **_hatch(colour))
    if curve.band:
        low, high = curve.band
        axes.fill_between(curve.x, low, high, color=colour, alpha=0.2, linewidth=0)
    for y, (kind, dashes) in zip(curve.kinds, kinds.items(), strict=False):
        axes.plot(
            curve.x,
            y,
            dashes,
            color=colour,
            linewidth=_WIDTH if kind == "total" else 1.2,
            marker="o" if curve.x.size == 1 else None,
            label=curve.label if kind == "total" and labelled else None,
        )
    if curve.heat:
        axes.plot(curve.x, curve.heat[0], linestyle=_COLD, color=colour, linewidth=1.2)


def _mark_guesses(axes: "Axes", curves: Sequence[_Curve]) -> None:
    """Grey around what no measured modulus carries, half of the way to points that one does."""
    label: str | None = "most of the hysteresis from\nan extrapolated modulus"
    for curve in curves:
        if not curve.guessed.any():
            continue
        at = np.arange(curve.x.size)
        halves = np.arange(0, curve.x.size - 0.5, 0.5)
        x, mu = np.interp(halves, at, curve.x), np.interp(halves, at, curve.kinds[0])
        guessed = np.interp(halves, at, curve.guessed) > 0
        around = (1 - _HALO) * mu, (1 + _HALO) * mu
        look: dict[str, Any] = {"color": grey(0.4), "alpha": 0.45, "linewidth": 0, "zorder": 0.5}
        axes.fill_between(x, *around, where=guessed, label=label, **look)
        label = None  # one entry for all


def _draw_rises(axes: "Axes", curves: Sequence[_Curve], tints: Sequence[Any]) -> None:
    """How much warmer the rubber is at q1, in the colours of the curves."""
    for curve, colour in zip(curves, tints, strict=True):
        if curve.heat:
            axes.plot(
                curve.x,
                curve.heat[1],
                color=colour,
                linewidth=1.8,
                marker="o" if curve.x.size == 1 else None,
            )


def _draw_profiles(axes: "Axes", scene: Scene) -> None:
    """The rise that each roughness feels, at some of the velocities and the first pressure."""
    from matplotlib.ticker import LogLocator, NullFormatter

    fastest = float(np.max(scene.velocity))
    slowest = max(float(np.min(scene.velocity)), 1e-4 * fastest)  # slower ones are cold
    velocity = np.geomspace(slowest, fastest, _PROFILES)
    q, rise = scene.rise_over_roughness(velocity)
    tints = shades()(np.linspace(0, 1, _PROFILES))
    for v, line, colour in zip(velocity[::-1], rise[::-1], tints[::-1], strict=True):
        axes.plot(q, line, color=colour, label=f"{v:.2g} m/s")
    axes.set_xscale("log")
    q1 = scene.spectrum.q1
    if q[-1] > 1.01 * q1:  # edges of contacts, which PartialContact counts, are finer than the road
        axes.axvline(q1, color=grey(0.5), linestyle=":", linewidth=1, label="$q_1$")
    decades = math.log10(scene.spectrum.q1 / scene.spectrum.q0)
    axes.xaxis.set_major_locator(LogLocator(subs=(1,) if decades > 2 else (1, 2, 5)))
    axes.xaxis.set_minor_formatter(NullFormatter())
    axes.set_ylim(bottom=0)
    axes.set_xlabel("Wavenumber $q$ [1/m]")
    axes.set_ylabel("Temperature rise $T(q) - T_0$ [K]")


def _label(axes: "Axes", abscissa: str, scenes: Sequence[Scene]) -> None:
    if abscissa != _TEMPERATURE:
        axes.set_xscale("log")
        axes.set_xlabel(abscissa)
    else:
        axes.set_xlabel(f"{abscissa} [{'°C' if _zero(scenes) else 'K'}]")


def _scale_friction(axes: "Axes", curves: Sequence[_Curve]) -> None:
    """From zero, or over decades where a linear axis would lay a whole curve on its foot."""
    mu = np.concatenate([y for curve in curves for y in (curve.kinds[0], *curve.heat[:1])])
    largest = [float(curve.kinds[0].max()) for curve in curves]
    if 0 < min(largest) < max(largest) / _FAR_APART:
        axes.set_yscale("log", nonpositive="clip")
        axes.set_ylim(
            float(np.min(mu, where=mu > 0, initial=np.inf)) / 1.5, float(np.max(mu)) * 1.5
        )
    else:
        axes.set_ylim(bottom=0)


def _shows(axes: "Axes", low: NDArray[np.float64], high: NDArray[np.float64]) -> bool:
    """Whether a band is anywhere seen beside the line that runs through it."""
    x = np.zeros_like(low)
    ends = [axes.transData.transform(np.column_stack([x + 1, y]))[:, 1] for y in (low, high)]
    with np.errstate(invalid="ignore"):
        width = (ends[1] - ends[0]) * 72 / axes.figure.dpi
    return bool(np.nanmax(width, initial=0) > 2 * _WIDTH)


def _tell_band(axes: "Axes", label: str, *, seen: bool, **look: Any) -> None:
    """An entry of the legend with a swatch, or words alone where the band cannot be seen."""
    if seen:
        axes.fill_between([], [], **look, label=label)
    else:
        axes.plot([], [], linestyle="", label=f"{label},\ntoo narrow to see")


def _tell_errors(
    axes: "Axes",
    curves: Sequence[_Curve],
    results: Sequence[SceneFriction],
    scenes: Sequence[Scene],
) -> None:
    """Entries of the legend for the error of the model and that of the numbers."""
    around = [(np.maximum(c.kinds[0] - c.off, 0), c.kinds[0] + c.off) for c in curves]
    seen = any(_shows(axes, *ends) for ends in around)
    of_scan = [isinstance(scene.correction, ScanContact) for scene in scenes]
    sources = ["\nof one scan, its pixels\nand the interpolation"] if any(of_scan) else []
    sources += [] if all(of_scan) else ["\nfrom exact sliding contacts"]
    label = f"model error (rms),{' or'.join(sources)}"
    _tell_band(axes, label, seen=seen, **_hatch(grey(0.3)))
    numerical = max(float(np.max(r.error_estimate / np.fmax(r.mu, 1e-300))) for r in results)
    power = f"$10^{{{math.ceil(math.log10(max(numerical, 1e-16)))}}}$"
    label = f"numerical error below {power},\ntoo small to see"
    axes.plot([], [], linestyle="", label=label)


def _hatch(colour: Any) -> dict[str, Any]:
    return {
        "facecolor": "none",
        "edgecolor": colour,
        "hatch": "//////",
        "alpha": 0.4,
        "linewidth": 0,
    }


def _zero(scenes: Sequence[Scene]) -> float:
    """What a picture calls zero [K]: of degrees Celsius where all scenes have them."""
    return ZERO_CELSIUS if all(scene.in_celsius for scene in scenes) else 0.0


def _names(scenes: Sequence[Scene]) -> list[str]:
    """What tells scenes apart: their files, and temperatures where a file has several."""
    paths = {scene.path for scene in scenes}
    short = len({path.name for path in paths}) == len(paths)
    names = []
    for scene in scenes:
        file = [scene.path.name if short else f"{scene.path}"] if len(paths) > 1 else []
        several = sum(other.path == scene.path for other in scenes) > 1
        names.append(", ".join(file + ([scene.temperature_text] if several else [])))
    return names


def _plain(name: str) -> str:
    """A file name as a legend shows it: no formula, not hidden, nothing that is no text."""
    name = name.encode(errors="backslashreplace").decode().replace("$", r"\$")
    return f"./{name}" if name.startswith("_") else name
