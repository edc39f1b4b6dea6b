"""The shell command `asperity`: its arguments and its exit status."""

import sys
from collections.abc import Sequence
from functools import partial

from asperity._core import Error, InvalidInput, OutOfRange
from asperity.base.begin import imported
from asperity.cli.options import typed_options
from asperity.cli.parser import parser
from asperity.cli.streams import discard, print_stderr, printable, standard_streams
from asperity.io.typed import as_typed


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the shell command; the exit status is 0, 2 for bad input, 1 for any other failure."""
    with standard_streams():
        try:
            imported()
            args = parser().parse_args(arguments)
            try:
                args.run(args)
            except Error as error:
                typed = error.said(partial(as_typed, inputs=typed_options(args)))
                return _fail(typed, 2 if isinstance(error, InvalidInput | OutOfRange) else 1)
        except BrokenPipeError:  # the reader of our output has gone
            discard(sys.stdout)
            return 1
        except OSError as error:
            discard(sys.stdout)
            named = "" if error.filename is None else f"{error.filename}: "
            return _fail(f"{named}{error.strerror or error}", 1)
        except MemoryError as error:
            return _fail(f"out of memory: {error}" if str(error) else "out of memory", 1)
        except KeyboardInterrupt:
            return _fail("interrupted", 130)
        return 0


def _fail(problem: object, status: int) -> int:
    print_stderr(f"asperity: {printable(' '.join(str(problem).split()))}\n")
    return status
