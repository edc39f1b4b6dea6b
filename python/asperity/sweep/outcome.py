"""What came of a task: numbers of its box, and why some of them are missing."""

import hashlib
import math
from collections.abc import Iterable
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import NDArray

from asperity._core import Error
from asperity.base.diagnostics import Note

Numbers = NDArray[np.float64]


@dataclass
class Outcome:
    """What came of a task."""

    start: tuple[int, ...]
    box: tuple[int, ...]
    values: dict[str, Any] = field(default_factory=dict)  # arrays of the box's shape, or a number
    sums: list[int] = field(default_factory=list)  # checksums of the files of a store
    contents: list[bytes] | None = None  # of these files, until they are written
    failure: NDArray[np.int64] | None = None  # codes of messages, 0 where there is none
    refused: int = 0  # scenes that could not be built of such values
    messages: dict[int, str] = field(default_factory=dict)
    kinds: dict[str, int] = field(default_factory=dict)  # failed points by kind of error
    notes: dict[Note, list[int]] = field(default_factory=dict)  # with the scenes that have it
    seconds: float = 0.0  # of the processor: what else the machine does cuts no tasks

    @property
    def failed(self) -> int:
        return sum(self.kinds.values())

    @property
    def points(self) -> int:
        return math.prod(self.box)

    def array(self, name: str) -> Numbers:
        """The numbers of a variable, NaN where nothing was put."""
        if name not in self.values:
            self.values[name] = np.full(self.box, np.nan)
        numbers: Numbers = self.values[name]
        return numbers

    def note(self, notes: Iterable[Note], scene: int) -> None:
        """Keep notes of a scene, which come in their order."""
        for note in notes:
            scenes = self.notes.setdefault(note, [])
            if scene not in scenes[-1:]:
                scenes.append(scene)

    def fail(self, where: Any, error: Error) -> None:
        """Note why there is nothing at `where`, an index of the box; what failed before stays."""
        message = str(error)
        code = code_of(error)
        if self.failure is None:
            self.failure = np.zeros(self.box, np.int64)
        kind = type(error).__name__
        before = self.failure[where]
        new = int(np.sum(before == 0))
        if new == 0:
            return
        self.failure[where] = np.where(before == 0, code, before)
        self.kinds[kind] = self.kinds.get(kind, 0) + new
        keep_message(self.messages, code, message)


def code_of(error: Error) -> int:
    """A number for errors of one kind, whatever values they have: there may be one a point.

    It has 48 bits, so that no two kinds of a sweep share it, and a double holds it.
    """
    kind = "/".join((type(error).__name__, *error.identity)).encode()
    return int.from_bytes(hashlib.blake2b(kind, digest_size=6).digest(), "big") or 1


def keep_message(messages: dict[int, str], code: int, message: str) -> None:
    """Keep one of the messages of a code, whichever order they come in."""
    messages[code] = min(message, messages.get(code, message))
