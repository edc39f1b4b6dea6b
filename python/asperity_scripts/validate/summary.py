"""Errors of all models in tables: worst and mean, by bandwidth and by Hurst exponent."""

from collections.abc import Sequence
from typing import Any

from asperity_scripts.validate.predictions import Prediction, Quantity

TITLE = "# What each correction is worth"


def error_rows(predictions: Sequence[Sequence[Prediction]]) -> dict[str, list[Any]]:
    flat = [prediction for group in predictions for prediction in group]
    return {
        "case": [p.contact.case for p in flat],
        "hurst": ["" if p.contact.hurst is None else p.contact.hurst for p in flat],
        "q1_over_q0": [p.contact.band for p in flat],
        "p_over_Eh": [p.contact.load for p in flat],
        "model": [p.model.name for p in flat],
        "shift_factor": [p.shift for p in flat],
        "contact_area": [p.area for p in flat],
        "contact_area_exact": [p.contact.area for p in flat],
        "contact_area_error": [p.area_error for p in flat],
        "energy_j_per_m2": [p.energy for p in flat],
        "energy_exact_j_per_m2": [p.contact.energy for p in flat],
        "energy_error": [p.energy_error for p in flat],
    }


def summary(predictions: Sequence[Sequence[Prediction]]) -> str:
    contacts = [prediction.contact for prediction in predictions[0]]
    loads = sorted(contact.load for contact in contacts)
    text = [
        TITLE,
        "",
        f"Relative errors in % against {len(contacts)} boundary-element contacts (elastic, without "
        f"friction or adhesion), p* = p / (E* h') from {loads[0]:.3g} to {loads[-1]:.3g}.",
        "",
    ]
    quantities: tuple[tuple[Quantity, str], ...] = (
        ("area", "Contact area, which sets the adhesion"),
        ("energy", "Elastic energy, which the friction integrand weighs"),
    )
    for quantity, title in quantities:
        best = min(predictions, key=lambda group: _mean(group, quantity))
        text += [f"## {title}", "", *_table(predictions, quantity), ""]
        text += ["Mean signed error by load p*:", "", *_by_load(predictions, quantity), ""]
        text += [f"Least mean error: {best[0].model.name}, {_mean(best, quantity):.1f} %.", ""]
    text += ["| name | in Python |", "| --- | --- |"]
    text += [f"| {group[0].model.name} | `{group[0].model.call}` |" for group in predictions]
    text += [
        "",
        "S in Eq. 22: on the friction integrand, with the uncorrected area. S in G: inside G, "
        "self-consistently. lambda0 = 2 pi / q0. In brackets: how many contacts.",
        "",
    ]
    return "\n".join(text)


def _mean(group: Sequence[Prediction], quantity: Quantity) -> float:
    return 100 * sum(abs(p.error(quantity)) for p in group) / len(group)


def _table(predictions: Sequence[Sequence[Prediction]], quantity: Quantity) -> list[str]:
    contacts = [prediction.contact for prediction in predictions[0]]
    groups = {"": list(range(len(contacts)))}
    for i, contact in enumerate(contacts):
        groups.setdefault(f"q1/q0 {contact.band:g}", []).append(i)
    for i, contact in enumerate(contacts):
        if contact.hurst is not None:
            groups.setdefault(f"H {contact.hurst:g}", []).append(i)
    names = sorted(filter(None, groups), key=_by_number)
    head = "".join(f" worst, {name} ({len(groups[name])}) |" for name in names)
    lines = ["| correction | mean | worst |" + head, "| --- " * (len(names) + 3) + "|"]
    for group in predictions:
        errors = [100 * p.error(quantity) for p in group]
        worst = [max((errors[i] for i in groups[name]), key=abs) for name in ("", *names)]
        cells = "".join(f" {error:+.1f} |" for error in worst)
        lines.append(f"| {group[0].model.name} | {_mean(group, quantity):.1f} |{cells}")
    return lines


def _by_load(predictions: Sequence[Sequence[Prediction]], quantity: Quantity) -> list[str]:
    loads: dict[float, list[int]] = {}
    for i, prediction in enumerate(predictions[0]):
        loads.setdefault(float(f"{prediction.contact.load:.3g}"), []).append(i)
    ordered = sorted(loads)
    head = "".join(f" {load:g} ({len(loads[load])}) |" for load in ordered)
    lines = ["| correction |" + head, "| --- " * (len(ordered) + 1) + "|"]
    for group in predictions:
        errors = [100 * p.error(quantity) for p in group]
        means = [sum(errors[i] for i in loads[load]) / len(loads[load]) for load in ordered]
        lines.append(f"| {group[0].model.name} |" + "".join(f" {mean:+.1f} |" for mean in means))
    return lines


def _by_number(group: str) -> tuple[bool, float]:
    name, number = group.split()
    return name == "H", float(number)
