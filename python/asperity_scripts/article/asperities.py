"""Section 3.2 checked: Eqs 14 to 21 of the improved Greenwood-Williamson model."""

from typing import Any

import numpy as np

from asperity.asperities import hertz_penetration, separation
from asperity.rubber import effective_modulus
from asperity_scripts.article.inputs import LAMBDA0, PRESSURES, Q0, VELOCITY, Inputs
from asperity_scripts.article.inputs import effective_modulus as modulus_of
from asperity_scripts.article.separation import eq20, shifts
from asperity_scripts.article.statement import Finding, Findings


def findings(inputs: Inputs) -> Findings:
    h0, stiff = inputs.sandpaper.rms_height, modulus_of(inputs.compound_a)
    return {
        "E1": {"": _eq14(h0, stiff)},
        "E2": {"": _eq15(inputs)},
        "E3": {"": _eqs17_to_20(h0, stiff)},
        "E4": {n: _interaction(h0, modulus_of(m.rubber)) for n, m in inputs.compounds.items()},
        "E5": _eq21(inputs),
    }


def _eq14(h0: float, stiff: float) -> Finding:
    radius, force = 1 / (Q0**2 * np.sqrt(2) * h0), 0.01  # Eq. 18

    def pressed(depth: float) -> float:
        return float(4 / 3 * stiff * np.sqrt(radius) * depth**1.5)  # the force of Eq. 16

    printed = pressed((9 * force / (16 * stiff**2 * radius)) ** (1 / 3))
    squared = pressed(hertz_penetration(force=force, effective_modulus=stiff, radius=radius))
    return Finding(abs(printed / force - 1) < 0.01, printed=printed, squared=squared)


def _eq15(inputs: Inputs) -> Finding:
    soft: dict[str, Any] = {"modulus": 1e6, "poisson_ratio": 0.5}
    stone: dict[str, Any] = {"modulus_2": [1e8, 1e9], "poisson_ratio_2": 0.3}
    error = effective_modulus(**soft) / effective_modulus(**soft, **stone) - 1
    fast = {n: abs(m.rubber.modulus(m.surface.q1)) / 1e9 for n, m in inputs.compounds.items()}
    return Finding(np.abs(error) < 0.02, error=error, **fast)


def _eqs17_to_20(h0: float, stiff: float) -> Finding:
    density = Q0**2 / (2 * np.pi**2 * np.sqrt(3)) * LAMBDA0**2 * np.sqrt(3) / 2
    x = 1e-3 * LAMBDA0
    bend = np.sqrt(2) * h0 * (2 * np.cos(Q0 * x) - 2) / x**2  # of sqrt(2) h0 cos(q0 x), at its top
    curvature = -bend / (Q0**2 * np.sqrt(2) * h0)
    rms = np.sqrt(np.mean((np.sqrt(2) * np.cos(2 * np.pi * np.arange(1000) / 1000)) ** 2))
    result = separation(pressure=PRESSURES, effective_modulus=stiff, rms_height=h0, q0=Q0)
    loads = [stiff * eq20(h0, d) / p for d, p in zip(result.effective, PRESSURES, strict=True)]
    ratios = np.array([density, curvature, rms, *loads])
    return Finding(np.abs(ratios - 1) < 1e-4, ratios=ratios)


def _interaction(h0: float, stiff: float) -> Finding:
    """How far d~ is above the separation of the plain model, in either reading."""
    arguments: dict[str, Any] = {"effective_modulus": stiff, "rms_height": h0, "q0": Q0}
    implicit, added = (
        separation(pressure=PRESSURES, reading=reading, **arguments)
        for reading in ("implicit", "added")
    )
    moved = [np.asarray(each.effective) - added.rigid for each in (implicit, added)]
    above = [np.all(d > 0.01 * h0) for d in moved]
    return Finding(above, implicit=1e6 * moved[0], added=1e6 * moved[1])


def _eq21(inputs: Inputs) -> dict[str, Finding]:
    findings = {}
    for name, model in inputs.models.items():
        d, _ = shifts(model, np.array(PRESSURES), np.array([VELOCITY]))
        printed = np.sqrt(2) * model.surface.rms_height / (d[:, 0] - model.correction.z_max)
        findings[name] = Finding(printed >= 1, printed=printed)
    turned = max(-2 * finding.numbers["printed"].min() for finding in findings.values())
    return {**findings, "": Finding(turned=turned)}
