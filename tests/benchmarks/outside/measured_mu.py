"""Measured dry mu of five compounds beside hysteresis and a fitted adhesion: 29 points.

    python tests/benchmarks/outside/measured_mu.py CLONE

CLONE is one of k100kan35-dotcom/psfinal_hysteresis_redesign. The shear stress of the contact, tau =
(mu - mu_H) p / A, of all compounds but one gives ln tau as a parabola in log10 v (Eq. 23), and with
it mu of the one left out. Beside it the baseline that knows no theory: the mean mu of the others at
that speed.
"""

from collections.abc import Sequence
from typing import Any

import clone
import numpy as np

import asperity

Array = np.ndarray
# speeds of the S compounds are 25 times those of the R ones, digit by digit: taken as v a_T at 40 C
COMMON = 25.0
CORRECTIONS = {
    "none": None,
    "`PartialContact`": asperity.PartialContact(),
    "S in both, 0.65": asperity.SFactor(gamma=0.65, applies_to="both"),
}
GROUPS = {
    "three S": ("S100", "S120", "S140"),
    "two R": ("R20", "R40"),
    "all five": tuple(clone.COMPOUNDS),
}
Rows = dict[str, tuple[Array, Array, Array, Array]]


def points(presets: clone.Presets, correction: Any, factors: str | None = None) -> Rows:
    """By compound: v as the R files have it, mu, mu_H and A; f and g are its own or given ones."""
    result = {}
    for name, compound in clone.COMPOUNDS.items():
        velocity, mu = presets.measured(name)
        own = asperity.friction(
            presets.road(),
            presets.rubber(name),
            pressure=clone.PRESSURE,
            velocity=velocity,
            correction=correction,
            strain_factors=presets.factors(factors or compound.strain),
            rtol=1e-4,
        )
        slow = velocity / (COMMON if name.startswith("S") else 1.0)
        result[name] = slow, mu, own.mu, own.contact_area
    return result


def stress(rows: tuple[Array, Array, Array, Array]) -> Array:
    _, mu, hysteresis, area = rows
    return (mu - hysteresis) * clone.PRESSURE / area


def left_out(rows: Rows, name: str) -> tuple[Array, Array]:
    """mu of a compound by theory and by the baseline, from the others alone."""
    others = [rows[other] for other in rows if other != name]
    v, _, hysteresis, area = rows[name]
    x = np.log10(np.concatenate([other[0] for other in others]))
    y = np.log(np.concatenate([stress(other) for other in others]))
    tau = np.exp(np.polyval(np.polyfit(x, y, 2), np.log10(v)))
    theory = hysteresis + tau * area / clone.PRESSURE
    at_this_speed = abs(np.log10(v)[:, None] - x) < 0.02  # files have four digits
    of_others = np.concatenate([other[1] for other in others])
    count = at_this_speed.sum(axis=1)
    return theory, np.where(count, at_this_speed @ of_others / np.maximum(count, 1), np.nan)


def errors(rows: Rows, names: Sequence[str]) -> tuple[Array, Array]:
    """Of theory and baseline, relative, at the points that have both."""
    chosen = {name: rows[name] for name in names}
    pairs = [np.array(left_out(chosen, name)) / rows[name][1] - 1 for name in names]
    both = np.concatenate(pairs, axis=1)
    theory, baseline = both[:, np.isfinite(both).all(axis=0)]
    return theory, baseline


def percent(error: Array) -> str:
    return f"{100 * np.sqrt(np.mean(error**2)):.1f} ({100 * error.mean():+.1f})"


def main() -> None:
    presets = clone.Presets(
        clone.given("k100kan35-dotcom/psfinal_hysteresis_redesign", "preset_data/mu_dry")
    )
    rows = points(presets, asperity.PartialContact())
    print("| compound | v [m/s] | mu | mu_H / mu | A | tau [MPa] |\n" + "| --- " * 6 + "|")
    for name, result in rows.items():
        v, mu, hysteresis, area = result
        cells = (v, mu, hysteresis / mu, area, stress(result) / 1e6)
        ranges = (f"{x.min():.3g} to {x.max():.3g}" for x in cells)
        print(f"| {name} | " + " | ".join(ranges) + " |")
    print("\n| left out of | points | mean of the others | " + " | ".join(CORRECTIONS) + " |")
    print("| --- " * (3 + len(CORRECTIONS)) + "|")
    for label, factors in (("", None), (", one f and g for all", clone.ONE_FOR_ALL)):
        of = [points(presets, correction, factors) for correction in CORRECTIONS.values()]
        for group, names in GROUPS.items():
            result = [errors(each, names) for each in of]
            theory = " | ".join(percent(each) for each, _ in result)
            baseline = result[0][1]
            print(f"| {group}{label} | {baseline.size} | {percent(baseline)} | {theory} |")


if __name__ == "__main__":
    main()
