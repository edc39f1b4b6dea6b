"""Several scenes side by side: by which inputs they differ, and where their mu does."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from asperity._core import Error
from asperity.draw.figure import pressure_text
from asperity.io.table import json_text
from asperity.report.texts import percent_text
from asperity.scene.model import Scene, SceneFriction

Array = NDArray[np.float64]
_LONGEST = 60  # characters of an input that is shown
MOST = 60  # velocities, or pressures, at which scenes are computed anew
_SAME = 1e-9  # relative: entries of two sweeps that are one

VERDICTS = (
    "by no more than the numerical error",
    "by no more than the bands of the inputs",
    "by more than these bands, but by no more than the model may be off",
    "by more than all errors that are known",
)


@dataclass(frozen=True)
class Difference:
    """One point at which two results are compared."""

    pressure: float  # of the first
    velocity: float
    first: float  # mu
    second: float
    verdict: int  # of VERDICTS

    @property
    def percent(self) -> str:
        return percent_text(100 * (self.second / self.first - 1), "+") if self.first else "-"


@dataclass(frozen=True)
class Pair:
    """A result held against the first; `compared` tells where."""

    first: str
    second: str
    compared: str
    differences: Sequence[Difference]

    @property
    def summary(self) -> list[str]:
        lines = [self.compared]
        for verdict, meaning in enumerate(VERDICTS):
            of_it = [one for one in self.differences if one.verdict == verdict]
            if of_it:
                v = [one.velocity for one in of_it]
                lines.append(
                    f"{len(of_it)} of {len(self.differences)} points differ {meaning}, "
                    f"from {min(v):.3g} to {max(v):.3g} m/s."
                )
        return lines


def compared(
    names: Sequence[str], scenes: Sequence[Scene], curves: Sequence[SceneFriction]
) -> list[Pair]:
    pairs = zip(names[1:], scenes[1:], curves[1:], strict=True)
    return [
        Pair(names[0], name, *_compared(scenes[0], curves[0], scene, curve))
        for name, scene, curve in pairs
    ]


def _compared(
    one: Scene, a: SceneFriction, other: Scene, b: SceneFriction
) -> tuple[str, Sequence[Difference]]:
    try:
        where = _points(one, other)
        first, second = _at_points(one, a, where[0]), _at_points(other, b, where[1])
    except _ApartError as apart:
        return f"{apart}", []
    except Error as error:
        return f"They cannot be computed at the velocities of both: {error}.", []
    anew = first is not a or second is not b
    return _told(*where, anew=anew), _differences(where[0], first, second)


class _ApartError(Exception):
    """Two scenes have no points in common, and why."""


class Points(NamedTuple):
    pressure: Array  # [Pa], shape (n,)
    velocity: Array  # [m/s], shape (m,)


def _points(one: Scene, other: Scene) -> tuple[Points, Points]:
    """Points of each of two scenes, by pairs.

    Single pressures are compared as they are: they belong to what the scenes differ by.
    """
    velocity = _common(one.velocity, other.velocity, "velocity", "m/s")
    if one.pressure.size == other.pressure.size == 1:
        return Points(one.pressure, velocity), Points(other.pressure, velocity)
    pressure = _common(one.pressure, other.pressure, "pressure", "Pa")
    return Points(pressure, velocity), Points(pressure, velocity)


def _common(a: Array, b: Array, name: str, unit: str) -> Array:
    """`a` where both are the same; else the entries of both where their ranges overlap."""
    if _same(a, b):
        return a
    low, high = max(a.min(), b.min()), min(a.max(), b.max())
    both = np.sort(np.concatenate([a, b]))
    both = both[(both >= low * (1 - _SAME)) & (both <= high * (1 + _SAME))]
    if not both.size:
        spans = " and ".join(f"{x.min():.4g} to {x.max():.4g} {unit}" for x in (a, b))
        raise _ApartError(f"The two have no {name} in common: {spans}.")
    both = both[np.append(True, np.diff(both) > _SAME * both[1:])]
    kept = np.linspace(0, both.size - 1, min(MOST, both.size)).round().astype(int)
    result: Array = both[kept]
    return result


def _same(a: Array, b: Array) -> bool:
    return a.size == b.size and np.allclose(a, b, rtol=_SAME, atol=0)


def _at_points(scene: Scene, curves: SceneFriction, points: Points) -> SceneFriction:
    """The curves where they are those of the points, else computed there, with their band."""
    if _same(scene.pressure, points.pressure) and _same(scene.velocity, points.velocity):
        return curves
    moved = replace(scene, pressure=points.pressure, velocity=points.velocity)
    result = moved.friction()
    return result if curves.band is None else result.within(moved.band(result.mu))


def _told(mine: Points, its: Points, *, anew: bool) -> str:
    v = mine.velocity
    span = f"{v.size} velocities from {v.min():.3g} to {v.max():.3g} m/s"
    text = f"They are compared at {span if v.size > 1 else f'{v[0]:.3g} m/s'}"
    if np.array_equal(mine.pressure, its.pressure):
        text += f" and {_pressures(mine.pressure)}"
    else:
        text += f", each at its own pressure, {_pressures(mine.pressure)} and "
        text += _pressures(its.pressure)
    if not anew:
        return f"{text}."
    return f"{text}. Where these are not points of a scene, it was computed there anew."


def _pressures(pressure: Array) -> str:
    if pressure.size == 1:
        return pressure_text(float(pressure[0]))
    low, high = (pressure_text(float(one)) for one in (pressure.min(), pressure.max()))
    return f"{pressure.size} pressures from {low} to {high}"


def _differences(at: Points, a: SceneFriction, b: SceneFriction) -> list[Difference]:
    """Every point, with the first kind of error that the difference is no larger than."""
    pairs = zip(_intervals(a), _intervals(b), strict=True)
    meet = [(one[0] <= other[1]) & (other[0] <= one[1]) for one, other in pairs]
    verdict = np.argmax([*meet, np.ones_like(meet[0])], axis=0)
    columns = np.broadcast_arrays(at.pressure[:, None], at.velocity, a.mu, b.mu, verdict)
    rows = zip(*(column.ravel().tolist() for column in columns), strict=True)
    return [Difference(*row) for row in rows]


def _intervals(result: SceneFriction) -> list[tuple[Array, Array]]:
    """Where mu is by its numerical error alone, with its inputs', and with its model's besides."""
    mu, error = result.mu, result.error_estimate
    low, high = (mu, mu) if result.band is None else result.band[:2]
    inputs = np.minimum(low, mu) - error, np.maximum(high, mu) + error
    away = result.hysteresis * np.nan_to_num(result.model_error, posinf=0.0)
    return [(mu - error, mu + error), inputs, (inputs[0] - away, inputs[1] + away)]


def differing_inputs(scenes: Sequence[Scene]) -> list[tuple[str, list[str]]]:
    """Keys whose values are not the same in all scenes, and the values."""
    flat = [_flat(scene.inputs) for scene in scenes]
    keys = dict.fromkeys(key for one in flat for key in one)
    rows = [(key, [one.get(key, "not given") for one in flat]) for key in keys]
    return [(key, [shortened(v) for v in values]) for key, values in rows if len({*values}) > 1]


def _flat(inputs: Mapping[str, Mapping[str, Any]]) -> dict[str, str]:
    return {
        f"[{table}] {key}": json_text(value)
        for table, values in inputs.items()
        for key, value in values.items()
    }


def shortened(text: str) -> str:
    return text if len(text) <= _LONGEST else f"{text[: _LONGEST - 3]}..."
