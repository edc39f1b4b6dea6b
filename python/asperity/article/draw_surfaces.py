"""Figs 2, 3, 6 and 7: the affine transformation, profiles and spectra."""

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np

from asperity._core import LineScan
from asperity.article.inputs import LAMBDA0, MAGNIFICATION, PIXEL_SIZE, PIXELS, Q0, Inputs
from asperity.article.page import (
    Page,
    asphalt_inputs,
    page,
    sandpaper_inputs,
    scan_inputs,
    stacked,
)
from asperity.article.peaks import located
from asperity.article.surfaces import Spectra
from asperity.plot.curves import COLOURS, new_figure

if TYPE_CHECKING:
    from matplotlib.axes import Axes

_SHIFT = 2.0  # p_T of Fig. 2
_TILT, _OFFSET = 0.02, 1e-3  # of the line scan of Fig. 6: slope, height [m]


def fig02(inputs: Inputs) -> Page:
    """A sinusoid of the sandpaper's rms height, in full contact and shifted to partial contact."""
    figure, panels = new_figure(2)
    x = np.linspace(0, 2 * LAMBDA0, 401)
    h = np.sqrt(2) * inputs.sandpaper.rms_height * np.cos(Q0 * x)
    shifted = (h - h.max()) / _SHIFT + h.max()
    for axes, rubber, p, title in (
        (panels[0], h, 1.0, "(a) full contact, $p_T$ = 1"),
        (panels[1], shifted, _SHIFT, f"(b) partial contact, $p_T$ = {_SHIFT:g}"),
    ):
        mm, um, mean = 1e3 * x, 1e6 * rubber, 1e6 * h.max() * (1 - 1 / p)
        axes.fill_between(mm, um, 200, color=COLOURS[5], alpha=0.35, linewidth=0, label="rubber")
        axes.fill_between(mm, -150, 1e6 * h, color="0.75", linewidth=0, label="substrate")
        axes.plot(mm, 1e6 * h, color="0.3", linewidth=1.2, label="$h(x)$")
        axes.plot(mm, um, color=COLOURS[0], linewidth=1.8, label="$h_T(x)$")
        axes.axhline(1e6 * h.max(), color=COLOURS[1], linestyle=":", label=r"$z_{\mathrm{max}}$")
        axes.axhline(mean, color=COLOURS[2], linestyle="--", label=r"$\langle h_T \rangle$")
        axes.set_xlim(0, mm[-1])
        axes.set_ylim(-150, 200)
        axes.set_xlabel("$x$ [mm]")
        axes.set_ylabel("Height $z$ [µm]")
        axes.set_title(title, fontsize="medium")
    figure.legend(
        *panels[0].get_legend_handles_labels(), loc="outside right center", fontsize="small"
    )
    columns = {"x_m": x.tolist(), "height_m": h.tolist(), "transformed_height_m": shifted.tolist()}
    return page(
        "fig02",
        figure,
        {"rms_height_m": inputs.sandpaper.rms_height, "q0_per_m": Q0, "shift_factor": _SHIFT},
        columns,
        "the gap between h and h_T in (b) is where the rubber does not reach",
    )


def fig03(inputs: Inputs) -> Page:
    """A profile through the highest point of the scan, with heights and peaks of the whole scan."""
    scan = inputs.scans[0]
    figure, (left, right) = new_figure(2)
    above = scan.heights - scan.heights.mean()
    row = above[np.unravel_index(above.argmax(), above.shape)[0]]
    x = np.arange(PIXELS) * PIXEL_SIZE
    edges, density = scan.height_histogram(bins=60)
    middle = (edges[1:] + edges[:-1]) / 2
    peaks = located(scan, 1.0)[2].heights
    counts, peak_edges = np.histogram(peaks, bins=12, density=True)
    peak_middle = (peak_edges[1:] + peak_edges[:-1]) / 2
    left.plot(1e3 * x, 1e6 * row, color="0.3", linewidth=0.6)
    left.set_xlim(0, 1e3 * x[-1])
    left.set_xlabel("$x$ [mm]")
    left.set_ylabel("Height $z$ [µm]")
    left.set_title("(a) profile", fontsize="medium")
    right.plot(1e-3 * density, 1e6 * middle, color=COLOURS[0], label="heights")
    right.stairs(
        1e-3 * counts,
        1e6 * peak_edges,
        orientation="horizontal",
        color=COLOURS[1],
        linewidth=1.5,
        label=r"local peaks, $\lambda_0$ apart",
    )
    for axes in (left, right):
        axes.axhline(
            1e6 * peaks.mean(),
            color=COLOURS[1],
            linestyle="--",
            label=r"$\langle h_{\mathrm{Peaks}} \rangle$",
        )
        axes.set_ylim(1.08e6 * scan.z_min, 1.15e6 * scan.z_max)
    right.set_xlim(left=0)
    right.set_xlabel("Probability density [1/mm]")
    right.set_ylabel("Height $z$ [µm]")
    right.set_title("(b) distributions, whole scan", fontsize="medium")
    right.legend(loc="lower right", fontsize="small")
    columns = stacked(
        [
            {"curve": "profile", "x_m": x, "height_m": row},
            {"curve": "heights", "height_m": middle, "density_per_m": density},
            {"curve": "peaks", "height_m": peak_middle, "density_per_m": counts},
        ]
    )
    given = {**sandpaper_inputs(inputs), **scan_inputs(), "min_distance_m": LAMBDA0}
    return page("fig03", figure, {**given, "mean_peak_height_m": float(peaks.mean())}, columns)


def fig06(inputs: Inputs) -> Page:
    """A line scan of the asphalt with a slope and an offset that we add, and without them."""
    figure, panels = new_figure(2)
    row = np.asarray(inputs.asphalt_scans[0].heights[0], dtype=float)
    x = np.arange(PIXELS) * PIXEL_SIZE
    raw = row + _OFFSET + _TILT * x
    flat = np.asarray(LineScan(raw, spacing=PIXEL_SIZE).detrend("plane").heights)
    for axes, heights, title in (
        (panels[0], raw, "(a) with slope and offset"),
        (panels[1], flat, "(b) slope and offset suppressed"),
    ):
        axes.plot(1e3 * x, 1e3 * heights, color=COLOURS[0], linewidth=0.7)
        axes.axhline(0, color="0.5", linewidth=0.8)
        axes.set_xlim(0, 1e3 * x[-1])
        axes.set_xlabel("$x$ [mm]")
        axes.set_ylabel("Height $z$ [mm]")
        axes.set_title(title, fontsize="medium")
    columns = {"x_m": x.tolist(), "height_m": raw.tolist(), "detrended_height_m": flat.tolist()}
    given = {**asphalt_inputs(inputs), **scan_inputs(0.0), "slope": _TILT, "offset_m": _OFFSET}
    return page("fig06", figure, given, columns, "slope and offset are added to a synthetic scan")


def fig07(inputs: Inputs, spectra: Sequence[Spectra]) -> Page:
    """Spectra of synthetic scans of both surfaces, with Eq. 28's lines."""
    figure, panels = new_figure(2)
    curves = []
    for axes, spectrum, mark in zip(panels, spectra, "ab", strict=True):
        _draw_spectrum(axes, spectrum)
        axes.set_title(f"({mark}) {spectrum.name}", fontsize="medium")
        q = spectrum.measured.wavenumber
        shown = q <= np.pi / PIXEL_SIZE
        curves.append(
            {
                "surface": spectrum.name,
                "wavenumber_per_m": q[shown],
                "density_m4": spectrum.measured.density[shown],
                "standard_error_m4": np.asarray(spectrum.measured.standard_error)[shown],
                "reliable": spectrum.measured.reliable[shown].astype(int),
                "synthesized_density_m4": _inside(spectrum, q[shown]),
            }
        )
    given = {
        **scan_inputs(),
        "skewness": "sandpaper as given, asphalt 0",
        **{f"hurst_{s.name}": s.fit.hurst for s in spectra},
        **{f"rms_height_m_{s.name}": s.truth.rms_height for s in spectra},
    }
    return page("fig07", figure, given, stacked(curves))


def _inside(spectrum: Spectra, q: "np.ndarray[tuple[int], np.dtype[np.float64]]") -> list[float]:
    """C of the analytic spectrum, 0 below q0."""
    return [float(spectrum.truth.at(k)) if k >= Q0 else 0.0 for k in q]


def _draw_spectrum(axes: "Axes", spectrum: Spectra) -> None:
    measured, fit = spectrum.measured, spectrum.fit
    good = measured.reliable & (measured.wavenumber >= Q0)
    rest = ~good & (measured.wavenumber <= np.pi / PIXEL_SIZE)
    for rows, colour, label in (
        (good, COLOURS[0], "synthetic scan"),
        (rest, "0.7", "unreliable or below $q_0$"),
    ):
        axes.plot(
            measured.wavenumber[rows],
            measured.density[rows],
            ".",
            markersize=3,
            color=colour,
            label=label,
        )
    whole = np.geomspace(Q0, MAGNIFICATION * Q0, 50)
    axes.plot(whole, spectrum.truth.at(whole), color="0.2", linewidth=1, label="analytic, to $q_1$")
    fitted = np.geomspace(fit.q0, fit.q1, 50)
    axes.plot(
        fitted,
        fit.spectrum.at(fitted),
        "--",
        color=COLOURS[1],
        linewidth=2,
        label=f"Eq. 28: $H$ = {fit.hurst:.3f}",
    )
    axes.axvline(Q0, color="0.5", linestyle=":", label="$q_0$ = 2000/m")
    axes.set_xscale("log")
    axes.set_yscale("log")
    axes.set_xlabel("Wavenumber $q$ [1/m]")
    axes.set_ylabel("Roughness spectrum $C(q)$ [m$^4$]")
    axes.legend(loc="upper right", fontsize="small")
