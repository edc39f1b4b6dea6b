"""The module shows Python what it looks for, and hides the rest from whatever else is loaded."""

import shutil
import subprocess
import sys

import pytest

from asperity import _core

NM = shutil.which("nm")


@pytest.mark.skipif(NM is None, reason="there is no nm")
@pytest.mark.skipif(sys.platform != "linux", reason="other symbol tables elsewhere")
def test_the_module_shows_its_start_alone():
    run = [NM, "-D", "--defined-only", _core.__file__]
    shown = subprocess.run(run, check=True, capture_output=True, text=True).stdout
    assert [line.split()[1:] for line in shown.splitlines()] == [["T", "PyInit__core"]]
