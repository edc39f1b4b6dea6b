"""What a sweep has so far, and results that are kept in memory."""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from asperity.base.diagnostics import Note, fatal_first
from asperity.sweep.describe import Described
from asperity.sweep.outcome import Outcome, keep_message


@dataclass
class Tally:
    """What a sweep has so far, whichever order it came in."""

    points: int = 0
    kinds: dict[str, int] = field(default_factory=dict)
    messages: dict[int, str] = field(default_factory=dict)
    notes: dict[Note, list[int]] = field(default_factory=dict)

    @classmethod
    def of(cls, described: Described) -> "Tally":
        return cls(notes={note: [-1] for note in described.notes})

    def add(self, outcome: Outcome) -> None:
        self.points += outcome.points
        for kind, count in outcome.kinds.items():
            self.kinds[kind] = self.kinds.get(kind, 0) + count
        for code, message in outcome.messages.items():
            keep_message(self.messages, code, message)
        for note, scenes in outcome.notes.items():
            self.notes.setdefault(note, []).extend(scenes)

    @property
    def failed(self) -> int:
        return sum(self.kinds.values())

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


class Memory:
    """Results that are kept in memory."""

    place = None

    def __init__(self, described: Described) -> None:
        self._described = described
        shape = described.shape
        self._values = {name: np.full(shape, np.nan) for name in described.variables}
        self._failure = np.zeros(shape, np.int64)
        self.tally = Tally.of(described)

    def has(self, _start: Sequence[int]) -> bool:
        return False

    def write(self, outcome: Outcome) -> None:
        ends = zip(outcome.start, outcome.box, strict=True)
        where = tuple(slice(start, start + size) for start, size in ends)
        for name, values in self._values.items():
            values[where] = outcome.values[name]
        if outcome.failure is not None:
            self._failure[where] = outcome.failure
        self.tally.add(outcome)

    def finish(self) -> Any:
        return self._described.dataset(self._values, self._failure, self.tally)
