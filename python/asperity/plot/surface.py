"""Figures of a scan and its spectrum (matplotlib)."""

import math
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from asperity.draw.figure import legend, new_figure, picture
from asperity.draw.style import grey, narrow, palette, paper
from asperity.scene.scan import LAY, Lay, Scan, nyquist
from asperity.self_affine_fit import SelfAffineFit
from asperity.spectrum import TabulatedSpectrum
from asperity.surface import HeightMap, LineScan

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

_MOST_PIXELS = 1000  # of a side, in a picture: a larger map is thinned out
_ABOVE = 10  # points between a panel and its title: the 0 of a map's corner stands there
# inches: of a map, of the scales and the bar beside it, and of the panel of the spectrum
_MAP_HEIGHT, _BESIDE_MAP, _SPECTRUM = 2.7, 1.7, 4.6


def spectrum_figure(
    raw: Scan,
    flat: Scan,
    spectrum: TabulatedSpectrum,
    fit: SelfAffineFit | None,
    cutoff: float | None,
    floor: float | None,
    lay: Lay | None,
    path: Path,
) -> bytes:
    """The scan as measured, without its trend (the article's Fig. 6), and its spectrum up to pi /
    pixel (Fig. 7). `floor` is the wavenumber from which noise is more than half of it."""
    figure, (left, middle, right) = new_figure(3)
    if isinstance(flat, HeightMap) and not narrow():
        _fit_to_maps(figure, flat)
    for axes, scan, title in (
        (left, raw, "(a) as measured"),
        (middle, flat, f"(b) {without_trend(raw)}"),
    ):
        if isinstance(scan, HeightMap):
            draw_map(figure, axes, scan, lay)
        else:
            draw_line(axes, scan)
        axes.set_title(title, fontsize="medium", pad=_ABOVE)
    right.set_title("(c) spectrum", fontsize="medium", pad=_ABOVE)
    draw_spectrum(right, spectrum, fit, cutoff, end=nyquist(flat), floor=floor)
    return picture(figure, path)


def without_trend(raw: Scan) -> str:
    """What was done to a scan that is shown without its trend."""
    return "trend removed" + (", holes filled" if raw.dropout_fraction > 0 else "")


def _fit_to_maps(figure: "Figure", scan: HeightMap) -> None:
    """Give two panels of maps the width that their shape fills, and the spectrum its own."""
    ny, nx = scan.heights.shape
    wide = nx * scan.pixel_size[1] / (ny * scan.pixel_size[0])
    width = float(np.clip(_MAP_HEIGHT * wide, 1.0, 4.0)) + _BESIDE_MAP
    figure.set_size_inches(2 * width + _SPECTRUM, float(figure.get_size_inches()[1]))
    figure.axes[0].get_gridspec().set_width_ratios([width, width, _SPECTRUM])  # type: ignore[union-attr]


def draw_map(figure: "Figure", axes: "Axes", scan: HeightMap, lay: Lay | None = None) -> None:
    """The heights, and the direction of the ridges where there is one."""
    ny, nx = scan.heights.shape
    step = -(-max(ny, nx) // (_MOST_PIXELS // 2 if narrow() else _MOST_PIXELS))
    shown = np.asarray(scan.heights[::step, ::step], dtype=float)
    size = np.array([ny * scan.pixel_size[0], nx * scan.pixel_size[1]])
    length, length_unit = _unit(float(size.max()))
    height, height_unit = _unit(float(np.nanmax(np.abs(shown))))
    low, high = np.nanpercentile(shown / height, [0.2, 99.8])
    axes.set_facecolor(grey(0.6))  # drop-outs
    image = axes.imshow(
        shown / height,
        extent=(0, size[1] / length, size[0] / length, 0),
        cmap="cividis",
        vmin=float(low),
        vmax=float(high),
        interpolation="nearest",
    )
    axes.set_xlabel(f"$x$ [{length_unit}]")
    axes.set_ylabel(f"$y$ [{length_unit}]")
    figure.colorbar(image, ax=axes, label=f"height [{height_unit}]", shrink=0.85)
    if lay is not None and lay.ratio > LAY:
        _draw_lay(axes, lay, size / length)


def _draw_lay(axes: "Axes", lay: Lay, size: NDArray[np.float64]) -> None:
    """A line along the ridges through the middle, with its angle."""
    y, x = size / 2
    step = 0.3 * min(size) * np.array([math.cos(lay.direction), math.sin(lay.direction)])
    for colour, width in ((paper(), 3.5), (palette()[1], 1.8)):
        line = [x - step[0], x + step[0]], [y - step[1], y + step[1]]
        axes.plot(*line, color=colour, linewidth=width, solid_capstyle="round")
    axes.annotate(
        f"lay {lay.degrees:.0f}°",
        (x + step[0], y + step[1]),
        textcoords="offset points",
        xytext=(4, 4),
        fontsize="small",
        bbox={"facecolor": paper(), "alpha": 0.8, "linewidth": 0, "boxstyle": "round,pad=0.2"},
    )


def draw_line(axes: "Axes", scan: LineScan) -> None:
    x = np.arange(scan.heights.size) * scan.spacing
    length, length_unit = _unit(float(x[-1]))
    height, height_unit = _unit(float(np.nanmax(np.abs(scan.heights))))
    axes.plot(x / length, scan.heights / height, color=palette()[0], linewidth=0.7)
    axes.set_xlim(0, float(x[-1]) / length)
    axes.set_xlabel(f"$x$ [{length_unit}]")
    axes.set_ylabel(f"height [{height_unit}]")


def draw_spectrum(
    axes: "Axes",
    spectrum: TabulatedSpectrum,
    fit: SelfAffineFit | None,
    cutoff: float | None,
    *,
    end: float | None = None,
    floor: float | None = None,
) -> None:
    """C(q); `end` is pi / pixel of its scan."""
    q, density, good = spectrum.wavenumber, spectrum.density, spectrum.reliable
    shown = density > 0
    _draw_band(axes, spectrum)
    for rows, colour, label in (
        (good & shown, palette()[0], "measured"),
        (~good & shown, grey(0.65), "flagged: do not trust"),
    ):
        if rows.any():
            axes.plot(q[rows], density[rows], ".", markersize=3, color=colour, label=label)
    if fit is not None:
        fitted = np.geomspace(fit.q0, fit.q1, 200)
        label = f"fit, $H$ = {fit.hurst:.3f} ± {fit.standard_errors['hurst']:.3f}"
        if fit.rolloff is not None:
            label += f"\nroll-off {fit.rolloff:.3g}/m"
        axes.plot(fitted, fit.spectrum.at(fitted), color=palette()[1], linewidth=1.5, label=label)
    if cutoff is not None:
        axes.axvline(cutoff, color=grey(0.4), linestyle="--", label="$q_1$ for rms slope 1.3")
    if end is not None:
        axes.axvline(end / 2, color=grey(0.4), linestyle=":", label="half of π / pixel; π / pixel")
        axes.axvline(end, color=grey(0.4), linestyle=":")
    if floor is not None:
        end_of_rows, colour = float(q[-1]), palette()[1]
        label = "flat: noise, no surface"
        axes.axvspan(floor, end_of_rows, color=colour, alpha=0.15, linewidth=0, label=label)
    axes.set_xscale("log")
    if shown.any():
        axes.set_yscale("log")
    axes.set_xlabel("Wavenumber $q$ [1/m]")
    axes.set_ylabel("Roughness spectrum $C(q)$ [m$^4$]")
    how: dict[str, Any] = {}
    if end is not None:
        slope = f"rms slope {spectrum.rms_slope:.3g} up to π / pixel"
        how = {"title": slope}
    legend(axes, **how)


def _draw_band(axes: "Axes", spectrum: TabulatedSpectrum) -> None:
    """One standard error to either side, where it is less than the density."""
    if spectrum.standard_error is None:
        return
    q, density, error = spectrum.wavenumber, spectrum.density, spectrum.standard_error
    lower: NDArray[np.float64] = np.maximum(density - error, density / 10)
    where = density > 0
    axes.fill_between(
        q[where],
        lower[where],
        (density + error)[where],
        color=palette()[0],
        alpha=0.2,
        linewidth=0,
        label="± standard error",
    )


def _unit(size: float) -> tuple[float, str]:
    """The metric unit in which a length is a number from 1 to 1000."""
    for factor, name in ((1.0, "m"), (1e-3, "mm"), (1e-6, "µm")):
        if size >= factor:
            return factor, name
    return 1e-9, "nm"
