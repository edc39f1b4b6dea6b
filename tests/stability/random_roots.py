"""Random scenes: has the sum rule of PartialContact one root, and is it the one that is found?

    python tests/stability/random_roots.py [--scenes 10000] [--seed 1]

Surfaces, rubbers and velocities are those of partial_scenes.py; a third of the loads are near
complete contact, a third make A/A0 of 1e-2 to 1e-7. The residual of the rule, ln(F B) less the
logarithm of int R dG + int T d ln x, is taken on a fine grid of ln q, with I2 from its definition,
at 360 values of ln kappa from -30 to 30, finer where it is flat, and its changes of sign are
counted. The area at the root is compared with that of `asperity.contact_area`. Printed: scenes
without a root, with several, with another area or not converged, where roots lie, the slope of the
residual there, and how far from 0 it is elsewhere. Exit status 1 where any scene failed.
"""

import argparse
import sys
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from scipy.special import erf, erfc

import asperity

sys.path.insert(0, str(Path(__file__).parents[1] / "reference"))
sys.path.insert(0, str(Path(__file__).parent))
from fit_partial_contact import STATED
from partial_scenes import draw_parts, power

TAIL = np.linspace(0, np.log(33), 200)
# no root lies on a value of this by design: where contact is complete it is at 0
INNER, OUTER = 0.0071 + np.arange(-6, 6, 0.05), np.arange(6.2, 30, 0.4)
SCAN = np.concatenate([-OUTER[::-1], INNER, OUTER])


def second_integral(rubber: Any, frequency: np.ndarray) -> np.ndarray:
    """I2 = int |E(w cos phi)|^2 dphi over a turn, by trapezoids in z, cos(phi) = sech(z)."""
    low, high = np.log(frequency.min()) - 14, np.log(frequency.max())
    places = np.linspace(low, high, 2000)
    w = np.exp(places)
    if isinstance(rubber, asperity.MasterCurve):
        w = np.clip(w, rubber.angular_frequency[0], rubber.angular_frequency[-1])
    square = np.log(np.abs(rubber.modulus(w)) ** 2)
    z = np.linspace(0, 14, 57)
    share = 1 / np.cosh(z)
    weight = 4 * 0.25 * share * np.where(z == 0, 0.5, 1.0)
    at = np.log(frequency)[:, None] + np.log(share)
    return np.exp(np.interp(at, places, square)) @ weight


def share_and_integral(g: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """A = erf(1 / (2 sqrt(g))) and F, the integral of A from 0 to g."""
    s = 0.5 / np.sqrt(g)
    share = erf(s)
    known = np.minimum(g, 1e200)
    part = np.sqrt(known / np.pi) * np.exp(-(np.minimum(s, 26) ** 2))
    return share, np.where(s > 6, known, (known + 0.5) * share + part - 0.5)


@dataclass
class Rule:
    """Numbers at unit load on the grid of ln q, and those of the end of the roughness."""

    g: np.ndarray  # at the places, beginning with 0
    steepness: np.ndarray  # g' = K I2 w
    tail: float  # int K w_e I2 (I2 / I2(q_e))^(1/4) x^-3 d ln x
    end_factor: float  # (4 w_e / M)^(1/5)
    excess: float  # 1 - 1 / rho

    def residual(self, log_kappa: np.ndarray, load: float) -> np.ndarray:
        """ln(F B / variance) at each kappa, `load` = 1 / sigma0^2."""
        kappa = np.exp(log_kappa)[:, None]
        g = np.maximum(load * self.g, 1e-300)
        share, risen = share_and_integral(kappa * g)
        a1, rest = share[:, -1], erfc(0.5 / np.sqrt(kappa[:, 0] * g[-1]))
        with np.errstate(divide="ignore"):
            log_a1 = np.where(rest < 0.5, np.log1p(-np.minimum(rest, 0.9)), np.log(a1))
        tenth, fourth, eighth = (-np.expm1(p * log_a1) for p in (0.1, 0.25, 8))
        obstacle = STATED["obstacle"] * self.end_factor * kappa[:, 0] ** 0.25 * rest**0.125
        obstacle *= 1 + STATED["light"] * tenth**3
        followed = 1 / (1 + obstacle[:, None] * share**2 * load * self.steepness) ** 2
        middle = (followed[:, 1:] + followed[:, :-1]) / 2
        variance = (middle * np.diff(risen)).sum(1) / kappa[:, 0]
        tail = load * self.tail * max(1, 0.1 * (1 - self.excess))
        variance += STATED["edges"] * a1 * fourth * tail
        spread = 1 + (STATED["spread"] * a1 + STATED["stiff"] * max(0, self.excess) ** 4) * eighth
        return np.log(risen[:, -1] * spread / variance)


def rule_of(q: np.ndarray, c: np.ndarray, rubber: Any, velocity: float) -> Rule:
    """The rule for rows of a spectrum: power laws between them, straight lines beside zeros."""
    rows = np.log(q)
    rough = np.flatnonzero((c[:-1] > 0) | (c[1:] > 0))[0]
    rows, q, c = rows[rough:], q[rough:], c[rough:]
    step = min(0.02, (rows[-1] - rows[0]) / 200)
    with np.errstate(divide="ignore", invalid="ignore"):  # rows of zero
        steep = np.nan_to_num(np.abs(np.diff(np.log(c))), nan=0, posinf=0)
    counts = np.ceil(np.maximum(8, np.maximum(np.diff(rows) / step, 4 * steep))).astype(int)
    parts = [np.linspace(rows[i], rows[i + 1], n + 1)[:-1] for i, n in enumerate(counts)]
    foot = parts[0][1] - rows[0]  # where A falls from 1, however fast
    parts[0] = np.concatenate([rows[:1], rows[0] + foot * np.geomspace(1e-12, 1, 60), parts[0][2:]])
    places = np.concatenate([*parts, rows[-1:]])
    i = np.repeat(np.arange(rows.size - 1), [len(part) for part in parts])
    middle = (places[1:] + places[:-1]) / 2

    def roughness(y: np.ndarray) -> np.ndarray:
        """q^4 C in the interval of each."""
        part = (y - rows[i]) / (rows[i + 1] - rows[i])
        with np.errstate(divide="ignore", invalid="ignore"):
            law = np.exp(np.log(c[i]) * (1 - part) + np.log(c[i + 1]) * part)
        line = c[i] + (c[i + 1] - c[i]) * (np.exp(y) - q[i]) / (q[i + 1] - q[i])
        return np.exp(4 * y) * np.where((c[i] > 0) & (c[i + 1] > 0), law, np.maximum(line, 0))

    mass = roughness(places[:-1]) + 4 * roughness(middle) + roughness(places[1:])
    mass *= np.diff(places) / 6
    total = np.concatenate([[0], np.cumsum(mass)])
    window = (np.interp(places + 1, places, total) - np.interp(places - 1, places, total)) / 2
    behind = np.cumsum(mass[::-1])[::-1]  # of the end, in its own digits
    last = np.clip((0.1 * total[-1] - (behind - mass)) / np.where(mass > 0, mass, 1), 0, 1)
    end = (last * mass * middle).sum() / (last * mass).sum()
    at_end = (np.interp(end + 1, places, total) - np.interp(end - 1, places, total)) / 2
    at_end = max(at_end, total[-1] / 20)
    factor = 1 / (8 * 0.75**2)
    i2 = second_integral(rubber, velocity * np.exp(np.concatenate([places, end + TAIL])))
    on_band, beyond = i2[: places.size], i2[places.size :]
    tail = np.trapezoid(beyond**1.25 * np.exp(-3 * TAIL), TAIL) / beyond[0] ** 0.25
    g = factor * np.concatenate([[0], np.cumsum(mass * (on_band[1:] + on_band[:-1]) / 2)])
    rho = factor * beyond[0] * total[-1] / g[-1]
    return Rule(
        g,
        factor * window * on_band,
        factor * at_end * tail,
        (4 * at_end / total[-1]) ** 0.2,
        1 - 1 / rho,
    )


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


def scan(rule: Rule, load: float) -> tuple[list[float], float, float]:
    """Roots, the slope at the first, and how far from 0 the residual is two units off it."""
    x, r = SCAN, rule.residual(SCAN, load)
    for _ in range(2):  # finer where it is flat or falls
        flat = np.flatnonzero(np.diff(r) < 0.2 * np.diff(x))
        flat = flat[:60]
        if not flat.size:
            break
        more = (x[flat][:, None] + np.diff(x)[flat][:, None] * np.arange(1, 4) / 4).ravel()
        x, r = np.append(x, more), np.append(r, rule.residual(more, load))
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
    load = power(rng, *ends) / rule.g[-1]
    roots, slope, margin = scan(rule, load)
    area = asperity.contact_area(
        asperity.TabulatedSpectrum(wavenumber=q, density=c),
        rubber,
        pressure=1 / np.sqrt(load),
        velocity=velocity,
        correction=asperity.PartialContact(),
        rtol=1e-4,
    )
    scanned = float(erf(0.5 / np.sqrt(np.exp(roots[0]) * load * rule.g[-1]))) if roots else np.nan
    return Outcome(f"{kind}, {regime}", roots, slope, margin, float(area), scanned)


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--scenes", type=int, default=10000)
    parser.add_argument("--seed", type=int, default=1)
    arguments = parser.parse_args()
    failed, roots, slopes, margins = 0, [], [], []
    for scene in range(arguments.scenes):
        try:
            outcome = compute(arguments.seed, scene)
        except asperity.NotConverged as error:
            failed += 1
            print(f"scene {scene}: {error}", flush=True)
            continue
        roots += outcome.roots
        slopes.append(outcome.slope)
        margins.append(outcome.margin)
        if not outcome.kept:
            failed += 1
            print(f"scene {scene}: {outcome}", flush=True)
    print(f"{arguments.scenes} scenes: {failed} failed")
    print(f"roots in ln kappa from {min(roots):.3g} to {max(roots):.3g}")
    print(f"slope of the residual there {min(slopes):.3g} or more, median {np.median(slopes):.3g}")
    print(f"two units and more of ln kappa from the root it is {min(margins):.3g} or more off 0")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
