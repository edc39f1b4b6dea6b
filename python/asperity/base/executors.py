"""Executors of the user's: whatever has the `submit` of `concurrent.futures`."""

from collections import deque
from collections.abc import Callable, Iterable, Iterator
from contextlib import suppress
from typing import Any, TypeVar

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


Outcome = TypeVar("Outcome")


def in_order(
    steps: Iterable[Any],
    draw: Callable[[], tuple[Any, ...]],
    compute: Callable[..., Outcome],
    threads: int,
) -> Iterator[Callable[[], Outcome]]:
    """Yield, for each step, what returns compute(*draw()) when it is called, or raises its error.

    Each is called before the next is asked for. `draw` runs in this thread alone, so that what it
    draws is the same for any number of threads.
    """
    if threads == 1:
        for _ in steps:
            yield lambda: compute(*draw())
        return
    from concurrent.futures import ThreadPoolExecutor  # here: `import asperity` is to be quick

    with ThreadPoolExecutor(threads) as pool:
        pending: deque[Callable[[], Outcome]] = deque()
        for _ in steps:
            try:
                pending.append(pool.submit(compute, *draw()).result)
            except Exception as error:
                pending.append(_raises(error))
            if len(pending) > 2 * threads:  # no thread waits, and no more is kept than that
                yield pending.popleft()
        yield from pending


def _raises(error: Exception) -> Callable[[], Any]:
    def outcome() -> Any:
        raise error

    return outcome
