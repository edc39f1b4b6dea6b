"""Digests of the files that a report was made from."""

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from asperity._core import InvalidInput
from asperity.io.files import sha256


@dataclass(frozen=True)
class Source:
    """A file, and what tells it from any other."""

    path: Path
    size: int  # bytes
    sha256: str


def digests(paths: Sequence[Path]) -> list[Source]:
    """Each file once, in the order in which they come."""
    return [_digest(path) for path in dict.fromkeys(paths)]


def check_unchanged(sources: Sequence[Source]) -> None:
    """Refuse files that have changed since: the report would tell of others."""
    for source in sources:
        if _digest(source.path) != source:
            raise InvalidInput(
                "has changed while the report was made: start again", where=source.path
            )


def _digest(path: Path) -> Source:
    result = sha256(path)
    return Source(path, path.stat().st_size, result)
