"""Look-ups of friction maps with heat, over those of the map without heat beside them.

    python tests/benchmarks/hot_map.py [--output DIR]

Singly, by one call for all points and of arrays in Python, with one temperature of the background
and with several, long after sliding began and after a distance. In one process by turns, medians of
processor time.
"""

import tempfile
import time
from pathlib import Path
from typing import Any

import compiled
import numpy as np
import timing

import asperity
import friction_map

BOX = {"pressure": (1e4, 1e6), "velocity": (1e-3, 10.0)}
RANGE = (273.15, 313.15)
SHARED = 293.15
DISTANCE = 1e-4
KINDS = {
    "hot": "long ago",
    "distance": "after a distance",
    "hot, various": "long ago, T0 of its own",
    "distance, various": "after a distance, T0 of its own",
}

CALLS = {
    "one look-up": "",
    "one call for all points": "all ",
    "arrays in Python": "arrays ",
}


def scene() -> dict[str, Any]:
    return {
        "spectrum": friction_map.ROAD,
        "rubber": friction_map.RUBBER,
        **BOX,
        "adhesion": friction_map.ADHESION,
        "shift": asperity.WLF(c1=8.86, c2=101.6, reference_temperature=293.15),
        "heating": asperity.Heating(
            density=1200, heat_capacity=1650, conductivity=0.23, contact_diameter=1e-3
        ),
    }


def arrays(
    made: asperity.FrictionMap, p: list[float], v: list[float], own: list[float]
) -> dict[str, list[float]]:
    """Return the nanoseconds a point of calls that take arrays, by turns."""
    points = {"pressure": np.array(p), "velocity": np.array(v)}
    hot = {"hot": {"temperature": SHARED}}
    if own:
        hot["hot, various"] = {"temperature": np.array(own)}
    after = {
        key.replace("hot", "distance"): asked | {"distance": DISTANCE} for key, asked in hot.items()
    }
    found: dict[str, list[float]] = {}
    for _ in range(friction_map.RUNS):
        for key, asked in ({"cold": {}} | hot | after).items():
            queried = made.cold if key == "cold" else made
            queried.mu(**points, **asked)  # the one before it left other cells in the cache
            start = time.process_time_ns()
            queried.mu(**points, **asked)
            found.setdefault(key, []).append((time.process_time_ns() - start) / len(p))
    return {f"arrays {key}": times for key, times in found.items()}


def make() -> timing.Report:
    timed = compiled.module("hot_map", *friction_map.HOST)
    draws = np.random.default_rng(20261123)
    drawn = (np.exp(draws.uniform(*np.log(side), friction_map.COUNT)) for side in BOX.values())
    p, v = (column.clip(*side).tolist() for column, side in zip(drawn, BOX.values(), strict=True))
    various = draws.uniform(*RANGE, friction_map.COUNT).tolist()
    rows: list[tuple[str, float, float, float]] = []
    for name, temperature, own in (("one T0", SHARED, []), ("a range of T0", RANGE, various)):
        made = asperity.friction_map(**scene(), temperature=temperature, rtol=1e-3, checked=0)
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / "bench.fmap"
            made.save(path)
            found = timed.queries(str(path), p, v, own, SHARED, DISTANCE, friction_map.RUNS)
        found |= arrays(made, p, v, own)
        for call, before in CALLS.items():
            cold = found[f"{before}cold"]
            for key, kind in KINDS.items():
                times = found.get(f"{before}{key}")
                if times is not None:
                    ratio = 1 / timing.ratio(cold, times)
                    what = f"{name}, {call}, {kind}"
                    rows.append((what, timing.median(times), timing.median(cold), ratio))
    columns = ("look_up", "time_ns", "cold_ns", "ratio")
    text = timing.markdown(
        ["a point of", "time [ns]", "without heat [ns]", "ratio"],
        [
            [what, timing.number(spent), timing.number(cold), f"{ratio:.2f}"]
            for what, spent, cold, ratio in rows
        ],
    )
    table = timing.table(
        "benchmark hot_map", dict(zip(columns, zip(*rows, strict=True), strict=True))
    )
    return timing.Report(
        f"{timing.machine()}, one thread:\n\n{text}", {"friction_map_hot.csv": table}
    )


if __name__ == "__main__":
    timing.run(make, __doc__)
