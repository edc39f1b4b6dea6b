"""What a worker computes: friction in a box of the sweep's points."""

import itertools
import math
import time
import zlib
from collections.abc import Iterator, Mapping
from contextlib import suppress
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from asperity._core import Error, InvalidInput, NotConverged, OutOfRange, __version__
from asperity.friction import Friction
from asperity.io import plausible
from asperity.scene.model import Scene
from asperity.scene.rubber import stiffest
from asperity.scene.scene import Builders, build_scene
from asperity.sweep.axes import PRESSURE, VELOCITY, Axis, with_values
from asperity.sweep.parts import ChangedFile, KeptBuilders

MOST_MESSAGES = 1000  # that a sweep keeps: those with the smallest codes
_FAILURES = (InvalidInput, NotConverged, OutOfRange)
BAND = ("mu_low", "mu_high")
Numbers = NDArray[np.float64]


@dataclass(frozen=True)
class Task:
    """A box of a sweep's points, with all that a worker needs to compute it."""

    path: str  # whose errors they are
    tables: Mapping[str, Any]  # of the scene, without the keys of the axes
    axes: tuple[Axis, ...]  # the values in the box
    start: tuple[int, ...]  # of the box
    shape: tuple[int, ...]  # of the whole sweep
    pressures: tuple[float, float]  # the lowest and the highest of the whole sweep
    digests: Mapping[str, str]
    variables: tuple[str, ...]
    store: tuple[str, str] | None = None  # where results go, and the text that is in its token
    version: str = __version__

    @property
    def box(self) -> tuple[int, ...]:
        return tuple(axis.size for axis in self.axes)


@dataclass
class Outcome:
    """What came of a task."""

    start: tuple[int, ...]
    box: tuple[int, ...]
    values: dict[str, Any] = field(default_factory=dict)  # arrays of the box's shape, or a number
    sums: list[int] | None = None  # checksums, where the worker has written the values
    failure: NDArray[np.uint32] | None = None  # codes of messages, 0 where there is none
    messages: dict[int, str] = field(default_factory=dict)
    kinds: dict[str, int] = field(default_factory=dict)  # failed points by kind of error
    notes: dict[str, int] = field(default_factory=dict)  # with the first scene that has it
    seconds: float = 0.0

    @property
    def failed(self) -> int:
        return sum(self.kinds.values())

    @property
    def points(self) -> int:
        return math.prod(self.box)

    def array(self, name: str) -> Numbers:
        """The numbers of a variable, NaN where nothing was put."""
        if name not in self.values:
            self.values[name] = np.full(self.box, np.nan)
        found: Numbers = self.values[name]
        return found

    def fail(self, where: Any, error: Error) -> None:
        """Note why there is nothing at `where`, an index of the box."""
        message = str(error)
        code = zlib.crc32(message.encode(errors="backslashreplace")) or 1
        if self.failure is None:
            self.failure = np.zeros(self.box, np.uint32)
        kind = type(error).__name__
        new = int(np.sum(self.failure[where] == 0))
        self.failure[where] = code
        self.kinds[kind] = self.kinds.get(kind, 0) + new
        keep_message(self.messages, code, message)


def keep_message(messages: dict[int, str], code: int, message: str) -> None:
    """Keep a message, and no more than a sweep keeps; which ones does not depend on their order."""
    messages[code] = message
    if len(messages) > MOST_MESSAGES:
        del messages[max(messages)]


def compute(task: Task) -> Outcome:
    """Return friction at every point of a task's box; what fails leaves NaN and a message."""
    if task.version != __version__:
        raise ChangedFile(f"a worker has asperity {__version__}, the sweep {task.version}")
    began = time.perf_counter()
    box = task.box
    outcome = Outcome(task.start, box)
    moved = [i for i, axis in enumerate(task.axes) if is_moved(axis, task.variables)]
    fixed = [i for i in range(len(box)) if i not in moved]
    whole = tuple(task.shape[i] for i in fixed)
    for place in itertools.product(*(range(box[i]) for i in fixed)):
        at: list[Any] = [slice(None)] * len(box)
        for i, index in zip(fixed, place, strict=True):
            at[i] = index
        first = [task.start[i] + index for i, index in zip(fixed, place, strict=True)]
        number = int(np.ravel_multi_index(first, whole)) if whole else 0
        _compute_scene(task, outcome, tuple(at), moved, number)
    for name in task.variables:
        outcome.values[name] = _sent(outcome.array(name))
    outcome.seconds = time.perf_counter() - began
    return outcome


def _sent(values: Numbers) -> Any:
    """What is sent of numbers: one where all are the same, without adhesion or shift say."""
    bits = values.reshape(-1).view(np.uint64)
    if bits.size > 1 and bits[0] == bits[-1] and (bits == bits[0]).all():
        return values.flat[0]
    return values


def is_moved(axis: Axis, variables: tuple[str, ...]) -> bool:
    """Whether an axis moves points of a scene; a band needs all pressures at all velocities."""
    return axis.of_points and (len(axis.values) == 1 or not set(BAND) & set(variables))


def _compute_scene(
    task: Task, outcome: Outcome, at: tuple[Any, ...], moved: list[int], number: int
) -> None:
    values = {
        key: entries[index]
        for axis, index in zip(task.axes, at, strict=True)
        if isinstance(index, int)
        for key, entries in axis.values.items()
    }
    points = [task.axes[i] for i in moved]
    tables = with_values(task.tables, values)
    shape = tuple(axis.size for axis in points)
    try:
        pressure = _along(points, PRESSURE, tables)
        velocity = _along(points, VELOCITY, tables)
        scene = _scene(task, tables, pressure, outcome, number)
    except ChangedFile:
        raise
    except _FAILURES as error:
        outcome.fail(at, error)
        return
    flat_p, flat_v = (np.broadcast_to(one, shape).ravel() for one in (pressure, velocity))
    for part, result in _results(scene, flat_p, flat_v):
        if isinstance(result, Error):
            where = list(at)
            for i, index in zip(moved, np.unravel_index(part.start, shape), strict=True):
                where[i] = int(index)
            outcome.fail(tuple(where), result)
            continue
        for note in result._plain_notes():
            outcome.notes[note] = min(number, outcome.notes.get(note, number))
        for name in task.variables:
            if name not in BAND:
                _put(outcome, name, at, shape, part, _found(result, name))
    if set(BAND) & set(task.variables):
        _band(scene, points, pressure, velocity, outcome, at)


def _found(result: Friction, name: str) -> Any:
    of = result.cold if name == "mu_cold" else result
    return getattr(of, name.removesuffix("_cold"))


def _put(
    outcome: Outcome,
    name: str,
    at: tuple[Any, ...],
    shape: tuple[int, ...],
    part: slice,
    found: Numbers,
) -> None:
    """Put the numbers of a run of a scene's points into their places."""
    if found.size == outcome.points:  # of a box of one scene: without a copy
        outcome.values[name] = np.array(found, float, copy=None).reshape(outcome.box)
    elif not shape:
        outcome.array(name)[at] = found[0]
    elif part == slice(0, math.prod(shape)):
        outcome.array(name)[at] = np.reshape(found, shape)
    else:
        places = np.unravel_index(np.arange(part.start, part.stop), shape)
        outcome.array(name)[at][places] = found


def _along(points: list[Axis], key: str, tables: Mapping[str, Any]) -> Numbers:
    """Pressures or velocities over the axes of points, which broadcast; or the scene's number."""
    for i, axis in enumerate(points):
        if key in axis.values:
            shape = [1] * len(points)
            shape[i] = axis.size
            return np.reshape(np.array(axis.values[key], float), shape)
    table, _, name = key.partition(".")
    given = tables.get(table, {}).get(name)
    if given is None:
        raise InvalidInput(f"[{table}] {name}: missing")
    return np.array(given, float)


def _scene(
    task: Task, tables: dict[str, Any], pressure: Numbers, outcome: Outcome, number: int
) -> Scene:
    """The scene of a place, whose own points are not used; its notes are kept."""
    path = Path(task.path)
    placed = {**tables, "conditions": {**tables["conditions"]}}
    lowest, highest = task.pressures if np.ndim(pressure) else (float(pressure),) * 2
    placed["conditions"] |= {"pressure_pa": lowest, "velocity_m_s": 1.0}
    kept = KeptBuilders(task.digests)
    builders = Builders(kept.surface, kept.rubber, kept.correction)
    with plausible.collected() as notes:
        scene = build_scene(path, placed, for_friction=True, builders=builders)
        with suppress(InvalidInput):  # of some of the points, which fail on their own
            where = f"{path}: [conditions] pressure_pa"
            plausible.check_load(where, highest, stiffest(scene.rubber))
    for note in (*notes, *scene.notes):
        outcome.notes[note] = min(number, outcome.notes.get(note, number))
    return scene


def _results(
    scene: Scene, pressure: Numbers, velocity: Numbers
) -> Iterator[tuple[slice, Friction | Error]]:
    """Results of runs of points that can be computed, and the error of each that cannot.

    A call fails as a whole, so that what failed is halved until single points are left: which
    points fail, and with which message, does not depend on how the sweep was cut.
    """
    pending = [slice(0, pressure.size)]
    hardest = stiffest(scene.rubber)
    where = f"{scene.path}: [conditions] pressure_pa"
    while pending:
        part = pending.pop()
        try:
            with plausible.collected():
                plausible.check_load(where, pressure[part], hardest)
            yield part, scene.friction_at(pressure[part], velocity[part])
        except _FAILURES as error:
            if part.stop - part.start == 1:
                yield part, error
                continue
            middle = (part.start + part.stop) // 2
            pending += [slice(middle, part.stop), slice(part.start, middle)]


def _band(
    scene: Scene,
    points: list[Axis],
    pressure: Numbers,
    velocity: Numbers,
    outcome: Outcome,
    at: tuple[Any, ...],
) -> None:
    """Lower and upper mu of a scene's pressures and velocities, all of which are in the box."""
    swept = replace(scene, pressure=pressure.ravel(), velocity=velocity.ravel())
    turned = bool(points) and VELOCITY in points[0].values and len(points) == 2
    mu = outcome.array("mu")[at]
    ones = np.ones((swept.pressure.size, swept.velocity.size))
    try:
        bounds = swept.band(ones)
    except _FAILURES as error:
        outcome.fail(at, error)
        return
    for name, share in zip(BAND, (bounds.lower, bounds.upper), strict=True):
        factor = share.T if turned else share
        outcome.array(name)[at] = mu * factor.reshape(np.shape(mu))
    for note in bounds.notes:
        outcome.notes.setdefault(note, 0)
