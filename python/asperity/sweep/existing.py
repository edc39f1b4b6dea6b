"""Stores that are there already: opened, refused or removed."""

import itertools
import json
import os
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from asperity._core import Error, InvalidInput
from asperity.base.arguments import FilePath
from asperity.base.table import imported
from asperity.io.aside import folder_beside
from asperity.sweep.journal import Journal


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
