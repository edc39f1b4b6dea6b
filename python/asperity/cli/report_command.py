"""The verb `report`: scenes as one HTML file."""

from argparse import Namespace

from asperity._core import InvalidInput
from asperity.base.arguments import FilePath
from asperity.cli.friction_commands import progress
from asperity.report.make import write_report


def report(args: Namespace) -> None:
    """Compute, draw and write a report."""
    paths = [FilePath(name) for name in args.scene]
    try:
        write_report(paths, FilePath(args.output), args.title, progress)
    except ImportError as error:  # of what the extra brings
        raise InvalidInput(f"report: {error}") from error
