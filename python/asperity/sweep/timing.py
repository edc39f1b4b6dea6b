"""What a sweep costs, from tasks that a worker was timed on."""

from collections.abc import Mapping
from dataclasses import replace

import numpy as np

from asperity._core import InvalidInput
from asperity.sweep.executors import Executor, result_of
from asperity.sweep.plan import Cost, Plan
from asperity.sweep.task import compute, is_moved

_TIMED = 0.2  # seconds that a timed task takes at least
_MOST_TIMED = 20_000  # points of it at most


def timed(plan: Plan, executor: Executor) -> Cost:
    """Seconds of a point and of a scene, measured by a worker on some of the points.

    What an axis of scenes costs is measured by a step along it. Points are taken from all over
    their axes, for some are harder than others.
    """
    task = plan.task
    moved = [i for i, axis in enumerate(task.axes) if is_moved(axis, task.variables)]

    refused: list[str] = []  # places that make no scene

    def seconds(points: int, at: Mapping[int, int]) -> tuple[float, int]:
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
        outcome = result_of(executor.submit(compute, replace(part, shape=part.box)))
        size = int(np.prod(part.box))
        if outcome.kinds.get("InvalidInput") == size:
            refused.extend(outcome.messages.values())
        return outcome.seconds, size

    seconds(1, {})  # a cold worker
    warm = seconds(1, {})[0]
    points, took, count = 64, warm, 1
    while moved and not refused and took < _TIMED and points <= _MOST_TIMED:
        took, now = seconds(points, {})
        if now <= count:
            break
        count, points = now, 4 * points
    change = {
        i: max(warm, seconds(1, {i: 1})[0])
        for i, axis in enumerate(task.axes)
        if i not in moved and axis.size > 1
    }
    if len(refused) >= 2 + len(change):  # the scene, not some of the values
        raise InvalidInput(refused[0])
    return Cost(max(took - warm, 1e-9) / max(count - 1, 1), warm, change)


def estimated(plan: Plan, cost: Cost) -> float:
    """Seconds that one worker would take, without what is built once."""
    moved = [is_moved(axis, plan.task.variables) for axis in plan.task.axes]
    scenes = int(np.prod([n for n, m in zip(plan.shape, moved, strict=True) if not m], initial=1))
    each = max([cost.scene, *cost.change.values()])
    return plan.points * cost.point + scenes * each
