"""Stores that are there already: opened, refused or removed."""

import itertools
import json
import os
from collections.abc import Callable, Iterator, Mapping
from pathlib import Path
from typing import Any, TypeVar

from asperity._core import Error, InvalidInput
from asperity.base.arguments import FilePath
from asperity.base.table import imported
from asperity.io.aside import folder_beside

JOURNAL = "_sweep/journal"
Entry = TypeVar("Entry")


class Journal:
    """The lines of a store, open and locked until `close`."""

    def __init__(self, store: Path) -> None:
        self._store = store
        try:  # without a buffer, which would be written again by `close` after a full disk
            self._file = (store / JOURNAL).open("r+b", buffering=0)
        except OSError as error:
            reason = error.strerror or error
            raise InvalidInput(
                f"is damaged: {JOURNAL} cannot be opened: {reason}", where=FilePath(store)
            ) from error
        if not _locked(self._file):
            self._file.close()
            raise InvalidInput("another sweep is writing to it", where=FilePath(store))

    def read(self, meaning: Callable[[bytes], Entry | None]) -> Iterator[Entry]:
        """What every line means. The next one is written after them, over a last one that means
        nothing or was not ended; InvalidInput where there is such a line before the last."""
        whole = 0
        with open(self._file.fileno(), "rb", closefd=False) as file:
            for number, line in enumerate(file, 1):
                entry = meaning(line[:-1]) if line.endswith(b"\n") else None
                if entry is None:
                    if file.read(1):
                        problem = f"line {number} of {JOURNAL} is none of this sweep"
                        raise InvalidInput(f"is damaged: {problem}", where=FilePath(self._store))
                    break
                whole += len(line)
                yield entry
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


def attributes_of(path: Path) -> dict[str, Any]:
    """Attributes of a store, whole or not; none of what is no store."""
    try:
        if path.suffix == ".nc":
            with open_store(path) as dataset:
                return dict(dataset.attrs)
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
        raise InvalidInput(f"cannot be read as a store: {error}", where=FilePath(path)) from error


def refuse_taken(path: Path) -> None:
    if os.path.lexists(path):
        raise InvalidInput(
            "exists already: resume it, or choose another store", where=FilePath(path)
        )


def refuse_another(path: Path, attributes: Mapping[str, Any], asked: Mapping[str, Any]) -> None:
    """Refuse what is no store, or that of another sweep; tell the first key that differs."""
    try:
        known = json.loads(str(attributes["sweep"]))
    except (KeyError, ValueError):
        raise InvalidInput("is no store of a sweep: choose another", where=FilePath(path)) from None
    for key in dict.fromkeys(itertools.chain(asked, known)):
        there, here = (json.dumps(inputs.get(key)) for inputs in (known, asked))
        if there != here:
            problem = (
                f"is the store of another sweep: {key} is {_cut(there)} there and {_cut(here)} here"
            )
            raise InvalidInput(problem, where=FilePath(path))


def _cut(text: str) -> str:
    return text if len(text) <= 80 else text[:77] + "..."


def refuse_foreign(path: Path) -> None:
    """Refuse to remove what is there but no store of a sweep."""
    if os.path.lexists(path) and (path.is_symlink() or "sweep" not in attributes_of(path)):
        raise InvalidInput("is no store of a sweep: remove it yourself", where=FilePath(path))


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
            with folder_beside(path) as folder:
                os.rename(path, folder / "store")
                journal.close()
        finally:
            journal.close()
    except OSError as error:
        raise Error(f"{path}: cannot be removed: {error.strerror or error}") from error
