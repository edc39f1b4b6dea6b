"""Digests of the files that a report was made from."""

import hashlib
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from asperity._core import InvalidInput
from asperity.io.files import check_file


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
            raise InvalidInput(f"{source.path}: has changed while the report was made: start again")


def _digest(path: Path) -> Source:
    try:
        check_file(path)
        with path.open("rb") as file:
            found = hashlib.file_digest(file, "sha256").hexdigest()
            return Source(path, file.tell(), found)
    except OSError as error:
        raise InvalidInput(f"{path}: cannot be read: {error.strerror or error}") from error
    except InvalidInput as error:
        raise InvalidInput(f"{path}: {error}") from error
