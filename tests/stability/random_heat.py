"""Random rubbers that heat themselves: is the error estimate of mu kept?

    python tests/stability/random_heat.py [--scenes 2000] [--seed 1] [--rings 0.1] [--curves 0]

Roads, Prony series, conditions, thermal constants, corrections and adhesion are drawn wide, four
velocities a scene; rubbers run away, melt, or stay cold. What rtol 1e-11 gives is the truth, and
results at 1e-3 to 1e-8 must be as near to it as their estimates say. A share of the roads are
tables of rings with scatter, jumps and empty rows, whose truth is of rtol 1e-9 on panels; a share
of the rubbers are master curves of rows anywhere, with gaps and noise, whose truth is of 1e-8.
Printed: how many results were compared, the errors over their estimates, the scenes that went above
700 K or were not solved, and each scene that exceeded. Exit status 1 where one did.
"""

import sys
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from judge import Held, NoTruth, judged
from options import options

import asperity

LAW = asperity.WLF(c1=8.86, c2=101.6, reference_temperature=293.15)
RTOLS = (1e-3, 1e-4, 1e-6, 1e-8)
RINGS_RTOLS = (1e-3, 1e-5, 1e-6)
CURVES_RTOLS = (1e-3, 1e-5, 4e-6)


@dataclass
class Outcome:
    """Errors over estimates by rtol; why there is no truth, and which rtol was not reached."""

    ratios: dict[float, float] = field(default_factory=dict)
    untold: str = ""
    refused: list[float] = field(default_factory=list)
    branches: int = 1


def draw_road(rng: Any) -> asperity.SelfAffineSpectrum:
    q1 = 2000 * np.exp(rng.uniform(np.log(1.5), np.log(3e3)))
    rolloff = 2000 * (q1 / 2000) ** rng.uniform(0.05, 0.6) if rng.random() < 0.3 else None
    return asperity.SelfAffineSpectrum(
        rms_height=10 ** rng.uniform(-6, -3.5),
        hurst=rng.uniform(0.2, 1),
        q0=2000,
        q1=q1,
        rolloff=rolloff,
    )


def draw_rings(rng: Any) -> asperity.TabulatedSpectrum:
    road = draw_road(rng)
    q = np.geomspace(road.q0, road.q1, int(rng.integers(20, 300)))
    density = road.at(q) * np.exp(rng.uniform(0, 0.6) * rng.normal(size=q.size))
    if rng.random() < 0.3:
        density = density * np.where((np.arange(q.size) // 10) % 2, 1.0, 10 ** rng.uniform(-3, 0))
    if rng.random() < 0.3:
        empty = rng.integers(0, q.size // 2)
        density[empty : empty + rng.integers(1, 8)] = 0
    return asperity.TabulatedSpectrum(wavenumber=q, density=density)


def draw_rubber(rng: Any) -> asperity.PronySeries:
    terms = int(rng.integers(1, 21))
    return asperity.PronySeries(
        equilibrium_modulus=10 ** rng.uniform(5, 7),
        moduli=10 ** rng.uniform(5, 9, terms),
        relaxation_times=10 ** rng.uniform(-11, 2, terms),
    )


def draw_curve(rng: Any) -> asperity.MasterCurve:
    """Rows at random frequencies, with gaps, and noise mostly in the loss."""
    w = np.sort(10 ** rng.uniform(-10, 20, int(rng.integers(60, 640))))
    kept = np.append(True, np.diff(np.log(w)) > 1e-3)
    for _ in range(int(rng.integers(0, 4))):
        gap = rng.integers(2, w.size - 2)
        kept[gap : gap + rng.integers(1, w.size // 4)] = False
    kept[-1] = True
    modulus = draw_rubber(rng).modulus(w[kept])
    scatter = rng.uniform(0, (0.03, 0.1))[:, None] * rng.normal(size=(2, kept.sum()))
    return asperity.MasterCurve(
        angular_frequency=w[kept],
        storage_modulus=modulus.real * np.exp(scatter[0]),
        loss_modulus=modulus.imag * np.exp(scatter[1]),
    )


def draw_correction(rng: Any, road: Any) -> Any:
    rms = road.rms_height() if callable(getattr(road, "rms_height", None)) else road.rms_height
    tops = {"z_max": rms * rng.uniform(1.5, 4), "z_min": -rms * rng.uniform(1.5, 4)}
    return [
        None,
        asperity.SFactor(gamma=rng.uniform(0, 1), applies_to="both"),
        asperity.NayakSFactor(),
        asperity.AffineShift(rng.uniform(1, 3)),
        asperity.PartialContact(),
        asperity.GreenwoodWilliamson(
            **tops, rms_height=rms, reading=("implicit", "added")[int(rng.integers(2))]
        ),
    ][int(rng.integers(6))]


def draw_scene(
    rng: Any, rings: float, curves: float = 0.0
) -> tuple[Any, asperity.PronySeries | asperity.MasterCurve, dict[str, Any]]:
    """Road, rubber and conditions."""
    of_rings = rng.random() < rings
    of_curve = curves > 0 and rng.random() < curves  # without them draws are those of before
    road = draw_rings(rng) if of_rings else draw_road(rng)
    correction = draw_correction(rng, road)
    exact = isinstance(correction, asperity.PartialContact) or rng.random() < 0.85
    heating = asperity.Heating(
        density=1200,
        heat_capacity=1650,
        conductivity=10 ** rng.uniform(-1, 0.5),
        contact_diameter=10 ** rng.uniform(-4.5, -2),
        residence=("disc", "box")[int(rng.integers(2))],
        macro_area=10 ** rng.uniform(-2, 0) if rng.random() < 0.2 else None,
    )
    sticky = asperity.Adhesion(shear_stress=10 ** rng.uniform(5, 7), reference_velocity=6e-3)
    at = {
        "pressure": 10 ** rng.uniform(3.5, 7),
        "velocity": 10 ** rng.uniform(-6, 1.3, 4),
        "temperature": rng.uniform(250, 343),
        "shift": LAW,
        "heating": heating,
        "correction": correction,
        "form": "exact" if exact else "interpolated",
        "adhesion": sticky if rng.random() < 0.5 else None,
    }
    return road, draw_curve(rng) if of_curve else draw_rubber(rng), at


def compute(seed: int, scene: int, *, rings: float = 0.0, curves: float = 0.0) -> Outcome:
    road, compound, at = draw_scene(np.random.default_rng([seed, scene]), rings, curves)
    best, rtols = 1e-11, RTOLS
    if isinstance(road, asperity.TabulatedSpectrum):
        best, rtols = 1e-9, RINGS_RTOLS
    if isinstance(compound, asperity.MasterCurve):
        best, rtols = 1e-8, CURVES_RTOLS
    outcome = Outcome()
    try:
        truth = asperity.friction(road, compound, **at, rtol=best)
    except asperity.Error as error:
        outcome.untold = type(error).__name__
        return outcome
    outcome.branches = int(truth.branches.max())
    for rtol in rtols:
        try:
            result = asperity.friction(road, compound, **at, rtol=rtol)
        except asperity.NotConverged:
            outcome.refused.append(rtol)
            continue
        stated = result.error_estimate + truth.error_estimate
        outcome.ratios[rtol] = float(
            np.max(np.abs(result.mu - truth.mu) / np.maximum(stated, 1e-300))
        )
    return outcome


def main() -> int:
    given = options(__doc__, scenes=2000, seed=1, rings=0.1, curves=0.0)

    def held(scene: int) -> list[Held]:
        outcome = compute(given.seed, scene, rings=given.rings, curves=given.curves)
        if outcome.untold:
            raise NoTruth(outcome.untold)
        several = [("with several states", 0.0, "")] * (outcome.branches > 1)
        refused = [(f"rtol {rtol:g}, not reached", 0.0, "") for rtol in outcome.refused]
        return [*several, *refused, *((f"rtol {k:g}", r, "") for k, r in outcome.ratios.items())]

    return judged(range(given.scenes), held)


if __name__ == "__main__":
    sys.exit(main())
