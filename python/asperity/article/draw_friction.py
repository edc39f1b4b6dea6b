"""Figs 5 and 15 and Table 1: moduli, friction over velocity, parameters."""

import re
from collections.abc import Sequence
from typing import Any

import numpy as np

from asperity._core import SelfAffineSpectrum
from asperity.article import compounds
from asperity.article.affine import printed_eq12
from asperity.article.inputs import ADHESION, ASPHALT_PRESSURE, Q0, Inputs
from asperity.article.page import Page, asphalt_inputs, page, stacked
from asperity.article.sliding import CUTOFFS, Sliding, of_asphalt
from asperity.plot.curves import COLOURS, new_figure

_LISTED = (1e-3, 1e-2, 1e-1, 1.0)  # m/s, of Table 1's friction
_Row = tuple[str, str, float, str, str]


def fig05(inputs: Inputs) -> Page:
    """E' and E'' of the surrogates: A and B by WLF, and A as either reading has to have it."""
    figure, (axes,) = new_figure(1)
    frequency = np.geomspace(1e-3, 1e10, 261)
    rubbers = {
        f"A, $T_g$ = {compounds.T_G['A']:g} °C": ("A", inputs.compound_a, COLOURS[0], 1.8),
        f"B, $T_g$ = {compounds.T_G['B']:g} °C": ("B", inputs.compound_b, COLOURS[1], 1.8),
    }
    for name, tuned in inputs.tuned.items():
        colour = COLOURS[2] if name == "implicit" else COLOURS[3]
        rubbers[f"A, tuned ({name})"] = (f"A, tuned ({name})", tuned.rubber, colour, 1.0)
    curves: list[dict[str, Any]] = []
    for label, (name, rubber, colour, width) in rubbers.items():
        modulus = np.asarray(rubber.modulus(frequency))
        axes.plot(frequency, modulus.real / 1e6, color=colour, linewidth=width, label=label)
        axes.plot(frequency, modulus.imag / 1e6, "--", color=colour, linewidth=width)
        curves.append(
            {
                "compound": name,
                "angular_frequency_rad_s": frequency,
                "storage_modulus_pa": modulus.real,
                "loss_modulus_pa": modulus.imag,
            }
        )
    for dash, text in (("-", "$E'$"), ("--", "$E''$")):
        axes.plot([], [], dash, color="0.3", label=text)
    axes.set_xscale("log")
    axes.set_yscale("log")
    axes.set_xlabel(r"Angular frequency $\omega$ [rad/s]")
    axes.set_ylabel("Modulus [MPa]")
    axes.set_title(f"surrogates, {compounds.ROOM:g} °C", fontsize="medium")
    figure.legend(loc="outside right upper", fontsize="small")
    given = {
        "temperature_c": compounds.ROOM,
        **{f"glass_transition_{k}_c": v for k, v in compounds.T_G.items()},
        "wlf_c1": compounds.C1,
        "wlf_c2_k": compounds.C2,
        "time_at_glass_transition_s": compounds.GLASS_TIME,
        **{f"tuned_by_decades_{name}": t.decades for name, t in inputs.tuned.items()},
    }
    note = "the article's moduli are not published; these are surrogates placed by T_g alone"
    return page("fig05", figure, given, stacked(curves), note)


def fig15(inputs: Inputs, sliding: Sliding) -> Page:
    """Friction of B on asphalt: the original theory and the modified one."""
    figure, panels = new_figure(2)
    curves = sliding.curves[CUTOFFS[0]]
    for axes, name, title in (
        (panels[0], "original", "(a) original theory"),
        (panels[1], "implicit", "(b) modified, IGW"),
    ):
        curve = curves[name]
        for values, dash, colour, label in (
            (curve.mu, "-", COLOURS[0], "total"),
            (curve.hysteresis, "--", COLOURS[1], "hysteresis"),
            (curve.adhesion, "--", COLOURS[4], "adhesion"),
        ):
            axes.plot(sliding.velocity, values, dash, color=colour, label=label)
        axes.set_xscale("log")
        axes.set_xlim(float(sliding.velocity[0]), float(sliding.velocity[-1]))
        axes.set_ylim(0, 1.4 * float(np.max(curves["original"].mu)))
        axes.set_xlabel("Sliding velocity $v$ [m/s]")
        axes.set_ylabel(r"Friction coefficient $\mu$ [-]")
        axes.set_title(title, fontsize="medium")
        axes.text(
            0.03,
            0.96,
            "measured points of the article's\nFig. 15 are not at hand: none shown",
            transform=axes.transAxes,
            va="top",
            fontsize="small",
        )
        axes.legend(loc="upper right", fontsize="small")
    names = {"original": "original", "implicit": "modified, implicit", "added": "modified, added"}
    columns = stacked(
        [
            {
                "theory": names[which],
                "cutoff": cutoff,
                "velocity_m_s": sliding.velocity,
                "mu": found[which].mu,
                "hysteresis": found[which].hysteresis,
                "adhesion": found[which].adhesion,
                "contact_area": found[which].contact_area,
                "shift_factor": found[which].shift_factor,
            }
            for cutoff, found in sliding.curves.items()
            for which in names
        ]
    )
    note = "the measured points of the article's Fig. 15 are not at hand: none are given"
    return page("fig15", figure, _given(inputs), columns, note)


def table1(inputs: Inputs, sliding: Sliding) -> Page:
    """Table 1 as printed, and what follows from it."""
    from matplotlib.transforms import Bbox

    rows = [*_printed(inputs.asphalt), *_following(inputs, sliding)]
    figure, (axes,) = new_figure(1)
    figure.set_size_inches(8.4, 0.27 * len(rows) + 0.6)
    axes.set_axis_off()
    cells = [
        [name, symbol, f"{value:.4g}", unit, source] for name, symbol, value, unit, source in rows
    ]
    drawn = axes.table(
        cells,
        colLabels=["Quantity", "Symbol", "Value", "Unit", "From"],
        colWidths=[0.42, 0.14, 0.12, 0.08, 0.24],
        cellLoc="left",
        colLoc="left",
        edges="horizontal",
        bbox=Bbox.from_bounds(0, 0, 1, 1),
    )
    drawn.auto_set_font_size(False)
    drawn.set_fontsize(9)
    titles = ("quantity", "symbol", "value", "unit", "source")
    columns = {title: [row[k] for row in rows] for k, title in enumerate(titles)}
    for title in ("symbol", "unit"):
        columns[title] = [re.sub(r"[$\\]", "", str(cell)) for cell in columns[title]]
    return page("table1", figure, _given(inputs), columns)


def _given(inputs: Inputs) -> dict[str, Any]:
    igw = of_asphalt(inputs, "implicit")
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


def _printed(road: SelfAffineSpectrum) -> list[_Row]:
    given = "Table 1"
    return [
        ("Hurst exponent", "$H$", road.hurst, "-", given),
        ("rms height", "$h_0$", 1e6 * road.rms_height, "µm", given),
        ("lower cut-off", "$q_0$", road.q0, "1/m", given),
        ("upper cut-off", "$q_{max}$", road.q1, "1/m", given),
        ("width of the adhesion", "$c$", ADHESION.width, "-", given),
        ("velocity of the adhesion", "$v_0$", 1e3 * ADHESION.reference_velocity, "mm/s", given),
        ("shear stress", r"$\tau_{f0}$", ADHESION.shear_stress / 1e6, "MPa", given),
        ("nominal pressure", r"$\sigma_0$", ASPHALT_PRESSURE / 1e3, "kPa", given),
    ]


def _following(inputs: Inputs, sliding: Sliding) -> list[_Row]:
    road, igw = inputs.asphalt, of_asphalt(inputs, "implicit")
    printed = printed_eq12(road)
    rows: list[_Row] = [
        (f"rms slope to {CUTOFFS[0]}", "$h'$", road.rms_slope, "-", "Table 1"),
        ("q1 at rms slope 1.3", "$q_1/q_0$", road.cutoff_for_slope() / Q0, "-", "rule of Sec. 4"),
        ("spectrum at q0, rms height h0", "$C(q_0)$", float(road.at(Q0)), "m$^4$", "Parseval"),
        ("spectrum at q0, Eq. 12 as printed", "$C(q_0)$", float(printed.at(Q0)), "m$^4$", "Eq. 12"),
        ("rms height of Eq. 12 as printed", "-", 1e6 * printed.rms_height, "µm", "Parseval"),
        ("highest point", r"$z_{max}$", 1e6 * igw.z_max, "µm", "synthetic scans"),
        ("lowest point", r"$z_{min}$", 1e6 * igw.z_min, "µm", "synthetic scans"),
    ]
    for cutoff, found in sliding.curves.items():
        for name, which in (("original", "original"), ("modified", "implicit")):
            rows += [
                (
                    f"friction at {v:g} m/s, {name}",
                    r"$\mu$",
                    _at(sliding, found[which].mu, v),
                    "-",
                    f"cut off at {cutoff}",
                )
                for v in _LISTED
            ]
    curve = sliding.curves[CUTOFFS[0]]["implicit"]
    rows += [
        (
            f"shift factor at {v:g} m/s",
            "$p_T$",
            _at(sliding, curve.shift_factor, v),
            "-",
            "implicit",
        )
        for v in _LISTED
    ]
    return rows


def _at(sliding: Sliding, values: Sequence[float], velocity: float) -> float:
    """Friction at a velocity that is a point of the curve."""
    return float(values[int(np.abs(sliding.velocity - velocity).argmin())])
