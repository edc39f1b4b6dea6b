"""Look-ups of a friction map, over the logarithms and the exponential that they cannot do without.

    python tests/benchmarks/friction_map.py [--output DIR]

The yardstick of a query in C++ is two logarithms and one exponential of the C library in the same
loop, that of an array from Python `np.log`, `np.log`, `np.exp` of arrays as long. Beside them
SciPy's RegularGridInterpolator of ln mu on a regular grid with no fewer nodes than the map's cells
have corners. All in one process by turns, medians; errors are the largest on 20,000 random points.

Then what builds take, and their check of a million points, on measured inputs too where
ASPERITY_DATA names their folder.
"""

import tempfile
import time
from pathlib import Path
from typing import Any

import compiled
import measured
import numpy as np
import timing
from scipy.interpolate import RegularGridInterpolator

import asperity

HOST = ("-std=c++17", "-O2")  # as hosts compile, nothing linked
BOX = {"pressure": (1e4, 1e6), "velocity": (1e-6, 10.0)}
ROAD = asperity.SelfAffineSpectrum(rms_height=265.7e-6, hurst=0.87, q0=2e3, q1=2e4)
RUBBER = asperity.PronySeries(
    equilibrium_modulus=3e6, moduli=np.full(20, 3e7), relaxation_times=np.geomspace(1e-12, 1, 20)
)
ADHESION = asperity.Adhesion(shear_stress=8.3e6)
COUNT = 1 << 14
RUNS = 41


class Scene:
    """Table 1's asphalt to its slope cut-off, a rubber of 20 terms, with or without adhesion."""

    def __init__(self, adhesion: asperity.Adhesion | None) -> None:
        self.parts = (ROAD, RUBBER)
        self.adhesion = adhesion
        start = time.perf_counter()
        self.map = asperity.friction_map(*self.parts, **BOX, adhesion=adhesion, checked=0)
        self.seconds = time.perf_counter() - start

    def mu(self, pressure: Any, velocity: Any) -> Any:
        options = {"adhesion": self.adhesion, "rtol": 1e-9}
        return asperity.friction(*self.parts, pressure=pressure, velocity=velocity, **options).mu

    def interpolator(self, method: str) -> tuple[int, Any]:
        """SciPy's, of ln mu on a regular grid of about as many nodes as the map has cells."""
        wide, high = (np.log(hi / lo) for lo, hi in (BOX["velocity"], BOX["pressure"]))
        columns = max(4, round(np.sqrt(self.map.cells * wide / high)))
        rows = max(4, round(self.map.cells / columns))
        v, p = np.geomspace(*BOX["velocity"], columns), np.geomspace(*BOX["pressure"], rows)
        values = np.log(self.mu(p[:, None], v))
        axes = np.log(p), np.log(v)
        inside = {"bounds_error": False, "fill_value": None}  # ends are rounded
        return rows * columns, RegularGridInterpolator(axes, values, method=method, **inside)


def builds() -> timing.Report:
    """Seconds of one thread for maps at 1e-4, and at 1e-8 over 18 decades of velocity."""
    wide = {"pressure": BOX["pressure"], "velocity": (1e-12, 1e6), "rtol": 1e-8}
    scenes: dict[str, tuple[Any, Any, dict[str, Any]]] = {
        "closed form, 20 terms": (ROAD, RUBBER, BOX),
        "the same at 1e-8, 18 decades of velocity": (ROAD, RUBBER, wide),
    }
    if measured.folder() is not None:
        scan = measured.spectra()["opd-1.opd"]
        curve = measured.rubbers()["epdm_70"].master_curve
        box = {"pressure": BOX["pressure"], "velocity": measured.velocities(scan, curve)}
        fit = asperity.fit_prony(curve)
        name = f"opd-1, {scan.wavenumber.size} rings, epdm_70"
        scenes |= {f"{name}, fitted": (scan, fit, box), f"{name}, measured": (scan, curve, box)}

    def build(name: str, checked: int) -> Any:
        *parts, options = scenes[name]
        return asperity.friction_map(*parts, **options, checked=checked, threads=1)

    quick = {name: lambda name=name: build(name, 0) for name in scenes}
    times = timing.by_turns(quick, 5, 1.0)
    plain = times["closed form, 20 terms"]
    rows = []
    for name in scenes:
        spent = timing.median(times[name])
        whole, made = timing.timed(lambda name=name: build(name, 1_000_000))
        over = 1 / timing.ratio(plain, times[name])
        rows.append((name, made.cells, spent, over, whole, made.exceeded))
    columns = ("scene", "cells", "build_s", "ratio", "checked_s", "exceeded")
    text = timing.markdown(
        ["map", "cells", "build [ms]", "over the closed form", "with a million checked [s]"],
        [
            [name, f"{cells}", f"{1e3 * spent:.3g}", f"{over:.2g}", f"{whole:.2g}"]
            for name, cells, spent, over, whole, _ in rows
        ],
    )
    table = timing.table(
        "benchmark friction_map", dict(zip(columns, zip(*rows, strict=True), strict=True))
    )
    return timing.Report(text, {"friction_map_build.csv": table})


def points(count: int) -> tuple[Any, Any]:
    draws = np.random.default_rng(20261121)
    sides = BOX["pressure"], BOX["velocity"]
    drawn = [np.exp(draws.uniform(*np.log(side), count)).clip(*side) for side in sides]
    return drawn[0], drawn[1]


def look_ups() -> timing.Report:
    timed = compiled.module("friction_map", *HOST)
    rows: list[tuple[str, float, float, float, float]] = []
    p, v = points(COUNT)

    def add(what: str, times: list[float], yardstick: list[float], error: float) -> None:
        ratio = 1 / timing.ratio(yardstick, times)
        rows.append((what, timing.median(times), timing.median(yardstick), ratio, error))

    def scipy_mu(grid: Any) -> Any:
        return np.exp(grid(np.column_stack([np.log(p), np.log(v)])))

    for name, adhesion in (("hysteresis", None), ("hysteresis and adhesion", ADHESION)):
        scene = Scene(adhesion)
        exact = scene.mu(p, v)
        error = float(np.abs(scene.map.mu(p, v) / exact - 1).max())
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / "bench.fmap"
            scene.map.save(path)
            mu, many, whole, yardstick = timed.queries(str(path), p.tolist(), v.tolist(), RUNS)
        add(f"C++, mu: {name}", mu, yardstick, error)
        add(f"C++, mu, one call for all points: {name}", many, yardstick, error)
        add(f"C++, all with derivatives: {name}", whole, yardstick, error)
        for count in (1000, COUNT, 1 << 20):
            few = points(count)
            calls = {
                "map": lambda few=few, made=scene.map: made.mu(*few),
                "numpy": lambda few=few: (np.log(few[0]), np.log(few[1]), np.exp(few[1])),
            }
            often = {k: timing.Repeated(call) for k, call in calls.items()}
            times = timing.by_turns(often, RUNS)
            scaled = {k: [1e9 * t / often[k].many / count for t in times[k]] for k in times}
            add(f"Python, {count} points: {name}", scaled["map"], scaled["numpy"], error)
        for other in ("hysteresis", "contact_area", "derivatives"):
            calls = {
                other: lambda made=scene.map, other=other: getattr(made, other)(p, v),
                "numpy": lambda: (np.log(p), np.log(v), np.exp(v)),
            }
            often = {k: timing.Repeated(call) for k, call in calls.items()}
            times = timing.by_turns(often, RUNS)
            scaled = {k: [1e9 * t / often[k].many / COUNT for t in times[k]] for k in times}
            add(f"Python, {COUNT} points, {other}: {name}", scaled[other], scaled["numpy"], error)
        for method in ("linear", "cubic"):
            nodes, grid = scene.interpolator(method)
            off = float(np.abs(scipy_mu(grid) / exact - 1).max())
            times = timing.by_turns({"grid": lambda grid=grid: scipy_mu(grid)}, 5, 5.0)
            spent = [1e9 * t / COUNT for t in times["grid"]]
            add(
                f"SciPy, {method}, {nodes} nodes: {name}", spent, scaled["numpy"][: len(spent)], off
            )
        text = f"{scene.map.cells} cells, {1e3 * scene.seconds:.0f} ms to build: {name}"
        print(text)
    columns = ("look_up", "time_ns", "yardstick_ns", "ratio", "error")
    text = timing.markdown(
        ["a point of", "time [ns]", "two ln and an exp [ns]", "ratio", "worst error"],
        [
            [what, f"{spent:.3g}", f"{yard:.3g}", f"{ratio:.2g}", f"{error:.1e}"]
            for what, spent, yard, ratio, error in rows
        ],
    )
    table = timing.table(
        "benchmark friction_map", dict(zip(columns, zip(*rows, strict=True), strict=True))
    )
    return timing.Report(f"{timing.machine()}, one thread:\n\n{text}", {"friction_map.csv": table})


def make() -> timing.Report:
    first, second = look_ups(), builds()
    return timing.Report(f"{first.text}\n{second.text}", {**first.files, **second.files})


if __name__ == "__main__":
    timing.run(make, __doc__)
