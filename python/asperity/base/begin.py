"""An interrupt while the shell command is being imported ends it as one that comes later does.

The package imports this first.
"""

import os
import signal
import sys
import threading
from pathlib import PurePath


def _is_command() -> bool:
    """Whether `asperity` or `python -m asperity` runs, not a program that imports the package."""
    begun = sys.argv[0] if sys.argv else ""
    by_module = begun == "-m" and "asperity" in sys.orig_argv
    return by_module or PurePath(begun).stem == "asperity"


def _end(*_: object) -> None:
    os.write(2, b"asperity: interrupted\n")
    os._exit(130)


def imported() -> None:
    """From here on an interrupt is an exception again."""
    if signal.getsignal(signal.SIGINT) is _end:
        signal.signal(signal.SIGINT, signal.default_int_handler)


if (
    _is_command()
    and threading.current_thread() is threading.main_thread()
    and signal.getsignal(signal.SIGINT) is signal.default_int_handler
):
    signal.signal(signal.SIGINT, _end)
