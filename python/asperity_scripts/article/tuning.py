"""Section 5.1 and the printed p_T: the modulus that they ask for, and the surrogates; Fig. 5."""

from typing import Any

import numpy as np

from asperity.draw.figure import legend, new_figure
from asperity.draw.style import grey, palette
from asperity_scripts.article import compounds
from asperity_scripts.article.inputs import Inputs, effective_modulus
from asperity_scripts.article.page import LOG, page, panel, stacked
from asperity_scripts.article.statement import Finding, Findings


def findings(inputs: Inputs) -> Findings:
    """What E*, z_max, z_min and compound A are for the printed p_T to come out."""
    bare = effective_modulus(inputs.compound_a)
    solved, moved = {}, {"": Finding(bare=bare / 1e6)}
    for reading, tuned in inputs.tuned.items():
        x = tuned.implied
        solved[reading] = Finding(
            p=x.shift_factor,
            stiff=x.effective_modulus / 1e6,
            ends=[x.lowest / 1e6, x.highest / 1e6],
            z_max=1e6 * x.z_max,
            z_min=1e6 * x.z_min,
        )
        moved[reading] = Finding(
            times=x.effective_modulus / bare, decades=tuned.decades, celsius=tuned.temperature
        )
    return {"G1": solved, "G2": moved}


def fig05(inputs: Inputs) -> dict[str, bytes]:
    """E' and E'' of the surrogates: A and B by WLF, and A as either reading has to have it."""
    figure, (axes,) = new_figure(1)
    frequency = np.geomspace(1e-3, 1e10, 261)
    plain = {"A": inputs.compound_a, "B": inputs.compound_b}
    rubbers = {f"{name}, $T_g$ = {compounds.T_G[name]:g} °C": name for name in plain}
    tuned = {f"A, tuned ({reading})": t.rubber for reading, t in inputs.tuned.items()}
    rubbers |= {name: name for name in tuned}
    curves: list[dict[str, Any]] = []
    for (label, name), colour in zip(rubbers.items(), palette(), strict=False):
        modulus = np.asarray({**plain, **tuned}[name].modulus(frequency))
        style: dict[str, Any] = {"color": colour, "linewidth": 1.8 if name in plain else 1.0}
        axes.plot(frequency, modulus.real / 1e6, label=label, **style)
        axes.plot(frequency, modulus.imag / 1e6, "--", **style)
        curves.append(
            {
                "compound": name,
                "angular_frequency_rad_s": frequency,
                "storage_modulus_pa": modulus.real,
                "loss_modulus_pa": modulus.imag,
            }
        )
    for dash, text in (("-", "$E$′"), ("--", "$E$″")):
        axes.plot([], [], dash, color=grey(0.3), label=text)
    labels = {"xlabel": r"Angular frequency $\omega$ [rad/s]", "ylabel": "Modulus [MPa]"}
    panel(axes, f"surrogates, {compounds.ROOM:g} °C", **LOG, **labels)
    legend(axes)
    facts = {
        "temperature_c": compounds.ROOM,
        **{f"glass_transition_{k}_c": v for k, v in compounds.T_G.items()},
        "wlf_c1": compounds.C1,
        "wlf_c2_k": compounds.C2,
        "time_at_glass_transition_s": compounds.GLASS_TIME,
        **{f"tuned_by_decades_{name}": t.decades for name, t in inputs.tuned.items()},
    }
    note = "the article's moduli are not published; these are surrogates placed by T_g alone"
    return page("fig05", figure, facts, stacked(curves), note)
