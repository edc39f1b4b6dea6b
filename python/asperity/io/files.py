"""Files written whole or not at all, and read only where they have an end."""

import errno
import os
import stat
from collections.abc import Iterable, Iterator, Mapping, Sequence
from contextlib import contextmanager, suppress
from functools import partial
from pathlib import Path

from asperity._core import Error, InvalidInput
from asperity.base.arguments import FilePath, reading

_DEVICE = {errno.ENOSPC, errno.EDQUOT, errno.EIO, errno.EFBIG}  # no fault of the path's


def write_whole(path: str | os.PathLike[str], content: bytes | str) -> None:
    """Replace a regular file by another, keeping its permissions; write into a device or a FIFO.

    The new content is written under a random name beside the file, which nobody else can have, and
    takes the file's place when it is complete: whoever dies or reads meanwhile finds one of the two
    whole. A symbolic link stays, and the file that it leads to is replaced.

    Raises
    ------
    InvalidInput
        The path cannot be written; the message says why.
    Error
        The device is full or fails.
    """
    with _refused(path):
        if isinstance(content, str):  # with names of files, which need be no text
            content = content.encode(errors="backslashreplace")
        _write(Path(os.path.realpath(path)), content)


def write_files(contents: Mapping[Path, bytes | str]) -> None:
    """Write every file whole, one after the other, into directories that are made where missing."""
    for path, content in contents.items():
        with _refused(path):
            path.parent.mkdir(parents=True, exist_ok=True)
        write_whole(path, content)


def check_file(path: Path) -> None:
    """Refuse what cannot be opened, and what one might wait for or read without end."""
    try:
        status = path.stat()
    except ValueError as error:
        raise InvalidInput(f"cannot be read: {error}") from error
    if stat.S_ISDIR(status.st_mode):
        raise IsADirectoryError(errno.EISDIR, os.strerror(errno.EISDIR))
    if not stat.S_ISREG(status.st_mode):
        raise InvalidInput("cannot be read: not a regular file")
    if status.st_size == 0:  # as those of /proc, some of which never end
        raise InvalidInput("is empty")
    path.open("rb").close()


def sha256(path: Path) -> str:
    """SHA-256 of a file's content.

    Raises
    ------
    InvalidInput
        In one line: the file, and why it cannot be read.
    """
    import hashlib  # here: `import asperity` is to be quick

    with reading(path):
        check_file(path)
        with path.open("rb") as content:
            return hashlib.file_digest(content, "sha256").hexdigest()


def check_output(path: Path) -> None:
    """Refuse, before any work, a path that cannot be written."""
    import tempfile  # here: `import asperity` is to be quick

    with _refused(path):
        target = FilePath(os.path.realpath(path))
        if not target.parent.is_dir():
            raise NotADirectoryError(0, f"the directory {FilePath(target.parent)} does not exist")
        mode = _mode(target)
        if mode is not None and stat.S_ISDIR(mode):
            raise IsADirectoryError(0, "it is a directory")
        if mode is None or stat.S_ISREG(mode):
            with tempfile.TemporaryFile(dir=target.parent):
                pass  # a trial: permissions alone say little about /proc, or to root


def refuse_overwrite(outputs: Sequence[Path], inputs: Sequence[Path]) -> None:
    taken = {os.path.realpath(path) for path in inputs}
    for path in outputs:
        if os.path.realpath(path) in taken:
            raise InvalidInput("is an input: choose another name for the output", where=path)


def check_directory(directory: Path, names: Iterable[str], *, force: bool) -> None:
    """Refuse, before any work, a directory that cannot be filled or holds files of these names.

    `force` lets the command replace them.
    """
    import tempfile

    with _refused(directory):
        places = (FilePath(directory), *FilePath(directory).absolute().parents)
        existing = next(place for place in places if os.path.lexists(place))
        if not existing.is_dir():
            raise NotADirectoryError(0, f"{existing} is no directory")
        with tempfile.TemporaryFile(dir=existing):
            pass
    taken = [name for name in names if os.path.lexists(directory / name)]
    if taken and not force:
        held = f"holds {', '.join(taken)} already"
        problem = f"{held}; choose another --output, or replace them with --force"
        raise InvalidInput(problem, where=FilePath(directory))
    for name in taken:
        check_output(directory / name)


@contextmanager
def _refused(path: str | os.PathLike[str]) -> Iterator[None]:
    """Let a failure name the path that the user named."""
    try:
        yield
    except InvalidInput:
        raise
    except (OSError, ValueError) as error:
        reason = getattr(error, "strerror", None) or error
        kind = Error if getattr(error, "errno", None) in _DEVICE else InvalidInput
        raise kind(f"{FilePath(os.fsdecode(path))}: cannot be written: {reason}") from error


def _write(target: Path, content: bytes) -> None:
    mode = _mode(target)
    if mode is not None and not stat.S_ISREG(mode):
        target.write_bytes(content)  # a device or a FIFO; a directory refuses
        return
    part = target.parent / f".asperity-{os.urandom(8).hex()}"
    try:
        private = partial(os.open, mode=0o666 if mode is None else 0o600)
        with open(part, "xb", opener=private) as file:
            file.write(content)
            file.flush()
            os.fsync(file.fileno())
        if mode is not None:
            part.chmod(stat.S_IMODE(mode))
        part.replace(target)
    except BaseException:
        with suppress(OSError):
            part.unlink()
        raise


def _mode(path: Path) -> int | None:
    """Return the kind and the permissions of what is there, or None where there is nothing."""
    with suppress(FileNotFoundError):
        return path.stat().st_mode
    return None
