"""The standard streams. A result that cannot be written is an error; notes are lost without one."""

import codecs
import errno
import io
import json
import os
import sys
from collections.abc import Iterator, Sequence
from contextlib import contextmanager, suppress
from typing import TextIO

from asperity.base.diagnostics import Note, fatal_first, few_lines, first_step

_FEW = 5  # lines of notes


@contextmanager
def standard_streams() -> Iterator[None]:
    """Let streams that are closed, full or unable to show a character do no harm."""
    for number in range(3):
        try:
            os.fstat(number)
        except OSError:  # the next file to be opened would have its place, and get what it is told
            os.open(os.devnull, os.O_RDWR)
    if isinstance(sys.stdout, io.TextIOWrapper):
        sys.stdout.reconfigure(errors=_ESCAPE)
    try:
        yield
    finally:
        print_stderr("")


def print_stdout(text: str) -> None:
    """Write to standard output; a failure names it."""
    name = "standard output"
    if sys.stdout is None:
        raise OSError(errno.EBADF, "is closed", name)
    try:
        print(text, end="", flush=True)
    except BrokenPipeError:
        raise
    except OSError as error:
        raise OSError(error.errno, error.strerror, name) from error


def print_stderr(text: str) -> None:
    """Write to standard error, as far as it takes it."""
    if sys.stderr is None:
        return
    try:
        print(text, end="", flush=True, file=sys.stderr)
    except OSError:
        discard(sys.stderr)


def tell_notes(notes: Sequence[Note], how_many: str | None) -> None:
    """Write notes to standard error with what to do about them, in a few lines or "all" of them;
    last what to do first."""
    if how_many != "all":
        lines = few_lines(notes, _FEW)
    else:
        lines = [f"note: {note.with_step}" for note in fatal_first(notes)]
        lines += [f"next: {step}" for step in [first_step(notes)] if step]
    for line in lines:
        print_stderr(f"{printable(line)}\n")


def discard(stream: TextIO | None) -> None:
    """Let what a stream still holds go nowhere, or Python's exit would try to write it again."""
    if stream is not None:
        with suppress(OSError, ValueError):
            os.dup2(os.open(os.devnull, os.O_WRONLY), stream.fileno())


def printable(text: str) -> str:
    """A text of one line, in which what a terminal would obey is written out."""
    return "".join(one if one.isprintable() else repr(one)[1:-1] for one in text)


def _escaped(error: UnicodeError) -> tuple[str, int]:
    """What an output cannot encode, in file names say, as JSON writes it in ASCII."""
    if not isinstance(error, UnicodeEncodeError):
        raise error
    return json.dumps(error.object[error.start : error.end])[1:-1], error.end


_ESCAPE = "asperity.escape"
codecs.register_error(_ESCAPE, _escaped)
