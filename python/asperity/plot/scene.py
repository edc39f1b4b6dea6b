"""Pictures of what a scene is made of: its surface and its rubber (matplotlib)."""

from contextlib import suppress
from pathlib import Path

import numpy as np

from asperity._core import InvalidInput, NotConverged
from asperity.base.quantities import temperature_text
from asperity.draw.figure import legend, new_figure, picture
from asperity.draw.style import Axes, grey, palette
from asperity.plot.rubber import draw_isotherms, draw_shifts
from asperity.plot.surface import draw_scan, draw_spectrum, without_trend
from asperity.scene.model import Scene
from asperity.scene.scan import flat, surface_spectrum
from asperity.self_affine_fit import SelfAffineFit
from asperity.shift_factors import WlfFit
from asperity.spectrum import TabulatedSpectrum


def surface_figure(scene: Scene, path: Path) -> bytes:
    """The scan without its trend, where there is one, and C(q) with the band that is used."""
    scan = scene.surface.scan
    figure, panels = new_figure(1 if scan is None else 2)
    measured = None
    if scan is not None:
        values = scene.surface.values
        detrend = None if values["detrend"] == "none" else values["detrend"]
        draw_scan(panels[0], flat(scan, detrend), scene.surface.lay)
        panels[0].set_title(without_trend(scan), fontsize="medium")
        measured = surface_spectrum(scan, window=values["window"], detrend=detrend)
        measured = measured.truncated(q1=measured.q1)
    _draw_used(panels[-1], scene, measured, scene.surface.fit)
    return picture(figure, path)


def _draw_used(
    axes: Axes, scene: Scene, measured: TabulatedSpectrum | None, fit: SelfAffineFit | None
) -> None:
    """C(q) as it was measured, and the part of it that the scene computes with."""
    spectrum = scene.spectrum
    if measured is not None:
        draw_spectrum(axes, measured, fit, None)
    q0, q1 = spectrum.q0, spectrum.q1
    if fit is not None or measured is None:
        q = np.geomspace(q0, q1, 300)
        label = "law beyond the fit" if fit is not None else "self-affine law"
        dashes = "--" if fit is not None else "-"
        axes.plot(q, spectrum.at(q), dashes, color=palette()[1], linewidth=1.2, label=label)
        axes.set(xscale="log", yscale="log", xlabel="Wavenumber $q$ [1/m]")
        axes.set_ylabel("Roughness spectrum $C(q)$ [m$^4$]")
    used = f"used, rms slope {spectrum.rms_slope:.3g}"
    axes.axvspan(q0, q1, color=grey(0.4), alpha=0.1, linewidth=0, label=used)
    legend(axes)


def rubber_figure(scene: Scene, path: Path) -> bytes:
    """E(w) of the rubber with the frequencies that sliding asks for; of isotherms their points too,
    and beside it them and the shift factors that made a master curve of them."""
    built = scene.built_rubber
    figure, panels = new_figure(1 if built.build is None else 3)
    axes = panels[-1]
    scene.rubber.plot(axes)
    for line, colour in zip(axes.lines, palette(), strict=False):
        line.set_color(colour)
    if built.build is not None and built.temperature is not None:
        points = built.build.points
        w = points.angular_frequency / float(built.build.shift_factor(built.temperature))
        axes.plot(w, points.storage_modulus, ".", ms=2.5, color=palette()[0], label="measured")
        axes.plot(w, points.loss_modulus, ".", ms=2.5, color=palette()[1])
    asked = scene.velocity.min() * scene.spectrum.q0, scene.velocity.max() * scene.spectrum.q1
    low, high = axes.get_xlim()
    ends = max(float(asked[0]), low), min(float(asked[1]), high)
    label = "$v q_0$ to $v q_1$"
    axes.axvspan(*ends, color=grey(0.4), alpha=0.1, linewidth=0, label=label)
    axes.set_xlim(low, high)
    axes.set(xlabel="Angular frequency $\\omega$ [rad/s]", ylabel="Modulus [Pa]")
    celsius = built.values.get("units", {}).get("temperature") == "C"
    if built.temperature is not None:
        at = temperature_text(built.temperature, celsius=celsius)
        axes.set_title(f"the rubber at {at}", fontsize="medium")
    legend(axes)
    if built.build is not None:
        panels[0].set_title("isotherms", fontsize="medium")
        draw_isotherms(panels[0], built.isotherms, celsius=celsius)
        wlf: WlfFit | None = None
        with suppress(InvalidInput, NotConverged):  # then the picture is without the law
            wlf = built.build.fit_wlf()
        panels[1].set_title("shift factors", fontsize="medium")
        draw_shifts(panels[1], built.build, wlf, celsius=celsius)
    return picture(figure, path)
