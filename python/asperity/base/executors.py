"""Executors of the user's: whatever has the `submit` of `concurrent.futures`."""

from collections import deque
from collections.abc import Callable, Iterable, Iterator
from contextlib import ExitStack, suppress
from functools import partial
from typing import Any, TypeVar

from asperity.base.diagnostics import Error, unfit

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


def submitted(executor: Any, function: Callable[..., Any], *arguments: Any) -> Any:
    """Return the future of a call."""
    try:
        return executor.submit(function, *arguments)
    except Exception as error:
        raise Error(f"the executor takes no tasks: {in_one_line(error)}") from error


Outcome = TypeVar("Outcome")


def in_order(
    function: Callable[..., Outcome],
    works: Iterable[tuple[Any, ...]],
    threads: int = 1,
    executor: Any = None,
) -> Iterator[Callable[[], Outcome]]:
    """Yield, for each work in turn, what returns function(*work) when it is called, or raises its
    error: by this thread, by several, or by an executor of the user's.

    Each is called before the next is asked for. Works are made in this thread alone, so that what
    they draw is the same for any number of threads, and few at once, as they may be large.
    """
    if executor is None and threads == 1:
        yield from (partial(function, *work) for work in works)
        return
    with ExitStack() as stack:
        room = 2 * (threads if executor is None else worker_count(executor))
        if executor is None:
            from concurrent.futures import ThreadPoolExecutor  # `import asperity` is to be quick

            executor = stack.enter_context(ThreadPoolExecutor(threads))
        pending: deque[Any] = deque()
        try:
            for work in works:
                pending.append(submitted(executor, function, *work))
                if len(pending) >= room:
                    yield pending.popleft().result
            while pending:
                yield pending.popleft().result
        finally:
            for future in pending:
                future.cancel()
