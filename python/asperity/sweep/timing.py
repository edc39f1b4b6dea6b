"""What a sweep costs, from tasks that a worker was timed on."""

import itertools
import math
from collections.abc import Mapping
from dataclasses import replace

import numpy as np

from asperity._core import InvalidInput
from asperity.sweep.executors import Executor, result_of
from asperity.sweep.outcome import Outcome
from asperity.sweep.plan import Cost, Plan
from asperity.sweep.task import compute

_TIMED = 0.05  # seconds that a timed task takes at least
_MOST_TIMED = 20_000  # points of it at most
_MOST_TRIED = 1000  # scenes that are tried until one can be built
_UNKNOWN = 1e-3  # seconds of a scene where none could be timed


def timed(plan: Plan, executor: Executor) -> Cost:
    """Seconds of a point and of a scene, measured by a worker on some of the points.

    What an axis of scenes costs is measured by a step along it. Points are taken from all over
    their axes, for some are harder than others.

    Raises
    ------
    InvalidInput
        No scene of the sweep can be built of its values; the message is that of the first.
    """
    task = plan.task
    moved = task.moved

    def outcome_of(points: int, at: Mapping[int, int]) -> Outcome:
        axes = []
        for i, axis in enumerate(task.axes):
            if i in moved:
                each = max(1, round(points ** (1 / len(moved))))
                chosen = np.unique(np.linspace(0, axis.size - 1, min(each, axis.size)).astype(int))
            else:
                chosen = np.array([at.get(i, 0)])
            entries = {key: tuple(v[j] for j in chosen) for key, v in axis.values.items()}
            axes.append(replace(axis, values=entries))
        part = plan.part(tuple(axes), (0,) * len(axes))
        outcome: Outcome = result_of(executor.submit(compute, replace(part, shape=part.box)))
        return outcome

    fixed = task.fixed
    refusal: str | None = None
    for count, place in enumerate(itertools.product(*(range(task.shape[i]) for i in fixed))):
        if count == _MOST_TRIED:
            return Cost(_UNKNOWN, _UNKNOWN, {})
        at = dict(zip(fixed, place, strict=True))
        cold = outcome_of(1, at)
        if not cold.refused:
            break
        refusal = refusal or next(iter(cold.messages.values()))
    else:
        raise InvalidInput(refusal or "")
    warm = outcome_of(1, at).seconds
    points, took, size = 64, warm, 1
    while moved and took < _TIMED and points <= _MOST_TIMED:
        outcome = outcome_of(points, at)
        took = outcome.seconds
        if outcome.points <= size:
            break
        size, points = outcome.points, 4 * points
    change = {
        i: max(warm, outcome_of(1, {**at, i: (at[i] + 1) % task.shape[i]}).seconds)
        for i in fixed
        if task.shape[i] > 1
    }
    return Cost(max(took - warm, 1e-9) / max(size - 1, 1), warm, change)


def estimated(plan: Plan, cost: Cost) -> float:
    """Seconds that one worker would take, without what is built once."""
    moved = plan.task.moved
    scenes = math.prod(n for i, n in enumerate(plan.shape) if i not in moved)
    each = max([cost.scene, *cost.change.values()])
    return plan.points * cost.point + scenes * each
