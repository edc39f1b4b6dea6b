"""A directory that a command fills again and again, and another's files in it, which it spares."""

import os
import re
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path

from asperity._core import InvalidInput
from asperity.io.table import check_output, check_writable

# A test of the file itself, or the name of a companion that must be there and be the command's own:
# pictures, which say nothing of who drew them, are known by the table beside them.
Mark = Callable[[Path], bool] | str


def table_of(command: str) -> Mark:
    """Whether a file opens as `Table.csv` does for this command, of whatever version."""
    line = re.compile(rf"# asperity \S+ {re.escape(command)}\r?\n".encode())
    return lambda path: line.match(path.read_bytes()) is not None


def begins(text: str) -> Mark:
    """Whether a file begins with this text."""
    return lambda path: path.read_bytes().startswith(text.encode())


def check_own_directory(directory: Path, owner: str, marks: Mapping[str, Sequence[Mark]]) -> None:
    """Refuse, before any work, a directory that a command cannot or should not write into.

    `marks` has all names that the command writes there, each with what its own file is known by,
    all of which must fit. `owner` is the command as the message names it, "the demo".

    Raises
    ------
    InvalidInput
        If it cannot be written, or holds files of these names that the command did not write.
    """
    existing = check_writable(directory)
    try:
        taken = [name for name in marks if os.path.lexists(directory / name)]
        foreign = ", ".join(name for name in taken if not _is_own(directory, name, marks))
    except OSError as error:
        raise InvalidInput(f"{directory}: cannot be written: {error.strerror or error}") from error
    if foreign:
        raise InvalidInput(
            f"{directory}: holds {foreign}, not {owner}'s own: choose another --output"
        )
    if existing == directory:
        for name in marks:
            check_output(directory / name)


def _is_own(directory: Path, name: str, marks: Mapping[str, Sequence[Mark]]) -> bool:
    path = directory / name
    return path.is_file() and all(
        _is_own(directory, mark, marks) if isinstance(mark, str) else mark(path)
        for mark in marks[name]
    )
