"""Section 2 checked: the area, the distribution of the pressure and Eq. 7; Fig. 1."""

from collections import defaultdict
from typing import Any

import numpy as np
from numpy.typing import NDArray

from asperity.contact import contact_area, mean_pressure, pressure_distribution
from asperity.draw.figure import new_figure
from asperity.draw.style import grey, palette
from asperity_scripts.article.inputs import (
    LAMBDA0,
    PIXEL_SIZE,
    PIXELS,
    PRESSURES,
    Q0,
    SIDE,
    VELOCITY,
    Inputs,
    magnifications,
)
from asperity_scripts.article.page import (
    page,
    panel,
    sandpaper_inputs,
    scan_inputs,
    stacked,
    tuned_inputs,
)
from asperity_scripts.article.readings import Array
from asperity_scripts.article.statement import Finding, Findings

_ZETA = (1.5, 5.0, 25.0)  # of Fig. 1
_SLIDING: dict[str, Any] = {"pressure": 0.5e6, "velocity": 1e-3}  # of Fig. 1
_SHOWN = 5  # lambda0 of the scan


def findings(inputs: Inputs) -> Findings:
    """Section 2 on the sandpaper with compound A at 0.1 m/s."""
    findings: dict[str, dict[str, Finding]] = defaultdict(dict)
    zeta, pressure = magnifications(200)[-2:], np.geomspace(0.4e6, 1e11, 400)
    heavy: dict[str, Any] = {"pressure": PRESSURES[-1], "velocity": VELOCITY}
    for name, model in inputs.compounds.items():
        theory = model.surface, model.rubber
        slope = np.diff(np.log(model.area(zeta)))[:, 0] / np.diff(np.log(zeta))
        levels = np.all(slope < 0), np.all(np.abs(slope) < 0.05)
        far = 5 * mean_pressure(*theory, **heavy)
        density = pressure_distribution(far, *theory, **heavy, rtol=1e-12)
        exact, rough = (
            contact_area(*theory, pressure=pressure, velocity=VELOCITY, form=form)
            for form in ("exact", "interpolated")
        )
        error, least = rough / exact - 1, exact.min()
        findings["T3"][name] = Finding(levels, slope=slope)
        findings["T8"][name] = Finding(density == 0, density=density, stress=far / 1e6)
        findings["T9"][name] = Finding(np.abs(error).max() < 0.03, error=error, least=least)
    return findings


def fig01(inputs: Inputs) -> dict[str, bytes]:
    """Contact patches at three magnifications above, the distribution of their pressure below.

    A(q)/A0 and P(sigma) are the theory's. Where the patches lie it does not say: drawn is the
    highest part of that size of the scan without its waves above q, within the patches before.
    """
    from matplotlib.colors import ListedColormap

    tuned, load = inputs.tuned["implicit"], _SLIDING["pressure"]
    theory = tuned.surface, tuned.rubber
    figure, panels = new_figure(6)
    stress, side = np.linspace(0, 70, 701) * load, 1e3 * _SHOWN * LAMBDA0
    touching = np.ones((PIXELS, PIXELS), dtype=bool)
    curves, shown = [], _SHOWN * PIXELS // SIDE
    areas = contact_area(*theory, **_SLIDING, wavenumber=np.array(_ZETA) * Q0).tolist()
    rows = zip(panels[:3], panels[3:], _ZETA, areas, "abc", strict=True)
    for upper, lower, zeta, area, mark in rows:
        density = pressure_distribution(stress, *theory, **_SLIDING, wavenumber=zeta * Q0)
        touching = _highest(_smooth(inputs.scans[0].heights, zeta * Q0), touching, area)
        upper.imshow(
            np.where(touching[:shown, :shown], 1.0, 0.0),
            extent=(0, side, side, 0),
            cmap=ListedColormap([grey(0.9), palette()[0]]),  # no contact, contact
            vmin=0,
            vmax=1,
            interpolation="nearest",
        )
        title = f"({mark}) $q/q_0$ = {zeta:g}, $A/A_0$ = {area:.3f}"
        panel(upper, title, xlabel="$x$ [mm]", ylabel="$y$ [mm]")
        lower.plot(stress / load, load * density, color=palette()[0], label=f"{zeta:g} $q_0$")
        label = r"$q_0$: all at $\sigma_0$"
        lower.axvline(1, color=grey(0.4), linestyle="--", linewidth=1, label=label)
        lower.set_ylim(bottom=0)
        panel(
            lower,
            f"{load / 1e6:g} MPa, {_SLIDING['velocity']:g} m/s",
            "upper right",
            xlim=(0, stress[-1] / load),
            xlabel=r"Local pressure $\sigma / \sigma_0$ [-]",
            ylabel=r"Distribution $\sigma_0 P(\sigma)$ [-]",
        )
        point = {"magnification": zeta, "contact_area": area}
        curves.append({**point, "stress_pa": stress, "density_per_pa": density})
    facts = {**sandpaper_inputs(inputs), **tuned_inputs(tuned), **scan_inputs()}
    facts |= {"pressure_pa": load, "velocity_m_s": _SLIDING["velocity"]}
    note = (
        "patches in the picture: the highest A(q)/A0 of the scan smoothed at q, within the patches "
        "before; the theory gives their area, not their place"
    )
    return page("fig01", figure, facts, stacked(curves), note)


def _smooth(heights: Array, cutoff: float) -> Array:
    """A periodic map without its waves above `cutoff` [1/m]."""
    q = 2 * np.pi * np.fft.fftfreq(PIXELS, PIXEL_SIZE)
    half = 2 * np.pi * np.fft.rfftfreq(PIXELS, PIXEL_SIZE)
    modes = np.fft.rfft2(heights)
    modes[np.hypot(q[:, None], half) > cutoff] = 0
    return np.asarray(np.fft.irfft2(modes, s=heights.shape))


def _highest(heights: Array, within: NDArray[np.bool_], share: float) -> NDArray[np.bool_]:
    """The highest points of a part of the map, as many as `share` of the whole."""
    count = round(share * heights.size)
    threshold = np.partition(heights[within], -count)[-count]
    return np.asarray(within & (heights >= threshold))
