"""Sections 4, 6.2 and 7 checked: friction of compound B on asphalt; Fig. 15 and Table 1."""

import re
from collections import defaultdict
from collections.abc import Mapping, Sequence
from itertools import groupby
from operator import itemgetter
from typing import TYPE_CHECKING, Any

import numpy as np

from asperity.correction import Correction, GreenwoodWilliamson, SFactor
from asperity.draw.figure import COLUMN, new_figure
from asperity.draw.style import narrow, palette
from asperity.friction import Friction, friction
from asperity.spectrum import SelfAffineSpectrum
from asperity_scripts.article.flash import cold, heated, hot_columns, rise
from asperity_scripts.article.inputs import (
    ADHESION,
    ASPHALT_PRESSURE,
    MAGNIFICATION,
    Q0,
    Inputs,
    heights_of,
)
from asperity_scripts.article.page import asphalt_inputs, page, panel, stacked
from asperity_scripts.article.readings import READINGS, Array, Reading
from asperity_scripts.article.statement import Finding, Findings
from asperity_scripts.article.surfaces import printed_eq12

if TYPE_CHECKING:
    from matplotlib.figure import Figure

# The article's q1, and that of the rule it cites.
_CUTOFFS = (f"{MAGNIFICATION:g} q0", "rms slope 1.3")
_VELOCITY = np.geomspace(1e-6, 10, 57)  # m/s
_SHARES = (1e-5, 1e-3, 1e-1, 1.0)  # m/s, at which shares of the adhesion are listed
_LISTED = (1e-3, 1e-2, 1e-1, 1.0)  # m/s, of Table 1's friction
_VALUES = ("mu", "hysteresis", "adhesion", "contact_area", "shift_factor")
_WIDTHS = (0.42, 0.14, 0.12, 0.08, 0.24)  # shares, of Table 1's columns
_WIDTHS_NARROW = (0.58, 0.17, 0.16, 0.09)
_Row = tuple[str, str, float, str, str]  # quantity, symbol, value, unit, source


def compute(inputs: Inputs) -> Mapping[str, Mapping[str, Friction]]:
    """Friction over velocity, by cut-off and by correction: plain Persson ("original"), IGW in both
    readings, and the S factor with gamma 0.4 and 0.5."""
    corrections: dict[str, Correction | None] = {"original": None}
    corrections |= {reading: _of_asphalt(inputs, reading) for reading in READINGS}
    corrections |= {f"gamma {gamma}": SFactor(gamma=gamma) for gamma in (0.4, 0.5)}
    return {
        name: {
            which: friction(
                surface,
                inputs.compound_b,
                pressure=ASPHALT_PRESSURE,
                velocity=_VELOCITY,
                correction=correction,
                adhesion=ADHESION,
            )
            for which, correction in corrections.items()
        }
        for name, surface in _surfaces(inputs).items()
    }


def _surfaces(inputs: Inputs) -> Mapping[str, SelfAffineSpectrum]:
    road = inputs.asphalt
    return dict(zip(_CUTOFFS, (road, road.truncated(q1=road.cutoff_for_slope())), strict=True))


def _of_asphalt(inputs: Inputs, reading: Reading) -> GreenwoodWilliamson:
    """IGW with the mean extremes of the synthetic scans and all of the published rms height."""
    return heights_of(inputs.asphalt_scans, reading, inputs.asphalt.rms_height)


def findings(inputs: Inputs) -> Findings:
    """Cut-offs, hysteresis and adhesion, with the article's cut-off and that of its rule."""
    findings: dict[str, dict[str, Finding]] = defaultdict(dict)
    for name, surface in (("sandpaper", inputs.sandpaper), ("asphalt", inputs.asphalt)):
        q1 = surface.cutoff_for_slope(1.3) / Q0
        findings["F1"][name] = Finding(
            abs(q1 / MAGNIFICATION - 1) < 0.1, q1=q1, slope=surface.rms_slope
        )
    curves = compute(inputs)
    for cutoff, theories in curves.items():
        plain, low, high = (theories[n] for n in ("original", "gamma 0.4", "gamma 0.5"))
        less = low.hysteresis / high.hysteresis - 1
        findings["F3"][cutoff] = Finding(np.all(np.abs(less) < 0.1), less=less)
        for reading in READINGS:
            name, modified = f"{cutoff}, {reading}", theories[reading]
            ratio, total = plain.hysteresis / modified.hysteresis, plain.mu / modified.mu
            share = modified.adhesion / modified.mu
            rising = _VELOCITY[1:][np.diff(share) >= 0]
            findings["F4"][name] = Finding(np.all(ratio > 1), ratio=ratio)
            findings["F5"][name] = Finding(
                np.all(total > 1), ratio=total, less=_VELOCITY[total < 1]
            )
            findings["F6"][name] = Finding(
                rising.size == 0, share=100 * _at(share, _SHARES), rising=rising
            )
    article, rule = (theories["original"].hysteresis for theories in curves.values())
    hot = heated(_surfaces(inputs), _VELOCITY)
    findings["F4"][""] = Finding(
        cutoff=rule / article,
        heat=np.stack([one.hysteresis / cold(one).hysteresis for one in hot.values()]).ravel(),
    )
    changed = [one.mu / cold(one).mu - 1 for one in hot.values()]
    findings["F5"][""] = Finding(
        heat=np.concatenate([_at(change, _SHARES) for change in changed]),
        rise=np.concatenate([_at(rise(one), _SHARES) for one in hot.values()]),
    )
    return findings


def _at(values: Array, velocity: Sequence[float]) -> Array:
    """Values at velocities that are points of the curve."""
    return np.asarray([values[np.abs(_VELOCITY - v).argmin()] for v in velocity])


def fig15(inputs: Inputs) -> dict[str, bytes]:
    """The original theory and the modified one."""
    figure, panels = new_figure(2)
    results = compute(inputs)
    hot = _hot_theories(inputs)
    curves = results[_CUTOFFS[0]]
    theories = {"original": "(a) original theory", "implicit": "(b) modified, IGW"}
    for axes, (name, title) in zip(panels, theories.items(), strict=True):
        for label, values, dash, colour in (
            ("total", curves[name].mu, "-", palette()[0]),
            ("hysteresis", curves[name].hysteresis, "--", palette()[1]),
            ("adhesion", curves[name].adhesion, "--", palette()[4]),
        ):
            axes.plot(_VELOCITY, values, dash, color=colour, label=label)
        heat = hot[name][_CUTOFFS[0]].mu
        axes.plot(_VELOCITY, heat, ":", color=palette()[0], label="total, with flash heat")
        axes.text(
            0.03,
            0.96,
            "measured points of\nthe article's Fig. 15\nare not at hand:\nnone shown",
            transform=axes.transAxes,
            va="top",
            fontsize="small",
        )
        panel(
            axes,
            title,
            "upper right",
            xscale="log",
            xlim=(_VELOCITY[0], _VELOCITY[-1]),
            ylim=(0, 1.5 * np.max(curves["original"].mu)),
            xlabel="Sliding velocity $v$ [m/s]",
            ylabel=r"Friction coefficient $\mu$ [-]",
        )
    names = {"original": "original", "implicit": "modified, implicit", "added": "modified, added"}
    columns = stacked(
        [
            {
                "theory": names[which],
                "cutoff": cutoff,
                "velocity_m_s": _VELOCITY,
                **{value: getattr(theories[which], value) for value in _VALUES},
                **hot_columns(hot[which][cutoff]),
            }
            for cutoff, theories in results.items()
            for which in names
        ]
    )
    note = "the measured points of the article's Fig. 15 are not at hand: none are given"
    return page("fig15", figure, _facts(inputs), columns, note)


def table1(inputs: Inputs) -> dict[str, bytes]:
    """Table 1 as printed, and what follows from it."""
    rows = [*_parameters(inputs), *_frictions(compute(inputs)), *_hot_rows(inputs)]
    figure = draw_table(rows)
    titles = ("quantity", "symbol", "value", "unit", "source")
    columns: dict[str, list[Any]] = dict(
        zip(titles, map(list, zip(*rows, strict=True)), strict=True)
    )
    for title in ("symbol", "unit"):
        columns[title] = [re.sub(r"[$\\]", "", cell) for cell in columns[title]]
    return page("table1", figure, _facts(inputs), columns)


def draw_table(rows: Sequence[_Row]) -> "Figure":
    """Rows under one another; in a single column their sources are headings between them."""
    from matplotlib.transforms import Bbox

    figure, (axes,) = new_figure(1)
    axes.set_axis_off()
    cells = [[name, symbol, f"{value:.4g}", *rest] for name, symbol, value, *rest in rows]
    heads = ["Quantity", "Symbol", "Value", "Unit", "From"]
    size, height = (6, 0.17) if narrow() else (9, 0.27)
    if narrow():
        heads.pop()
        by_source = groupby(cells, key=itemgetter(-1))
        cells = [row for source, of in by_source for row in _headed(source, list(of))]
    figure.set_size_inches(COLUMN if narrow() else 8.4, height * len(cells) + 0.6)
    drawn = axes.table(
        cells,
        colLabels=heads,
        colWidths=_WIDTHS_NARROW if narrow() else _WIDTHS,
        cellLoc="left",
        colLoc="left",
        edges="horizontal",
        bbox=Bbox.from_bounds(0, 0, 1, 1),
    )
    drawn.auto_set_font_size(False)
    drawn.set_fontsize(size)
    for cell in drawn.get_celld().values():
        cell.PAD = 0.02
    return figure


def _headed(source: str, rows: Sequence[Sequence[str]]) -> list[list[str]]:
    """Rows without their source, below a row that names it."""
    return [[f"{source}:", "", "", ""], *(list(row[:-1]) for row in rows)]


def _facts(inputs: Inputs) -> dict[str, Any]:
    igw = _of_asphalt(inputs, "implicit")
    return {
        **asphalt_inputs(inputs),
        "compound": "B",
        "pressure_pa": ASPHALT_PRESSURE,
        "shear_stress_pa": ADHESION.shear_stress,
        "reference_velocity_m_s": ADHESION.reference_velocity,
        "width": ADHESION.width,
        "z_max_m": igw.z_max,
        "z_min_m": igw.z_min,
    }


def _parameters(inputs: Inputs) -> list[_Row]:
    road, igw, source = inputs.asphalt, _of_asphalt(inputs, "implicit"), "Table 1"
    printed, scans = printed_eq12(road), "synthetic scans"
    return [
        ("Hurst exponent", "$H$", road.hurst, "-", source),
        ("rms height", "$h_0$", 1e6 * road.rms_height, "µm", source),
        ("lower cut-off", "$q_0$", road.q0, "1/m", source),
        ("upper cut-off", "$q_{max}$", road.q1, "1/m", source),
        ("width of the adhesion", "$c$", ADHESION.width, "-", source),
        ("velocity of the adhesion", "$v_0$", 1e3 * ADHESION.reference_velocity, "mm/s", source),
        ("shear stress", r"$\tau_{f0}$", ADHESION.shear_stress / 1e6, "MPa", source),
        ("nominal pressure", r"$\sigma_0$", ASPHALT_PRESSURE / 1e3, "kPa", source),
        (f"rms slope to {_CUTOFFS[0]}", "$h'$", road.rms_slope, "-", source),
        ("q1 at rms slope 1.3", "$q_1/q_0$", road.cutoff_for_slope() / Q0, "-", "rule of Sec. 4"),
        ("spectrum at q0, rms height h0", "$C(q_0)$", float(road.at(Q0)), "m$^4$", "Parseval"),
        ("spectrum at q0, Eq. 12 as printed", "$C(q_0)$", float(printed.at(Q0)), "m$^4$", "Eq. 12"),
        ("rms height of Eq. 12 as printed", "-", 1e6 * printed.rms_height, "µm", "Parseval"),
        ("highest point", r"$z_{max}$", 1e6 * igw.z_max, "µm", scans),
        ("lowest point", r"$z_{min}$", 1e6 * igw.z_min, "µm", scans),
    ]


def _listed(what: str, values: Array, symbol: str, unit: str, source: str) -> list[_Row]:
    at = zip(_LISTED, _at(values, _LISTED).tolist(), strict=True)
    return [(what.format(f"{v:g} m/s"), symbol, value, unit, source) for v, value in at]


def _frictions(curves: Mapping[str, Mapping[str, Friction]]) -> list[_Row]:
    rows: list[_Row] = []
    for cutoff, theories in curves.items():
        for name, which in (("original", "original"), ("modified", "implicit")):
            what, mu = f"friction at {{}}, {name}", theories[which].mu
            rows += _listed(what, mu, r"$\mu$", "-", f"cut off at {cutoff}")
    factors = curves[_CUTOFFS[0]]["implicit"].shift_factor
    return [*rows, *_listed("shift factor at {}", factors, "$p_T$", "-", "implicit")]


def _hot_theories(inputs: Inputs) -> dict[str, Mapping[str, Friction]]:
    """The original theory and IGW in both readings with the heat of sliding, by cut-off."""
    corrections = {"original": None} | {name: _of_asphalt(inputs, name) for name in READINGS}
    return {
        name: heated(_surfaces(inputs), _VELOCITY, correction)
        for name, correction in corrections.items()
    }


def _hot_rows(inputs: Inputs) -> list[_Row]:
    rows: list[_Row] = []
    theories = _hot_theories(inputs)
    for cutoff, hot in theories["original"].items():
        source = f"cut off at {cutoff}"
        for name, of in (("original", hot), ("modified", theories["implicit"][cutoff])):
            rows += _listed(f"friction at {{}}, {name}, flash heat", of.mu, r"$\mu$", "-", source)
        rows += _listed("rise at {}, original", rise(hot), r"$T(q_1) - T_0$", "K", source)
    return rows
