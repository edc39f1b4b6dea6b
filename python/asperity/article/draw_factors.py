"""Figs 8 to 12: correction factors and contact areas over magnification."""

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from asperity._core import AffineShift
from asperity.article.factors import GAMMA, PRINTED_P_T1, Factors, cf
from asperity.article.inputs import LAMBDA0, PIXELS, PRESSURES, SIDE, VELOCITY, Inputs
from asperity.article.page import (
    Page,
    page,
    sandpaper_inputs,
    scan_inputs,
    stacked,
    tuned_inputs,
)
from asperity.article.peaks import located
from asperity.plot.curves import COLOURS, new_figure

if TYPE_CHECKING:
    from matplotlib.axes import Axes

_Array = NDArray[np.float64]
_MIDDLE = 1  # of PRESSURES, that of Figs 8 and 9
_SHOWN = 8  # lambda0 of the map, a corner of it


def fig08(inputs: Inputs, factors: Factors) -> Page:
    """Peaks no closer than lambda0, and the factor that p_T1 gives."""
    return _local(inputs, factors, "fig08", 1.0, PRINTED_P_T1[0])


def fig09(inputs: Inputs, factors: Factors) -> Page:
    """Peaks no closer than lambda0 / 2."""
    return _local(inputs, factors, "fig09", 0.5, PRINTED_P_T1[1])


def fig10(inputs: Inputs, factors: Factors) -> Page:
    """Area with the local peaks' p_T1 beside the original one."""
    shift = PRINTED_P_T1[1]
    label = f"modified, $p_{{T1}}$ = {shift:g}"
    given = {"p_t1": shift, **_given(inputs)}
    return _areas("fig10", given, factors, factors.local_area[shift], label)


def fig11(inputs: Inputs, factors: Factors) -> Page:
    """IGW-CF beside PF-CF at three pressures."""
    figure, panels = new_figure(3)
    shift = inputs.tuned["implicit"].implied.shift_factor
    rows = zip(panels, PRESSURES, factors.persson, factors.improved, shift, strict=True)
    for axes, pressure, persson, improved, p in rows:
        axes.plot(factors.zeta, persson, color=COLOURS[0], label=rf"PF-CF, $\gamma$ = {GAMMA}")
        axes.plot(factors.zeta, improved, "--", color=COLOURS[1], label=f"IGW-CF, $p_T$ = {p:.2f}")
        _magnification(axes, "Correction factor CF [-]")
        axes.set_title(_megapascal(pressure), fontsize="medium")
        axes.set_ylim(0.7 * factors.persson.min(), 1.5)
        axes.legend(fontsize="small")
    columns = _columns(factors, {"pf_cf": factors.persson, "igw_cf": factors.improved})
    return page("fig11", figure, _given(inputs), columns)


def fig12(inputs: Inputs, factors: Factors) -> Page:
    """Area with IGW beside the original one."""
    return _areas("fig12", _given(inputs), factors, factors.improved_area, "modified, IGW")


def _local(inputs: Inputs, factors: Factors, name: str, distance: float, printed: float) -> Page:
    scan, pressure = inputs.scans[0], PRESSURES[_MIDDLE]
    x, y, peaks = located(scan, distance)
    own = cf(inputs, inputs.rubber, factors.zeta, AffineShift(peaks.shift_factor))[_MIDDLE]
    curves = {
        "pf_cf": factors.persson[_MIDDLE],
        "lp_cf_printed": factors.local[printed][_MIDDLE],
        "lp_cf_scan": own,
    }
    figure, (left, right) = new_figure(2)
    _draw_corner(left, scan.heights - scan.heights.mean(), x, y)
    apart = r"$\lambda_0$" if distance == 1 else rf"{distance:g} $\lambda_0$"
    left.set_title(f"(a) peaks no closer than {apart}, a corner", fontsize="medium")
    styles = ("-", "--", ":")
    labels = (
        rf"PF-CF, $\gamma$ = {GAMMA}",
        f"LP-CF, $p_{{T1}}$ = {printed:g} (printed)",
        f"LP-CF, $p_{{T1}}$ = {peaks.shift_factor:.2f} (this scan)",
    )
    for row, dash, label, colour in zip(curves.values(), styles, labels, COLOURS, strict=False):
        right.plot(factors.zeta, row, dash, color=colour, label=label)
    _magnification(right, "Correction factor CF [-]")
    title = f"(b) {_megapascal(pressure)}, {VELOCITY:g} m/s"
    right.set_title(title, fontsize="medium")
    right.legend(fontsize="small")
    given = {
        **_given(inputs),
        **scan_inputs(),
        "min_distance_m": distance * LAMBDA0,
        "p_t1_printed": printed,
        "p_t1_scan": peaks.shift_factor,
        "pressure_pa": pressure,
    }
    found: list[dict[str, Any]] = [
        {"part": "peaks", "x_m": x, "y_m": y, "height_m": peaks.heights},
        {"part": "factors", "magnification": factors.zeta, **curves},
    ]
    return page(name, figure, given, stacked(found))


def _draw_corner(axes: "Axes", heights: _Array, x: _Array, y: _Array) -> None:
    side, pixels = 1e3 * _SHOWN * LAMBDA0, _SHOWN * PIXELS // SIDE
    low, high = np.percentile(1e6 * heights, [0.2, 99.8])
    image = axes.imshow(
        1e6 * heights[:pixels, :pixels],
        extent=(0, side, side, 0),
        cmap="cividis",
        vmin=float(low),
        vmax=float(high),
        interpolation="nearest",
    )
    axes.plot(1e3 * x, 1e3 * y, "o", color=COLOURS[1], markersize=4, markeredgecolor="white")
    axes.set_xlim(0, side)
    axes.set_ylim(side, 0)
    axes.set_xlabel("$x$ [mm]")
    axes.set_ylabel("$y$ [mm]")
    axes.figure.colorbar(image, ax=axes, label="Height $z$ [µm]", shrink=0.9)


def _areas(
    name: str, given: dict[str, Any], factors: Factors, modified: _Array, label: str
) -> Page:
    figure, (axes,) = new_figure(1)
    for pressure, before, after, colour in zip(
        PRESSURES, factors.area, modified, COLOURS, strict=False
    ):
        axes.plot(factors.zeta, before, color=colour, label=_megapascal(pressure))
        axes.plot(factors.zeta, after, "--", color=colour)
    for dash, text in (("-", "original"), ("--", label)):
        axes.plot([], [], dash, color="0.3", label=text)
    _magnification(axes, "Relative contact area $A / A_0$ [-]")
    axes.set_title(f"{VELOCITY:g} m/s", fontsize="medium")
    axes.figure.legend(loc="outside right upper")
    columns = _columns(factors, {"original_area": factors.area, "modified_area": modified})
    return page(name, figure, given, columns)


def _columns(factors: Factors, curves: dict[str, _Array]) -> dict[str, list[Any]]:
    """Pressures below one another."""
    blocks: Sequence[dict[str, Any]] = [
        {
            "pressure_pa": pressure,
            "magnification": factors.zeta,
            **{name: rows[k] for name, rows in curves.items()},
        }
        for k, pressure in enumerate(PRESSURES)
    ]
    return stacked(blocks)


def _given(inputs: Inputs) -> dict[str, Any]:
    tuned = tuned_inputs(inputs.tuned["implicit"])
    return {**sandpaper_inputs(inputs), **tuned, "velocity_m_s": VELOCITY, "gamma": GAMMA}


def _magnification(axes: "Axes", label: str) -> None:
    axes.set_xscale("log")
    axes.set_yscale("log")
    axes.set_xlabel("Magnification $q / q_0$ [-]")
    axes.set_ylabel(label)


def _megapascal(pressure: float) -> str:
    return f"{pressure / 1e6:g} MPa"
