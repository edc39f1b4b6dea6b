"""What a worker computes: friction in a box of the sweep's points."""

import itertools
import time
from collections.abc import Iterator, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np

from asperity._core import Error, InvalidInput, NotConverged, OutOfRange, __version__
from asperity.friction import Friction
from asperity.io import plausible
from asperity.scene.model import Scene
from asperity.scene.scene import build_scene
from asperity.sweep import chunks
from asperity.sweep.axes import PRESSURE, VELOCITY, Axis, with_values
from asperity.sweep.chunks import Place
from asperity.sweep.outcome import Numbers, Outcome, Where
from asperity.sweep.parts import ChangedFile, WorkersBuilders

_FAILURES = (InvalidInput, NotConverged, OutOfRange)
BAND = ("mu_low", "mu_high")


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
    store: Place | None = None  # where results go, if not back
    version: str = __version__

    @property
    def box(self) -> tuple[int, ...]:
        return tuple(axis.size for axis in self.axes)

    @property
    def wants_band(self) -> bool:
        return bool(set(BAND) & set(self.variables))

    @property
    def has_heat(self) -> bool:
        swept = (key for axis in self.axes for key in axis.values)
        return "heating" in self.tables or any(key.startswith("heating.") for key in swept)

    @property
    def is_whole(self) -> bool:
        """Whether points of a scene are never cut: heat at a velocity begins from the one before
        it, and a band is of all points."""
        return self.has_heat or self.wants_band

    @property
    def fixed(self) -> list[int]:
        """Axes whose values make another scene each; scenes are numbered along them."""
        return [i for i in range(len(self.axes)) if i not in self.moved]

    @property
    def moved(self) -> list[int]:
        """Axes that move points of a scene, which one call computes together.

        A band needs all pressures at all velocities. With heat a call has one pressure.
        """
        points = [(i, axis.values) for i, axis in enumerate(self.axes) if axis.of_points]
        if self.wants_band:
            return [i for i, values in points if len(values) == 1]
        return [i for i, values in points if VELOCITY in values or not self.has_heat]


def compute(task: Task) -> Outcome:
    """Return friction at every point of a task's box; what fails leaves NaN and a message."""
    if task.version != __version__:
        raise ChangedFile(f"a worker has asperity {__version__}, the sweep {task.version}")
    began = time.thread_time()
    outcome = Outcome(task.start, task.box)
    fixed = task.fixed
    for place in itertools.product(*(range(task.box[i]) for i in fixed)):
        _compute_scene(task, outcome, dict(zip(fixed, place, strict=True)))
    for name in task.variables:
        outcome.values[name] = _sent(outcome.array(name))
    outcome.seconds = time.thread_time() - began
    return outcome


def _sent(values: Numbers) -> Any:
    """What is sent of numbers: one where all are the same, without adhesion or shift say."""
    bits = values.reshape(-1).view(np.uint64)
    if bits.size > 1 and bits[0] == bits[-1] and (bits == bits[0]).all():
        return values.flat[0]
    return values


def _compute_scene(task: Task, outcome: Outcome, at: dict[int, int]) -> None:
    rows = (slice(at[i], at[i] + 1) if i in at else slice(None) for i in range(len(task.box)))
    where = (*rows, ...)
    first = [task.start[i] + index for i, index in at.items()]
    number = int(np.ravel_multi_index(first, [task.shape[i] for i in at])) if at else 0
    values = {
        key: entries[index]
        for i, index in at.items()
        for key, entries in task.axes[i].values.items()
    }
    points = [task.axes[i] for i in task.moved]
    tables = with_values(task.tables, values)
    shape = tuple(axis.size for axis in points)
    try:
        pressure = _along(points, PRESSURE, tables)
        velocity = _along(points, VELOCITY, tables)
        scene = _scene(task, tables, pressure, velocity, outcome, number)
    except ChangedFile:
        raise
    except _FAILURES as error:
        outcome.refused += isinstance(error, InvalidInput)
        outcome.fail(error, where)
        return
    flat_p, flat_v = (np.broadcast_to(one, shape).ravel() for one in (pressure, velocity))
    for part, result in _results(scene, flat_p, flat_v):
        if isinstance(result, Error):
            outcome.fail(result, where, part)
            continue
        # "small-friction" is on all points of a scene, of which this has some
        outcome.note((one for one in result.notes if one.code != "small-friction"), number)
        for name in task.variables:
            if name not in BAND:
                outcome.put(name, where, part, _column(result, name))
    if task.wants_band:
        _band(scene, points, pressure, velocity, outcome, where, number)


def _column(result: Friction, name: str) -> Any:
    of = result.cold if name == "mu_cold" else result
    return getattr(of, name.removesuffix("_cold"))


def _along(points: list[Axis], key: str, tables: Mapping[str, Any]) -> Numbers:
    """Pressures or velocities over the axes of points, which broadcast; or the scene's number."""
    for i, axis in enumerate(points):
        if key in axis.values:
            shape = [1] * len(points)
            shape[i] = axis.size
            return np.reshape(np.array(axis.values[key], float), shape)
    table, _, name = key.partition(".")
    entry = tables.get(table, {}).get(name)
    if entry is None:
        raise InvalidInput(f"[{table}] {name}: missing")
    return np.array(entry, float)


def _scene(
    task: Task,
    tables: dict[str, Any],
    pressure: Numbers,
    velocity: Numbers,
    outcome: Outcome,
    number: int,
) -> Scene:
    """The scene of a place, whose own points are not used; its notes are kept.

    Numbers of an axis of points were checked when the sweep was planned.
    """
    path = Path(task.path)
    placed = {**tables, "conditions": {**tables["conditions"]}}
    lowest, highest = task.pressures if np.ndim(pressure) else (float(pressure),) * 2
    alone = 1.0 if np.ndim(velocity) else float(velocity)
    placed["conditions"] |= {"pressure_pa": lowest, "velocity_m_s": alone}
    with plausible.collected() as notes:
        scene = build_scene(path, placed, for_friction=True, builders=WorkersBuilders(task.digests))
        with suppress(InvalidInput):  # of some of the points, which fail on their own
            name = "[conditions] pressure_pa"
            plausible.check_load(name, highest, scene.rubber._stiffest, path=path)
    outcome.note((*notes, *scene.notes), number)
    return scene


def _results(
    scene: Scene, pressure: Numbers, velocity: Numbers
) -> Iterator[tuple[slice, Friction | Error]]:
    """Results of runs of points that can be computed, and the error of each that cannot.

    A call fails as a whole, so that what failed is halved until single points are left: which
    points fail, and with which message, does not depend on how the sweep was cut.
    """
    pending = [slice(0, pressure.size)]
    hardest = scene.rubber._stiffest
    while pending:
        part = pending.pop()
        try:
            with plausible.collected():
                name = "[conditions] pressure_pa"
                plausible.check_load(name, pressure[part], hardest, path=scene.path)
            yield part, scene.friction_at(pressure[part], velocity[part])
        except _FAILURES as error:
            if part.stop - part.start == 1:
                yield part, error
                continue
            pending += _halves(part)


def _band(
    scene: Scene,
    points: list[Axis],
    pressure: Numbers,
    velocity: Numbers,
    outcome: Outcome,
    where: Where,
    number: int,
) -> None:
    """Lower and upper mu of a scene's pressures and velocities, all of which are in the box."""
    mu = outcome.array("mu")[where]
    turned = len(points) == 2 and VELOCITY in points[0].values
    grid = (pressure.size, velocity.size)
    place = np.arange(mu.size).reshape(grid[::-1]).T if turned else np.arange(mu.size).reshape(grid)
    shares = np.full((2, mu.size), np.nan)
    pending = [(slice(0, grid[0]), slice(0, grid[1]))]
    while pending:  # what fails is cut, pressures first, until single points are left
        part = pending.pop()
        rows, columns = part
        swept = replace(scene, pressure=pressure.ravel()[rows], velocity=velocity.ravel()[columns])
        try:
            bounds = swept.band(np.ones((swept.pressure.size, swept.velocity.size)))
        except _FAILURES as error:
            if swept.pressure.size > 1:
                pending += [(half, columns) for half in _halves(rows)]
            elif swept.velocity.size > 1:
                pending += [(rows, half) for half in _halves(columns)]
            else:
                k = int(place[rows.start, columns.start])
                outcome.fail(error, where, slice(k, k + 1))
            continue
        shares[:, place[part]] = bounds.lower, bounds.upper
        outcome.note(bounds.notes, number)
    for name, share in zip(BAND, shares, strict=True):
        outcome.array(name)[where] = mu * share.reshape(mu.shape)


def _halves(part: slice) -> tuple[slice, slice]:
    middle = (part.start + part.stop) // 2
    return slice(middle, part.stop), slice(part.start, middle)


TOKEN = "_sweep/token"  # a text that no other store has, by which a worker knows this one


def work(task: Task) -> Outcome:
    """Compute a task. What is for a store is written if this process sees it, else it goes back."""
    outcome = compute(task)
    if task.store is not None:
        outcome.contents = chunks.encoded(outcome, task.variables, task.store.cut)
        outcome.sums = chunks.checksums(outcome.contents)
        outcome.values, outcome.failure = {}, None
        if _sees(task.store):
            write_box(task.store, task.variables, outcome)
    return outcome


def write_box(store: Place, variables: Sequence[str], outcome: Outcome) -> None:
    try:
        chunks.write(store.files(outcome.start, variables), outcome.contents or [])
    except OSError as error:
        reason = error.strerror or error
        raise Error(f"{store.path}: cannot be written: {reason}; --resume goes on") from error
    outcome.contents = None


def token_of(path: Path) -> str | None:
    """The text that is in a store's token; None where it cannot be read."""
    try:
        return (path / TOKEN).read_text()
    except (OSError, ValueError):
        return None


def _sees(store: Place) -> bool:
    return token_of(Path(store.path)) == store.token
