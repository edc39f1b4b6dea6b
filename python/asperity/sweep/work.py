"""A task as a worker does it: computed, and written where the worker sees the store."""

from collections.abc import Mapping, Sequence
from functools import lru_cache
from pathlib import Path
from typing import Any

import numpy as np

from asperity._core import Error
from asperity.base.table import imported
from asperity.sweep.task import Outcome, Task, compute

TOKEN = "_sweep/token"  # a text that no other store has, by which a worker knows this one


def work(task: Task) -> Outcome:
    """Compute a task. Its numbers go into the store if this process sees it, else they go back."""
    outcome = compute(task)
    if task.store is not None and _sees(*task.store):
        arrays = _arrays(*task.store, task.variables)
        outcome.sums = write_box(Path(task.store[0]), arrays, outcome)
        outcome.values, outcome.failure = {}, None
    return outcome


def write_box(path: Path, arrays: Mapping[str, Any], outcome: Outcome) -> list[int]:
    """Write the chunks of a box, each whole or not at all; return sums to know them by."""
    where = where_of(outcome)
    failure: Any = np.uint32(0) if outcome.failure is None else outcome.failure
    parts = {**outcome.values, "failure": failure}
    try:
        for name, array in arrays.items():
            array[where] = parts[name]
    except OSError as error:
        reason = error.strerror or error
        raise Error(f"{path}: cannot be written: {reason}; --resume goes on") from error
    return [bits(parts[name], outcome.points) for name in arrays]


def where_of(outcome: Outcome) -> tuple[slice, ...]:
    return tuple(slice(s, s + size) for s, size in zip(outcome.start, outcome.box, strict=True))


def bits(numbers: Any, points: int) -> int:
    """The sum of the bits as whole numbers, by which numbers that are missing or torn are seen."""
    array = np.asarray(numbers)
    whole = np.ascontiguousarray(array).view(f"u{array.itemsize}")
    return int(whole.sum(dtype=np.uint64)) * (points if array.ndim == 0 else 1) % 2**64


def arrays_of(group: Any, variables: Sequence[str]) -> dict[str, Any]:
    return {name: group[name] for name in (*variables, "failure")}


def _sees(path: str, token: str) -> bool:
    try:
        return (Path(path) / TOKEN).read_text() == token
    except OSError:
        return False


@lru_cache(maxsize=4)
def _arrays(path: str, token: str, variables: tuple[str, ...]) -> dict[str, Any]:
    group = imported("zarr", "sweep").open_group(path, mode="r+", use_consolidated=False)
    return arrays_of(group, variables)
