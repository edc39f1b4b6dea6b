"""A hysteresis curve of 60 velocities: time and error of ours and of other methods, in one process.

Table 1's surface (H 0.87, h_rms 265.7 um, q0 2000, q1 1e6), a Prony series of 20 terms, S factor
0.5 on the friction, 81 kPa, 1e-6 to 10 m/s; one thread; methods by turns, medians. Errors are the
worst of the curve, against tests/reference/friction_curves.csv. Yardsticks are three forms of the
graded-panel method in NumPy, vectorised over the velocities: with 28 Gauss-Legendre panels of 16
nodes for each velocity, which grow from its front by factors of 4 and are 0.35 long at most, in
whole arrays as most would write it; the same in blocks that stay in the cache, into memory that is
kept; and that with 11 panels of 14, which one finds who knows the truth of this curve. Below, the
same surface with a modulus of 23 rows instead of the 20 terms. pip install scipy.
"""

import warnings
from dataclasses import replace
from functools import partial

import timing
from curves import Curve, curves
from moduli import PlainProny
from schemes import graded_panels, log_trapezoid, nested_quad

import asperity

YARDSTICKS = {
    "plain": "graded panels, 448 nodes, NumPy",
    "blocked": "graded panels, 448 nodes, NumPy in blocks",
    "tuned": "graded panels, 154 nodes, NumPy in blocks",
}
TERMS = ("equilibrium_modulus", "moduli", "relaxation_times")
EVERY = 20  # of the velocities, for the nested quad
RUNS = 21


def methods(curve: Curve) -> dict[str, timing.Call]:
    calls: dict[str, timing.Call] = {
        f"ours, rtol {rtol:.0e}": partial(curve.ours, rtol) for rtol in (1e-3, 1e-6, 1e-9)
    }
    plain = replace(curve, modulus=PlainProny(*(curve.inputs[name] for name in TERMS)))
    panels = {"nodes": 16, "growth": 4, "longest": 0.35}
    calls[YARDSTICKS["plain"]] = partial(graded_panels, plain, **panels)
    calls[YARDSTICKS["blocked"]] = partial(graded_panels, curve, **panels)
    calls[YARDSTICKS["tuned"]] = partial(graded_panels, curve, nodes=14, growth=9, longest=3)
    for points in (100, 1000, 10000):
        calls[f"log-trapezoid, {points} points"] = partial(log_trapezoid, curve, points)
    for name in ("qag", "qags", "cquad"):
        calls[f"GSL {name.upper()}, rtol 1e-06"] = partial(curve.ours, 1e-6, name)
    return calls


def curve_table() -> dict[str, list[object]]:
    """Columns of the table of 60 velocities."""
    curve = curves()["Table 1"]
    calls = methods(curve)
    times = timing.by_turns(calls, RUNS)
    errors = {name: curve.error(call()) for name, call in calls.items()}
    few = curve.of_velocities(slice(EVERY // 2, None, EVERY))
    with warnings.catch_warnings(action="ignore"):  # scipy knows that it does not converge
        elapsed, result = timing.timed(partial(nested_quad, few, 1e-6))
    name = f"nested quad, scaled from {few.truth.size} velocities"
    times[name], errors[name] = [EVERY * elapsed], few.error(result)
    columns: dict[str, list[object]] = {
        "method": list(times),
        "time_s": [timing.median(result) for result in times.values()],
        "error": list(errors.values()),
    }
    for key, yardstick in YARDSTICKS.items():
        columns[f"{key}_ratio"] = [
            timing.ratio(times[yardstick], result) for result in times.values()
        ]
    return columns


def tabulated() -> dict[str, float]:
    """A curve by 23 rows over the same by 20 terms, at 1e-9, and what is done once before."""
    by_terms, by_rows = (curves()[name].thinned() for name in ("Table 1", "tabulated modulus"))
    calls = {"terms": partial(by_terms.ours, 1e-9), "rows": partial(by_rows.ours, 1e-9)}
    times = timing.by_turns(calls, RUNS)
    names = ("angular_frequency", "storage_modulus", "loss_modulus")
    table = {name: getattr(by_rows.rubber, name) for name in names}
    read, first = [], []
    for _ in range(RUNS):
        elapsed, rubber = timing.timed(partial(asperity.MasterCurve, **table))
        read.append(elapsed)
        first.append(timing.seconds(partial(replace(by_rows, rubber=rubber).ours, 1e-9)))
    rows, terms = (timing.median(times[name]) for name in ("rows", "terms"))
    ratio = timing.ratio(times["rows"], times["terms"])
    once = timing.median(read) + timing.median(first) - rows
    return {"rows_s": rows, "terms_s": terms, "ratio": ratio, "once_s": once}


def make() -> dict[str, bytes]:
    """Both tables as files."""
    result = tabulated()
    other = {"quantity": list(result), "value": list(result.values())}
    return {
        "friction.csv": timing.table("benchmark friction", curve_table()),
        "tabulated.csv": timing.table("benchmark tabulated modulus", other),
    }
