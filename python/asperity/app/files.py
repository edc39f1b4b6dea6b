"""Files that a session was given: kept in a folder of its own, under names of our own."""

import itertools
import os
import re
import shutil
import tempfile
from pathlib import Path

from asperity._core import InvalidInput
from asperity.io.aside import locked_folder, remove_left

MOST_BYTES = 256 * 2**20  # of one file
MOST_FILES = 40  # of a session
MOST_TOGETHER = 2**30  # bytes of a session
_PREFIX = "asperity-app-"
_ENDING = re.compile(r"\.[A-Za-z0-9]{1,8}")


class Folder:
    """A private folder, which is gone when the session is."""

    def __init__(self) -> None:
        self.path, self._lock = locked_folder(_PREFIX)  # for its owner alone
        self.shown: dict[str, str] = {}  # by our names, the client's, which are only ever shown
        self._numbers = itertools.count(1)  # no two threads have the same

    def keep(self, shown: str, content: bytes) -> str:
        """Write a file and return its name here; of the client's name only the ending is used."""
        if len(content) > MOST_BYTES:
            sizes = f"has {len(content) // 2**20} MB: must have at most {MOST_BYTES // 2**20}"
            raise InvalidInput(f"{plain(shown)}: {sizes}")
        if not content:
            raise InvalidInput(f"{plain(shown)}: is empty")
        held = sum(one.stat().st_size for one in self.path.iterdir())
        if len(self.shown) >= MOST_FILES or held + len(content) > MOST_TOGETHER:
            most = f"{MOST_FILES} files and {MOST_TOGETHER // 2**20} MB"
            raise InvalidInput(f"{plain(shown)}: a session holds at most {most}: begin a new one")
        ending = _ENDING.fullmatch(Path(shown.replace("\\", "/")).suffix)
        name = f"file-{next(self._numbers)}{ending[0].lower() if ending else ''}"
        (self.path / name).write_bytes(content)
        self.shown[name] = plain(shown)
        return name

    def forget(self, name: str) -> None:
        """Remove a file that is of no use."""
        (self.path / name).unlink(missing_ok=True)
        self.shown.pop(name, None)

    def as_shown(self, text: str) -> str:
        """A message with the client's names in the place of ours, and without our folder."""
        text = text.replace(f"{self.path}/", "")
        text = re.sub(r"^scene\.toml: ", "", text)
        for name, shown in list(self.shown.items()):  # threads keep files
            text = re.sub(rf"\b{re.escape(name)}\b", lambda _, shown=shown: shown, text)  # type: ignore[misc]
        return text

    def close(self) -> None:
        shutil.rmtree(self.path, ignore_errors=True)
        if self._lock >= 0:
            os.close(self._lock)
            self._lock = -1


def remove_old_folders() -> None:
    """Remove those of apps that were killed."""
    remove_left(Path(tempfile.gettempdir()), _PREFIX)


def plain(name: str) -> str:
    """The last part of a client's name, as a text of one line."""
    last = name.replace("\\", "/").rsplit("/", 1)[-1]
    return "".join(one for one in last if one.isprintable())[:80] or "file"
