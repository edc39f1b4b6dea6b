"""ZIP archives, of which the sizes that they declare are not believed."""

import io
import os
import zipfile
from collections.abc import Iterable
from pathlib import Path
from typing import IO, Any, BinaryIO

import numpy as np
from numpy.typing import NDArray

from asperity.base.diagnostics import must_be

_RATIO = 100  # of inflated to stored bytes: heights have 2 to 20, zeros 1000
_FREE = 2**24  # bytes that any archive may inflate to
_PIECE = 2**18
_DATE = (1980, 1, 1, 0, 0, 0)  # of members that are written: the same contents give the same bytes


def archived(contents: Iterable[tuple[str, bytes]]) -> bytes:
    """The bytes of an archive of files with these names."""
    out = io.BytesIO()
    with zipfile.ZipFile(out, "w", zipfile.ZIP_DEFLATED) as archive:
        for name, content in contents:
            entry = zipfile.ZipInfo(name, _DATE)
            entry.external_attr = 0o644 << 16
            archive.writestr(entry, content, zipfile.ZIP_DEFLATED)
    return out.getvalue()


class Archive:
    def __init__(self, file: BinaryIO) -> None:
        size = file.seek(0, os.SEEK_END)
        self._archive = zipfile.ZipFile(file)
        self._left = _FREE + _RATIO * size
        self.members = [one for one in self._archive.infolist() if not one.is_dir()]

    def open(self, member: zipfile.ZipInfo) -> "_Member":
        if member.compress_type not in (zipfile.ZIP_STORED, zipfile.ZIP_DEFLATED):
            raise must_be("", "stored or deflated", "is compressed in an unusual way")
        return _Member(self, self._archive.open(member))

    def check(self) -> None:
        """Refuse an archive that inflates without end, before another library opens it."""
        for member in self.members:
            content = self.open(member)
            while content.read():
                pass

    def count(self, inflated: int) -> None:
        """InvalidInput where more has been inflated than an archive of this size should hold."""
        self._left -= inflated
        if self._left < 0:
            allowed = f"at most {_RATIO} times as much, beyond {_FREE >> 20} MB"
            raise must_be("", allowed, "inflates to far more than its own size")


class _Member:
    """Inflated piece by piece: one call may return less than it asks for."""

    def __init__(self, archive: Archive, file: IO[bytes]) -> None:
        self._archive = archive
        self._file = file

    def read(self, most: int = _PIECE) -> bytes:
        piece = self._file.read(min(most, _PIECE))
        self._archive.count(len(piece))
        return piece

    def read_all(self) -> bytes:
        return b"".join(iter(self.read, b""))


def read_array(archive: Archive, member: zipfile.ZipInfo) -> NDArray[Any]:
    """An array of an .npz file; errors of several kinds where it is none."""
    file: Any = archive.open(member)  # NumPy needs no more of a file than what this has
    return np.lib.format.read_array(file, allow_pickle=False)


def read_arrays(path: Path) -> dict[str, NDArray[Any]]:
    """The arrays of an .npz file by their names; errors of several kinds where it is none."""
    with path.open("rb") as file:
        archive = Archive(file)
        return {
            one.filename.removesuffix(".npy"): read_array(archive, one) for one in archive.members
        }
