"""Where results go as they come: memory, or a Zarr store that outlives the sweep's driver."""

import itertools
import json
import os
import shutil
import tempfile
import uuid
from collections.abc import Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np

from asperity._core import Error, InvalidInput
from asperity.base.arguments import FilePath
from asperity.base.table import imported
from asperity.sweep.describe import Described, consolidate
from asperity.sweep.task import Outcome, keep_message
from asperity.sweep.work import TOKEN, arrays_of, bits, where_of, write_box

_JOURNAL = "_sweep/journal"  # a line a box that is whole


@dataclass
class Tally:
    """What a sweep has so far, whichever order it came in."""

    points: int = 0
    kinds: dict[str, int] = field(default_factory=dict)
    messages: dict[int, str] = field(default_factory=dict)
    notes: dict[str, int] = field(default_factory=dict)

    @classmethod
    def of(cls, described: Described) -> "Tally":
        return cls(notes=dict.fromkeys(described.notes, -1))

    def add(self, outcome: Outcome) -> None:
        self.points += outcome.points
        for kind, count in outcome.kinds.items():
            self.kinds[kind] = self.kinds.get(kind, 0) + count
        for code, message in outcome.messages.items():
            keep_message(self.messages, code, message)
        for note, scene in outcome.notes.items():
            self.notes[note] = min(scene, self.notes.get(note, scene))

    @property
    def failed(self) -> int:
        return sum(self.kinds.values())

    def attributes(self) -> dict[str, Any]:
        notes = sorted(self.notes, key=lambda note: (self.notes[note], note))
        return {"notes": "\n".join(notes), "failed": self.failed}


class Memory:
    """Results that are kept in memory."""

    token = None

    def __init__(self, described: Described) -> None:
        self._described = described
        shape = described.shape
        self._values = {name: np.full(shape, np.nan) for name in described.variables}
        self._failure = np.zeros(shape, np.uint32)
        self.tally = Tally.of(described)
        self.done: set[tuple[int, ...]] = set()

    def write(self, outcome: Outcome) -> None:
        where = where_of(outcome)
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
    after them: whatever ends the driver, a box with a line is whole. The line has sums of the
    numbers, which `resume` compares. Workers that see the store write their boxes themselves.
    """

    def __init__(self, path: Path, described: Described, cut: Sequence[int]) -> None:
        refuse_taken(path)
        zarr = imported("zarr", "sweep")
        try:
            beside = Path(tempfile.mkdtemp(prefix=".asperity-", dir=path.parent)) / "store"
        except OSError as error:
            raise InvalidInput(f"{path}: cannot be written: {error.strerror}") from error
        try:
            described.create(zarr, beside, cut)
            (beside / _JOURNAL).touch()
            (beside / TOKEN).write_text(uuid.uuid4().hex)
            os.rename(beside, path)
        except OSError as error:
            raise Error(f"{path}: cannot be written: {error.strerror or error}") from error
        finally:
            shutil.rmtree(beside.parent, ignore_errors=True)
        self._open(path, described)

    @classmethod
    def resumed(cls, path: Path, described: Described) -> "ZarrStore":
        """The store of an earlier run of the same sweep."""
        store = cls.__new__(cls)
        try:
            group = imported("zarr", "sweep").open_group(str(path), mode="r")
            known = dict(group.attrs)
        except Exception:
            known = {}
        refuse_another(path, known, described.inputs)
        store._open(path, described)
        store._read_journal()
        return store

    def _open(self, path: Path, described: Described) -> None:
        self.path = path
        self._described = described
        zarr = imported("zarr", "sweep")
        self.group = zarr.open_group(str(path), mode="r+", use_consolidated=False)
        self._arrays = arrays_of(self.group, described.variables)
        self.token = str(path.absolute()), (path / TOKEN).read_text()
        self.cut: tuple[int, ...] = tuple(self.group.attrs["cut"])
        self.tally = Tally.of(described)
        self.done: set[tuple[int, ...]] = set()
        self._journal = (path / _JOURNAL).open("r+b")
        if not _locked(self._journal):
            self._journal.close()
            raise InvalidInput(f"{FilePath(path)}: another sweep is writing to it")

    def _read_journal(self) -> None:
        content = self._journal.read()
        whole = content.rfind(b"\n") + 1
        for line in content[:whole].splitlines(keepends=True):
            entry = json.loads(line)
            start = tuple(entry["start"])
            if start not in self.done and self._sums_of(start) == entry["sums"]:
                outcome = Outcome(start, tuple(entry["box"]))
                outcome.kinds, outcome.notes = entry["kinds"], entry["notes"]
                outcome.messages = {int(code): text for code, text in entry["messages"].items()}
                self.tally.add(outcome)
                self.done.add(start)
        self._journal.seek(whole)
        self._journal.truncate()

    def write(self, outcome: Outcome) -> None:
        """Write a box unless its worker has, and then its line."""
        sums = outcome.sums
        if sums is None:
            sums = write_box(self.path, self._arrays, outcome)
        line = {
            "start": outcome.start,
            "box": outcome.box,
            "digest": self._described.digest_of(outcome.start),
            "sums": sums,
            "kinds": outcome.kinds,
            "messages": outcome.messages,
            "notes": outcome.notes,
        }
        try:
            self._journal.write(json.dumps(line).encode() + b"\n")
            self._journal.flush()
        except OSError as error:
            reason = error.strerror or error
            raise Error(f"{self.path}: cannot be written: {reason}; --resume goes on") from error
        self.done.add(outcome.start)
        self.tally.add(outcome)

    def _sums_of(self, start: tuple[int, ...]) -> list[int] | None:
        where = tuple(slice(s, s + c) for s, c in zip(start, self.cut, strict=True))
        try:
            return [bits(array[where], 1) for array in self._arrays.values()]
        except Exception:  # a chunk that is gone, or cut off by the machine's end
            return None

    def finish(self) -> Any:
        """Say that the store is whole, and open it."""
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


def _locked(file: Any) -> bool:
    """Whether nobody else has the file, who then waits for this process to end."""
    try:
        import fcntl
    except ModuleNotFoundError:  # Windows keeps others from the open file on its own
        return True
    try:
        fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except OSError:
        return False
    return True


def open_store(path: Path) -> Any:
    """A store as an `xarray.Dataset` that reads numbers when they are asked for."""
    xarray = imported("xarray", "sweep")
    engine = "netcdf4" if path.suffix == ".nc" else "zarr"
    try:
        return xarray.open_dataset(str(path), engine=engine, chunks=None)
    except Exception as error:
        raise InvalidInput(f"{FilePath(path)}: cannot be read as a store: {error}") from error


def refuse_taken(path: Path) -> None:
    if os.path.lexists(path):
        raise InvalidInput(f"{FilePath(path)}: exists already: resume it, or choose another store")


def refuse_another(path: Path, attributes: Mapping[str, Any], asked: Mapping[str, Any]) -> None:
    """Refuse what is no store, or that of another sweep; tell the first key that differs."""
    try:
        known = json.loads(str(attributes["sweep"]))
    except (KeyError, ValueError):
        raise InvalidInput(f"{FilePath(path)}: is no store of a sweep: choose another") from None
    for key in dict.fromkeys(itertools.chain(asked, known)):
        there, here = (json.dumps(inputs.get(key)) for inputs in (known, asked))
        if there != here:
            problem = f"is of another sweep: {key} is {_cut(there)} there and {_cut(here)} here"
            raise InvalidInput(f"{FilePath(path)}: {problem}")


def _cut(text: str) -> str:
    return text if len(text) <= 80 else text[:77] + "..."


def remove_store(path: Path) -> None:
    """Remove the store of a sweep, and nothing else."""
    if path.is_dir():
        with suppress(Exception):
            group = imported("zarr", "sweep").open_group(str(path), mode="r")
            if "sweep" in group.attrs:
                shutil.rmtree(path)
                return
        raise InvalidInput(f"{FilePath(path)}: is no store of a sweep: it stays")
    if path.is_file():
        path.unlink()
