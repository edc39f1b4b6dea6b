"""The journal of a store: a line for each box that is whole, and the lock of its only writer."""

import os
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any, TypeVar

from asperity._core import InvalidInput
from asperity.base.arguments import FilePath

JOURNAL = "_sweep/journal"
Entry = TypeVar("Entry")


class Journal:
    """The lines of a store, open and locked until `close`."""

    def __init__(self, store: Path) -> None:
        self._store = store
        try:  # without a buffer, which would be written again by `close` after a full disk
            self._file = (store / JOURNAL).open("r+b", buffering=0)
        except OSError as error:
            reason = error.strerror or error
            raise InvalidInput(
                f"is damaged: {JOURNAL} cannot be opened: {reason}", where=FilePath(store)
            ) from error
        if not _locked(self._file):
            self._file.close()
            raise InvalidInput("another sweep is writing to it", where=FilePath(store))

    def read(self, meaning: Callable[[bytes], Entry | None]) -> Iterator[Entry]:
        """What every line means. The next one is written after them, over a last one that means
        nothing or was not ended; InvalidInput where there is such a line before the last."""
        whole = 0
        with open(self._file.fileno(), "rb", closefd=False) as file:
            for number, line in enumerate(file, 1):
                entry = meaning(line[:-1]) if line.endswith(b"\n") else None
                if entry is None:
                    if file.read(1):
                        problem = f"line {number} of {JOURNAL} is none of this sweep"
                        raise InvalidInput(f"is damaged: {problem}", where=FilePath(self._store))
                    break
                whole += len(line)
                yield entry
        self._file.seek(whole)

    def add(self, line: bytes) -> None:
        os.ftruncate(self._file.fileno(), self._file.tell())
        rest = line + b"\n"
        while rest:
            rest = rest[self._file.write(rest) :]

    def close(self) -> None:
        self._file.close()


def _locked(file: Any) -> bool:
    """Lock a file until it is closed; False where another process has locked it."""
    try:
        import fcntl
    except ModuleNotFoundError:  # Windows keeps others from the open file on its own
        return True
    try:
        fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except OSError:
        return False
    return True
