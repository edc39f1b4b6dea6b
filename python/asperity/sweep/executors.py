"""Executors: whatever has the `submit` of `concurrent.futures`, and this process."""

import logging
import time
import warnings
from collections.abc import Callable, Iterator
from concurrent.futures import BrokenExecutor, CancelledError, Future
from contextlib import contextmanager
from typing import Any

from asperity._core import Error
from asperity.base.executors import accepted, in_one_line, submitted, worker_count
from asperity.base.table import imported

_AGAIN = 2.0  # seconds between two questions how many workers there are


class Lost(Exception):
    """A task that took its workers with it; others go on."""


class Executor:
    """Where tasks go: an executor of the user's, or this process."""

    def __init__(self, executor: Any = None) -> None:
        self._executor = executor
        self._accepted = None if executor is None else accepted(executor)
        self._asked, self._workers = -_AGAIN, 1

    def submit(self, function: Callable[..., Any], *arguments: Any) -> Any:
        if self._accepted is None:
            return _here(function, *arguments)
        return submitted(self._accepted, function, *arguments)

    @property
    def room(self) -> int:
        """How many tasks may be under way: two for each worker, and one."""
        if self._executor is None:
            return 1
        if time.monotonic() - self._asked > _AGAIN:
            self._workers, self._asked = worker_count(self._executor), time.monotonic()
        return 2 * self._workers + 1


@contextmanager
def local_cluster(workers: int) -> Iterator[Any]:
    """A Dask client of processes of this machine, a thread each, which restart when they end."""
    distributed, dask = imported("distributed", "sweep"), imported("dask", "sweep")
    quiet = {"distributed.worker.profile.enabled": False}  # a hundred looks a second at a loop in C
    with dask.config.set(quiet):
        with warnings.catch_warnings():
            warnings.filterwarnings("ignore", "Port .* is already in use")  # nobody asked for it
            try:
                made = distributed.LocalCluster(
                    n_workers=workers,
                    threads_per_worker=1,
                    dashboard_address=None,
                    silence_logs=logging.CRITICAL,
                )
            except RuntimeError as error:
                problem = in_one_line(error)
                raise Error(f"the workers ended as they started: {problem}") from error
        with made as cluster, distributed.Client(cluster) as client:
            yield client


def _here(function: Callable[..., Any], *arguments: Any) -> Future[Any]:
    future: Future[Any] = Future()
    try:
        future.set_result(function(*arguments))
    except Exception as error:
        future.set_exception(error)
    return future


def result_of(future: Any) -> Any:
    """The result of a task, or what its failure means for the sweep."""
    try:
        return future.result()
    except Error:
        raise
    except MemoryError as error:
        raise Lost(f"MemoryError: {error}") from error
    except (BrokenExecutor, CancelledError) as error:
        problem = f"{type(error).__name__} {error}".strip()
        raise Error(f"the executor lost its workers: {problem}; resume goes on") from error
    except Exception as error:
        problem = in_one_line(error)
        if type(error).__name__ == "KilledWorker":
            raise Lost(problem) from error
        raise Error(f"a task failed on its worker: {problem}") from error
