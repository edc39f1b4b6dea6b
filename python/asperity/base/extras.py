"""The line that installs what an extra needs."""

import shlex
import sys


def to_install(extra: str) -> str:
    """A line for the Python that runs: a shell's `pip` may be of another one."""
    return f"{shlex.quote(sys.executable or 'python3')} -m pip install 'asperity[{extra}]'"
