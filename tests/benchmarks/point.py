"""One point from Python, over the C++ call and an empty call with as many arguments; and a grid.

The C++ call is timed by C++ (point.cpp), linked to the library of the `release` preset, which is
built where that is missing or old: some minutes the first time. ASPERITY_LIBRARY names another one,
a libasperity.a of this very source. The grid is 1000 pressures times 1000 velocities at rtol 1e-6,
from Python, over that C++ call for one of its points: what it would take point by point.
"""

import os
import subprocess
from functools import partial
from pathlib import Path

import compiled
import numpy as np
import timing
from curves import curves

import asperity

VELOCITY = 1e-2
RTOLS = (1e-3, 1e-6, 1e-9)
SIDE = 1000  # of the grid
CALLS = ("cpp", "python", "empty")


def library() -> Path:
    """libasperity.a of this source."""
    if given := os.environ.get("ASPERITY_LIBRARY"):
        return Path(given)
    for step in (
        ["--preset", "release"],
        ["--build", "--preset", "release", "--target", "asperity"],
    ):
        subprocess.run(["cmake", *step], cwd=compiled.ROOT, check=True, stdout=subprocess.DEVNULL)
    return compiled.ROOT / "build/release/cpp/libasperity.a"


def measure() -> dict[float, dict[str, float]]:
    """Seconds by rtol and by CALLS."""
    timed = compiled.module("point", "-std=c++20", "-O3", libraries=(library(),))
    curve = curves()["Table 1"]
    inputs, result = curve.inputs, {}
    names = ("rms_height", "hurst", "q0", "q1", "equilibrium_modulus", "moduli", "relaxation_times")
    for rtol in RTOLS:
        options = {"velocity": VELOCITY, "correction": curve.correction, "rtol": rtol}
        call = partial(
            asperity.friction, curve.road, curve.rubber, pressure=inputs["pressure"], **options
        )
        empty = partial(
            timed.empty, curve.road, curve.rubber, pressure=inputs["pressure"], **options
        )
        scene = [inputs[name] for name in (*names, "pressure")]
        by_cpp = timed.seconds(*scene, VELOCITY, inputs["gamma"], rtol, 15, 200)
        times = (timing.median(by_cpp), timing.typical(call, 15), timing.typical(empty, 15))
        result[rtol] = dict(zip(CALLS, times, strict=True))
    return result


def grid(side: int) -> float:
    """Seconds of a (v, p) grid from Python."""
    curve = curves()["Table 1"]
    conditions = {
        "pressure": np.geomspace(1e4, 1e6, side),
        "velocity": np.geomspace(1e-6, 10, side)[:, None],
        "correction": curve.correction,
    }
    call = partial(asperity.friction, curve.road, curve.rubber, **conditions)
    return timing.median([timing.seconds(call) for _ in range(3)])


def make() -> dict[str, bytes]:
    """The table as a file."""
    quantities = {
        f"{name}, rtol {rtol:.0e}": seconds
        for rtol, times in measure().items()
        for name, seconds in times.items()
    }
    quantities[f"grid {SIDE} x {SIDE}"] = grid(SIDE)
    columns = {"quantity": list(quantities), "time_s": list(quantities.values())}
    return {"point.csv": timing.table("benchmark point", columns)}
