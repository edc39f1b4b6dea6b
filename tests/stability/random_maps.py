"""Friction maps of random scenes, each checked on as many random points and on its own edges.

    python tests/stability/random_maps.py [--maps 100] [--points 10000] [--seed 1] [--tables 0.2]

Surfaces, rubbers and corrections are those of random_scenes.py, boxes up to three decades
of pressure and eight of velocity (some of a ten thousandth), rtol 1e-2 to 1e-5. Refused boxes (no
contact somewhere, a pressure that a double cannot hold) and tolerances that are not met are
counted by their error; every map that is made must keep its max_error, and that its tolerance.
Exit status 1 where one does not.
"""

import sys
from collections import Counter
from typing import Any

import numpy as np
from options import options
from random_scenes import draw_correction, draw_rubber, draw_surface, power

import asperity


def box(rng: Any, low: float, high: float, decades: float) -> tuple[float, float]:
    start = power(rng, low, high)
    ratio = 1 + 1e-4 if rng.random() < 0.1 else power(rng, 0.01, decades)
    return start, start * ratio


def edge_points(rng: Any, made: asperity.FrictionMap, count: int) -> tuple[Any, Any]:
    """On the sides and corners of the box."""
    drawn = [
        np.exp(rng.uniform(*np.log(side), count)).clip(*side)
        for side in (made.pressure, made.velocity)
    ]
    for values, side in zip(drawn, (made.pressure, made.velocity), strict=True):
        values[rng.random(count) < 0.3] = side[0]
        values[rng.random(count) < 0.3] = side[1]
    return drawn[0], drawn[1]


def compute(seed: int, number: int, points: int, tables: float) -> str:
    """What came of a scene: "kept", what it failed in, or the error it was refused with."""
    rng = np.random.default_rng([seed, number])
    surface, q0, q1 = draw_surface(rng, tables)
    pressure, velocity = box(rng, 4, 6, 3), box(rng, -6, -1, 8)
    rubber = draw_rubber(rng, tables, velocity[0] * q0, velocity[1] * q1)
    scene = {"correction": draw_correction(rng, surface.rms_height)}
    try:
        made = asperity.friction_map(
            surface,
            rubber,
            pressure=pressure,
            velocity=velocity,
            rtol=power(rng, -5, -2),
            checked=points,
            **scene,
        )
    except asperity.Error as error:
        return f"{type(error).__name__}: {str(error)[:60]}"
    if made.max_error > made.rtol:
        return f"FAILED: max_error {made.max_error} above rtol {made.rtol}"
    if made.exceeded:
        return f"FAILED: {made.exceeded} beyond {made.max_error}: {made.largest_checked_error}"
    p, v = edge_points(rng, made, 500)
    exact = asperity.friction(surface, rubber, pressure=p, velocity=v, rtol=1e-8, **scene)
    error = np.abs(made.contact_area(p, v) / exact.contact_area - 1).max()
    if exact.hysteresis.all():
        error = max(error, np.abs(made.hysteresis(p, v) / exact.hysteresis - 1).max())
    return "kept" if error <= made.max_error else f"FAILED: {error} on an edge, {made.max_error}"


def main() -> int:
    asked = options(__doc__, maps=100, points=10_000, seed=1, tables=0.2)
    result: Counter[str] = Counter()
    for number in range(asked.maps):
        outcome = compute(asked.seed, number, asked.points, asked.tables)
        result[outcome.split(":")[0]] += 1
        if outcome != "kept":
            print(f"scene {number}: {outcome}", flush=True)
    print(", ".join(f"{count} {what}" for what, count in sorted(result.items())))
    return 1 if result["FAILED"] else 0


if __name__ == "__main__":
    sys.exit(main())
