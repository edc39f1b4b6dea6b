"""Commands that write are killed by SIGKILL at every line of the writing.

python tests/stability/killed.py [COMMAND...]

After each kill every file must be the old one or the new one, whole. Parts under random names may
stay; the next run must go well and leave no more of them. The kills are by the line that is
executed, so that none falls where nothing is written.
"""

import argparse
import contextlib
import io
import os
import signal
import sys
import tempfile
from pathlib import Path

import numpy as np

import asperity
from asperity.cli.main import main as command
from asperity.io import files

SCENE = """\
surface = { rms_height_m = 1e-5, hurst = 0.8, q0_per_m = 2e3, q1_per_m = 1e5 }

[rubber]
equilibrium_modulus_pa = 3e6
moduli_pa = [1e7, 1e8]
relaxation_times_s = [1e-2, 1e-5]

[conditions]
pressure_pa = 1e5
velocity_m_s = { from = 1e-3, to = 1, points = 3 }
"""
SCAN = ["--pixel-size", "3e-5", "--unit", "m"]
COMMANDS = {
    "friction": ["friction", "scene.toml", "--output", "out/a.csv", "--plot", "out/b.png"],
    "spectrum": ["spectrum", "scan.npy", *SCAN, "--output", "out/a.csv", "--plot", "out/b.svg"],
    "map": ["map", "scene.toml", "--rtol", "0.1", "--checked", "0", "--output", "out/a.fmap"],
    "demo": ["demo", "--output", "out", "--force"],
}


def quietly(arguments: list[str]) -> int:
    with contextlib.redirect_stdout(io.StringIO()), contextlib.redirect_stderr(io.StringIO()):
        return command(arguments)


def killed_at(line: int, arguments: list[str]) -> bool:
    """Whether a process that dies at this line of `files` has got there."""
    child = os.fork()
    if child == 0:
        passed = 0

        def trace(frame: object, event: str, _: object) -> object:
            nonlocal passed
            if frame.f_code.co_filename != files.__file__:  # type: ignore[attr-defined]
                return None
            passed += event == "line"
            if passed == line:
                os.kill(os.getpid(), signal.SIGKILL)
            return trace

        sys.settrace(trace)  # type: ignore[arg-type]
        os._exit(quietly(arguments))
    status = os.waitstatus_to_exitcode(os.waitpid(child, 0)[1])
    if status not in (0, -signal.SIGKILL):
        raise RuntimeError(f"{' '.join(arguments)}: ended with {status}")
    return status == -signal.SIGKILL


def content(out: Path) -> dict[str, bytes]:
    return {path.name: path.read_bytes() for path in out.iterdir()}


def run(name: str) -> int:
    """How many kills have left something else than old and new files."""
    arguments, out = COMMANDS[name], Path("out")
    out.mkdir()
    if quietly(arguments) != 0:
        raise RuntimeError(f"{name}: fails without a kill")
    new = content(out)
    old = {file: data[: len(data) // 2] for file, data in new.items()}
    wrong, line, ends = 0, 1, {"old": 0, "new": 0}
    while True:
        for file, data in old.items():
            (out / file).write_bytes(data)
        if not killed_at(line, arguments):
            break
        left = content(out)
        for file in new:
            if left[file] not in (old[file], new[file]):
                wrong += 1
                print(f"{name}: killed at line {line} of the writing, {file} is neither")
            ends["new" if left[file] == new[file] else "old"] += 1
        strangers = set(left) - set(new)
        wrong += any(not one.startswith(".asperity-") for one in strangers) or len(strangers) > 1
        for one in strangers:
            (out / one).unlink()
        line += 1
    wrong += content(out) != new
    for path in out.iterdir():
        path.unlink()
    out.rmdir()
    print(
        f"{name}: {line - 1} kills, {ends['old']} old files, {ends['new']} new ones, {wrong} wrong"
    )
    return wrong


def main() -> int:
    parser = argparse.ArgumentParser()
    parser.add_argument("commands", nargs="*", metavar="COMMAND", help=", ".join(COMMANDS))
    args = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder, contextlib.chdir(folder):
        Path("scene.toml").write_text(SCENE)
        spectrum = asperity.SelfAffineSpectrum(rms_height=1e-5, hurst=0.8, q0=2e3, q1=1e5)
        surface = asperity.synthesize(spectrum, shape=(48, 40), pixel_size=3e-5, seed=1)
        np.save("scan.npy", surface.heights)
        return int(sum(run(name) for name in args.commands or COMMANDS) > 0)


if __name__ == "__main__":
    sys.exit(main())
