"""Random scenes: has the sum rule of PartialContact one root, and is it the one that is found?

    python tests/stability/random_roots.py [--scenes 10000] [--seed 1]

Surfaces, rubbers and velocities are those of partial_scenes.py; a third of the loads are near
complete contact, a third make A/A0 of 1e-2 to 1e-7. The residual of the rule, the logarithm of its
right side over its left one by brute force (partial_truth.py, four nodes a panel), is taken at 360
values of ln kappa from -30 to 30, finer where it is flat, and its changes of sign are counted. The
area at the root is compared with that of `asperity.contact_area`. Printed: scenes without a root,
with several, with another area or not converged, where roots lie, the slope of the residual there,
and how far from 0 it is elsewhere. Exit status 1 where any scene failed.
"""

import sys
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from scipy.special import erf

import asperity

sys.path.insert(0, str(Path(__file__).parents[1] / "reference"))
sys.path.insert(0, str(Path(__file__).parent))
from judge import Held, judged
from options import options
from partial_rule import sums, variance
from partial_scenes import draw_parts, power
from partial_truth import Surface, Truth

# no root lies on a value of this by design: where contact is complete it is at 0
INNER, OUTER = 0.0071 + np.arange(-6, 6, 0.05), np.arange(6.2, 30, 0.4)
SCAN = np.concatenate([-OUTER[::-1], INNER, OUTER])


def rule_of(q: Any, c: Any, rubber: Any, velocity: float) -> Truth:
    return Truth(Surface(q, c), rubber, velocity, nodes=4)


def area_of(rule: Truth, log_kappa: float, pressure: float) -> float:
    return float(erf(0.5 * pressure / np.sqrt(np.exp(log_kappa) * rule.nodes[4])))


@dataclass
class Outcome:
    """Roots in ln kappa, how near to another one the residual comes, and the areas, ours first."""

    kind: str
    roots: list[float]
    slope: float  # at the root
    margin: float
    area: float
    scanned: float

    @property
    def kept(self) -> bool:
        """Whether there is one root, and its area is that of the package but for the grid."""
        return len(self.roots) == 1 and abs(self.area / self.scanned - 1) < 0.02


def scan(rule: Truth, pressure: float) -> tuple[list[float], float, float]:
    """Roots, the slope at the first, and how far from 0 the residual is two units off it."""
    nodes, tail = rule.under(pressure)

    def residual(log_kappa: Any) -> Any:
        return np.array(
            [np.log(variance(k * nodes[4]) / sums(k, nodes, tail)[0]) for k in np.exp(log_kappa)]
        )

    x, r = SCAN, residual(SCAN)
    for _ in range(2):  # finer where it is flat or falls
        flat = np.flatnonzero(np.diff(r) < 0.2 * np.diff(x))
        flat = flat[:60]
        if not flat.size:
            break
        more = (x[flat][:, None] + np.diff(x)[flat][:, None] * np.arange(1, 4) / 4).ravel()
        x, r = np.append(x, more), np.append(r, residual(more))
        order = np.argsort(x)
        x, r = x[order], r[order]
    changes = np.flatnonzero((r[1:] > 0) != (r[:-1] > 0))
    slopes = np.diff(r) / np.diff(x)
    roots = [float(x[i] - r[i] / slopes[i]) for i in changes]
    if not roots:
        return roots, 0, 0
    away = np.abs(x - roots[0]) > 2
    return roots, float(slopes[changes[0]]), float((r * np.sign(x - roots[0]))[away].min())


def compute(seed: int, scene: int) -> Outcome:
    """Scene number `scene` of a seed."""
    rng = np.random.default_rng([seed, scene])
    kind, q, c, rubber, velocity = draw_parts(rng)
    rule = rule_of(q, c, rubber, velocity)
    regime = rng.choice(["complete", "usual", "light"])
    ends = {"complete": (-2.5, -0.3), "usual": (-0.3, 4), "light": (4, 14)}[regime]
    pressure = np.sqrt(rule.nodes[4] / power(rng, *ends))
    roots, slope, margin = scan(rule, pressure)
    area = asperity.contact_area(
        asperity.TabulatedSpectrum(wavenumber=q, density=c),
        rubber,
        pressure=pressure,
        velocity=velocity,
        correction=asperity.PartialContact(),
        rtol=1e-4,
    )
    scanned = area_of(rule, roots[0], pressure) if roots else np.nan
    return Outcome(f"{kind}, {regime}", roots, slope, margin, float(area), scanned)


def main() -> int:
    asked = options(__doc__, scenes=10_000, seed=1)
    outcomes = []

    def held(scene: int) -> list[Held]:
        outcomes.append(outcome := compute(asked.seed, scene))
        return [("one root", 0.0 if outcome.kept else np.inf, outcome)]

    status = judged(range(asked.scenes), held)
    roots = [root for one in outcomes for root in one.roots]
    slopes, margins = ([getattr(one, name) for one in outcomes] for name in ("slope", "margin"))
    print(f"roots in ln kappa from {min(roots):.3g} to {max(roots):.3g}")
    print(f"slope of the residual there {min(slopes):.3g} or more, median {np.median(slopes):.3g}")
    print(f"two units and more of ln kappa from the root it is {min(margins):.3g} or more off 0")
    return status


if __name__ == "__main__":
    sys.exit(main())
