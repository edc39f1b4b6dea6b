"""Figs 13 and 14: separation and p_T over pressure and over velocity, both readings."""

from typing import TYPE_CHECKING, Any

import numpy as np

from asperity.article.inputs import Inputs
from asperity.article.page import Page, page, sandpaper_inputs, stacked, tuned_inputs
from asperity.article.readings import READINGS
from asperity.article.shifts import Readings, Shifts
from asperity.plot.curves import COLOURS, new_figure

if TYPE_CHECKING:
    from matplotlib.axes import Axes


def fig13(inputs: Inputs, readings: Readings) -> Page:
    """Over pressure, a colour a velocity."""
    figure, panels = new_figure(4)
    for row, name in enumerate(READINGS):
        curves = readings.over_pressure[name]
        left, right = panels[2 * row : 2 * row + 2]
        for k, v in enumerate(curves.velocity):
            x, label = curves.pressure / 1e6, f"{v:g} m/s"
            _draw(left, right, x, curves.effective[:, k], curves.shift_factor[:, k], k, label)
        for axes in (left, right):
            axes.set_xlabel(r"Nominal pressure $\sigma_0$ [MPa]")
            axes.set_xlim(0, float(curves.pressure[-1]) / 1e6)
        _finish(left, right, inputs, name, "ab" if row == 0 else "cd")
        right.legend(fontsize="small", loc="upper right")
    return page("fig13", figure, _given(inputs), _columns(readings.over_pressure))


def fig14(inputs: Inputs, readings: Readings) -> Page:
    """Over velocity, a colour a pressure."""
    figure, panels = new_figure(4)
    for row, name in enumerate(READINGS):
        curves = readings.over_velocity[name]
        left, right = panels[2 * row : 2 * row + 2]
        for k, pressure in enumerate(curves.pressure):
            label = f"{pressure / 1e6:g} MPa"
            x, d, p = curves.velocity, curves.effective[k], curves.shift_factor[k]
            _draw(left, right, x, d, p, k, label)
        for axes in (left, right):
            axes.set_xscale("log")
            axes.set_xlabel("Sliding velocity $v$ [m/s]")
            axes.set_xlim(float(curves.velocity[0]), float(curves.velocity[-1]))
        _finish(left, right, inputs, name, "ab" if row == 0 else "cd")
        right.legend(fontsize="small", loc="upper left")
    return page("fig14", figure, _given(inputs), _columns(readings.over_velocity))


def _draw(
    left: "Axes", right: "Axes", x: Any, effective: Any, factor: Any, k: int, label: str
) -> None:
    left.plot(x, 1e3 * effective, color=COLOURS[k], label=label)
    shown = np.where(np.isfinite(factor), factor, np.nan)  # no contact: no p_T to draw
    right.plot(x, shown, color=COLOURS[k], label=label)


def _finish(left: "Axes", right: "Axes", inputs: Inputs, name: str, marks: str) -> None:
    implied = inputs.tuned[name].implied
    z_max, z_min = 1e3 * implied.z_max, 1e3 * implied.z_min
    left.set_ylim(-0.58, 0.38)
    left.axhspan(z_max, 0.38, color="0.88", linewidth=0)
    left.text(0.03, 0.965, "no contact", transform=left.transAxes, va="top", fontsize="small")
    left.axhline(z_min, color="0.4", linestyle=":", linewidth=1)
    left.text(
        0.97,
        z_min - 0.01,
        r"full contact below $z_{\mathrm{min}}$",
        transform=left.get_yaxis_transform(),
        ha="right",
        va="top",
        fontsize="small",
    )
    left.set_ylabel(r"Separation $\tilde{d}$ [mm]")
    right.set_ylabel("Shift factor $p_T$ [-]")
    right.set_ylim(0.9, 5)
    for axes, mark in ((left, marks[0]), (right, marks[1])):
        title = f"({mark}) {name} reading, $E^*$ = {implied.effective_modulus / 1e6:.3g} MPa"
        axes.set_title(title + " at 0.1 m/s", fontsize="medium")


def _given(inputs: Inputs) -> dict[str, Any]:
    return {
        **sandpaper_inputs(inputs),
        **{name: tuned_inputs(tuned) for name, tuned in inputs.tuned.items()},
    }


def _columns(curves: dict[str, Shifts]) -> dict[str, list[Any]]:
    return stacked(
        [
            {
                "reading": name,
                "pressure_pa": np.repeat(c.pressure, c.velocity.size),
                "velocity_m_s": np.tile(c.velocity, c.pressure.size),
                "separation_m": c.effective.ravel(),
                "shift_factor": c.shift_factor.ravel(),
            }
            for name in READINGS
            for c in (curves[name],)
        ]
    )
