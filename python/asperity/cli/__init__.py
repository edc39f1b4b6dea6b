"""The command line."""

from asperity.cli.main import main as main
