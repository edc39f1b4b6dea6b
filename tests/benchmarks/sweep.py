"""What a sweep adds to the plain loop, what workers gain, and the memory of the driver.

    python tests/benchmarks/sweep.py overhead          processor time over that of the plain loop
    python tests/benchmarks/sweep.py measured          the same of two scans with a measured rubber
    python tests/benchmarks/sweep.py workers           one and two Dask workers: wall and processor
    python tests/benchmarks/sweep.py memory            peak memory of the driver over the points
    python tests/benchmarks/sweep.py model             what 100 workers would take

Points are pressures times velocities of three treads on a self-affine road. `measured` needs
ASPERITY_DATA. Wall times say something on an idle machine alone; processor times do on a busy one
too.
"""

import argparse
import os
import resource
import subprocess
import sys
import tempfile
import time
from dataclasses import replace
from functools import cache
from pathlib import Path

import measured as inputs
import numpy as np

import asperity
from asperity.scene.rubber import BuiltRubber, build_rubber
from asperity.scene.scene import Builders, build_scene
from asperity.sweep import parts, plan, run, work
from asperity.sweep.executors import local_cluster

SCENE = {
    "surface": {"rms_height_m": 2e-4, "hurst": 0.8, "q0_per_m": 2e3, "q1_per_m": 1e5},
    "rubber": {
        "equilibrium_modulus_pa": 3e6,
        "moduli_pa": [1e9, 1e8, 1e7],
        "relaxation_times_s": [1e-8, 1e-6, 1e-4],
    },
    "conditions": {"pressure_pa": 1e5, "velocity_m_s": 1e-2},
}
TREADS = 3
MOST_OF_TREAD = 3_333_400  # points, of more there are more treads


def over(points: int) -> dict[str, np.ndarray]:
    treads = max(TREADS, -(-points // MOST_OF_TREAD))
    return {
        "rubber.equilibrium_modulus_pa": np.linspace(2e6, 4e6, treads),
        "conditions.pressure_pa": np.geomspace(5e4, 5e5, 100),
        "conditions.velocity_m_s": np.geomspace(1e-5, 1, max(1, points // (treads * 100))),
    }


def plain(points: int) -> float:
    """Processor time of the loop that a sweep takes the place of, which keeps what it computes."""
    axes = over(points)
    surface, rubber = SCENE["surface"], SCENE["rubber"]
    treads, p, v = axes.values()
    step = max(1, plan.MOST_POINTS // v.size)
    began = time.process_time()
    kept = {name: np.full((treads.size, p.size, v.size), np.nan) for name in plan.PLAIN}
    for k, modulus in enumerate(treads.tolist()):
        road = asperity.SelfAffineSpectrum(
            rms_height=surface["rms_height_m"],
            hurst=surface["hurst"],
            q0=surface["q0_per_m"],
            q1=surface["q1_per_m"],
        )
        tread = asperity.PronySeries(
            equilibrium_modulus=modulus,
            moduli=rubber["moduli_pa"],
            relaxation_times=rubber["relaxation_times_s"],
        )
        for i in range(0, p.size, step):
            found = asperity.friction(road, tread, pressure=p[i : i + step, None], velocity=v)
            for name, array in kept.items():
                array[k, i : i + step] = getattr(found, name)
    return time.process_time() - began


def overhead(points: int) -> None:
    """Processor time over that of the plain loop, the median of three in turns."""
    asperity.sweep(SCENE, over(30_000))  # what is imported is imported now
    for name in ("memory", "results.zarr"):
        found = []
        for _ in range(3):
            with tempfile.TemporaryDirectory() as folder:
                store = None if name == "memory" else Path(folder) / name
                loop = plain(points)
                began = time.process_time()
                asperity.sweep(SCENE, over(points), store=store).close()
                found.append((time.process_time() - began) / loop)
        print(
            f"{points} points into {name}: {sorted(found)[1]:.3f} of the plain loop's {loop:.2f} s"
        )


def measured(points: int) -> None:
    """Overhead where parts take long to build: opd-1 and al3d-1 with the isotherms of epdm_70."""
    data = inputs.folder()
    if data is None:
        sys.exit("ASPERITY_DATA is not set: it names the folder of measured inputs")
    tables = {
        "surface": {},
        "rubber": {
            "isotherms": [str(data / "dma/epdm_70/tf_015p.csv")],
            "columns": inputs.COLUMNS,
            "units": inputs.UNITS,
            "modulus": "G",
            "temperature_c": 20,
            "extrapolation": "power-law",
        },
        "conditions": {"pressure_pa": 1e5, "velocity_m_s": 1e-3},
    }
    scans = [str(data / "topography" / name) for name in inputs.SCANS]
    p, v = np.geomspace(5e4, 5e5, 20), np.geomspace(1e-5, 1e-1, max(1, points // 80))
    corrections = {"none": None, "partial-contact": asperity.PartialContact()}
    axes = {
        "surface.file": scans,
        "correction.kind": list(corrections),
        "conditions.pressure_pa": p,
        "conditions.velocity_m_s": v,
    }

    def rubber() -> BuiltRubber:
        return build_rubber(Path(), tables["rubber"], None)

    def loop(each_anew: bool) -> float:
        began = time.process_time()
        one_rubber = cache(rubber)
        kept = {name: np.full((2, 2, p.size, v.size), np.nan) for name in plan.PLAIN}
        builders = Builders(rubber=build_rubber if each_anew else lambda *_: one_rubber())
        for i, scan in enumerate(scans):
            scene = tables | {"surface": {"file": scan}}
            made = None
            for k, correction in enumerate(corrections.values()):
                if made is None or each_anew:
                    made = build_scene(Path(), scene, for_friction=True, builders=builders)
                found = replace(made, correction=correction).friction_at(p[:, None], v)
                for name, array in kept.items():
                    array[i, k] = getattr(found, name)
        return time.process_time() - began

    def swept(store: Path) -> float:
        for kept in (parts._SCANS, parts._SURFACES, parts._RUBBERS, parts._CORRECTIONS):
            kept._made.clear()  # as in a new worker
        began = time.process_time()
        asperity.sweep(tables, axes, store=store).close()
        return time.process_time() - began

    with tempfile.TemporaryDirectory() as folder:
        swept(Path(folder) / "first.zarr")  # what is imported is imported now
        turns = []
        for turn in range(3):
            once, anew = loop(False), loop(True)
            turns.append((swept(Path(folder) / f"{turn}.zarr") / once, anew / once, once))
    ratio, anew, once = (sorted(column)[1] for column in zip(*turns, strict=True))
    print(
        f"{4 * p.size * v.size} points of two scans: {ratio:.3f} of the {once:.2f} s of a loop "
        f"that builds both scans and the rubber once; {anew:.2f} if it builds them for each scene"
    )


def workers(points: int) -> None:
    """Wall and processor seconds with one worker and with two."""
    told = {}
    for count in (1, 2):
        with (
            tempfile.TemporaryDirectory() as folder,
            local_cluster(count) as client,
        ):
            small = over(30_000)
            asperity.sweep(SCENE, small, executor=client)  # workers have imported all
            before = client.run(time.process_time)
            began, own = time.perf_counter(), time.process_time()
            asperity.sweep(
                SCENE, over(points), executor=client, store=Path(folder) / "results.zarr"
            ).close()
            wall, own = time.perf_counter() - began, time.process_time() - own
            after = client.run(time.process_time)
            theirs = sum(after[one] - before[one] for one in after)
            told[count] = {"wall": wall, "driver": own, "workers": theirs}
            print(
                f"{points} points, {count} workers: {wall:.2f} s of wall, processor: "
                f"driver with scheduler {own:.2f} s, workers {theirs:.2f} s"
            )
    one, two = told[1], told[2]
    bound = 2 * one["workers"] / (two["workers"] + two["driver"])
    print(
        f"two over one: {one['wall'] / two['wall']:.2f} by wall, "
        f"{bound:.2f} by processor time on two cores"
    )


def memory(points: int) -> None:
    """Peak memory of a driver whose worker is another process, for more and more points."""
    for count in (points // 10, points // 3, points):
        code = (
            "import sys, resource; sys.path.insert(0, sys.argv[1]); import sweep, asperity\n"
            "from concurrent.futures import ProcessPoolExecutor\n"
            "from multiprocessing import get_context\n"
            "with ProcessPoolExecutor(1, mp_context=get_context('forkserver')) as pool:\n"
            "    asperity.sweep(sweep.SCENE, sweep.over(int(sys.argv[2])), executor=pool,\n"
            "        store=sys.argv[3]).close()\n"
            "print(resource.getrusage(resource.RUSAGE_SELF).ru_maxrss)\n"
        )
        with tempfile.TemporaryDirectory() as folder:
            run = [sys.executable, "-c", code, str(Path(__file__).parent), str(count)]
            out = subprocess.run([*run, f"{folder}/r.zarr"], check=True, stdout=subprocess.PIPE)
            size = sum(file.stat().st_size for file in Path(folder).rglob("*") if file.is_file())
        print(f"{count} points: {int(out.stdout) / 1024:.0f} MB, store of {size / 1e6:.0f} MB")


def _hide_store() -> None:
    work._sees = lambda _: False


def model(points: int) -> None:
    """Seconds of many workers: their processors in parallel, and the driver's one task by one."""
    loop = plain(points) / points
    tasks, per_task, sent = 200, {}, 0.0
    with local_cluster(1) as client:
        for seen in (True, False):
            if not seen:
                client.run(_hide_store)
            for size in (1, 100):  # points of a task: what it costs, and what its numbers do
                axes = {
                    "conditions.velocity_m_s": np.geomspace(1e-5, 1, tasks),
                    "conditions.pressure_pa": np.geomspace(5e4, 5e5, size * size),
                }
                run.cut_of = lambda *_, size=size: (1, size * size)
                with tempfile.TemporaryDirectory() as folder:
                    own = time.process_time()
                    asperity.sweep(SCENE, axes, executor=client, store=f"{folder}/r.zarr").close()
                    per_task[seen, size] = (time.process_time() - own) / tasks
    sent = (per_task[False, 100] - per_task[False, 1]) / 1e4
    print(
        f"a point {loop * 1e6:.2f} us of a worker, {sent * 1e6:.3f} us of the driver if it is sent"
    )
    for seen in (True, False):
        task = per_task[seen, 1]
        print(f"workers see the store: {seen}; a task takes {task * 1e3:.1f} ms of the driver")
        for count in (1, 10, 100):
            driver = task * 1e9 / plan.MOST_POINTS + (0 if seen else sent * 1e9)
            print(f"  1e9 points, {count} workers: {max(loop * 1e9 / count, driver):.0f} s")


if __name__ == "__main__":
    what = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    what.add_argument("what", choices=("overhead", "measured", "workers", "memory", "model"))
    what.add_argument("--points", type=float, default=1e7)
    given = what.parse_args()
    globals()[given.what](int(given.points))
    peak = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024
    print(f"peak memory {peak:.0f} MB, {os.cpu_count()} processors")
