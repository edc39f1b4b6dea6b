"""The picture of friction of scenes; beside it what heat makes of it."""

import math
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np

from asperity.base.arguments import known
from asperity.draw.directions import DIRECTION
from asperity.draw.figure import PRESSURE, legend, new_figure, picture, pressure_text
from asperity.draw.friction import (
    Curve,
    abscissa_of,
    band_text,
    curves_of,
    draw_friction,
    label_abscissa,
)
from asperity.draw.style import Axes, grey, shades
from asperity.scan_contact import ScanContact
from asperity.scene.model import Scene, SceneFriction

_PROFILES = 5  # velocities at which the temperature of each roughness is drawn


def friction_figure(scenes: Sequence[Scene], results: Sequence[SceneFriction], path: Path) -> bytes:
    """mu over velocity, or over what else alone varies, a colour a pressure, temperature or scene;
    with heat also mu without it, a panel of the rise of the temperature, and over velocity one of
    the rise that each roughness feels."""
    files = [scene.path for scene in scenes]
    abscissa = abscissa_of(results, temperatures=all(files.count(one) > 1 for one in files))
    names = _files(scenes)
    celsius = all(scene.in_celsius for scene in scenes)
    given = [scene.temperature for scene in scenes]
    curves = list(curves_of(results, names, abscissa, given, celsius=celsius))
    heated = any(np.isfinite(curve.rise).any() for curve in curves)
    profiled = next((s for s in scenes if s.heating is not None and s.velocity.size > 1), None)
    panels = 1 + heated + (profiled is not None)
    figure, (axes, *beside) = new_figure(panels, polar=abscissa == DIRECTION)
    levels = {s.sampling["level"] for s, r in zip(scenes, results, strict=True) if r.band}
    texts = {"band": "\n".join(map(band_text, sorted(levels))), "model": _model_text(scenes)}
    texts["bar"] = PRESSURE if len(scenes) == 1 else ""
    tints = draw_friction(axes, curves, abscissa, celsius=celsius, **texts)
    if beside:
        _draw_rises(beside[0], curves, tints)
        label_abscissa(beside[0], abscissa, celsius=celsius)
    if profiled is not None:
        _draw_profiles(beside[1], profiled)
        at = [pressure_text(float(profiled.pressure[0])), profiled.temperature_text]
        legend(beside[1], title=", ".join(at))
    legend(axes)
    return picture(figure, path)


def _model_text(scenes: Sequence[Scene]) -> str:
    """Where the model error is known from, for a legend."""
    of_scan = [isinstance(scene.correction, ScanContact) for scene in scenes]
    sources = ["\nof one scan, its pixels\nand the interpolation"] if any(of_scan) else []
    sources += [] if all(of_scan) else ["\nfrom exact sliding contacts"]
    return f"model error (rms),{' or'.join(sources)}"


def _draw_rises(axes: Axes, curves: Sequence[Curve], tints: Sequence[Any]) -> None:
    """How much warmer the rubber is at q1, in the colours of the curves."""
    for curve, colour in zip(curves, tints, strict=True):
        if np.isfinite(curve.rise).any():
            marker = "o" if curve.x.size == 1 else None
            axes.plot(curve.x, curve.rise, color=colour, linewidth=1.8, marker=marker)
    axes.set_ylim(bottom=0)
    axes.set_ylabel("Temperature rise at $q_1$ [K]")


def _draw_profiles(axes: Axes, scene: Scene) -> None:
    """The rise that each roughness feels, at some of the velocities and the first pressure."""
    from matplotlib.ticker import LogLocator, NullFormatter

    fastest = float(np.max(scene.velocity))
    slowest = max(float(np.min(scene.velocity)), 1e-4 * fastest)  # slower ones are cold
    velocity = np.geomspace(slowest, fastest, _PROFILES)
    result = scene.roughly(
        pressure=scene.pressure[0], velocity=velocity, heating=scene.heating, contributions=True
    )
    q, rise = known(result.wavenumber), known(result.temperature_profile) - known(scene.temperature)
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
    axes.set(xlabel="Wavenumber $q$ [1/m]", ylabel="Temperature rise $T(q) - T_0$ [K]")


def _files(scenes: Sequence[Scene]) -> list[str]:
    paths = {scene.path for scene in scenes}
    if len(paths) == 1:
        return [""] * len(scenes)
    short = len({path.name for path in paths}) == len(paths)
    return [_plain(scene.path.name if short else f"{scene.path}") for scene in scenes]


def _plain(name: str) -> str:
    """A file name as a legend shows it: no formula, not hidden, nothing that is no text."""
    name = name.encode(errors="backslashreplace").decode().replace("$", r"\$")
    return f"./{name}" if name.startswith("_") else name
