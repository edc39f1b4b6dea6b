"""The shell command `asperity`: its arguments and its exit status."""

import codecs
import io
import json
import os
import sys
from collections.abc import Sequence
from contextlib import suppress

from asperity._core import Error, InvalidInput, OutOfRange
from asperity.cli.parser import parser


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the shell command; the exit status is 0, 2 for bad input, 1 for any other failure."""
    if isinstance(sys.stdout, io.TextIOWrapper):
        sys.stdout.reconfigure(errors=_ESCAPE)
    args = parser().parse_args(arguments)
    try:
        args.run(args)
    except (InvalidInput, OutOfRange) as error:
        return _fail(error, 2)
    except BrokenPipeError:  # the reader of our output has gone
        _drop_stdout()
        return 1
    except OSError as error:
        _drop_stdout()
        named = "" if error.filename is None else f"{error.filename}: "
        return _fail(f"{named}{error.strerror or error}", 1)
    except MemoryError as error:
        return _fail(f"out of memory: {error}" if str(error) else "out of memory", 1)
    except Error as error:
        return _fail(error, 1)
    except KeyboardInterrupt:
        return _fail("interrupted", 130)
    return 0


def _fail(problem: object, status: int) -> int:
    print("asperity:", " ".join(str(problem).split()), file=sys.stderr)
    return status


def _drop_stdout() -> None:
    """Let what stdout still holds go nowhere, or Python's exit would try to write it again."""
    with suppress(OSError):
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())


def _escaped(error: UnicodeError) -> tuple[str, int]:
    """What an output cannot encode, in file names say, as JSON writes it in ASCII."""
    if not isinstance(error, UnicodeEncodeError):
        raise error
    return json.dumps(error.object[error.start : error.end])[1:-1], error.end


_ESCAPE = "asperity.escape"
codecs.register_error(_ESCAPE, _escaped)
