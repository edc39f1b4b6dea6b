"""The file behind a memory map, read by file reads.

A mapped page that another process cuts off ends this process (SIGBUS); a read that comes short is
an error like others. Reads also leave no pages behind that count as memory of this process.
"""

import mmap
import os
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from asperity._core import InvalidInput
from asperity.base.arguments import FilePath, reading

Stamp = tuple[int, int, int, int]


@dataclass(frozen=True)
class FileArray:
    """Numbers of two axes in a file; `place` is the byte at which the first of them begins."""

    path: str
    place: int
    shape: tuple[int, int]
    strides: tuple[int, int]
    dtype: np.dtype[Any]
    stamp: Stamp

    def __getitem__(self, box: tuple[slice, slice]) -> NDArray[Any]:
        (y0, y1), (x0, x1) = ((part.start, part.stop) for part in box)
        (down, along), item = self.strides, self.dtype.itemsize
        if abs(along) > abs(down):  # a transposed file: its rows are these columns
            turned = replace(self, shape=self.shape[::-1], strides=(along, down))
            return np.ascontiguousarray(turned[box[::-1]].T)
        heights = np.empty((y1 - y0, x1 - x0), self.dtype)
        length = (x1 - x0 - 1) * abs(along) + item
        first = min(x0 * along, (x1 - 1) * along)
        packed = along == item
        line = bytearray(length)
        with reading(self), open(self.path, "rb", buffering=0) as file:
            self._check(os.fstat(file.fileno()))
            for row in range(y1 - y0):
                file.seek(self.place + (y0 + row) * down + first)
                self._fill(file, memoryview(heights[row]).cast("B") if packed else line)
                if not packed:
                    start = 0 if along >= 0 else length - item
                    heights[row] = np.ndarray(x1 - x0, self.dtype, line, start, (along,))
            self._check(os.fstat(file.fileno()))
        return heights

    def _fill(self, file: Any, into: Any) -> None:
        got, view = 0, memoryview(into)
        while got < len(view):
            count = file.readinto(view[got:])
            if not count:
                raise InvalidInput("ends before its heights do; was it cut short?", where=self)
            got += count

    def _check(self, now: os.stat_result) -> None:
        if stamp_of(now) != self.stamp:
            raise InvalidInput("was changed while it was read", where=self)

    def __str__(self) -> str:
        return f"{FilePath(self.path)}"


def stamp_of(status: os.stat_result) -> Stamp:
    """Return what changes with a file: where it is, how long, when it was last written."""
    return status.st_dev, status.st_ino, status.st_size, status.st_mtime_ns


def file_behind(array: NDArray[Any]) -> FileArray | None:
    """Return the file that an array of two axes is a memory map of, or a view of one, if any."""
    owner: Any = array
    while owner is not None and not isinstance(owner, np.memmap):
        owner = getattr(owner, "base", None)
    if owner is None or owner.filename is None or owner.mode == "c":  # "c": changes stay in memory
        return None
    mapping: Any = owner
    mapped = np.frombuffer(mapping._mmap, np.uint8)
    start = owner.offset - owner.offset % mmap.ALLOCATIONGRANULARITY
    place = start + array.ctypes.data - mapped.ctypes.data
    path = os.fspath(owner.filename)
    with reading(FilePath(path)), open(path, "rb", buffering=0) as file:
        stamp = stamp_of(os.fstat(file.fileno()))
        same = _is_mapped(file, mapping._mmap)
    if not same:
        raise InvalidInput("was replaced after it was mapped: load it again", where=FilePath(path))
    ny, nx = array.shape
    down, along = array.strides
    return FileArray(path, place, (ny, nx), (down, along), array.dtype, stamp)


def _is_mapped(file: Any, mapping: Any) -> bool:
    """Whether a mapping is of this file: by its inode where Linux tells, elsewhere by its length.

    The file is mapped again and the two mappings are compared, as the device of a mapping need not
    be that of `stat` (overlays, subvolumes).
    """
    length = os.fstat(file.fileno()).st_size
    if not length:  # nothing to map, and nothing to read either
        return True
    with mmap.mmap(file.fileno(), 1, access=mmap.ACCESS_READ) as again:
        now, then = _inode(_address(again)), _inode(_address(mapping))
    if now is not None and then is not None:
        return now == then
    try:
        return bool(mapping.size() == length)
    except (OSError, ValueError):  # a mapping that keeps no file open
        return True


def _address(mapping: Any) -> int:
    return np.frombuffer(mapping, np.uint8, 1).ctypes.data


def _inode(address: int) -> tuple[str, str] | None:
    """Return the device and the inode of the mapping at an address, where Linux tells."""
    try:
        with open("/proc/self/maps") as maps:
            for line in maps:
                span, _, _, device, inode = line.split(maxsplit=5)[:5]
                first, end = (int(place, 16) for place in span.split("-"))
                if first <= address < end:
                    return (device, inode) if inode != "0" else None
    except (OSError, ValueError):
        return None
    return None
