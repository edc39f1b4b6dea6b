"""Figures of a master curve: isotherms, the curve, shift factors, the Prony fit (matplotlib)."""

from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np

from asperity.base.quantities import ZERO_CELSIUS, temperature_text
from asperity.dma import MasterCurveBuild
from asperity.draw.figure import legend, new_figure, picture
from asperity.draw.style import Axes, grey, palette, shades
from asperity.prony_fit import PronyFit
from asperity.shift_factors import WlfFit
from asperity.sweeps import Isotherm

# of sweeps and of complex moduli, marks, names, places in the palette
_PARTS = (("storage_modulus", "real", "o", "$E$′", 0), ("loss_modulus", "imag", "^", "$E$″", 1))
_TAN = 2  # of the palette
_SMALL = 2.5  # points, of marks


def rubber_figure(
    isotherms: Sequence[Isotherm],
    build: MasterCurveBuild,
    wlf: WlfFit | None,
    prony: PronyFit | None,
    path: Path,
    *,
    celsius: bool,
) -> bytes:
    """Isotherms as measured, the master curve (the article's Fig. 5), a_T, what the fit leaves.
    Temperatures are in the unit that the files have."""
    figure, (first, second, third, fourth) = new_figure(4)
    reference = temperature_text(build.reference_temperature, celsius=celsius)
    titles = [
        "(a) isotherms",
        f"(b) master curve at {reference}",
        "(c) shift factors",
        "(d) points about the Prony fit",
    ]
    for axes, title in zip((first, second, third, fourth), titles, strict=True):
        axes.set_title(title, fontsize="medium")
    draw_isotherms(first, isotherms, celsius=celsius)
    _draw_master(second, build, prony)
    draw_shifts(third, build, wlf, celsius=celsius)
    _draw_residual(fourth, build, prony)
    return picture(figure, path)


def draw_isotherms(axes: Axes, isotherms: Sequence[Isotherm], *, celsius: bool) -> None:
    temperatures = np.array([isotherm.temperature for isotherm in isotherms])
    span = max(float(np.ptp(temperatures)), 1.0)
    for isotherm in isotherms:
        colour = shades()((isotherm.temperature - temperatures.min()) / span)
        for (name, _, mark, _, _), dashes in zip(_PARTS, "-:", strict=True):
            look: dict[str, Any] = {"markersize": _SMALL, "linewidth": 0.8, "color": colour}
            axes.plot(isotherm.angular_frequency, getattr(isotherm, name), mark + dashes, **look)
    for extreme in (temperatures.min(), temperatures.max()):
        colour = shades()((extreme - temperatures.min()) / span)
        axes.plot([], [], color=colour, label=temperature_text(extreme, celsius=celsius))
    for (_, _, mark, label, _), dashes in zip(_PARTS, "-:", strict=True):
        axes.plot([], [], mark + dashes, color=grey(0.4), markersize=_SMALL, label=label)
    _logarithmic(axes, "Angular frequency $\\omega$ [rad/s]", "Modulus [Pa]")


def _draw_master(axes: Axes, build: MasterCurveBuild, prony: PronyFit | None) -> None:
    points = build.points
    w = points.angular_frequency
    for name, _, mark, label, place in _PARTS:
        look: dict[str, Any] = {"markersize": _SMALL, "color": palette()[place]}
        axes.plot(w, getattr(points, name), mark, label=label, **look)
    if prony is not None:
        dense = np.geomspace(w[0], w[-1], 300)
        fitted = prony.modulus(dense)
        axes.plot(dense, fitted.real, color=grey(0), linewidth=0.9, label="Prony fit")
        axes.plot(dense, fitted.imag, color=grey(0), linewidth=0.9)
    _logarithmic(axes, "Reduced frequency $a_T\\, \\omega$ [rad/s]", "Modulus [Pa]")
    right = axes.twinx()
    tan = points.loss_modulus / points.storage_modulus
    right.plot(w, tan, ".", markersize=2.5, color=palette()[_TAN])
    axes.plot([], [], ".", color=palette()[_TAN], label="$\\tan\\delta$")
    right.set_ylabel("$\\tan\\delta$ [-]", color=palette()[_TAN])
    right.set_ylim(0, 1.6 * float(tan.max()))
    right.tick_params(direction="in", colors=palette()[_TAN])
    legend(axes)


def draw_shifts(axes: Axes, build: MasterCurveBuild, wlf: WlfFit | None, *, celsius: bool) -> None:
    zero = ZERO_CELSIUS if celsius else 0.0
    look: Any = {"fmt": "o", "markersize": 4, "capsize": 3, "color": palette()[0]}
    deviations, label = 2 * build.standard_deviation, "measured, ± 2 standard deviations"
    axes.errorbar(build.temperature - zero, build.log10_a_T, deviations, label=label, **look)
    if wlf is not None:
        t = np.linspace(build.temperature[0], build.temperature[-1], 200)
        d = t - wlf.reference_temperature
        label = f"WLF, $c_1$ = {wlf.c1:.3g}, $c_2$ = {wlf.c2:.4g} K\n"
        label += f"residual {wlf.residual:.2g} decades"
        axes.plot(t - zero, -wlf.c1 * d / (wlf.c2 + d), color=palette()[1], label=label)
    axes.set(xlabel=f"Temperature $T$ [{'°C' if celsius else 'K'}]", ylabel="$\\log_{10} a_T$ [-]")
    legend(axes)


def _draw_residual(axes: Axes, build: MasterCurveBuild, prony: PronyFit | None) -> None:
    axes.axhline(0, color=grey(0.4), linewidth=0.8)
    axes.set(xscale="log", xlabel="Reduced frequency $a_T\\, \\omega$ [rad/s]")
    axes.set_ylabel("Measured / fit - 1 [%]")
    if prony is None:
        return
    points = build.points
    fitted = prony.modulus(points.angular_frequency)
    of_curve = prony.storage_residual, prony.loss_residual
    for (name, part, mark, label, place), off in zip(_PARTS, of_curve, strict=True):
        miss = 100 * (getattr(points, name) / getattr(fitted, part) - 1)
        rms = np.sqrt(np.mean(miss**2))  # of the points drawn; the fit knows their smooth curve
        label += f", rms {rms:.2g} %; of the master curve {100 * off:.2g} %"
        look: dict[str, Any] = {"markersize": _SMALL, "color": palette()[place]}
        axes.plot(points.angular_frequency, miss, mark, label=label, **look)
    legend(axes)


def _logarithmic(axes: Axes, x: str, y: str) -> None:
    axes.set(xscale="log", yscale="log", xlabel=x, ylabel=y)
    legend(axes)
