"""Work for a few threads, whose outcomes come in the order of the work."""

from collections import deque
from collections.abc import Callable, Iterable, Iterator
from concurrent.futures import Future, ThreadPoolExecutor
from typing import Any, TypeVar

Outcome = TypeVar("Outcome")


def in_order(
    steps: Iterable[Any],
    draw: Callable[[], tuple[Any, ...]],
    compute: Callable[..., Outcome],
    threads: int,
) -> Iterator[Future[Outcome]]:
    """Yield the outcome of compute(*draw()) for each step: a value, or what either raised.

    `draw` is called in this thread alone, so that what it draws is the same for any number of
    them. With one thread nothing runs beside it.
    """
    if threads == 1:
        for _ in steps:
            yield _done(lambda: compute(*draw()))
        return
    with ThreadPoolExecutor(threads) as pool:
        pending: deque[Future[Outcome]] = deque()
        for _ in steps:
            drawn = _done(draw)
            error = drawn.exception()
            pending.append(
                pool.submit(compute, *drawn.result()) if error is None else _failed(error)
            )
            if len(pending) > 2 * threads:  # no thread waits, and no more is kept than that
                yield pending.popleft()
        yield from pending


def _done(call: Callable[[], Outcome]) -> Future[Outcome]:
    future: Future[Outcome] = Future()
    try:
        future.set_result(call())
    except Exception as error:
        future.set_exception(error)
    return future


def _failed(error: BaseException) -> Future[Any]:
    future: Future[Any] = Future()
    future.set_exception(error)
    return future
