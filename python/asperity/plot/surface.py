"""Figures of a scan and its spectrum (matplotlib)."""

import math
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from asperity.draw.figure import legend, new_figure, picture
from asperity.draw.style import Axes, Figure, grey, narrow, palette, paper
from asperity.scene.scan import LAY, Lay, Scan, nyquist
from asperity.self_affine_fit import SelfAffineFit
from asperity.spectrum import TabulatedSpectrum
from asperity.surface import HeightMap, metric_unit

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
        draw_scan(axes, scan, lay)
        axes.set_title(title, fontsize="medium", pad=_ABOVE)
    right.set_title("(c) spectrum", fontsize="medium", pad=_ABOVE)
    draw_spectrum(right, spectrum, fit, cutoff, end=nyquist(flat), floor=floor)
    return picture(figure, path)


def without_trend(raw: Scan) -> str:
    """What was done to a scan that is shown without its trend."""
    return "trend removed" + (", holes filled" if raw.dropout_fraction > 0 else "")


def _fit_to_maps(figure: Figure, scan: HeightMap) -> None:
    """Give two panels of maps the width that their shape fills, and the spectrum its own."""
    ny, nx = scan.heights.shape
    wide = nx * scan.pixel_size[1] / (ny * scan.pixel_size[0])
    width = float(np.clip(_MAP_HEIGHT * wide, 1.0, 4.0)) + _BESIDE_MAP
    figure.set_size_inches(2 * width + _SPECTRUM, float(figure.get_size_inches()[1]))
    figure.axes[0].get_gridspec().set_width_ratios([width, width, _SPECTRUM])  # type: ignore[union-attr]


def draw_scan(axes: Axes, scan: Scan, lay: Lay | None = None) -> None:
    """The heights, and the direction of the ridges where there is one."""
    scan.plot(axes)
    if not isinstance(scan, HeightMap):
        axes.lines[0].set_color(palette()[0])
        axes.margins(x=0)
        return
    axes.set_facecolor(grey(0.6))  # drop-outs
    if lay is not None and lay.ratio > LAY:
        size = np.multiply(scan.heights.shape, scan.pixel_size)
        _draw_lay(axes, lay, size / metric_unit(float(size.max()))[0])


def _draw_lay(axes: Axes, lay: Lay, size: NDArray[np.float64]) -> None:
    """A line along the ridges through the middle, with its angle."""
    y, x = size / 2
    step = 0.3 * min(size) * np.array([math.cos(lay.direction), math.sin(lay.direction)])
    for colour, width in ((paper(), 3.5), (palette()[1], 1.8)):
        line = [x - step[0], x + step[0]], [y - step[1], y + step[1]]
        axes.plot(*line, color=colour, linewidth=width, solid_capstyle="round")
    box = {"facecolor": paper(), "alpha": 0.8, "linewidth": 0, "boxstyle": "round,pad=0.2"}
    look: Any = {"xytext": (4, 4), "textcoords": "offset points", "fontsize": "small", "bbox": box}
    axes.annotate(f"lay {lay.degrees:.0f}°", (x + step[0], y + step[1]), **look)


def draw_spectrum(
    axes: Axes,
    spectrum: TabulatedSpectrum,
    fit: SelfAffineFit | None,
    cutoff: float | None,
    *,
    end: float | None = None,
    floor: float | None = None,
) -> None:
    """C(q); `end` is pi / pixel of its scan."""
    axes.set_prop_cycle(color=palette())
    spectrum.plot(axes)
    if (drawn := axes.get_legend()) is not None:
        drawn.remove()  # that of a figure stands above its panel
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
        look: Any = {"color": palette()[1], "alpha": 0.15, "linewidth": 0}
        axes.axvspan(floor, float(spectrum.wavenumber[-1]), label="flat: noise, no surface", **look)
    title = f"rms slope {spectrum.rms_slope:.3g} up to π / pixel"
    legend(axes, **({} if end is None else {"title": title}))
