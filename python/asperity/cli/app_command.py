"""The verb `app`: the app in the browser."""

from argparse import Namespace

from asperity.app.serve import serve
from asperity.cli.streams import print_stdout


def app(args: Namespace) -> None:
    """Serve until Ctrl-C; the address is one line on standard output."""
    serve(
        args.host,
        args.port,
        browser=not args.no_browser,
        tell=lambda address: print_stdout(f"{address}\n"),
    )
