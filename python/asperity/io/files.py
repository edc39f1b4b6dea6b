"""Files written whole or not at all."""

import os
import stat
import tempfile
from contextlib import suppress
from pathlib import Path

from asperity._core import InvalidInput


def write_whole(path: str | os.PathLike[str], content: bytes) -> None:
    """Replace a regular file by another, keeping its permissions; write into a device or a FIFO.

    The new content is written under a random name beside the file, which nobody else can have, and
    takes the file's place when it is complete: whoever dies or reads meanwhile finds one of the two
    whole. A symbolic link stays, and the file that it leads to is replaced.

    Raises
    ------
    InvalidInput
        The path cannot be written; the message says why.
    """
    try:
        _write(Path(os.path.realpath(path)), content)
    except (OSError, ValueError) as error:
        reason = getattr(error, "strerror", None) or error
        raise InvalidInput(f"{os.fspath(path)}: cannot be written: {reason}") from error


def _write(target: Path, content: bytes) -> None:
    mode = None
    with suppress(FileNotFoundError):
        mode = target.stat().st_mode
    if mode is not None and not stat.S_ISREG(mode):
        target.write_bytes(content)  # a device or a FIFO; a directory refuses
        return
    handle, part = tempfile.mkstemp(prefix=".asperity-", dir=target.parent)
    try:
        with os.fdopen(handle, "wb") as file:
            file.write(content)
            file.flush()
            os.fsync(file.fileno())
        os.chmod(part, stat.S_IMODE(mode) if mode is not None else 0o666 & ~_umask())
        os.replace(part, target)
    except BaseException:
        with suppress(OSError):
            os.unlink(part)
        raise


def _umask() -> int:
    """Return which permissions a new file does not get. There is no other way to ask."""
    mask = os.umask(0o077)
    os.umask(mask)
    return mask
