"""The command line."""

from asperity.cli.cli import main

__all__ = ["main"]
