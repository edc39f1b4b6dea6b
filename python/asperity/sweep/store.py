"""Where results go: memory, or a Zarr store that outlives the sweep's driver."""

import json
import math
import os
import uuid
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np

from asperity.base.arguments import FilePath
from asperity.base.diagnostics import Error, InvalidInput, Note
from asperity.base.executors import in_one_line
from asperity.base.table import imported
from asperity.io.aside import folder_beside
from asperity.sweep.chunks import FAILURE, Place, checksums, content_of
from asperity.sweep.describe import Described, consolidate
from asperity.sweep.existing import (
    JOURNAL,
    Journal,
    attributes_of,
    open_store,
    refuse_another,
    refuse_taken,
)
from asperity.sweep.outcome import Outcome
from asperity.sweep.task import TOKEN, token_of, write_box


class Memory:
    place = None

    def __init__(self, described: Described) -> None:
        self._described = described
        shape = described.shape
        self._values = {name: np.full(shape, np.nan) for name in described.variables}
        self._failure = np.zeros(shape, np.int64)
        self.tally = described.tally()

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


class ZarrStore:
    """A Zarr store whose boxes are chunks, with a journal of those that are whole.

    A chunk's files take their place when they are complete, and its line in the journal is written
    after them: whatever ends the driver, a box with a line is whole. The line has checksums of the
    files, which `resume` compares. Workers that see the store write their boxes themselves.
    """

    def __init__(self, path: Path, described: Described, cut: Sequence[int]) -> None:
        refuse_taken(path)
        zarr = imported("zarr", "sweep")
        try:
            with folder_beside(path) as folder:
                store = folder / "store"
                described.create(zarr, store, cut)
                (store / JOURNAL).touch()
                (store / TOKEN).write_text(uuid.uuid4().hex)
                os.rename(store, path)
        except OSError as error:
            raise Error(f"{path}: cannot be written: {error.strerror or error}") from error
        self._open(path, described)

    @classmethod
    def resumed(cls, path: Path, described: Described) -> "ZarrStore":
        """The store of an earlier run of the same sweep."""
        store = cls.__new__(cls)
        refuse_another(path, attributes_of(path), described.inputs)
        store._open(path, described)
        try:
            store._read_journal()
        except BaseException:
            store._journal.close()
            raise
        return store

    def _open(self, path: Path, described: Described) -> None:
        self.path = path
        self._described = described
        zarr = imported("zarr", "sweep")
        try:
            self.group = zarr.open_group(str(path), mode="r+", use_consolidated=False)
            self.cut: tuple[int, ...] = tuple(self.group.attrs["cut"])
            form = described.shape, self.cut
            for name in (*described.variables, FAILURE):
                array = self.group[name]
                if (array.shape, array.chunks) != form:
                    raise InvalidInput(f"is damaged: the shape of {name}", where=FilePath(path))
        except InvalidInput:
            raise
        except Exception as error:  # whatever Zarr finds wrong
            problem = in_one_line(error)
            raise InvalidInput(f"is damaged: {problem}", where=FilePath(path)) from error
        token = token_of(path)
        if not token:
            raise InvalidInput(f"is damaged: {TOKEN} cannot be read", where=FilePath(path))
        self.place = Place(str(path.absolute()), token, self.cut)
        self.tally = described.tally()
        along = zip(described.shape, self.cut, strict=True)
        self._done = np.zeros([math.ceil(n / c) for n, c in along], bool)
        self._journal = Journal(path)

    def _read_journal(self) -> None:
        for outcome in self._journal.read(self._outcome_of):
            if not self.has(outcome.start) and self._sums_of(outcome) == outcome.sums:
                self._add(outcome)

    def has(self, start: Sequence[int]) -> bool:
        return bool(self._done[self._index(start)])

    def _index(self, start: Sequence[int]) -> tuple[int, ...]:
        return tuple(s // c for s, c in zip(start, self.cut, strict=True))

    def _add(self, outcome: Outcome) -> None:
        self._done[self._index(outcome.start)] = True
        self.tally.add(outcome)

    def _outcome_of(self, line: bytes) -> Outcome | None:
        """What a line says of its box; None where it is no line of this sweep."""
        try:
            entry = json.loads(line)
            start = tuple(entry["start"])
            if entry["digest"] != self._described.digest_of(start):
                return None
            along = zip(start, self.cut, self._described.shape, strict=True)
            box = tuple(min(c, size - s) for s, c, size in along)
            outcome = Outcome(start, box, sums=list(entry["sums"]))
            outcome.kinds = {str(kind): int(n) for kind, n in entry["kinds"].items()}
            outcome.notes = {
                Note.of_line(line): [*map(int, n)] for line, n in entry["notes"].items()
            }
            outcome.messages = {int(code): str(one) for code, one in entry["messages"].items()}
        except (ValueError, TypeError, KeyError, AttributeError, RecursionError):
            return None
        return outcome if list(box) == entry["box"] else None

    def write(self, outcome: Outcome) -> None:
        """Write a box unless its worker has, and then its line."""
        self._refuse_replaced()
        if outcome.contents is not None:
            write_box(self.place, self._described.variables, outcome)
        line = {
            "start": outcome.start,
            "box": outcome.box,
            "digest": self._described.digest_of(outcome.start),
            "sums": outcome.sums,
            "kinds": outcome.kinds,
            "messages": outcome.messages,
            "notes": {note.line: n for note, n in outcome.notes.items()},
        }
        try:
            self._journal.add(json.dumps(line).encode())
        except OSError as error:
            reason = error.strerror or error
            raise Error(f"{self.path}: cannot be written: {reason}; --resume goes on") from error
        self._add(outcome)

    def _refuse_replaced(self) -> None:
        """End where the store at the path is not the one that was opened: no lock is everywhere."""
        if token_of(self.path) != self.place.token:
            raise Error(f"{self.path}: was removed or replaced while the sweep ran")

    def _sums_of(self, outcome: Outcome) -> list[int]:
        files = self.place.files(outcome.start, self._described.variables)
        return checksums([content_of(file) for file in files])

    def finish(self) -> Any:
        """Say that the store is whole, and open it."""
        self._refuse_replaced()
        attributes = {**self.tally.attributes(), "complete": 1}
        try:
            self._described.add_messages(self.group, self.tally.messages)
            self.group.attrs.update(attributes)
            consolidate(self.path)
        except OSError as error:
            raise Error(f"{self.path}: cannot be written: {error.strerror or error}") from error
        return open_store(self.path)

    def __enter__(self) -> "ZarrStore":
        return self

    def __exit__(self, *_: object) -> None:
        self._journal.close()
