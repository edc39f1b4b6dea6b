"""A task as a worker does it: computed, and written where the worker sees the store."""

import zlib
from collections.abc import Mapping, Sequence
from functools import lru_cache
from pathlib import Path
from typing import Any

import numpy as np

from asperity._core import Error
from asperity.base.table import imported
from asperity.sweep.outcome import Outcome
from asperity.sweep.task import Task, compute

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
    """Write the chunks of a box, each whole or not at all; return their checksums."""
    where = where_of(outcome)
    failure: Any = np.int64(0) if outcome.failure is None else outcome.failure
    parts = {**outcome.values, "failure": failure}
    try:
        for name, array in arrays.items():
            array[where] = parts[name]
    except OSError as error:
        reason = error.strerror or error
        raise Error(f"{path}: cannot be written: {reason}; --resume goes on") from error
    return [checksum(parts[name], outcome.box) for name in arrays]


def where_of(outcome: Outcome) -> tuple[slice, ...]:
    return tuple(slice(s, s + size) for s, size in zip(outcome.start, outcome.box, strict=True))


def checksum(numbers: Any, box: tuple[int, ...]) -> int:
    """CRC-32 of the numbers of a box in order, by which missing, torn or moved ones are seen."""
    return zlib.crc32(np.ascontiguousarray(np.broadcast_to(numbers, box)).data)


def arrays_of(group: Any, variables: Sequence[str]) -> dict[str, Any]:
    return {name: group[name] for name in (*variables, "failure")}


def token_of(path: Path) -> str | None:
    """The text that is in a store's token; None where it cannot be read."""
    try:
        return (path / TOKEN).read_text()
    except (OSError, ValueError):
        return None


def _sees(path: str, token: str) -> bool:
    return token_of(Path(path)) == token


@lru_cache(maxsize=4)
def _arrays(path: str, token: str, variables: tuple[str, ...]) -> dict[str, Any]:
    group = imported("zarr", "sweep").open_group(path, mode="r+", use_consolidated=False)
    return arrays_of(group, variables)
