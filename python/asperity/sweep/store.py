"""Where results go as they come: memory, or a Zarr store that outlives the sweep's driver."""

import itertools
import json
import os
import shutil
import tempfile
import uuid
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np

from asperity._core import Error, InvalidInput
from asperity.base.arguments import FilePath
from asperity.base.notes import fatal_first
from asperity.base.table import imported
from asperity.sweep.describe import Described, consolidate
from asperity.sweep.journal import JOURNAL, Journal
from asperity.sweep.outcome import Outcome, keep_message
from asperity.sweep.work import TOKEN, arrays_of, checksum, token_of, where_of, write_box


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
        notes = fatal_first(sorted(self.notes, key=lambda note: (self.notes[note], note)))
        return {"notes": "\n".join(notes), "failed": self.failed}


class Memory:
    """Results that are kept in memory."""

    token = None

    def __init__(self, described: Described) -> None:
        self._described = described
        shape = described.shape
        self._values = {name: np.full(shape, np.nan) for name in described.variables}
        self._failure = np.zeros(shape, np.int64)
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
    after them: whatever ends the driver, a box with a line is whole. The line has checksums of the
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
            (beside / JOURNAL).touch()
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
            self._arrays = arrays_of(self.group, described.variables)
            self.cut: tuple[int, ...] = tuple(self.group.attrs["cut"])
            form = described.shape, self.cut
            for name, array in self._arrays.items():
                if (array.shape, array.chunks) != form:
                    raise InvalidInput(f"{FilePath(path)}: is damaged: the shape of {name}")
        except InvalidInput:
            raise
        except Exception as error:  # whatever Zarr finds wrong
            problem = " ".join(f"{type(error).__name__}: {error}".split())
            raise InvalidInput(f"{FilePath(path)}: is damaged: {problem}") from error
        token = token_of(path)
        if not token:
            raise InvalidInput(f"{FilePath(path)}: is damaged: {TOKEN} cannot be read")
        self.token = str(path.absolute()), token
        self.tally = Tally.of(described)
        self.done: set[tuple[int, ...]] = set()
        self._journal = Journal(path)

    def _read_journal(self) -> None:
        for number, line in enumerate(self._journal.lines(), 1):
            outcome = self._outcome_of(line)
            if outcome is None:
                problem = f"line {number} of {JOURNAL} is none of this sweep"
                raise InvalidInput(f"{FilePath(self.path)}: is damaged: {problem}")
            start = outcome.start
            if start not in self.done and self._sums_of(outcome) == outcome.sums:
                self.tally.add(outcome)
                self.done.add(start)

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
            outcome.notes = {str(note): int(n) for note, n in entry["notes"].items()}
            outcome.messages = {int(code): str(one) for code, one in entry["messages"].items()}
        except (ValueError, TypeError, KeyError, AttributeError, RecursionError):
            return None
        return outcome if list(box) == entry["box"] else None

    def write(self, outcome: Outcome) -> None:
        """Write a box unless its worker has, and then its line."""
        self._refuse_replaced()
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
            self._journal.add(json.dumps(line).encode())
        except OSError as error:
            reason = error.strerror or error
            raise Error(f"{self.path}: cannot be written: {reason}; --resume goes on") from error
        self.done.add(outcome.start)
        self.tally.add(outcome)

    def _refuse_replaced(self) -> None:
        """End where the store at the path is not the one that was opened: no lock is everywhere."""
        if token_of(self.path) != self.token[1]:
            raise Error(f"{self.path}: was removed or replaced while the sweep ran")

    def _sums_of(self, outcome: Outcome) -> list[int] | None:
        where = where_of(outcome)
        try:
            return [checksum(array[where], outcome.box) for array in self._arrays.values()]
        except Exception:  # a chunk that is gone, or cut off by the machine's end
            return None

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


def attributes_of(path: Path) -> dict[str, Any]:
    """Attributes of a store, whole or not; none of what is no store."""
    try:
        if path.suffix == ".nc":
            with open_store(path) as found:
                return dict(found.attrs)
        return dict(imported("zarr", "sweep").open_group(str(path), mode="r").attrs)
    except ImportError:
        raise
    except Exception:  # whatever Zarr or NetCDF finds wrong
        return {}


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
            problem = (
                f"is the store of another sweep: {key} is {_cut(there)} there and {_cut(here)} here"
            )
            raise InvalidInput(f"{FilePath(path)}: {problem}")


def _cut(text: str) -> str:
    return text if len(text) <= 80 else text[:77] + "..."


def refuse_foreign(path: Path) -> None:
    """Refuse to remove what is there but no store of a sweep."""
    if os.path.lexists(path) and (path.is_symlink() or "sweep" not in attributes_of(path)):
        raise InvalidInput(f"{FilePath(path)}: is no store of a sweep: remove it yourself")


def remove_store(path: Path) -> None:
    """Remove the store of a sweep, if there is one that nobody writes to, and nothing else."""
    refuse_foreign(path)
    if not os.path.lexists(path):
        return
    try:
        if path.is_file():
            path.unlink()
            return
        journal = Journal(path)
        try:  # away from its place at once: no half of it is left there
            beside = Path(tempfile.mkdtemp(prefix=".asperity-", dir=path.parent))
            os.rename(path, beside / "store")
        finally:
            journal.close()
        shutil.rmtree(beside)
    except OSError as error:
        raise Error(f"{path}: cannot be removed: {error.strerror or error}") from error
