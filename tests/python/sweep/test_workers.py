"""Real executors: processes that are killed, a scheduler over TCP, ranks of MPI, a driver's end."""

import os
import re
import shutil
import signal
import subprocess
import sys
import time
from contextlib import contextmanager
from pathlib import Path

import numpy as np
import pytest

import asperity
from asperity.cli.main import main
from asperity.sweep import run
from helpers.sweeps import SCENE, toml

xarray = pytest.importorskip("xarray", reason="a sweep needs asperity[sweep]")
pytest.importorskip("zarr", reason="a store needs asperity[sweep]")

OVER = {
    "surface.hurst": np.linspace(0.6, 0.9, 8).tolist(),
    "conditions.pressure_pa": np.geomspace(1e4, 1e6, 1000).tolist(),
}
# Warnings of Dask's own, of sockets that its processes leave behind.
pytestmark = pytest.mark.filterwarnings("ignore")
SWEEP = """
scene = "scene.toml"
[over]
surface.hurst = [0.7, 0.8, 0.9]
"conditions.pressure_pa" = {from = 1e4, to = 1e6, points = 20}
"""


@pytest.fixture(scope="module")
def expected():
    return asperity.sweep(SCENE, OVER, variables=["mu"])


@pytest.fixture
def files(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "scene.toml").write_text(toml(SCENE))
    (tmp_path / "sweep.toml").write_text(SWEEP)
    with asperity.sweep(
        "scene.toml",
        {
            "surface.hurst": [0.7, 0.8, 0.9],
            "conditions.pressure_pa": np.geomspace(1e4, 1e6, 20),
        },
        store="here.zarr",
    ):
        pass
    return tmp_path


def same_as_here(name):
    with xarray.open_dataset("here.zarr") as here, xarray.open_dataset(name) as there:
        assert np.isfinite(here.mu).all()
        for variable in ("mu", "hysteresis", "contact_area", "error_estimate", "failure"):
            assert np.array_equal(here[variable], there[variable]), variable
        assert here.attrs["notes"] == there.attrs["notes"]


def test_a_killed_worker_costs_its_task(expected, monkeypatch):
    distributed = pytest.importorskip("distributed")
    monkeypatch.setattr(run, "cut_of", lambda *_: (1, 250, 7))  # 32 tasks
    cluster = distributed.LocalCluster(
        n_workers=2, threads_per_worker=1, dashboard_address=None, silence_logs=50
    )
    with cluster, distributed.Client(cluster) as client:
        first = client.run(os.getpid)
        killed = []

        def progress(done, points):
            if not killed:
                killed.append(next(iter(first.values())))
                os.kill(killed[0], signal.SIGKILL)

        result = asperity.sweep(SCENE, OVER, executor=client, progress=progress, variables=["mu"])
        assert killed
        assert np.array_equal(result.mu, expected.mu)
        assert result.attrs["failed"] == 0
        client.wait_for_workers(2, timeout=120)
        assert killed[0] not in client.run(os.getpid).values()


@contextmanager
def started(*command):
    process = subprocess.Popen(
        [sys.executable, "-m", *command],
        stdout=subprocess.DEVNULL,
        stderr=subprocess.PIPE,
        text=True,
    )
    try:
        yield process
    finally:
        process.kill()
        process.communicate()


@pytest.mark.long
def test_a_scheduler_and_workers_are_processes_over_tcp(files, capsys):
    pytest.importorskip("distributed")
    quiet = ("--no-dashboard", "--host", "127.0.0.1")
    with started("distributed.cli.dask_scheduler", *quiet, "--port", "0") as scheduler:
        address = None
        while address is None:
            line = scheduler.stderr.readline()
            assert line, "the scheduler ended"
            address = re.search(r"Scheduler at: +(tcp://127\.0\.0\.1:\d+)", line)
        worker = (
            "distributed.cli.dask_worker",
            address[1],
            *quiet,
            "--nthreads",
            "1",
            "--no-nanny",
        )
        with started(*worker), started(*worker):
            line = ["sweep", "sweep.toml", "--output", "there.zarr", "--scheduler", address[1]]
            assert main(line) == 0
    assert capsys.readouterr().err.splitlines()[-1] == "there.zarr: 420 points, none failed"
    same_as_here("there.zarr")


@pytest.mark.long
def test_a_scheduler_that_does_not_answer_is_told_in_a_line(files, capsys):
    pytest.importorskip("distributed")
    began = time.monotonic()
    line = ["sweep", "sweep.toml", "--output", "there.zarr", "--scheduler", "tcp://127.0.0.1:9"]
    assert main(line) == 1
    assert time.monotonic() - began < 20
    told = capsys.readouterr().err.splitlines()
    assert told == [
        "asperity: --scheduler tcp://127.0.0.1:9: does not answer within 10 s: is it running?"
    ]
    assert not Path("there.zarr").exists()


def test_two_ranks_of_mpi(files):
    pytest.importorskip("mpi4py")
    mpiexec = shutil.which("mpiexec", path=f"{Path(sys.executable).parent}:{os.environ['PATH']}")
    if mpiexec is None:
        pytest.skip("has no mpiexec, which asperity[mpi] brings")
    ranks = [mpiexec, "-n", "2", sys.executable, "-m", "asperity", "sweep", "sweep.toml"]
    done = subprocess.run(
        [*ranks, "--output", "there.nc", "--mpi"], capture_output=True, text=True, timeout=300
    )
    assert done.returncode == 0, done.stderr
    assert done.stderr.splitlines()[-1] == "there.nc: 420 points, none failed"
    same_as_here("there.nc")


DRIVER = """
import sys
import asperity
from asperity.sweep import run
from helpers.sweeps import SCENE
run.cut_of = lambda *_: (1, 125, 7)  # 64 tasks
asperity.sweep(SCENE, {over}, store="killed{ending}", resume=True, variables=["mu"])
"""


@pytest.mark.parametrize("ending", [".zarr", pytest.param(".nc", marks=pytest.mark.long)])
def test_what_a_killed_driver_wrote_is_resumed(ending, expected, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    part = Path("killed.zarr" if ending == ".zarr" else "killed.nc.part")
    journal = part / "_sweep/journal"
    code = DRIVER.format(over=OVER, ending=ending)
    helpers = str(Path(__file__).parents[1])
    paths = os.pathsep.join([helpers, *filter(None, [os.environ.get("PYTHONPATH")])])
    driver = [sys.executable, "-c", code]
    counts = []
    for kills in (1, 2):
        process = subprocess.Popen(driver, env={**os.environ, "PYTHONPATH": paths})
        while process.poll() is None and len(counts) < kills:
            written = journal.read_text().count("\n") if journal.exists() else 0
            if written >= (counts[-1] if counts else 0) + 10:
                counts.append(written)
            time.sleep(0.002)
        process.send_signal(signal.SIGKILL)
        assert process.wait() == -signal.SIGKILL
    assert 10 <= counts[0] < counts[1] < 64
    subprocess.run(driver, env={**os.environ, "PYTHONPATH": paths}, check=True)
    with xarray.open_dataset(f"killed{ending}") as result:
        assert np.array_equal(result.mu, expected.mu)
        assert result.attrs["complete"] == 1
    if ending == ".zarr":
        assert journal.read_text().count("\n") == 64
    assert os.listdir() == [f"killed{ending}"]


def _begun_by(parent):
    """A process that Dask has begun for the parent."""
    for folder in Path("/proc").glob("[0-9]*"):
        try:
            command = (folder / "cmdline").read_text()
            of = int((folder / "stat").read_text().rpartition(")")[2].split()[1])
        except (OSError, IndexError):
            continue
        if "spawn_main" in command and of == parent:
            return int(folder.name)
    return None


@pytest.mark.skipif(not Path("/proc/self/stat").exists(), reason="there is no /proc")
def test_a_worker_killed_as_it_starts_is_one_line(files):
    pytest.importorskip("distributed")
    command = ("asperity", "sweep", "sweep.toml", "--output", "a.zarr", "--workers", "2")
    with started(*command) as process:
        while (worker := _begun_by(process.pid)) is None:
            assert process.poll() is None
            time.sleep(0.01)
        os.kill(worker, signal.SIGKILL)
        said = process.communicate(timeout=120)[1]
    assert process.returncode == 1
    assert said.startswith("asperity: the workers ended as they started: ")
    assert said.count("\n") == 1
