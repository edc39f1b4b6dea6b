"""The picture of what makes the friction of a scene: what 10 % of each decade is worth."""

from pathlib import Path

import numpy as np

from asperity.base.arguments import known
from asperity.base.quantities import ZERO_CELSIUS
from asperity.draw.figure import new_figure, picture
from asperity.draw.style import Axes, grey, palette
from asperity.scene.design import Design, Worth

_BARS = 0.8  # of a decade


def design_figure(design: Design, path: Path) -> bytes:
    """Bars by decade of frequency and of wavelength at the point with the largest mu."""
    result = design.result
    at = np.unravel_index(int(np.argmax(result.mu)), np.shape(result.mu))
    point = float(result.pressure[at]), float(result.velocity[at])
    here = [one for one in design.worths if (one.pressure, one.velocity) == point]
    percent = 100 / result.mu[at] if result.mu[at] > 0 else 0.0
    figure, (first, second) = new_figure(2)
    second.sharey(first)
    for place, (part, label, colour) in enumerate(
        (("storage", "$E$′", palette()[0]), ("loss", "$E$″", palette()[3]))
    ):
        rows = [one for one in here if one.part == part]
        height = [percent * one.mu for one in rows]
        bars = np.log10([known(one.lower) for one in rows]) + 0.1 + place * _BARS / 2
        first.bar(bars, height, _BARS / 2, align="edge", color=colour, label=label)
    decades = np.log10([known(one.lower) for one in here if one.part in ("storage", "loss")])
    first.set_xticks(np.arange(decades.min(), decades.max() + 2))
    first.set_xlabel(r"decade of $\omega a_T$, $\log_{10}$ (rad/s)")
    _name_temperatures(first, [one for one in here if one.part == "loss"])
    first.legend(frameon=False, loc="lower left")
    waves = [one for one in here if one.part == "spectrum"]
    ends = np.log10([1e6 * known(one.lower) for one in waves])
    height = [percent * one.mu for one in waves]
    second.bar(ends + 0.1, height, _BARS, align="edge", color=palette()[1])
    second.set_xticks(np.arange(ends.min(), ends.max() + 2))
    second.set_xlabel(r"decade of wavelength, $\log_{10}$ (µm)")
    title = f"$\\mu$ = {result.mu[at]:.3g} at {point[0] / 1e3:.4g} kPa, {point[1]:.3g} m/s"
    second.set_title(title, fontsize="medium")
    for axes in (first, second):
        axes.axhline(0, color=grey(0.4), linewidth=0.8)
        axes.set_ylabel(r"$\Delta\mu / \mu$ of 10 % more [%]")
    return picture(figure, path)


def _name_temperatures(axes: Axes, rows: list[Worth]) -> None:
    """Above each decade the temperature that it has in a DMA at 10 Hz, as far as it is known."""
    here = [one for one in rows if one.temperature is not None]
    if not here:
        return
    top = axes.secondary_xaxis("top")
    places = [float(np.log10(known(one.lower))) + 0.5 for one in here]
    celsius = [round(known(one.temperature) - ZERO_CELSIUS) for one in here]
    top.set_xticks(places, [f"{one}".replace("-", "−") for one in celsius])
    top.set_xlabel("temperature in a DMA at 10 Hz [°C]")
