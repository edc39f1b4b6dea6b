"""What came of a task, numbers of its box and why some are missing, and of all of them so far."""

import hashlib
import math
from collections.abc import Iterable
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import NDArray

from asperity.base.diagnostics import Error, Note, fatal_first

Numbers = NDArray[np.float64]
Where = tuple[Any, ...]  # an index of a box that gives a view of it


@dataclass(kw_only=True)
class Lacking:
    """Why points have no numbers, and what was noted of those that have."""

    messages: dict[int, str] = field(default_factory=dict)
    kinds: dict[str, int] = field(default_factory=dict)  # failed points by kind of error
    notes: dict[Note, list[int]] = field(default_factory=dict)  # with the scenes that have it

    @property
    def failed(self) -> int:
        return sum(self.kinds.values())


@dataclass
class Outcome(Lacking):
    start: tuple[int, ...]
    box: tuple[int, ...]
    values: dict[str, Any] = field(default_factory=dict)  # arrays of the box's shape, or a number
    sums: list[int] = field(default_factory=list)  # checksums of the files of a store
    contents: list[bytes] | None = None  # of these files, until they are written
    failure: NDArray[np.int64] | None = None  # codes of messages, 0 where there is none
    refused: int = 0  # scenes that could not be built of such values
    seconds: float = 0.0  # of the processor: what else the machine does cuts no tasks

    @property
    def points(self) -> int:
        return math.prod(self.box)

    def array(self, name: str) -> Numbers:
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

    def put(self, name: str, where: Where, part: slice, numbers: Numbers) -> None:
        """Put the numbers of a run of points, counted along what is at `where` in the box."""
        self.array(name)[where].flat[part] = numbers

    def fail(self, error: Error, where: Where, part: slice = slice(None)) -> None:
        """Note why there is nothing at some of the points; what failed before stays."""
        if self.failure is None:
            self.failure = np.zeros(self.box, np.int64)
        view = self.failure[where]
        before = view.flat[part]
        new = int(np.sum(before == 0))
        if new == 0:
            return
        code, kind = code_of(error), type(error).__name__
        view.flat[part] = np.where(before == 0, code, before)
        self.kinds[kind] = self.kinds.get(kind, 0) + new
        keep_message(self.messages, code, str(error))


def code_of(error: Error) -> int:
    """A number for errors of one kind, whatever values they have: there may be one a point.

    It has 48 bits, so that no two kinds of a sweep share it, and a double holds it.
    """
    kind = "/".join((type(error).__name__, *error.identity)).encode()
    return int.from_bytes(hashlib.blake2b(kind, digest_size=6).digest(), "big") or 1


def keep_message(messages: dict[int, str], code: int, message: str) -> None:
    """Keep one of the messages of a code, whichever order they come in."""
    messages[code] = min(message, messages.get(code, message))


@dataclass
class Tally(Lacking):
    """What a sweep has so far, whichever order it came in; a note that is of all scenes has -1."""

    points: int = 0

    def add(self, outcome: Outcome) -> None:
        self.points += outcome.points
        for kind, count in outcome.kinds.items():
            self.kinds[kind] = self.kinds.get(kind, 0) + count
        for code, message in outcome.messages.items():
            keep_message(self.messages, code, message)
        for note, scenes in outcome.notes.items():
            self.notes.setdefault(note, []).extend(scenes)

    def attributes(self) -> dict[str, Any]:
        notes = fatal_first(sorted(self.notes, key=lambda note: (min(self.notes[note]), note)))
        texts: dict[str, Iterable[str]] = {
            "notes": notes,
            "note_labels": [note.label for note in notes],
            "note_steps": [note.next_step for note in notes],
            "note_scenes": [_runs(self.notes[note]) for note in notes],
        }
        return {**{name: "\n".join(of) for name, of in texts.items()}, "failed": self.failed}


def _runs(scenes: Iterable[int]) -> str:
    """Numbers of scenes as runs, from:to from:to, of which -1 is all of them."""
    numbers = np.unique(np.fromiter(scenes, np.int64))
    ends = np.flatnonzero(np.diff(numbers) > 1)
    first, last = numbers[np.append(0, ends + 1)], numbers[np.append(ends, numbers.size - 1)]
    return " ".join(f"{a}:{b}" for a, b in zip(first, last, strict=True))
