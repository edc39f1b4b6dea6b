"""What two threads gain: two calls at the same time, and one call that is told to share its points.

    python tests/benchmarks/threads.py [--output DIR]

A call alone, two of them at the same time in threads of Python, and one with threads=2, by turns,
the median of the ratios. PBKDF2 of Python's hashlib, which neither shares nor allocates memory,
tells how much the machine itself has for two threads. Turns during which other processes had more
than a tenth of a core are left out (Linux). Of the gain of threads=2 over that of two calls, which
is all that the machine has for this work, follows a serial share s and by Amdahl the gain of 16
cores, 1 / (s + (1 - s) / 16). With ASPERITY_DATA opd-1 with epdm_70 is among the work. All results
are bit-equal (tests/python/friction/test_threads.py).
"""

import hashlib
import os
import statistics
import sys
import time
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from functools import partial
from pathlib import Path
from typing import Any

import measured
import numpy as np
import timing
from curves import Curve, curves
from rings import rings, rubber

import asperity

TURNS = 15
PATIENCE = 600  # turns, to find as many that nobody disturbed
QUIET = 0.1  # cores
BATCH, CURVE = 60_000, 60  # velocities
BOX = {"pressure": (5e4, 5e5), "rtol": 1e-3, "checked": 100_000}
Work = Callable[[int], object]  # of a number of threads


def batch(curve: Curve, points: int, threads: int) -> object:
    """BATCH velocities, `points` of them a call."""
    velocity = np.geomspace(curve.velocity[0], curve.velocity[-1], points)
    call = partial(
        asperity.friction,
        curve.road,
        curve.rubber,
        pressure=curve.inputs["pressure"],
        velocity=velocity,
        correction=curve.correction,
        threads=threads,
    )
    return [call() for _ in range(BATCH // points)]


def sweep(
    surface: Any, rubber: Any, ends: tuple[float, float], points: int, threads: int
) -> object:
    velocity = np.geomspace(*ends, points)
    return asperity.friction(surface, rubber, pressure=1e5, velocity=velocity, threads=threads)


def mapped(surface: Any, rubber: Any, ends: tuple[float, float], threads: int) -> object:
    return asperity.friction_map(surface, rubber, velocity=ends, threads=threads, **BOX)


def band(surface: Any, rubber: Any, ends: tuple[float, float], threads: int) -> object:
    velocity = np.geomspace(*ends, 60)
    return asperity.friction_band(surface, rubber, pressure=1e5, velocity=velocity, threads=threads)


def work() -> dict[str, Work]:
    known = curves()
    scenes = {"20 Prony terms": known["Table 1"], "modulus of 23 rows": known["tabulated modulus"]}
    calls: dict[str, Work] = {
        f"{name}, {points} velocities a call": partial(batch, curve, points)
        for name, curve in scenes.items()
        for points in (BATCH, CURVE)
    }
    calls["392 rings, 20 terms, 10,000 velocities"] = partial(
        sweep, rings(392, 8), rubber(), (1e-6, 10), 10_000
    )
    if measured.folder() is not None:
        scan, build = measured.spectra()["opd-1.opd"], measured.rubbers()["epdm_70"]
        curve, fitted = build.master_curve, asperity.fit_prony(build)
        ends = measured.velocities(scan, curve)
        name = "opd-1 with epdm_70"
        calls[f"{name}, its Prony series, 10,000 velocities"] = partial(
            sweep, scan, fitted, ends, 10_000
        )
        calls[f"{name}, its master curve, 1,000 velocities"] = partial(
            sweep, scan, curve, ends, 1000
        )
        calls[f"{name}, its Prony series, a map"] = partial(mapped, scan, fitted, ends)
        calls[f"{name}, a band of 100 draws, 60 velocities"] = partial(band, scan, build, ends)
    return calls


def hashed(_: int) -> object:
    return hashlib.pbkdf2_hmac("sha256", b"word", b"salt", 200_000)


def wall_seconds(call: timing.Call) -> float:
    """By the clock on the wall: two threads spend the processor's time twice."""
    start = time.perf_counter()
    call()
    return time.perf_counter() - start


def turn(pool: ThreadPoolExecutor, of: Work) -> tuple[float, float, float]:
    """Seconds of a call alone, of two at the same time, and of one that shares its points."""

    def together() -> None:
        for future in [pool.submit(of, 1), pool.submit(of, 1)]:
            future.result()

    return wall_seconds(partial(of, 1)), wall_seconds(together), wall_seconds(partial(of, 2))


def others() -> float:
    """Seconds of processor time that other processes have had; 0 where nobody counts them."""
    try:
        ticks = [int(n) for n in Path("/proc/stat").read_text().split("\n", 1)[0].split()[1:9]]
    except OSError:
        return 0.0
    all_of_them = (sum(ticks) - ticks[3] - ticks[4]) / os.sysconf("SC_CLK_TCK")  # not the idle
    return all_of_them - sum(os.times()[:2])


def undisturbed(pool: ThreadPoolExecutor, of: Work) -> list[tuple[float, float, float]]:
    turn(pool, of)  # both threads are there, memory is warm
    found: list[tuple[float, float, float]] = []
    for _ in range(PATIENCE):
        before = others()
        times = turn(pool, of)
        if others() - before < QUIET * sum(times):
            found.append(times)
        if len(found) == TURNS:
            return found
    sys.exit(f"only {len(found)} of {PATIENCE} turns were undisturbed: the machine is busy")


def make() -> timing.Report:
    names, rows = [*work(), "the machine (PBKDF2)"], []
    with ThreadPoolExecutor(2) as pool:
        for of in [*work().values(), hashed]:
            times = undisturbed(pool, of)
            one = statistics.median(alone for alone, _, _ in times)
            calls = statistics.median(2 * alone / both for alone, both, _ in times)
            shared = statistics.median(alone / two for alone, _, two in times)
            rows.append((one, calls, shared))
    one, calls, shared = zip(*rows, strict=True)
    text = timing.markdown(
        ["work", "alone [ms]", "two calls gain", "threads=2 gains", "serial", "16 by Amdahl"],
        [
            [name, timing.number(1e3 * row[0]), f"{row[1]:.2f}", *shares(name, row[1], row[2])]
            for name, row in zip(names, rows, strict=True)
        ],
    )
    columns = {"work": names, "alone_s": one, "two_calls": calls, "threads_2": shared}
    files = {"threads.csv": timing.table("benchmark threads", columns)}
    return timing.Report(f"Two threads of one process:\n\n{text}", files)


def shares(name: str, calls: float, shared: float) -> list[str]:
    """The last three columns; calls of 60 velocities stay on one thread, and a hash does."""
    if name.endswith(f" {CURVE} velocities a call") or "PBKDF2" in name:
        return ["-", "-", "-"]
    serial = max(0.0, calls / shared - 1)
    return [f"{shared:.2f}", f"{100 * serial:.0f} %", f"{1 / (serial + (1 - serial) / 16):.1f}"]


if __name__ == "__main__":
    timing.run(make, __doc__)
