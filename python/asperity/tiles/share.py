"""Tiles shared by threads, or by whatever has the `submit` of `concurrent.futures`."""

from collections import deque
from collections.abc import Callable, Iterable, Iterator
from contextlib import ExitStack, suppress
from typing import Any, TypeVar

from asperity._core import Error, InvalidInput
from asperity.base.arguments import MOST_THREADS, brief, whole

Outcome = TypeVar("Outcome")


class Workers:
    """Who computes: this thread, several, or an executor of the user's."""

    def __init__(self, threads: Any = 1, executor: Any = None) -> None:
        self.threads = whole(threads, "threads", lowest=1, highest=MOST_THREADS)
        self.executor = executor
        if executor is None:
            return
        if not callable(getattr(executor, "submit", None)):
            allowed = "must have the submit of concurrent.futures"
            raise InvalidInput(f"executor = {brief(executor)}: {allowed}")
        if self.threads > 1:
            raise InvalidInput(f"threads = {threads}: an executor brings its own workers")
        if callable(getattr(executor, "get_executor", None)):  # Dask: equal tasks are not one task
            self.executor = executor.get_executor(pure=False)

    def outcomes(
        self, function: Callable[..., Outcome], works: Iterable[tuple[Any, ...]]
    ) -> Iterator[Outcome]:
        """Yield function(*work) of each work, in their order: sums do not depend on who computed.

        Few are under way at once, so that pieces of a map in memory are not all copied.
        """
        if self.executor is None and self.threads == 1:
            for work in works:
                yield function(*work)
            return
        with ExitStack() as stack:
            executor, room = self.executor, 2 * _count(self.executor)
            if executor is None:
                from concurrent.futures import ThreadPoolExecutor  # `import asperity` is quick

                executor = stack.enter_context(ThreadPoolExecutor(self.threads))
                room = 2 * self.threads
            pending: deque[Any] = deque()
            try:
                for work in works:
                    pending.append(_submit(executor, function, work))
                    if len(pending) >= room:
                        yield _result(pending.popleft())
                while pending:
                    yield _result(pending.popleft())
            finally:
                for future in pending:
                    future.cancel()


def _count(executor: Any) -> int:
    """How many works an executor computes at once; a few where it does not tell."""
    for name in ("_max_workers", "num_workers"):
        with suppress(Exception):
            if isinstance(found := getattr(executor, name, None), int) and found > 0:
                return found
    cores = getattr(getattr(executor, "_client", None), "ncores", None)  # Dask
    return max(1, int(sum(cores().values()))) if callable(cores) else 8


def _submit(executor: Any, function: Callable[..., Any], work: tuple[Any, ...]) -> Any:
    try:
        return executor.submit(function, *work)
    except Exception as error:
        problem = " ".join(f"{type(error).__name__}: {error}".split())
        raise Error(f"the executor takes no tiles: {problem}") from error


def _result(future: Any) -> Any:
    try:
        return future.result()
    except (Error, MemoryError):
        raise
    except Exception as error:
        problem = " ".join(f"{type(error).__name__}: {error}".split())
        raise Error(f"a tile failed on its worker: {problem}") from error
