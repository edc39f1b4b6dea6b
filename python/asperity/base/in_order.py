"""Work for a few threads, whose outcomes come in the order of the work."""

from collections import deque
from collections.abc import Callable, Iterable, Iterator
from typing import Any, TypeVar

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
