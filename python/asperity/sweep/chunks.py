"""Chunks of a store as files: what Zarr would write, without an event loop and two threads a chunk.

A chunk of an array of Zarr's third format is the file `NAME/c/i/j/...` with its numbers in little
endian, compressed by Blosc. At the end of an axis it is as large as any other; a chunk of the fill
value alone needs no file.
"""

import os
import uuid
import zlib
from collections.abc import Iterator, Sequence
from contextlib import suppress
from dataclasses import dataclass
from functools import lru_cache
from pathlib import Path
from typing import Any

import numpy as np

from asperity.base.table import imported
from asperity.sweep.outcome import Outcome

FAILURE = "failure"
# As quick as none, and three quarters of the size.
BLOSC = {"cname": "lz4", "clevel": 1}


@dataclass(frozen=True)
class Place:
    """Where a worker finds a store."""

    path: str
    token: str  # a text that no other store has
    cut: tuple[int, ...]  # of a chunk

    def files(self, start: Sequence[int], names: Sequence[str]) -> Iterator[Path]:
        index = [str(s // c) for s, c in zip(start, self.cut, strict=True)]
        for name in (*names, FAILURE):
            yield Path(self.path).joinpath(name, "c", *index)


def encoded(outcome: Outcome, names: Sequence[str], cut: tuple[int, ...]) -> list[bytes]:
    """The content of a box's files, empty where none is needed."""
    contents = [_chunk(outcome.values[name], outcome.box, cut) for name in names]
    failure = outcome.failure
    return [*contents, b"" if failure is None else _chunk(failure, outcome.box, cut)]


def _chunk(numbers: Any, box: tuple[int, ...], cut: tuple[int, ...]) -> bytes:
    whole = np.zeros(cut, numbers.dtype)  # what is past an end of the array is never read
    whole[tuple(map(slice, box))] = numbers
    content: bytes = _blosc().encode(whole)
    return content


@lru_cache(maxsize=1)
def _blosc() -> Any:
    blosc = imported("numcodecs.blosc", "sweep")
    blosc.use_threads = False  # as Zarr has it: other threads are workers' own
    return blosc.Blosc(shuffle=blosc.SHUFFLE, **BLOSC)


def write(files: Iterator[Path], contents: Sequence[bytes]) -> None:
    for file, content in zip(files, contents, strict=True):
        if not content:
            file.unlink(missing_ok=True)
            continue
        file.parent.mkdir(parents=True, exist_ok=True)
        part = file.with_name(f".{uuid.uuid4().hex}.partial")
        try:
            part.write_bytes(content)
            os.replace(part, file)
        except OSError:
            with suppress(OSError):
                part.unlink()
            raise


def checksums(contents: Sequence[bytes]) -> list[int]:
    """CRC-32 of the contents of files, by which missing, torn or moved ones are seen."""
    return [zlib.crc32(content) for content in contents]


def content_of(file: Path) -> bytes:
    """What is in a file; nothing where there is none, or none that can be read."""
    try:
        return file.read_bytes()
    except OSError:
        return b""
