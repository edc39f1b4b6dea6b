"""A hysteresis curve of 60 velocities: time and error of ours and of other methods, in one process.

    python tests/benchmarks/friction.py [--runs 15]

Table 1's surface (H 0.87, h_rms 265.7 um, q0 2000, q1 1e6), a Prony series of 20 terms, S factor
0.5 on the friction, 81 kPa, 1e-6 to 10 m/s; one thread. The yardstick is a vectorised NumPy form of
the graded-panel method: Gauss-Legendre panels that grow from the front by factors of 4, with a
cumulative integration matrix. Methods alternate; medians of the runs. Errors are the largest of the
curve, against GSL's adaptive integration at 1e-12. Also a grid of pressures and velocities, and one
point from Python. scipy's nested quad and a trapezoid in ln q are run once. pip install scipy.
"""

import argparse
import statistics
import time
from collections.abc import Callable
from typing import Any

import numpy as np
from scipy.integrate import cumulative_trapezoid, quad, trapezoid
from scipy.special import erf

import asperity

H, RMS, Q0, Q1, SIGMA, GAMMA = 0.87, 265.7e-6, 2000.0, 1e6, 81e3, 0.5
STIFF = 1 / (1 - 0.5**2)
VELOCITY = np.geomspace(1e-6, 10, 60)
X = np.linspace(0, 1, 20)
TAU = 10 ** (-12 + 14 * X)
MODULI = 2e8 * np.exp(-(((X - 0.3) / 0.2) ** 2) / 2) + 7e4
E_INF = 3e6
WEIGHTS = 2 * MODULI * (E_INF + (MODULI / (1 + TAU[:, None] / TAU)).sum(axis=1))
DENSITY = H / np.pi * (RMS / Q0) ** 2 / (1 - (Q1 / Q0) ** (-2 * H))
LENGTH = np.log(Q1 / Q0)

ROAD = asperity.SelfAffineSpectrum(rms_height=RMS, hurst=H, q0=Q0, q1=Q1)
RUBBER = asperity.PronySeries(equilibrium_modulus=E_INF, moduli=MODULI, relaxation_times=TAU)
CORRECTION = asperity.SFactor(gamma=GAMMA, applies_to="friction")


def rates(s: Any, velocity: Any) -> tuple[Any, Any]:
    """dG/ds, and dmu/ds without P S, at s = ln(q / q0)."""
    q = Q0 * np.exp(s)
    t = (velocity * q)[..., None] * TAU
    r = np.sqrt(1 + t * t)
    s_over_t = t / (r * (r + 1))
    i1 = 2 * np.pi * (s_over_t @ MODULI)
    i2 = 2 * np.pi * (E_INF**2 + (t * s_over_t) @ WEIGHTS)
    common = q**4 * DENSITY * np.exp(-2 * (H + 1) * s)
    return common * i2 * (STIFF / SIGMA) ** 2 / 8, common * i1 * STIFF / SIGMA / 2


def weight(g: Any) -> Any:
    """P S."""
    share = erf(0.5 / np.sqrt(g))
    return share * (GAMMA + (1 - GAMMA) * share**2)


NODES, GAUSS = np.polynomial.legendre.leggauss(16)
CUMULATIVE = np.array(
    [
        np.polynomial.Legendre.fit(NODES, row, 15, domain=[-1, 1]).integ(lbnd=-1)(NODES)
        for row in np.eye(16)
    ]
)


def graded_panels() -> Any:
    """Vectorised over velocities: 448 nodes each, panels growing from the narrowest front."""
    front = 1 / rates(np.zeros(60), VELOCITY)[0].max()
    edges = [0.0, *np.minimum(front * 4.0 ** np.arange(100), 0.25)]
    edges = sorted({*edges, *np.linspace(0.25, LENGTH, 29 - len({*edges}))})
    edges = np.array(edges)
    half = np.diff(edges)[:, None] / 2
    s = edges[:-1, None] + half * (1 + NODES)
    g_rate, mu_rate = rates(s, VELOCITY[:, None, None])
    inside = (g_rate * half) @ CUMULATIVE
    before = np.cumsum((g_rate * half) @ GAUSS, axis=1)
    g = inside + np.concatenate([np.zeros((60, 1)), before[:, :-1]], axis=1)[:, :, None]
    return ((mu_rate * weight(g) * half) @ GAUSS).sum(axis=1)


def trapezoid_curve(points: int) -> Any:
    """On a logarithmic grid, as published programs do."""
    s = np.linspace(0, LENGTH, points)
    g_rate, mu_rate = rates(s, VELOCITY[:, None])
    g = np.maximum(cumulative_trapezoid(g_rate, s, axis=1, initial=0), 1e-300)
    return trapezoid(mu_rate * weight(g), s, axis=1)


def nested_quad(velocities: Any) -> Any:
    def mu(v: float) -> float:
        def g(s: float) -> float:
            return quad(lambda at: rates(np.array(at), v)[0], 0, s)[0]

        return quad(lambda s: rates(np.array(s), v)[1] * weight(g(s)), 0, LENGTH)[0]

    return np.array([mu(v) for v in velocities])


def ours(rtol: float, method: str = "gauss") -> Callable[[], Any]:
    def run() -> Any:
        options = {"pressure": SIGMA, "velocity": VELOCITY, "correction": CORRECTION}
        return asperity.friction(ROAD, RUBBER, rtol=rtol, method=method, **options).mu

    return run


def seconds(call: Callable[[], Any]) -> float:
    start = time.perf_counter()
    call()
    return time.perf_counter() - start


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--runs", type=int, default=15)
    runs = parser.parse_args().runs
    truth = ours(1e-12, "qag")()
    methods = {f"ours, rtol {rtol:.0e}": ours(rtol) for rtol in (1e-3, 1e-6, 1e-9)}
    methods["graded panels, NumPy"] = graded_panels
    for points in (100, 1000, 10000):
        methods[f"trapezoid in ln q, {points}"] = lambda points=points: trapezoid_curve(points)
    methods["GSL QAG, rtol 1e-6"] = ours(1e-6, "qag")
    times: dict[str, list[float]] = {name: [] for name in methods}
    for _ in range(runs):
        for name, call in methods.items():
            times[name].append(seconds(call))
    yardstick = times["graded panels, NumPy"]
    print("| method | time [us] | yardstick over it | worst error |\n| --- | --- | --- | --- |")
    for name, call in methods.items():
        ratio = statistics.median(y / t for y, t in zip(yardstick, times[name], strict=True))
        error = np.abs(call() / truth - 1).max()
        print(
            f"| {name} | {1e6 * statistics.median(times[name]):.0f} | {ratio:.3g} | {error:.1e} |"
        )
    some = VELOCITY[::20]
    start = time.perf_counter()
    error = np.abs(nested_quad(some) / truth[::20] - 1).max()
    elapsed = 20e6 * (time.perf_counter() - start)
    print(f"| nested quad, scaled from 3 | {elapsed:.0f} | - | {error:.1e} |")

    def point() -> Any:
        return asperity.friction(ROAD, RUBBER, pressure=SIGMA, velocity=1e-2, correction=CORRECTION)

    def grid(n: int) -> Callable[[], Any]:
        pressure, velocity = np.geomspace(1e4, 1e6, n), np.geomspace(1e-6, 10, n)[:, None]
        options = {"pressure": pressure, "velocity": velocity, "correction": CORRECTION}
        return lambda: asperity.friction(ROAD, RUBBER, **options)

    one = statistics.median(seconds(point) for _ in range(200))
    many = statistics.median(seconds(grid(100)) for _ in range(5))
    print(
        f"one point from Python {1e6 * one:.1f} us; a point of a 100 x 100 grid {100 * many:.2f} us"
    )


if __name__ == "__main__":
    main()
