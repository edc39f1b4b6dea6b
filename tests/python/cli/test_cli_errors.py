"""The shell command in trouble: one line, the right exit status, and no file left behind."""

import os
import subprocess
import sys

import numpy as np
import pytest

import asperity
from asperity.base.diagnostics import Argument
from asperity.cli.main import main
from asperity.io.files import write_files
from helpers.scenes import SCENE


def names(folder):
    return sorted(path.name for path in folder.iterdir())


SPECTRUM = ["spectrum", "scan.npy", "--pixel-size", "1e-5", "--unit", "m"]


FRICTION = ["friction", "scene.toml"]


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (["friction", "none.toml"], "none.toml: cannot be read"),
        (["area", "none\nat all.toml"], r"'none\nat all.toml': cannot be read"),
        (["spectrum", "none.npy"], "none.npy: cannot be read"),
        (["spectrum", "/dev/null"], "/dev/null: cannot be read"),
        (["friction", "scan.npy"], "scan.npy: not a TOML file"),
        ([*FRICTION, "--output", "."], ".: cannot be written"),
        ([*FRICTION, "--output", "x" * 300], f"{'x' * 300}: cannot be written"),
        ([*FRICTION, "--output", "scene.toml"], "scene.toml: is an input"),
        ([*SPECTRUM, "--output", "scan.npy"], "scan.npy: is an input"),
        (["friction", "scanned.toml", "--output", "scan.npy"], "scan.npy: is an input"),
        ([*FRICTION, "--plot", "a.png", "--output", "a.png"], "a.png: --output and --plot"),
        ([*FRICTION, "--style", "dark"], "--style: goes with --plot"),
        (["validate", "--velocities", "1"], "--velocities: goes with --sliding"),
        (["validate", "--pixel-size", "1e-5"], "--pixel-size: goes with --surface"),
        (["validate", "--sliding", "--q0", "1e3"], "--sliding, --q0: must be one of them"),
        (["validate", "--surface", "scan.npy", "--rows", "r"], "--surface, --rows: must be"),
        (["area", "long.toml", "--points", "100000"], "long.toml: pressures, velocities"),
        (["spectrum", "scan.npy"], "scan.npy: --pixel-size is missing"),
        ([*SPECTRUM, "--q-min", "1e4", "--q-max", "1e3"], "--q-max 1e3: must be above"),
        (["spectrum", "holes.npy", *SPECTRUM[2:]], "holes.npy: "),
    ],
)
def test_bad_input_is_one_line_and_leaves_no_file(folder, capsys, arguments, message):
    holes = np.ones((20, 20))
    holes[:, :3] = np.nan
    np.save(folder / "holes.npy", holes)
    scan = "[surface]\nfile = 'scan.npy'\npixel_size_m = 1e-5\nunit = 'm'\n"
    (folder / "long.toml").write_text(SCENE.replace("points = 5", "points = 6"))
    (folder / "scanned.toml").write_text(scan + SCENE[SCENE.index("[rubber]") :])
    before = names(folder)
    if "--output" not in arguments:
        arguments = [*arguments, "--output", "out.csv"]
    assert main(arguments) == 2
    out, err = capsys.readouterr()
    assert out == ""
    assert len(err.splitlines()) == 1
    assert err.startswith(f"asperity: {message}")
    assert names(folder) == before


@pytest.mark.parametrize(
    ("arguments", "named"),
    [
        ([], "VERB"),
        (["frictoin"], "VERB: invalid choice: 'frictoin'"),
        (["area", "scene.toml", "--points", "1"], "--points: '1'"),
        ([*SPECTRUM, "--pixel-size", "abc"], "--pixel-size: 'abc'"),
        ([*SPECTRUM, "--window", "boxcar"], "--window: invalid choice: 'boxcar'"),
    ],
)
def test_bad_usage_is_one_line(folder, capsys, arguments, named):
    with pytest.raises(SystemExit) as caught:
        main(arguments)
    assert caught.value.code == 2
    out, err = capsys.readouterr()
    assert out == ""
    assert len(err.splitlines()) == 1
    assert named in err


NO_FILE = "cannot be read: not a regular file"
DMA = ["--columns", "frequency=f,temperature=T,storage=s,loss=l", "--modulus", "E"]
DMA += ["--units", "frequency=Hz,temperature=K,modulus=Pa"]


@pytest.mark.parametrize(
    "arguments",
    [
        ["friction", "FILE"],
        ["fit", "scene.toml", "FILE"],
        ["map", "--info", "FILE"],
        ["rubber", "FILE", *DMA],
        ["rubber", "sweep.csv", *DMA, "--shift", "FILE"],
        [*SPECTRUM[:1], "FILE", *SPECTRUM[2:]],
        ["validate", "--rows", "FILE"],
        ["validate", "--surface", "FILE"],
    ],
)
@pytest.mark.parametrize("name", ["pipe", "/dev/zero", "loop"])
def test_what_has_no_end_is_refused_and_not_waited_for(folder, capsys, undrawn, arguments, name):
    if not (folder / "pipe").exists():
        os.mkfifo(folder / "pipe")
    if not (folder / "loop").is_symlink():
        (folder / "loop").symlink_to("loop")
    rows = "".join(f"{10**k},293,2e6,1e6\n" for k in range(4))
    (folder / "sweep.csv").write_text(f"f,T,s,l\n{rows}")
    assert main([name if one == "FILE" else one for one in arguments]) == 2
    out, err = capsys.readouterr()
    problem = "cannot be read: Too many levels of symbolic links" if name == "loop" else NO_FILE
    assert (out, err) == ("", f"asperity: {name}: {problem}\n")


def test_an_error_in_a_later_scene_keeps_the_old_output(folder, capsys):
    (folder / "bad.toml").write_text(SCENE.replace("[81e3, 2e5]", "-1"))
    (folder / "mu.csv").write_text("of yesterday")
    arguments = ["friction", "scene.toml", "bad.toml", "--output", "mu.csv", "--plot", "mu.png"]
    assert main(arguments) == 2
    message = "asperity: bad.toml: [conditions] pressure_pa = -1: must be positive"
    assert capsys.readouterr().err.startswith(message)
    assert (folder / "mu.csv").read_text() == "of yesterday"
    assert not (folder / "mu.png").exists()


def test_not_converged_is_no_bad_input(folder, capsys, monkeypatch):
    def fail(*_, **__):
        rtol = Argument("rtol")
        raise asperity.NotConverged("mu = 1 with error 2,\nwhere ", rtol, " = 1e-6 was asked for")

    monkeypatch.setattr("asperity.scene.model.friction", fail)
    assert main(["friction", "scene.toml", "--output", "mu.csv"]) == 1
    line = "asperity: scene.toml: mu = 1 with error 2, where [solver] rtol = 1e-6 was asked for\n"
    assert capsys.readouterr().err == line
    assert not (folder / "mu.csv").exists()


def test_failing_disk_leaves_nothing(folder, capsys, monkeypatch):
    def full(_):
        raise OSError(28, "No space left on device")

    monkeypatch.setattr("os.fsync", full)
    before = names(folder)
    assert main(["friction", "scene.toml", "--output", "mu.csv"]) == 1
    line = "asperity: mu.csv: cannot be written: No space left on device\n"
    assert capsys.readouterr().err == line
    assert names(folder) == before


def test_no_name_for_the_parts_is_known_beforehand(tmp_path):
    """Another process with the same number, or a planted link, takes nobody's place."""
    planted = tmp_path / "planted"
    planted.write_bytes(b"mine")
    for i in range(20):
        (tmp_path / f".asperity-{os.getpid()}-{i}.part").symlink_to(planted)
    write_files({tmp_path / "a": b"new"})
    assert planted.read_bytes() == b"mine"
    assert (tmp_path / "a").read_bytes() == b"new"
    assert not (tmp_path / "a").is_symlink()


@pytest.mark.parametrize(
    ("failure", "status", "line"),
    [
        (MemoryError("Unable to allocate 37.3 GiB"), 1, "out of memory: Unable to allocate 37.3"),
        (MemoryError(), 1, "out of memory"),
        (KeyboardInterrupt(), 130, "interrupted"),
    ],
)
def test_what_stops_the_work_is_one_line(folder, capsys, monkeypatch, failure, status, line):
    def stop(*_, **__):
        raise failure

    monkeypatch.setattr("asperity.scene.model.friction", stop)
    before = names(folder)
    assert main(["friction", "scene.toml", "--output", "mu.csv"]) == status
    out, err = capsys.readouterr()
    assert out == ""
    assert err.startswith(f"asperity: {line}")
    assert len(err.splitlines()) == 1
    assert names(folder) == before


INTERRUPTED = """
import os, signal, sys, threading
from asperity.cli.main import main
from asperity.scene import model

signal.signal(signal.SIGINT, signal.default_int_handler)  # nohup and CI start with it ignored
running, compute, begun = threading.Event(), model.friction, []

def friction(*parts, **conditions):
    begun.append(conditions["pressure"].size)
    running.set()
    return compute(*parts, **conditions)

def interrupt():
    running.wait()
    os.kill(os.getpid(), signal.SIGINT)

model.friction, model._CHUNK = friction, 1  # 200,000 calls, of which the first sends for the end
threading.Thread(target=interrupt, daemon=True).start()
status = main(["friction", "long.toml", "--output", "mu.csv"])
sys.exit(status if sum(begun) < 200_000 else "it went on to the end")
"""


def test_interrupt_ends_a_long_computation(folder):
    (folder / "long.toml").write_text(SCENE.replace("points = 5", "points = 100000"))
    before = names(folder)
    done = subprocess.run(
        ["sh", "-c", 'trap "" INT; exec "$0" -c "$1"', sys.executable, INTERRUPTED],
        capture_output=True,
        text=True,
        check=False,
    )
    assert (done.returncode, done.stdout, done.stderr) == (130, "", "asperity: interrupted\n")
    assert names(folder) == before
