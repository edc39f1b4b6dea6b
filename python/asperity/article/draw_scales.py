"""Fig. 1: contact patches and pressure distributions at three magnifications."""

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from asperity._core import contact_area, pressure_distribution
from asperity.article.inputs import LAMBDA0, PIXEL_SIZE, PIXELS, Q0, SIDE, Inputs
from asperity.article.page import (
    Page,
    page,
    sandpaper_inputs,
    scan_inputs,
    stacked,
    tuned_inputs,
)
from asperity.plot.curves import COLOURS, new_figure

if TYPE_CHECKING:
    from matplotlib.colors import ListedColormap

_Array = NDArray[np.float64]
_ZETA = (1.5, 5.0, 25.0)
_PRESSURE, _VELOCITY = 0.5e6, 1e-3
_SHOWN = 5  # lambda0 of the scan


def fig01(inputs: Inputs) -> Page:
    """Patches above, the distribution of their pressure below.

    A(q)/A0 and P(sigma) are the theory's. Where the patches lie it does not say: drawn is the
    highest part of that size of the scan without its waves above q, within the patches before.
    """
    areas = contact_area(
        inputs.sandpaper,
        inputs.rubber,
        pressure=_PRESSURE,
        velocity=_VELOCITY,
        wavenumber=np.array(_ZETA) * Q0,
    )
    figure, panels = new_figure(6)
    stress = np.linspace(0, 70, 701) * _PRESSURE
    touching = np.ones((PIXELS, PIXELS), dtype=bool)
    curves = []
    shown = _SHOWN * PIXELS // SIDE
    for upper, lower, zeta, area, mark in zip(
        panels[:3], panels[3:], _ZETA, areas, "abc", strict=True
    ):
        touching = _highest(_smooth(inputs.scans[0].heights, zeta * Q0), touching, float(area))
        upper.imshow(
            np.where(touching[:shown, :shown], 1.0, 0.0),
            extent=(0, 1e3 * _SHOWN * LAMBDA0, 1e3 * _SHOWN * LAMBDA0, 0),
            cmap=_two_colours(),
            vmin=0,
            vmax=1,
            interpolation="nearest",
        )
        upper.set_xlabel("$x$ [mm]")
        upper.set_ylabel("$y$ [mm]")
        upper.set_title(f"({mark}) $q/q_0$ = {zeta:g}, $A/A_0$ = {area:.3f}", fontsize="medium")
        density = np.asarray(
            pressure_distribution(
                stress,
                inputs.sandpaper,
                inputs.rubber,
                pressure=_PRESSURE,
                velocity=_VELOCITY,
                wavenumber=zeta * Q0,
            )
        )
        lower.plot(
            stress / _PRESSURE, _PRESSURE * density, color=COLOURS[0], label=f"{zeta:g} $q_0$"
        )
        lower.axvline(
            1, color="0.4", linestyle="--", linewidth=1, label=r"$q_0$: all at $\sigma_0$"
        )
        lower.set_xlim(0, stress[-1] / _PRESSURE)
        lower.set_ylim(bottom=0)
        lower.set_xlabel(r"Local pressure $\sigma / \sigma_0$ [-]")
        lower.set_ylabel(r"Distribution $\sigma_0 P(\sigma)$ [-]")
        lower.set_title(f"{_PRESSURE / 1e6:g} MPa, {_VELOCITY:g} m/s", fontsize="medium")
        lower.legend(fontsize="small", loc="upper right")
        curves.append(
            {
                "magnification": zeta,
                "contact_area": float(area),
                "stress_pa": stress,
                "density_per_pa": density,
            }
        )
    given = {
        **sandpaper_inputs(inputs),
        **tuned_inputs(inputs.tuned["implicit"]),
        **scan_inputs(),
        "pressure_pa": _PRESSURE,
        "velocity_m_s": _VELOCITY,
    }
    note = (
        "patches in the picture: the highest A(q)/A0 of the scan smoothed at q, within the patches "
        "before; the theory gives their area, not their place"
    )
    return page("fig01", figure, given, stacked(curves), note)


def _smooth(heights: _Array, cutoff: float) -> _Array:
    """A periodic map without its waves above `cutoff` [1/m]."""
    q = 2 * np.pi * np.fft.fftfreq(PIXELS, PIXEL_SIZE)
    half = 2 * np.pi * np.fft.rfftfreq(PIXELS, PIXEL_SIZE)
    modes = np.fft.rfft2(heights)
    modes[np.hypot(q[:, None], half) > cutoff] = 0
    return np.asarray(np.fft.irfft2(modes, s=heights.shape))


def _highest(heights: _Array, within: NDArray[np.bool_], share: float) -> NDArray[np.bool_]:
    """The highest points of a part of the map, as many as `share` of the whole."""
    count = round(share * heights.size)
    threshold = np.partition(heights[within], -count)[-count]
    return np.asarray(within & (heights >= threshold))


def _two_colours() -> "ListedColormap":
    """No contact, contact."""
    from matplotlib.colors import ListedColormap

    return ListedColormap(["0.9", COLOURS[0]])
