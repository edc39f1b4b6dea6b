"""The shell command, called as a shell calls it."""

from collections.abc import Sequence

from asperity.cli.main import main


def status_of(arguments: Sequence[object]) -> int:
    """Its exit status, that of the parser's refusals too."""
    try:
        return main([str(argument) for argument in arguments]) or 0
    except SystemExit as stop:
        return int(stop.code or 0)
