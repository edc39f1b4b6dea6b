"""Files that a session was given: kept in a folder of its own, under names of our own."""

import itertools
import os
import shutil
import tempfile
from pathlib import Path

from asperity.base.diagnostics import File, InvalidInput, Sentence, Value
from asperity.io.aside import locked_folder, remove_left

MOST_BYTES = 256 * 2**20  # of one file
MOST_FILES = 40  # of a session
MOST_TOGETHER = 2**30  # bytes of a session
_PREFIX = "asperity-app-"
_LONGEST_ENDING = 8


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
            raise InvalidInput(sizes, where=plain(shown))
        if not content:
            raise InvalidInput("is empty", where=plain(shown))
        held = sum(one.stat().st_size for one in self.path.iterdir())
        if len(self.shown) >= MOST_FILES or held + len(content) > MOST_TOGETHER:
            most = f"{MOST_FILES} files and {MOST_TOGETHER // 2**20} MB"
            problem = f"a session holds at most {most}: begin a new one"
            raise InvalidInput(problem, where=plain(shown))
        ending = Path(shown.replace("\\", "/")).suffix[1:].lower()
        usable = ending.isascii() and ending.isalnum() and len(ending) <= _LONGEST_ENDING
        name = f"file-{next(self._numbers)}{f'.{ending}' if usable else ''}"
        (self.path / name).write_bytes(content)
        self.shown[name] = plain(shown)
        return name

    def forget(self, name: str) -> None:
        (self.path / name).unlink(missing_ok=True)
        self.shown.pop(name, None)

    def as_shown(self, sentence: Sentence) -> Sentence:
        """A sentence with the client's names in the place of ours, and without our scene's."""
        said: list[str] = []
        for phrase in sentence:
            if isinstance(phrase, File | Value):
                name = Path(phrase.strip("'")).name
                phrase = phrase.saying(self.shown.get(name, phrase))
            elif type(phrase) is str:  # of a library
                phrase = phrase.replace(f"{self.path}/", "")
            said.append(phrase)
        if said and isinstance(said[0], File) and Path(said[0]) == self.path / "scene.toml":
            return tuple(said[2:])
        return tuple(said)

    def close(self) -> None:
        shutil.rmtree(self.path, ignore_errors=True)
        if self._lock >= 0:
            os.close(self._lock)
            self._lock = -1


def remove_old_folders() -> None:
    remove_left(Path(tempfile.gettempdir()), _PREFIX)


def plain(name: str) -> str:
    """The last part of a client's name, as a text of one line."""
    last = name.replace("\\", "/").rsplit("/", 1)[-1]
    return "".join(one for one in last if one.isprintable())[:80] or "file"
