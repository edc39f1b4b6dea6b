"""Measured friction beside the theory with fitted adhesion, as in the article's Fig. 15."""

import math
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np

from asperity.adhesion import AdhesionFit
from asperity.base.quantities import ZERO_CELSIUS
from asperity.draw.figure import (
    MOST_ENTRIES,
    VELOCITY,
    legend_outside,
    new_figure,
    picture,
    pressure_text,
)
from asperity.draw.friction import TOO_NARROW, band_text, curves_of, draw_friction
from asperity.draw.style import Axes, colours, grey, narrow
from asperity.scene.experiment import Experiment, Fitted, nearest_pressure
from asperity.scene.scene_fit import SceneFit


def fit_figure(fits: Sequence[Fitted], experiment: Experiment, path: Path) -> bytes:
    """Points, total, hysteresis and adhesion: the original theory, and beside it the modified."""
    figure, panels = new_figure(len(fits))
    if not narrow():
        figure.set_size_inches(4.6 * len(fits) + 2.2, 3.9)
    titles = ["(a) original", "(b) modified"] if len(fits) == 2 else ["original"]
    if len(fits) == 1 and fits[0].scene.correction is not None:
        titles = ["modified"]
    highest = 1.1 * max(
        float(experiment.measured.mu.max()), *(float(f.curves.mu.max()) for f in fits)
    )
    for axes, fit, title in zip(panels, reversed(fits), titles, strict=True):
        _draw(axes, fit, experiment)
        told = "no adhesion fits: see the notes"
        if fit.adhesion is not None:
            told = _parameters(fit.adhesion)
        axes.set_title(f"{title}\n{told}", fontsize="small")
        axes.set_ylim(top=highest)
    entries: dict[str, Any] = {}  # of both panels, each once: points may be put aside in one alone
    for axes in panels:
        for handle, label in zip(*axes.get_legend_handles_labels(), strict=True):
            entries.setdefault(label, handle)
    for label in list(entries):  # what is seen in the other panel is no longer unseen
        entries.pop(label + TOO_NARROW, None)
    legend_outside(figure, [*entries.values()], [*entries])
    return picture(figure, path)


def scene_fit_figure(fit: SceneFit, path: Path) -> bytes:
    figure, (first, second) = new_figure(2)
    nowhere = np.zeros_like(fit.mu)
    kelvin = nowhere if fit.temperature is None else fit.temperature
    groups = sorted({*zip(fit.pressure.tolist(), kelvin.tolist(), strict=True)})
    many = len(groups) > MOST_ENTRIES
    for (load, hot), colour in zip(groups, colours(len(groups)), strict=True):
        here = np.flatnonzero((fit.pressure == load) & (kelvin == hot))
        here = here[np.argsort(fit.velocity[here], kind="stable")]
        v, mu, low, high = (x[here] for x in (fit.velocity, fit.mu, fit.band_lower, fit.band_upper))
        label = pressure_text(load) + (f", {hot - ZERO_CELSIUS:.3g} °C" if hot else "")
        first.fill_between(v, low, high, color=colour, alpha=0.2, linewidth=0)
        first.plot(v, mu, "-", color=colour, linewidth=1.5)
        first.plot(v, fit.measured[here], "o", color=colour, ms=3.5, label=None if many else label)
        ends = np.array([mu - low, high - mu])
        second.errorbar(fit.measured[here], mu, ends, fmt="o", color=colour, ms=3.5, lw=0.8)
        if fit.left_out is not None:
            second.plot(fit.measured[here], fit.left_out[here], "x", color=colour, ms=4.5)
    interval = "95 % interval of stated errors" + ", scatter" * (fit.scatter is not None)
    fitted = " with fitted numbers" if fit.free else ""
    first.plot([], [], "-", color=grey(0.3), label=f"scene{fitted}")
    first.fill_between([], [], color=grey(0.3), alpha=0.2, linewidth=0, label=interval)
    if fit.left_out is not None:
        first.plot([], [], "x", color=grey(0.3), ms=4.5, label="point left out of the fit")
    first.set(xscale="log", xlabel=VELOCITY, ylabel="Friction coefficient $\\mu$ [-]")
    first.set_ylim(0, 1.1 * max(float(fit.measured.max()), float(fit.mu.max())))
    sides = min(fit.measured.min(), fit.mu.min()), max(fit.measured.max(), fit.mu.max())
    second.plot(sides, sides, color=grey(0.5), linewidth=0.8, zorder=0)
    second.set(xlabel="$\\mu$ as measured [-]", ylabel="$\\mu$ of the scene [-]")
    off, same = (f"{100 * one:.2g} %" for one in (fit.rms_left_out, fit.rms_same_mu))
    second.set_title(f"rms off {off}; the same $\\mu$ everywhere {same}", fontsize="small")
    legend_outside(figure, *first.get_legend_handles_labels())
    return picture(figure, path)


def _draw(axes: Axes, fit: Fitted, experiment: Experiment) -> None:
    """mu of the scene with its parts and its band, and the points in the colours of its curves."""
    scene, measured = fit.scene, experiment.measured
    given, celsius = [scene.temperature], scene.in_celsius
    curves = list(curves_of([fit.curves], [""], VELOCITY, given, celsius=celsius))
    band = "" if fit.curves.band is None else band_text(scene.sampling["level"])
    tints = draw_friction(axes, curves, VELOCITY, band=band)
    aside = np.zeros(measured.mu.shape, np.bool_)
    if fit.adhesion is not None:
        aside = np.asarray(fit.adhesion.outliers)
    nearest = scene.pressure[nearest_pressure(scene, experiment.pressure)]
    for points, mark, name in ((np.logical_not(aside), "o", "measured"), (aside, "x", "put aside")):
        if not points.any():
            continue
        axes.plot([], [], mark, color=grey(0.3), markersize=4, label=name)
        for curve, colour in zip(curves, tints, strict=True):
            here = points & (nearest == curve.pressure)
            axes.plot(measured.velocity[here], measured.mu[here], mark, color=colour, markersize=4)


def _parameters(fit: AdhesionFit) -> str:
    """The adhesion found, for a title: inside of the panel it would lie on points and curves."""
    errors = fit.standard_errors
    stress = _with_error(fit.shear_stress / 1e6, errors["shear_stress"] / 1e6)
    velocity = _with_error(1e3 * fit.reference_velocity, 1e3 * errors["reference_velocity"])
    width = _with_error(fit.width, errors["width"])
    gap = "\n" if narrow() else ", "
    return f"$\\tau_{{f0}}$ = {stress} MPa\n$v_0$ = {velocity} mm/s{gap}$c$ = {width}"


def _with_error(value: float, error: float) -> str:
    """Two digits of the error, and of the value as many places; "held" where there is no error."""
    if error == 0:
        return f"{value:.4g} (held)"
    places = max(0, 1 - math.floor(math.log10(error)))
    return f"{value:.{places}f} ± {error:.{places}f}"
