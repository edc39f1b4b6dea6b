"""Peak memory of a step in a process of its own, by the kernel's high-water mark (Linux)."""

import re
import subprocess
import sys
from pathlib import Path

CHILD = """
import re
from pathlib import Path

def kilobytes(key):
    return int(re.search(key + r":\\s+(\\d+)", Path("/proc/self/status").read_text())[1])

def peak(step, *inputs):
    "Above what is held before it; the mark is forgotten first."
    Path("/proc/self/clear_refs").write_text("5")
    before = kilobytes("VmRSS")
    kept = step(*inputs)
    return kilobytes("VmHWM") - before
"""


def printed(code: str, *arguments: str) -> list[float]:
    """The numbers that code prints, which may use CHILD's functions and modules beside this."""
    done = subprocess.run(
        [sys.executable, "-c", f"{CHILD}\n{code}", *arguments],
        capture_output=True,
        text=True,
        check=True,
        cwd=Path(__file__).parent,
    )
    return [float(number) for number in re.findall(r"\S+", done.stdout)]
