"""Executors of the user's: whatever has the `submit` of `concurrent.futures`."""

from contextlib import suppress
from typing import Any

from asperity.base.diagnostics import unfit

_UNTOLD = 8


def accepted(executor: Any) -> Any:
    """Return what takes the tasks of an executor."""
    if not callable(getattr(executor, "submit", None)):
        allowed = "must have the submit of concurrent.futures"
        raise unfit("executor", executor, allowed)
    if callable(getattr(executor, "get_executor", None)):  # Dask: equal tasks are not one task
        return executor.get_executor(pure=False)
    return executor


def worker_count(executor: Any) -> int:
    """Return how many tasks an executor computes at once, 1 or more; a few if it does not tell."""
    for dask in (executor, getattr(executor, "_client", None)):
        if callable(cores := getattr(dask, "ncores", None)):
            return max(1, int(sum(cores().values())))
    for name in ("num_workers", "_max_workers"):  # mpi4py.futures, concurrent.futures
        with suppress(Exception):
            if isinstance(count := getattr(executor, name, None), int):
                return max(1, count)
    return _UNTOLD


def in_one_line(error: BaseException) -> str:
    """Return the kind of an error and its text, without line breaks."""
    return " ".join(f"{type(error).__name__}: {error}".split())
