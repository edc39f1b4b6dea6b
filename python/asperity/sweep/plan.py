"""What a sweep is to compute: its axes and inputs, checked, and how it is cut into tasks."""

import hashlib
import itertools
import json
import math
from array import array
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

from asperity._core import __version__
from asperity.base.arguments import brief
from asperity.base.diagnostics import Argument, InvalidInput, Note, must_be, refusal
from asperity.io.fields import nearest
from asperity.results.friction import COLUMNS, HEAT
from asperity.scene.keys import FILES, files_of, with_files
from asperity.scene.scene import check_tables
from asperity.sweep.axes import POINTS, PRESSURE, Axis, axes_of, with_values
from asperity.sweep.parts import digest
from asperity.sweep.task import BAND, Task

MOST_POINTS = 2**19  # of a task: what a worker sends back at once, 4 MB a variable
_SECONDS = 1.0  # that a task is to take
_LONG = 100  # values of an axis that a store's inputs hold; of longer ones their digest

PLAIN = tuple(name for name in COLUMNS if name not in ("pressure", "velocity"))
MEANINGS = {
    **{name: COLUMNS[name] for name in PLAIN},
    **HEAT,
    "temperature": ("K", "temperature of the roughness at q1"),
    "mu_cold": ("1", "friction coefficient without its heat"),
    "mu_low": ("1", "lower end of the band on mu"),
    "mu_high": ("1", "upper end of the band on mu"),
}


@dataclass(frozen=True)
class Plan:
    """A sweep before it is cut."""

    path: Path  # whose errors they are
    tables: Mapping[str, Any]  # of the scene, as they were written
    axes: tuple[Axis, ...]  # as they were written
    task: Task  # the whole sweep as one: with files found, and what the axes set left out
    notes: tuple[Note, ...] = ()  # numbers that their units make unlikely

    @property
    def shape(self) -> tuple[int, ...]:
        return self.task.shape

    @property
    def points(self) -> int:
        return math.prod(self.shape)

    @property
    def inputs(self) -> dict[str, Any]:
        """What makes the sweep this one, by names that a message can tell."""
        scene = {f"{name}.{key}": one for name, t in self.tables.items() for key, one in t.items()}
        over = {axis.name: {k: _short(v) for k, v in axis.values.items()} for axis in self.axes}
        swept = {key for axis in self.axes for key in axis.values}
        return {
            "asperity": __version__,
            "over": list(self.axes and over),
            **{f"over {name}": values for name, values in over.items()},
            **{key: one for key, one in scene.items() if key not in swept},
            **{f"content of {file}": sha for file, sha in self.task.digests.items()},
            "variables": list(self.task.variables),
        }

    def boxes(self, cut: Sequence[int]) -> Iterator[tuple[int, ...]]:
        return itertools.product(
            *(range(0, size, step) for size, step in zip(self.shape, cut, strict=True))
        )

    def box(self, start: Sequence[int], cut: Sequence[int]) -> Task:
        ends = zip(self.task.axes, start, cut, strict=True)
        return self.part(tuple(axis.part(slice(s, s + c)) for axis, s, c in ends), tuple(start))

    def part(self, axes: tuple[Axis, ...], start: tuple[int, ...]) -> Task:
        """A task of some of the values of each axis, with the digests that it needs."""
        used = set(_all_files(self.task.tables, axes))
        digests = {file: sha for file, sha in self.task.digests.items() if file in used}
        return replace(self.task, axes=axes, start=start, digests=digests)


def plan_of(
    path: Path,
    tables: Mapping[str, Any],
    over: object,
    variables: Sequence[str] | None,
    where: Path,
) -> Plan:
    """Check a sweep as far as that is possible before anything is computed.

    `path` is that of the scene, whose folder has its files, `where` that of the axes and variables.
    """
    tables = _plain_tables(path, tables)
    axes = tuple(axes_of(where, over, tables))
    for axis in axes:
        if axis.name in MEANINGS or axis.name.startswith("failure") or axis.name == "zarr.json":
            problem = "is the name of a variable or of a file in the store: must be another"
            raise InvalidInput(Argument(f"over {brief(axis.name)}"), f": {problem}", where=where)
    check_tables(path, with_values(tables, {k: v[0] for a in axes for k, v in a.values.items()}))
    swept = {key for axis in axes for key in axis.values}
    folder = path.parent.absolute()

    def from_anywhere(key: str, one: Any) -> Any:
        return with_files(key, one, lambda file: str(folder / file))

    template = {
        name: {key: from_anywhere(f"{name}.{key}", one) for key, one in table.items()}
        for name, table in tables.items()
    }
    # the axis that goes over a temperature takes the place of the scene's in the other unit
    for one, other in (("k", "c"), ("c", "k")):
        if f"conditions.temperature_{one}" in swept:
            template["conditions"].pop(f"temperature_{other}", None)
    template = with_values(template, dict.fromkeys(swept - {"correction.kind"}))
    template.setdefault("conditions", {})
    absolute: list[Axis] = []
    for axis in axes:
        swept_files = [key for key in FILES if key in axis.values]
        files = {k: tuple(from_anywhere(k, one) for one in axis.values[k]) for k in swept_files}
        absolute.append(replace(axis, values={**axis.values, **files}))
    task = Task(
        path=str(path),
        tables=template,
        axes=tuple(absolute),
        start=(0,) * len(axes),
        shape=tuple(axis.size for axis in axes),
        pressures=_pressures(path, absolute, template),
        digests={file: digest(file) for file in dict.fromkeys(_all_files(template, absolute))},
        variables=_variables(where, template, swept, variables),
    )
    return Plan(path, tables, axes, task)


def _plain_tables(path: Path, tables: object) -> dict[str, Any]:
    if not isinstance(tables, Mapping):
        raise refusal("scene", tables, "the path of a scene, or its tables")
    for name, table in tables.items():
        if not isinstance(table, Mapping):
            raise InvalidInput(f"[{name}] must be a table", where=path)
    try:
        plain: dict[str, Any] = json.loads(json.dumps(tables, default=_listed))
    except (TypeError, ValueError) as error:
        raise must_be("", "what a scene file can hold", f"{error}", where=path) from None
    return plain


def _listed(value: Any) -> Any:
    if hasattr(value, "tolist"):
        return value.tolist()
    if isinstance(value, Path | tuple):
        return str(value) if isinstance(value, Path) else list(value)
    raise TypeError(f"{brief(value)} in the scene")


def _all_files(tables: Mapping[str, Any], axes: Sequence[Axis]) -> Iterator[str]:
    yield from files_of(tables)
    for axis in axes:
        for key in FILES:
            for value in axis.values.get(key, ()):
                yield from (value if isinstance(value, list) else [value] * (value is not None))


def _pressures(path: Path, axes: Sequence[Axis], tables: Mapping[str, Any]) -> tuple[float, float]:
    for axis in axes:
        if PRESSURE in axis.values:
            return min(axis.values[PRESSURE]), max(axis.values[PRESSURE])
    for key in POINTS:
        if not any(key in axis.values for axis in axes):
            name = key.partition(".")[2]
            if not isinstance(tables["conditions"].get(name), int | float):
                raise must_be(f"[conditions] {name}", "a number", ": missing", where=path)
    pressure = float(tables["conditions"][PRESSURE.partition(".")[2]])
    return pressure, pressure


def _variables(
    path: Path,
    tables: Mapping[str, Any],
    swept: set[str],
    wanted: Sequence[str] | None,
) -> tuple[str, ...]:
    has = {name for name in tables} | {key.partition(".")[0] for key in swept}
    every = [*PLAIN]
    if "heating" in has:
        every += [*HEAT, "mu_cold"]
    if "uncertainty" in has:
        every += BAND
    if wanted is None:
        return tuple(every)
    if not isinstance(wanted, list | tuple) or not wanted:
        raise refusal("variables", wanted, "a list of names")
    for name in wanted:
        if name not in every:
            raise InvalidInput(
                f"{path}: variables: {brief(name)} is none of this sweep, "
                + nearest(str(name), dict.fromkeys(every))
            )
    band = ["mu"] if set(wanted) & set(BAND) else []  # which is relative to it
    return tuple(name for name in every if name in {*wanted, *band})


def _short(values: Sequence[Any]) -> Any:
    if len(values) <= _LONG:
        return list(values)
    content = values if isinstance(values, array) else json.dumps(values).encode()
    return {"values": len(values), "sha256": hashlib.sha256(content).hexdigest()}


@dataclass(frozen=True)
class Cost:
    """Measured seconds: of a point, of a scene that changes along each axis, of a warm one."""

    point: float
    scene: float
    change: Mapping[int, float]  # by the axis that changes


def cut_of(plan: Plan, cost: Cost) -> tuple[int, ...]:
    """How long a task's box is along each axis, for tasks of about a second.

    Axes of points come first, the last of them before others; then those whose scenes are cheap.
    """
    task = plan.task
    moved = task.moved
    fixed = sorted(task.fixed, key=lambda i: (cost.change.get(i, cost.scene), -i))
    cut = [1] * len(task.shape)
    for i in moved[::-1]:
        size = task.shape[i]
        now = math.prod(cut)
        each = max(now * cost.point, 1e-12)
        most = min((_SECONDS - cost.scene) / each, MOST_POINTS / now)
        cut[i] = size if task.is_whole else _even(size, most)
        if cut[i] < size:
            return tuple(cut)
    seconds = math.prod(cut) * cost.point + cost.scene
    for i in fixed:
        each = seconds + max(cost.change.get(i, 0.0) - cost.scene, 0.0)
        most = min(_SECONDS / max(each, 1e-12), MOST_POINTS / math.prod(cut))
        cut[i] = _even(task.shape[i], most)
        seconds = each * cut[i]
        if cut[i] < task.shape[i]:
            break
    return tuple(cut)


def _even(size: int, most: float) -> int:
    """The length of parts that are about equal, at most so long."""
    parts = math.ceil(size / max(1, min(size, int(most))))
    return math.ceil(size / parts)
