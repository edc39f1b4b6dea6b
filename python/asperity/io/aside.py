"""Folders of ours for what is not complete: locked while their process lives, removed after it.

The lock is the system's, on the folder itself, and goes with the process however it ends.
"""

import os
import shutil
import tempfile
import time
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from importlib import import_module
from pathlib import Path
from typing import Any

from asperity._core import InvalidInput
from asperity.base.arguments import FilePath

fcntl: Any = None
with suppress(ModuleNotFoundError):  # Windows
    fcntl = import_module("fcntl")
_YOUNG = 60  # s in which a folder that is not locked may be one that is about to be
_CONTENT = {"store", "store.nc"}  # of a folder beside an output
_BESIDE = ".asperity-"


def locked_folder(prefix: str, parent: Path | None = None) -> tuple[Path, int]:
    """A new private folder, and the open handle that locks it (-1 where there are no locks)."""
    folder = Path(tempfile.mkdtemp(prefix=prefix, dir=parent))
    if fcntl is None:
        return folder, -1
    handle = os.open(folder, os.O_RDONLY)
    with suppress(OSError):  # a file system without locks
        fcntl.flock(handle, fcntl.LOCK_EX | fcntl.LOCK_NB)
    return folder, handle


@contextmanager
def folder_beside(path: Path) -> Iterator[Path]:
    """A folder beside an output, in which it is made as `store` or `store.nc`."""
    remove_left(path.parent, _BESIDE, _CONTENT)
    try:
        folder, handle = locked_folder(_BESIDE, path.parent)
    except OSError as error:
        raise InvalidInput(f"cannot be written: {error.strerror}", where=FilePath(path)) from error
    try:
        yield folder
    finally:
        shutil.rmtree(folder, ignore_errors=True)
        if handle >= 0:
            os.close(handle)


def remove_left(parent: Path, prefix: str, content: set[str] | None = None) -> None:
    """Remove the folders of processes that were killed; `content` is all that they may hold."""
    if fcntl is None:
        return
    for folder in parent.glob(f"{prefix}????????"):
        with suppress(OSError):  # of somebody else, or gone meanwhile
            handle = os.open(folder, os.O_RDONLY | os.O_DIRECTORY | os.O_NOFOLLOW)
            try:
                status = os.fstat(handle)
                if status.st_uid != os.getuid() or time.time() - status.st_mtime < _YOUNG:
                    continue
                if content is not None and not content.issuperset(os.listdir(handle)):
                    continue
                fcntl.flock(handle, fcntl.LOCK_EX | fcntl.LOCK_NB)
                shutil.rmtree(folder)
            finally:
                os.close(handle)
