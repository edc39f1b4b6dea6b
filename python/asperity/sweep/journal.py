"""The journal of a store: a line for each box that is whole, and the lock of its only writer."""

import os
from collections.abc import Iterator
from pathlib import Path
from typing import Any

from asperity._core import InvalidInput
from asperity.base.arguments import FilePath

JOURNAL = "_sweep/journal"


class Journal:
    """The lines of a store, open and locked until `close`."""

    def __init__(self, store: Path) -> None:
        try:  # without a buffer, which would be written again by `close` after a full disk
            self._file = (store / JOURNAL).open("r+b", buffering=0)
        except OSError as error:
            reason = error.strerror or error
            raise InvalidInput(
                f"{FilePath(store)}: is damaged: {JOURNAL} cannot be opened: {reason}"
            ) from error
        if not _locked(self._file):
            self._file.close()
            raise InvalidInput(f"{FilePath(store)}: another sweep is writing to it")

    def lines(self) -> Iterator[bytes]:
        """Every whole line. The next one is written after them, over one that was not ended."""
        whole = 0
        with open(self._file.fileno(), "rb", closefd=False) as file:
            for line in file:
                if line.endswith(b"\n"):
                    whole += len(line)
                    yield line[:-1]
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
