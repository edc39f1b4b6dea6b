"""Tiles shared by threads, or by whatever has the `submit` of `concurrent.futures`."""

from collections.abc import Callable, Iterable, Iterator
from typing import Any, TypeVar

from asperity.base.arguments import MOST_THREADS, whole
from asperity.base.diagnostics import Error, unfit
from asperity.base.executors import accepted, in_one_line, in_order

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
        """Yield function(*work) of each work in turn: sums do not depend on who computed."""
        for outcome in in_order(function, works, self.threads, self.executor):
            try:
                result = outcome()
            except (Error, MemoryError):
                raise
            except Exception as error:
                raise Error(f"a tile failed on its worker: {in_one_line(error)}") from error
            yield result
