"""What threads gain: 10,000 velocities, a map and a band on one and two threads, and 16 by Amdahl.

    python tests/benchmarks/threads.py

Two threads against one by turns in one process, medians of 9; beside them two calls of one thread
each at the same time, which is all that the machine can gain: two of its cores may be one. With a
serial share s of the time of one thread, n threads gain 1 / (s + (1 - s) / n) of that: the gain of
two over the machine's tells s, 0 at least, and the last column is what follows for 16 cores that
share nothing. Results are bit-equal (`test_threads.py`).
"""

import time
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from functools import partial
from typing import Any

import numpy as np
from rings import RUBBER, rings

import asperity

RUNS = 9
VELOCITY = np.geomspace(1e-6, 10, 10_000)
CLOSED = asperity.SelfAffineSpectrum(rms_height=265.7e-6, hurst=0.87, q0=2000, q1=2.4e4)
MEASURED = rings(392, 8)
FREQUENCY = np.geomspace(1e-4, 1e8, 140)
CURVE = asperity.MasterCurve(
    angular_frequency=FREQUENCY,
    storage_modulus=RUBBER.modulus(FREQUENCY).real,
    loss_modulus=RUBBER.modulus(FREQUENCY).imag,
)
NOISY = asperity.TabulatedSpectrum(
    wavenumber=MEASURED.wavenumber,
    density=MEASURED.density,
    standard_error=0.1 * MEASURED.density,
)
BOX = {"pressure": (5e4, 5e5), "velocity": (1e-4, 1.0)}


def curve(surface: Any, rubber: Any, velocity: Any, threads: int) -> Any:
    return asperity.friction(
        surface, rubber, pressure=81e3, velocity=velocity, threads=threads, contributions=False
    )


def grid(threads: int) -> Any:
    return asperity.friction(
        CLOSED,
        RUBBER,
        pressure=np.geomspace(1e4, 1e6, 300)[:, None],
        velocity=VELOCITY[::33],
        threads=threads,
    )


CASES: dict[str, Callable[[int], Any]] = {
    "10,000 velocities, self-affine, 20 terms": partial(curve, CLOSED, RUBBER, VELOCITY),
    "300 pressures x 304 velocities, the same": grid,
    "10,000 velocities, 392 rings, 20 terms": partial(curve, MEASURED, RUBBER, VELOCITY),
    "1,000 velocities, 392 rings, 140 rows of a master curve": partial(
        curve, MEASURED, CURVE, np.geomspace(1e-4, 1, 1000)
    ),
    "a map, 392 rings, 100,000 points checked": lambda threads: asperity.friction_map(
        MEASURED, RUBBER, checked=100_000, threads=threads, **BOX
    ),
    "a band of 100 draws, 60 velocities": lambda threads: asperity.friction_band(
        NOISY, RUBBER, pressure=81e3, velocity=VELOCITY[::167], threads=threads
    ),
}


def wall(work: Callable[[Any], Any], argument: Any) -> float:
    """Seconds by the clock on the wall: that is what threads are for."""
    start = time.perf_counter()
    work(argument)
    return time.perf_counter() - start


def side_by_side(work: Callable[[int], Any]) -> None:
    with ThreadPoolExecutor(2) as pool:
        list(pool.map(work, (1, 1)))


def main() -> None:
    print("| work | one thread [ms] | two gain | the machine | serial share | 16 gain |")
    print("| --- | --- | --- | --- | --- | --- |")
    for name, work in CASES.items():
        work(2)
        runs = [(wall(work, 1), wall(work, 2), wall(side_by_side, work)) for _ in range(RUNS)]
        one, two, both = np.array(runs).T
        gain, machine = float(np.median(one / two)), float(np.median(2 * one / both))
        serial = max(0.0, 2 * min(1.0, machine / 2) / gain - 1)
        sixteen = 1 / (serial + (1 - serial) / 16)
        gains = f"{gain:.2f} | {machine:.2f} | {100 * serial:.0f} % | {sixteen:.1f}"
        shown = f"{1e3 * np.median(one):.3g} | {gains}"
        print(f"| {name} | {shown} |", flush=True)


if __name__ == "__main__":
    main()
