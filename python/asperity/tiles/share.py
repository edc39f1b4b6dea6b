"""Tiles shared by threads, or by whatever has the `submit` of `concurrent.futures`."""

from collections import deque
from collections.abc import Callable, Iterable, Iterator
from contextlib import ExitStack
from typing import Any, TypeVar

from asperity._core import Error
from asperity.base.arguments import MOST_THREADS, whole
from asperity.base.diagnostics import unfit
from asperity.base.executors import accepted, in_one_line, worker_count

Outcome = TypeVar("Outcome")


class Workers:
    """Who computes: this thread, several, or an executor of the user's."""

    def __init__(self, threads: Any = 1, executor: Any = None) -> None:
        self.threads = whole(threads, "threads", lowest=1, highest=MOST_THREADS)
        self.executor = None if executor is None else accepted(executor)
        if self.executor is not None and self.threads > 1:
            raise unfit("threads", threads, "an executor brings its own workers", f"{threads}")

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
            executor, room = self.executor, 2 * self.threads
            if executor is None:
                from concurrent.futures import ThreadPoolExecutor  # `import asperity` is quick

                executor = stack.enter_context(ThreadPoolExecutor(self.threads))
            else:
                room = 2 * worker_count(executor)
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


def _submit(executor: Any, function: Callable[..., Any], work: tuple[Any, ...]) -> Any:
    try:
        return executor.submit(function, *work)
    except Exception as error:
        raise Error(f"the executor takes no tiles: {in_one_line(error)}") from error


def _result(future: Any) -> Any:
    try:
        return future.result()
    except (Error, MemoryError):
        raise
    except Exception as error:
        raise Error(f"a tile failed on its worker: {in_one_line(error)}") from error
