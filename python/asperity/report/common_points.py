"""Points at which two scenes can be compared, and what the scenes give there."""

from dataclasses import replace
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from asperity.scene.model import Scene, SceneFriction

Array = NDArray[np.float64]
MOST = 60  # velocities, or pressures, at which scenes are computed anew
_SAME = 1e-9  # relative: entries of two sweeps that are one


class Points(NamedTuple):
    """Every pressure with every velocity."""

    pressure: Array  # [Pa], shape (n,)
    velocity: Array  # [m/s], shape (m,)


def common(one: Scene, other: Scene) -> tuple[Points, Points] | str:
    """Points of each of two scenes, by pairs; why there are none as a sentence.

    Single pressures are compared as they are: they belong to what the scenes differ by.
    """
    velocity = _common(one.velocity, other.velocity)
    if velocity is None:
        spans = [f"{v.min():.3g} to {v.max():.3g} m/s" for v in (one.velocity, other.velocity)]
        return f"The two have no velocity in common: {spans[0]}, and {spans[1]}."
    if one.pressure.size == other.pressure.size == 1:
        return Points(one.pressure, velocity), Points(other.pressure, velocity)
    pressure = _common(one.pressure, other.pressure)
    if pressure is None:
        spans = [f"{p.min():.4g} to {p.max():.4g} Pa" for p in (one.pressure, other.pressure)]
        return f"The two have no pressure in common: {spans[0]}, and {spans[1]}."
    return Points(pressure, velocity), Points(pressure, velocity)


def _common(a: Array, b: Array) -> Array | None:
    """`a` where both are the same; else the entries of both where their ranges overlap."""
    if _same(a, b):
        return a
    low, high = max(a.min(), b.min()), min(a.max(), b.max())
    both = np.sort(np.concatenate([a, b]))
    both = both[(both >= low * (1 - _SAME)) & (both <= high * (1 + _SAME))]
    if not both.size:
        return None
    both = both[np.append(True, np.diff(both) > _SAME * both[1:])]
    kept = np.linspace(0, both.size - 1, min(MOST, both.size)).round().astype(int)
    result: Array = both[kept]
    return result


def _same(a: Array, b: Array) -> bool:
    return a.size == b.size and np.allclose(a, b, rtol=_SAME, atol=0)


def at_points(scene: Scene, curves: SceneFriction, points: Points) -> SceneFriction:
    """The curves where they are those of the points, else computed there, with their band."""
    if _same(scene.pressure, points.pressure) and _same(scene.velocity, points.velocity):
        return curves
    moved = replace(scene, pressure=points.pressure, velocity=points.velocity)
    result = moved.friction()
    return result if curves.band is None else result.within(moved.band(result.mu))
