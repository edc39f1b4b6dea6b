"""Options of the long runs: numbers with defaults, and which of several kinds are run."""

import argparse
from collections.abc import Iterable
from typing import Any


def options(doc: str | None, kinds: Iterable[str] = (), **defaults: float) -> Any:
    """Of the command line; `kinds` are those asked for, all of them where none is."""
    parser = argparse.ArgumentParser(description=(doc or "").splitlines()[0])
    known = list(kinds)
    if known:
        parser.add_argument("kinds", nargs="*", metavar="KIND", help=", ".join(known))
    for name, default in defaults.items():
        parser.add_argument(f"--{name}", type=type(default), default=default)
    found = parser.parse_args()
    if known:
        if unknown := set(found.kinds) - set(known):
            parser.error(f"KIND: {', '.join(sorted(unknown))}: must be among {', '.join(known)}")
        found.kinds = found.kinds or known
    return found
