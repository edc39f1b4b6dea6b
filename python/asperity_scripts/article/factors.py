"""Section 6.1 checked: correction factors and contact areas over magnification; Figs 8 to 12."""

from collections import defaultdict
from typing import TYPE_CHECKING, Any

import numpy as np

from asperity.correction import AffineShift, Correction, SFactor
from asperity.draw.figure import legend, new_figure
from asperity.draw.style import grey, palette, paper
from asperity_scripts.article.inputs import (
    LAMBDA0,
    MAGNIFICATION,
    PIXELS,
    PRESSURES,
    SIDE,
    VELOCITY,
    Inputs,
    Model,
    magnifications,
)
from asperity_scripts.article.page import (
    LOG,
    page,
    panel,
    sandpaper_inputs,
    scan_inputs,
    stacked,
    tuned_inputs,
)
from asperity_scripts.article.peaks import located
from asperity_scripts.article.readings import Array
from asperity_scripts.article.separation import shifts
from asperity_scripts.article.statement import Finding, Findings

if TYPE_CHECKING:
    from matplotlib.axes import Axes

_ZETA = magnifications(300)
_GAMMA = 0.5
_S = SFactor(gamma=_GAMMA)  # PF-CF = S A / A0
_WIDE, _NARROW = AffineShift(2.5), AffineShift(2.0)  # p_T1 of Figs 8 and 9, of LP-CF
_MIDDLE = 1  # of PRESSURES, that of Figs 8 and 9
_SHOWN = 8  # lambda0 of the map, a corner of it
_MPA = [f"{pressure / 1e6:g} MPa" for pressure in PRESSURES]
_FACTOR = {**LOG, "xlabel": "Magnification $q / q_0$ [-]", "ylabel": "Correction factor CF [-]"}
_AREA = {**_FACTOR, "ylabel": "Relative contact area $A / A_0$ [-]"}
_PF_CF = rf"PF-CF, $\gamma$ = {_GAMMA}"


def findings(inputs: Inputs) -> Findings:
    """What Section 6.1 and the conclusions say of S, of matches, penetration and areas."""
    findings: dict[str, dict[str, Finding]] = defaultdict(dict)
    for name, model in inputs.compounds.items():
        area, persson = model.area(_ZETA), model.cf(_ZETA, _S)
        s, end = persson / area, _ZETA[-1:]
        gamma = _ZETA[np.argmax(s < 1.01 * _GAMMA, axis=1)]  # from where on S is near gamma
        low = model.cf(end, SFactor(gamma=0.4))[:, 0] / persson[:, -1] - 1
        wide, narrow = (model.cf(_ZETA, shift) / persson - 1 for shift in (_WIDE, _NARROW))
        beyond = [np.flatnonzero(np.abs(row) > 0.05)[-1] + 1 for row in narrow]
        matches = np.abs(narrow[:, -1]).max() < 0.05, np.abs(narrow).max() < 0.05
        findings["C1"][name] = Finding(np.all(s[area < 1] > 1), s=s[area < 1])
        findings["C2"][name] = Finding(gamma.max() < MAGNIFICATION**0.1, gamma=gamma)
        findings["C5"][name] = Finding(np.abs(low).max() < 0.1, low=low)
        findings["C6"][name] = Finding(
            np.abs(wide[:, -1]).min() > 0.05, end=wide[0, -1], q0=wide[0, 0]
        )
        findings["C7"][name] = Finding(
            matches, end=_largest(narrow[:, -1]), most=_largest(narrow), near=_ZETA[beyond]
        )
    for name, model in inputs.models.items():
        complete: dict[str, Correction] = {"pf": _S, "igw": model.correction, "lp": _NARROW}
        left = {n: model.cf(_ZETA[-1:], c, [1e12])[0, 0] for n, c in complete.items()}
        area, larger = model.area(_ZETA), model.area(_ZETA, model.correction)
        igw, p = model.cf(_ZETA, model.correction), _shift(model)
        ratio, off = igw[:, -1] / area[:, -1], (igw / model.cf(_ZETA, _S))[:, -1] - 1
        near, gain = np.abs(off), larger / area
        depth = (model.correction.z_max - model.correction.z_min) / p
        up = np.all(gain[area < 1] > 1), np.all(np.diff(gain[:, -1]) < 0)
        findings["C4"][name] = Finding([factor > 0.99 for factor in left.values()], **left)
        findings["C8"][name] = Finding(np.abs(ratio / _GAMMA - 1) < 0.1, ratio=ratio, p=p)
        findings["C9"][name] = Finding(np.all(near[1:] < 0.1), near[0] > near[1:].max(), off=off)
        findings["C11"][name] = Finding(depth[0] < depth[1:].min(), depth=1e6 * depth)
        findings["C14"][name] = Finding(up, gain=gain[:, -1], more=(larger - area)[:, -1])
    return findings


def fig08(inputs: Inputs) -> dict[str, bytes]:
    """Peaks no closer than lambda0, and the factor that p_T1 gives."""
    return _local("fig08", inputs, 1.0, _WIDE)


def fig09(inputs: Inputs) -> dict[str, bytes]:
    """Peaks no closer than lambda0 / 2."""
    return _local("fig09", inputs, 0.5, _NARROW)


def fig10(inputs: Inputs) -> dict[str, bytes]:
    """Area with the local peaks' p_T1 beside the original one."""
    facts, label = {"p_t1": _NARROW.p, **_facts(inputs)}, f"modified, $p_{{T1}}$ = {_NARROW.p:g}"
    return _areas("fig10", facts, inputs.tuned["implicit"], _NARROW, label)


def fig11(inputs: Inputs) -> dict[str, bytes]:
    """IGW-CF beside PF-CF at three pressures."""
    figure, panels = new_figure(3)
    model = inputs.tuned["implicit"]
    curves = {"pf_cf": model.cf(_ZETA, _S), "igw_cf": model.cf(_ZETA, model.correction)}
    limits = 0.7 * curves["pf_cf"].min(), 1.5
    rows = zip(panels, _MPA, *curves.values(), model.implied.shift_factor, strict=True)
    for axes, load, persson, improved, p in rows:
        axes.plot(_ZETA, persson, color=palette()[0], label=_PF_CF)
        axes.plot(_ZETA, improved, "--", color=palette()[1], label=f"IGW-CF, $p_T$ = {p:.2f}")
        panel(axes, load, "best", **_FACTOR, ylim=limits)
    return page("fig11", figure, _facts(inputs), _columns(curves))


def fig12(inputs: Inputs) -> dict[str, bytes]:
    model = inputs.tuned["implicit"]
    return _areas("fig12", _facts(inputs), model, model.correction, "modified, IGW")


def _local(name: str, inputs: Inputs, distance: float, printed: AffineShift) -> dict[str, bytes]:
    model, scan = inputs.tuned["implicit"], inputs.scans[0]
    x, y, peaks = located(scan, distance)
    shift = peaks.shift_factor
    factors: dict[str, Correction] = {
        "pf_cf": _S,
        "lp_cf_printed": printed,
        "lp_cf_scan": AffineShift(shift),
    }
    curves = {which: model.cf(_ZETA, factor)[_MIDDLE] for which, factor in factors.items()}
    figure, (left, right) = new_figure(2)
    _draw_corner(left, scan.heights - scan.heights.mean(), x, y)
    apart = r"$\lambda_0$" if distance == 1 else rf"{distance:g} $\lambda_0$"
    panel(left, f"(a) peaks no closer than {apart}, a corner", xlabel="$x$ [mm]", ylabel="$y$ [mm]")
    labels = (
        _PF_CF,
        f"LP-CF, $p_{{T1}}$ = {printed.p:g} (printed)",
        f"LP-CF, $p_{{T1}}$ = {shift:.2f} (this scan)",
    )
    lines = zip(curves.values(), ("-", "--", ":"), labels, palette(), strict=False)
    for row, dash, label, colour in lines:
        right.plot(_ZETA, row, dash, color=colour, label=label)
    panel(right, f"(b) {_MPA[_MIDDLE]}, {VELOCITY:g} m/s", "best", **_FACTOR)
    facts = {
        **_facts(inputs),
        **scan_inputs(),
        "min_distance_m": distance * LAMBDA0,
        "p_t1_printed": printed.p,
        "p_t1_scan": shift,
        "pressure_pa": PRESSURES[_MIDDLE],
    }
    parts: list[dict[str, Any]] = [
        {"part": "peaks", "x_m": x, "y_m": y, "height_m": peaks.heights},
        {"part": "factors", "magnification": _ZETA, **curves},
    ]
    return page(name, figure, facts, stacked(parts))


def _draw_corner(axes: "Axes", heights: Array, x: Array, y: Array) -> None:
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
    axes.plot(1e3 * x, 1e3 * y, "o", color=palette()[1], markersize=4, markeredgecolor=paper())
    axes.set(xlim=(0, side), ylim=(side, 0))
    axes.figure.colorbar(image, ax=axes, label="Height $z$ [µm]", shrink=0.9)


def _areas(
    name: str, facts: dict[str, Any], model: Model, correction: Correction, label: str
) -> dict[str, bytes]:
    figure, (axes,) = new_figure(1)
    before, after = model.area(_ZETA), model.area(_ZETA, correction)
    for load, original, modified, colour in zip(_MPA, before, after, palette(), strict=False):
        axes.plot(_ZETA, original, color=colour, label=load)
        axes.plot(_ZETA, modified, "--", color=colour)
    for dash, text in (("-", "original"), ("--", label)):
        axes.plot([], [], dash, color=grey(0.3), label=text)
    panel(axes, f"{VELOCITY:g} m/s", **_AREA)
    legend(axes)
    return page(name, figure, facts, _columns({"original_area": before, "modified_area": after}))


def _columns(curves: dict[str, Array]) -> dict[str, list[Any]]:
    return stacked(
        [
            {"pressure_pa": pressure, "magnification": _ZETA}
            | {name: rows[k] for name, rows in curves.items()}
            for k, pressure in enumerate(PRESSURES)
        ]
    )


def _facts(inputs: Inputs) -> dict[str, Any]:
    tuned = tuned_inputs(inputs.tuned["implicit"])
    return {**sandpaper_inputs(inputs), **tuned, "velocity_m_s": VELOCITY, "gamma": _GAMMA}


def _shift(model: Model) -> Array:
    """p_T2 at 0.1 m/s, at the three pressures."""
    return shifts(model, np.array(PRESSURES), np.array([VELOCITY]))[1][:, 0]


def _largest(difference: Array) -> float:
    """That which is farthest from 0."""
    return float(difference.flat[np.abs(difference).argmax()])
