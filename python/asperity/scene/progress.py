"""What a bar shows of work on a scene."""

import time
from collections.abc import Callable, Iterable, Iterator
from contextlib import AbstractContextManager, contextmanager
from typing import Any

from asperity.correction import Correction
from asperity.scan_contact import ScanContact

_PAUSE = 0.2  # s between two looks of a line

# has a bar over the chunks of some work, or none
Progress = Callable[[list[slice]], AbstractContextManager[Iterable[slice]]]


@contextmanager
def line_on(bar: Any) -> Iterator[Callable[[str], object]]:
    """What writes a line beside a bar, from the bar's delay on; no bar, no line."""
    if not hasattr(bar, "set_postfix_str"):
        yield lambda line: None
        return
    begin = due = bar.start_t + bar.delay

    def show(line: str) -> None:
        nonlocal due
        if time.time() >= due:
            due = time.time() + _PAUSE
            bar.set_postfix_str(line)

    try:
        yield show
    finally:
        if due > begin:
            bar.clear()  # a bar that made no step leaves the line


def with_contacts(progress: Progress, correction: Correction | None) -> Progress:
    """The same, with how many contacts of a scan are solved."""
    if not isinstance(correction, ScanContact):
        return progress

    @contextmanager
    def shown(chunks: list[slice]) -> Iterator[Iterable[slice]]:
        def tell(solved: int, needed: int) -> None:
            show(f"{solved} of {needed} contacts solved")

        with progress(chunks) as bar, line_on(bar) as show, correction.progress(tell):
            yield bar

    return shown
