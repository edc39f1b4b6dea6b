"""The command line."""

from asperity.cli.main import main

__all__ = ["main"]
