"""The journal of a store: a line for each box that is whole, and the lock of its only writer."""

from pathlib import Path
from typing import Any

from asperity._core import InvalidInput
from asperity.base.arguments import FilePath

JOURNAL = "_sweep/journal"


class Journal:
    """The lines of a store, open and locked until `close`."""

    def __init__(self, store: Path) -> None:
        try:
            self._file = (store / JOURNAL).open("r+b")
        except OSError as error:
            reason = error.strerror or error
            raise InvalidInput(
                f"{FilePath(store)}: is damaged: {JOURNAL} cannot be opened: {reason}"
            ) from error
        if not _locked(self._file):
            self._file.close()
            raise InvalidInput(f"{FilePath(store)}: another sweep is writing to it")

    def lines(self) -> list[bytes]:
        """Every whole line. The next one is written after them, over one that was not ended."""
        content = self._file.read()
        whole = content.rfind(b"\n") + 1
        self._file.seek(whole)
        return content[:whole].split(b"\n")[:-1]

    def add(self, line: bytes) -> None:
        self._file.truncate()
        self._file.write(line + b"\n")
        self._file.flush()

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
