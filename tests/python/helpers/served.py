"""The app as a process of its own, as a user starts it."""

import os
import signal
import subprocess
import sys
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path


@contextmanager
def served(*options: str) -> Iterator[tuple[str, Path]]:
    """The address that is printed, and the folder in which the app keeps files of sessions."""
    with tempfile.TemporaryDirectory() as aside:
        run = [sys.executable, "-m", "asperity", "app", "--no-browser", *options]
        environment = {**os.environ, "TMPDIR": aside, "MPLBACKEND": "agg"}
        with subprocess.Popen(run, stdout=subprocess.PIPE, text=True, env=environment) as process:
            try:
                assert process.stdout is not None
                yield process.stdout.readline().strip(), Path(aside)
            finally:
                process.send_signal(signal.SIGTERM)
                process.wait(30)
        assert list(Path(aside).glob("asperity-app-*")) == []
