"""Friction in two threads of one Python process, over the same work in one.

    python tests/benchmarks/threads.py [--output DIR]

Table 1's surface and conditions at rtol 1e-6, in batches of 20 000 velocities and in calls of 60 of
them, of a Prony series of 20 terms and of a modulus of 23 rows; and what the machine itself has for
two threads: PBKDF2 of Python's hashlib, which neither shares nor allocates memory. One thread and
two by turns in pairs, the median of the pairs' ratios; twice one after the other is the work. Pairs
during which other processes had more than a tenth of a core are left out (Linux).
"""

import hashlib
import os
import statistics
import sys
import time
from collections.abc import Mapping
from concurrent.futures import ThreadPoolExecutor
from functools import partial
from pathlib import Path

import numpy as np
import timing
from curves import Curve, curves

import asperity

PAIRS = 15
PATIENCE = 600  # pairs, to find as many that nobody disturbed
QUIET = 0.1  # cores
BATCH, CURVE = 60_000, 60  # velocities


def batch(curve: Curve, points: int) -> object:
    """BATCH velocities, `points` of them a call."""
    velocity = np.geomspace(curve.velocity[0], curve.velocity[-1], points)
    call = partial(
        asperity.friction,
        curve.road,
        curve.rubber,
        pressure=curve.inputs["pressure"],
        velocity=velocity,
        correction=curve.correction,
    )
    return [call() for _ in range(BATCH // points)]


def work() -> Mapping[str, timing.Call]:
    known = curves()
    scenes = {"20 Prony terms": known["Table 1"], "modulus of 23 rows": known["tabulated modulus"]}
    calls: dict[str, timing.Call] = {
        f"{name}, {points} velocities a call": partial(batch, curve, points)
        for name, curve in scenes.items()
        for points in (BATCH, CURVE)
    }
    hashed = partial(hashlib.pbkdf2_hmac, "sha256", b"word", b"salt", 200_000)
    return {**calls, "the machine (PBKDF2)": hashed}


def wall_seconds(call: timing.Call) -> float:
    """By the clock on the wall: two threads spend the processor's time twice."""
    start = time.perf_counter()
    call()
    return time.perf_counter() - start


def once_and_together(pool: ThreadPoolExecutor, call: timing.Call) -> tuple[float, float]:
    """Seconds of two calls one after the other, and of two in threads."""

    def alone() -> None:
        call()
        call()

    def together() -> None:
        for future in [pool.submit(call), pool.submit(call)]:
            future.result()

    return wall_seconds(alone), wall_seconds(together)


def others() -> float:
    """Seconds of processor time that other processes have had; 0 where nobody counts them."""
    try:
        ticks = [int(n) for n in Path("/proc/stat").read_text().split("\n", 1)[0].split()[1:9]]
    except OSError:
        return 0.0
    all_of_them = (sum(ticks) - ticks[3] - ticks[4]) / os.sysconf("SC_CLK_TCK")  # not the idle
    return all_of_them - sum(os.times()[:2])


def undisturbed(pool: ThreadPoolExecutor, call: timing.Call) -> list[tuple[float, float]]:
    once_and_together(pool, call)  # both threads are there, memory is warm
    found: list[tuple[float, float]] = []
    for _ in range(PATIENCE):
        before = others()
        pair = once_and_together(pool, call)
        if others() - before < QUIET * sum(pair):
            found.append(pair)
        if len(found) == PAIRS:
            return found
    sys.exit(f"only {len(found)} of {PATIENCE} pairs were undisturbed: the machine is busy")


def make() -> timing.Report:
    rows: list[tuple[str, float, float, float]] = []
    with ThreadPoolExecutor(2) as pool:
        for name, call in work().items():
            pairs = undisturbed(pool, call)
            one, two = (statistics.median(times) for times in zip(*pairs, strict=True))
            rows.append((name, one, two, statistics.median(a / b for a, b in pairs)))
    columns = dict(
        zip(
            ("work", "one_thread_s", "two_threads_s", "ratio"), zip(*rows, strict=True), strict=True
        )
    )
    text = timing.markdown(
        ["work, twice", "one thread [ms]", "two [ms]", "ratio"],
        [
            [name, timing.number(1e3 * one), timing.number(1e3 * two), f"{ratio:.2f}"]
            for name, one, two, ratio in rows
        ],
    )
    files = {"threads.csv": timing.table("benchmark threads", columns)}
    return timing.Report(f"Two threads of one process:\n\n{text}", files)


if __name__ == "__main__":
    timing.run(make, __doc__)
