"""Several scenes side by side: by which inputs they differ, and where their mu does."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from asperity.io.table import json_text
from asperity.report.texts import percent_text
from asperity.scene.model import Curves, Scene

_SAME = 1e-9  # relative: pressures and velocities of a sweep that are one point
_LONGEST = 60  # characters of an input that is shown

VERDICTS = (
    "by no more than the numerical error",
    "by no more than the bands of the inputs",
    "by more than these bands, but by no more than the model may be off",
    "by more than all errors that are known",
)


@dataclass(frozen=True)
class Difference:
    """One point that two results share."""

    pressure: float
    velocity: float
    first: float  # mu
    second: float
    verdict: int  # of VERDICTS

    @property
    def percent(self) -> str:
        if self.first == 0:
            return "-"
        return percent_text(100 * (self.second / self.first - 1), "+")


@dataclass(frozen=True)
class Pair:
    """A result held against the first."""

    first: str
    second: str
    differences: Sequence[Difference]

    @property
    def summary(self) -> list[str]:
        """A sentence for each verdict that occurs."""
        if not self.differences:
            return ["The two have no pressure and velocity in common: give both the same sweep."]
        lines = []
        for verdict, meaning in enumerate(VERDICTS):
            of_it = [one for one in self.differences if one.verdict == verdict]
            if of_it:
                v = [one.velocity for one in of_it]
                lines.append(
                    f"{len(of_it)} of {len(self.differences)} points differ {meaning}, "
                    f"from {min(v):.3g} to {max(v):.3g} m/s."
                )
        return lines


def compared(names: Sequence[str], scenes: Sequence[Scene], curves: Sequence[Curves]) -> list[Pair]:
    """Every result against the first."""
    pairs = zip(names[1:], scenes[1:], curves[1:], strict=True)
    return [
        Pair(names[0], name, _differences(scenes[0], curves[0], scene, curve))
        for name, scene, curve in pairs
    ]


def _differences(one: Scene, a: Curves, other: Scene, b: Curves) -> list[Difference]:
    found = []
    for i, j in _shared(one.pressure, other.pressure):
        for k, m in _shared(one.velocity, other.velocity):
            verdict = _verdict(_intervals(a, i, k), _intervals(b, j, m))
            found.append(
                Difference(
                    float(one.pressure[i]),
                    float(one.velocity[k]),
                    float(a.mu[i, k]),
                    float(b.mu[j, m]),
                    verdict,
                )
            )
    return found


def _shared(a: NDArray[np.float64], b: NDArray[np.float64]) -> list[tuple[int, int]]:
    """Which entries of two sweeps are the same."""
    nearest = [int(np.abs(b - value).argmin()) for value in a]
    pairs = enumerate(nearest)
    return [(i, j) for i, j in pairs if abs(b[j] - a[i]) <= _SAME * max(abs(a[i]), abs(b[j]))]


def _intervals(result: Curves, i: int, k: int) -> list[tuple[float, float]]:
    """Where mu is by its numerical error alone, with its inputs', and with its model's besides."""
    mu, error = float(result.mu[i, k]), float(result.error_estimate[i, k])
    numerical = (mu - error, mu + error)
    low, high = (mu, mu) if result.band is None else (float(x[i, k]) for x in result.band)
    inputs = (min(low, mu) - error, max(high, mu) + error)
    off = 0.0 if result.model_error is None else float(result.model_error[i, k])
    away = float(result.hysteresis[i, k]) * (off if np.isfinite(off) else 0.0)
    return [numerical, inputs, (inputs[0] - away, inputs[1] + away)]


def _verdict(a: Sequence[tuple[float, float]], b: Sequence[tuple[float, float]]) -> int:
    """The first kind of error that the difference is no larger than."""
    for verdict, (mine, its) in enumerate(zip(a, b, strict=True)):
        if mine[0] <= its[1] and its[0] <= mine[1]:
            return verdict
    return len(VERDICTS) - 1


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
