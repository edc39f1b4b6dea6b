"""Random scenes: the error estimates of PartialContact against the errors they have.

    python tests/stability/random_partial_contact.py [--scenes 10000] [--seed 1] [--brute 0.02]

Surfaces, rubbers and velocities are those of partial_scenes.py, with two loads each that make A/A0
of 1e-4 to 1. The truth is rtol = 1e-10, on panels; for a share of `brute`, and for each scene that
fails, brute force (partial_truth.py). Friction is compared at rtol 1e-4 to 1e-9: mu must be as near
to the truth as both estimates say, the area within rtol. Printed: scenes that exceeded or did not
converge, and the largest error over its estimate for each rtol. Exit status 1 where any failed.
"""

import argparse
import sys
from pathlib import Path
from typing import Any

import numpy as np

import asperity

sys.path.insert(0, str(Path(__file__).parent))
from partial_scenes import draw_parts, power
from partial_truth import Surface, Truth

ROUNDING = 3e-14
TOLERANCES = (1e-4, 1e-5, 1e-6, 1e-7, 1e-8, 1e-9)


def draw_scene(seed: int, scene: int) -> tuple[str, Any, Any, dict[str, Any]]:
    """What scene number `scene` of a seed is like, spectrum, rubber and the rest."""
    rng = np.random.default_rng([seed, scene])
    kind, q, c, rubber, velocity = draw_parts(rng)
    spectrum = asperity.TabulatedSpectrum(wavenumber=q, density=c)
    stiffness = abs(rubber.modulus(velocity * spectrum.q1))
    conditions = {
        "pressure": stiffness * power(rng, -4, 0.7, 2),
        "velocity": velocity,
        "correction": asperity.PartialContact(),
    }
    return kind, spectrum.scaled(1 / spectrum.rms_slope**2), rubber, conditions


def truth_of(spectrum: Any, rubber: Any, conditions: dict[str, Any], brute: bool) -> Any:
    """mu, its error and the area of the scene's loads."""
    if not brute:
        best = asperity.friction(spectrum, rubber, **conditions, rtol=1e-10)
        return best.mu, best.error_estimate, best.contact_area
    surface = Surface(spectrum.wavenumber, spectrum.density)
    truth = Truth(surface, rubber, conditions["velocity"])
    mu, area = np.transpose([truth.at(load) for load in conditions["pressure"]])
    return mu, ROUNDING * mu, area


def excess(found: Any, truth: Any, rtol: float) -> float:
    """The largest error over what is allowed."""
    mu, error, area = truth
    allowed = found.error_estimate + error
    of_mu = np.divide(np.abs(found.mu - mu), allowed, where=allowed > 0, out=allowed * 0)
    of_area = np.abs(found.contact_area / area - 1) / (rtol + ROUNDING)
    return float(max(of_mu.max(), of_area.max()))


def compute(seed: int, scene: int, brute: bool) -> dict[float, float]:
    """The error of a scene over what is allowed, by rtol."""
    _, spectrum, rubber, conditions = draw_scene(seed, scene)
    truth = truth_of(spectrum, rubber, conditions, brute)
    results = {
        rtol: excess(asperity.friction(spectrum, rubber, **conditions, rtol=rtol), truth, rtol)
        for rtol in TOLERANCES
    }
    if not brute and max(results.values()) > 1:
        return compute(seed, scene, brute=True)
    return results


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--scenes", type=int, default=10000)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--brute", type=float, default=0.02)
    arguments = parser.parse_args()
    failed, worst = 0, dict.fromkeys(TOLERANCES, 0.0)
    for scene in range(arguments.scenes):
        brute = (scene * arguments.brute) % 1 < arguments.brute
        try:
            results = compute(arguments.seed, scene, brute)
        except asperity.NotConverged as error:
            failed += 1
            print(f"scene {scene}: {error}", flush=True)
            continue
        for rtol, result in results.items():
            worst[rtol] = max(worst[rtol], result)
            if result > 1:
                failed += 1
                print(f"scene {scene}, rtol {rtol:g}: {result:.3g} of what is allowed", flush=True)
    print(f"{arguments.scenes} scenes: {failed} failed")
    print("worst error over what is allowed:", {f"{r:g}": round(w, 3) for r, w in worst.items()})
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
