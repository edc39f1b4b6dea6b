"""Random surfaces and rubbers for PartialContact, most of them absurd.

Closed forms, rings with scatter, scans as they are measured, steps, lines, empty and faint rows,
soft ends; elastic rubbers to those of five decades in one step, wild series, master curves with
noise; velocities over fourteen decades.
"""

from typing import Any

import numpy as np

import asperity


def power(rng: Any, low: float, high: float, size: int | None = None) -> Any:
    return 10 ** rng.uniform(low, high, size)


def draw_rows(rng: Any) -> tuple[str, np.ndarray, np.ndarray]:
    """What a surface is like, its wavenumbers and its densities but for a factor."""
    kind = str(rng.choice(["closed", "rings", "scan", "steps", "lines", "empty", "faint", "soft"]))
    fall = -2 * (1 + rng.uniform(0.05, 1))
    n = int(np.exp(rng.uniform(np.log(4), np.log(150))))
    if kind == "closed":
        q = np.array([1.0, power(rng, 0.05, 5)])
        if rng.random() < 0.4:
            q = np.array([1.0, q[1] ** rng.uniform(0.05, 0.9), q[1]])
        return kind, q, np.maximum(q / q[-2], 1) ** fall
    if rng.random() < 0.5:
        k = int(rng.choice([1, 4, 8])) + np.arange(n)
        q = k / k[0]
    else:
        q = np.geomspace(1, power(rng, 0.1, 5), n)
    c = q**fall * np.exp(rng.choice([0, 0.1, 0.5]) * rng.standard_normal(n))
    x = np.log(q) / np.log(q[-1])  # from 0 to 1
    if kind == "rings":
        c *= power(rng, 0, rng.uniform(0, 3), n)
    elif kind == "scan":
        c *= np.exp(rng.standard_normal(n) / np.sqrt(1 + np.arange(n)))
        c[x < 0.1] *= rng.uniform(0.1, 3)
        c += c[-1] * power(rng, -3, 1)
    elif kind == "steps":
        c *= np.where(x > rng.uniform(0, 1), power(rng, -9, 4), 1)
        c *= np.where(x > rng.uniform(0, 1), power(rng, -4, 6), 1)
    elif kind == "lines":
        c *= np.where(rng.random(n) < 0.1, power(rng, 1, 6), 1)
    elif kind == "empty":
        c[rng.random(n) < rng.uniform(0, 0.8)] = 0
        c[rng.integers(n)] = 1
    elif kind == "faint":
        c *= np.where(x > rng.uniform(0, 1), power(rng, -14, -1), 1)
    else:
        x = q / q[-1] ** rng.uniform(0.1, 1)
        c *= np.exp(-np.minimum(x ** rng.choice([1, 2]), 200))
    return kind, q, c


def draw_rubber(rng: Any) -> tuple[str, Any]:
    kind = str(rng.choice(["elastic", "one step", "two steps", "broad", "wild", "curve"]))
    moduli, times = np.array([]), np.array([])
    if kind == "one step":
        moduli, times = power(rng, 0, 5, 1), np.ones(1)
    elif kind == "two steps":
        moduli, times = power(rng, -1, 4, 2), np.array([1.0, power(rng, -6, -0.5)])
    elif kind in ("broad", "curve"):
        moduli = np.geomspace(power(rng, -1, 1), power(rng, 0, 3), 20)
        times = np.geomspace(1, power(rng, -9, -2), 20)
    elif kind == "wild":
        n = int(rng.integers(3, 20))
        moduli, times = power(rng, -2, 4, n), power(rng, -8, 2, n)
    series = asperity.PronySeries(
        equilibrium_modulus=1e6, moduli=1e6 * moduli, relaxation_times=times
    )
    if kind != "curve":
        return kind, series
    w = np.geomspace(1e-10, 1e18, int(rng.integers(25, 200)))
    noise = np.exp(rng.choice([0.01, 0.1]) * rng.standard_normal((2, w.size)))
    e = series.modulus(w)
    curve = asperity.MasterCurve(
        angular_frequency=w, storage_modulus=e.real * noise[0], loss_modulus=e.imag * noise[1]
    )
    return kind, curve


def draw_parts(rng: Any) -> tuple[str, np.ndarray, np.ndarray, Any, float]:
    """What a scene is like, rows of its spectrum but for a factor, rubber and velocity."""
    kind, q, c = draw_rows(rng)
    name, rubber = draw_rubber(rng)
    velocity = power(rng, -7, 7) if name != "curve" else power(rng, -6, 6) / np.sqrt(q[-1])
    return f"{kind}, {name}", q, c, rubber, velocity
