"""What a sweep adds to the plain loop, what workers gain, and the memory of the driver.

    python tests/benchmarks/sweep.py overhead          processor time over that of the plain loop
    python tests/benchmarks/sweep.py workers           one and two Dask workers: wall and processor
    python tests/benchmarks/sweep.py memory            peak memory of the driver over the points

Points are pressures times velocities of three treads on a self-affine road. Wall times say
something on an idle machine alone; processor times do on a busy one too.
"""

import argparse
import os
import resource
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import numpy as np

import asperity
from asperity.sweep import plan
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
            result = asperity.friction(road, tread, pressure=p[i : i + step, None], velocity=v)
            for name, array in kept.items():
                array[k, i : i + step] = getattr(result, name)
    return time.process_time() - began


def overhead(points: int) -> None:
    """Processor time over that of the plain loop, the median of three in turns."""
    asperity.sweep(SCENE, over(30_000))  # what is imported is imported now
    for name in ("memory", "results.zarr"):
        result = []
        for _ in range(3):
            with tempfile.TemporaryDirectory() as folder:
                store = None if name == "memory" else Path(folder) / name
                loop = plain(points)
                began = time.process_time()
                asperity.sweep(SCENE, over(points), store=store).close()
                result.append((time.process_time() - began) / loop)
        print(
            f"{points} points into {name}: {sorted(result)[1]:.3f} of the plain loop's {loop:.2f} s"
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


if __name__ == "__main__":
    what = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    what.add_argument("what", choices=("overhead", "workers", "memory"))
    what.add_argument("--points", type=float, default=1e7)
    given = what.parse_args()
    globals()[given.what](int(given.points))
    peak = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024
    print(f"peak memory {peak:.0f} MB, {os.cpu_count()} processors")
