"""Friction curves to sixteen digits: what the work-precision diagrams of tests/benchmarks need.

Hysteresis with S of the uncorrected P in the integrand (article Eqs 8 and 22, THEORY.md 3 to 5) at
20 or 60 velocities of six scenes, in long double (64 bits of mantissa, as on x86-64), erf by
mpmath. Method one: Gauss panels in x = ln(ln q - ln q0), closed I1 and I2 (a table's by Gauss rules
in z, cos(phi) = sech(z)). Method two: Gauss panels in ln q that grow from the front, I1 and I2 by
their definition (trapezoid in z; a table's by Gauss rules in phi).
"""

from itertools import pairwise

import mpmath as mp
import numpy as np
import tables
from steffen import Table

LONG = np.longdouble
assert np.finfo(LONG).eps < 2e-19
mp.mp.dps = 25
PI = LONG("3.14159265358979323846264")

X = np.linspace(0, 1, 20)
SBR = {
    "equilibrium_modulus": 3e6,
    "moduli": [float(f"{e:.6g}") for e in 2e8 * np.exp(-(((X - 0.3) / 0.2) ** 2) / 2) + 7e4],
    "relaxation_times": [float(f"{t:.6g}") for t in 10 ** (-12 + 14 * X)],
}
SOFT = {"equilibrium_modulus": 1e6, "moduli": [1e6, 3e6], "relaxation_times": [1e-3, 1e-5]}
ASPHALT = {"rms_height": 265.7e-6, "hurst": 0.87, "q0": 2000.0, "q1": 1e6, "pressure": 81e3}


def sampled(low, high, per_decade):
    """Return a table of SBR, to four digits, between 10^low and 10^high rad/s."""
    count = round((high - low) * per_decade) + 1
    frequency = [float(f"{10 ** (low + k / per_decade):.8g}") for k in range(count)]
    pairs = [tables.prony(w, *SBR.values()) for w in frequency]
    return [frequency, *([float(f"{p[k]:.4g}") for p in pairs] for k in range(2))]


def velocities(count):
    """Return velocities from 1e-6 to 10 m/s."""
    return [float(f"{v:.6g}") for v in np.geomspace(1e-6, 10, count)]


SCENES = {
    "mild": {**ASPHALT, **SOFT, "rms_height": 50e-6, "hurst": 0.8, "q1": 1e5, "pressure": 1e5},
    "Table 1": {**ASPHALT, **SBR, "velocities": velocities(60)},
    "steep front": {**ASPHALT, **SBR, "rms_height": 5e-4, "q1": 2e4, "pressure": 2e3},
    "tabulated modulus": {**ASPHALT, "table": sampled(-3, 8, 2)},
    "near full contact": {**ASPHALT, **SBR, "rms_height": 1e-6, "q1": 1e5, "pressure": 3e6},
    "weak contact": {**ASPHALT, **SBR, "rms_height": 1e-5, "hurst": 0.5, "q1": 1e7, "pressure": 50},
}
USUAL = {"equilibrium_modulus": None, "moduli": [], "relaxation_times": [], "table": [[], [], []]}
USUAL["velocities"] = velocities(20)
POISSON, GAMMA = 0.5, 0.5


def long(values):
    """Return mpmath numbers, or doubles as they are, as long doubles."""
    return np.array([LONG(mp.nstr(mp.mpf(v), 22)) for v in values], dtype=LONG)


def gauss(count):
    """Return nodes, weights, and the matrix of integrals from -1 to each node."""
    x = [mp.mpf(float(v)) for v in np.polynomial.legendre.leggauss(count)[0]]
    slope = None
    for _ in range(2):
        p = [mp.legendre(count, v) for v in x]
        slope = [
            count * (mp.legendre(count - 1, v) - v * f) / (1 - v * v)
            for v, f in zip(x, p, strict=True)
        ]
        x = [v - f / d for v, f, d in zip(x, p, slope, strict=True)]
    weight = long([2 / ((1 - v * v) * d * d) for v, d in zip(x, slope, strict=True)])
    x = long(x)
    p = [np.ones(count, LONG), x]
    for k in range(1, count + 1):
        p.append(((2 * k + 1) * x * p[k] - k * p[k - 1]) / (k + 1))
    matrix = np.outer(1 + x, weight / 2)
    for k in range(1, count):
        matrix += np.outer((p[k + 1] - p[k - 1]) / 2, p[k] * weight)
    return x, weight, matrix


FINE, COARSE = gauss(40), gauss(30)


def prony_closed(scene):
    """Return w -> (I1, I2) by the closed forms."""
    inputs = (
        LONG(scene["equilibrium_modulus"]),
        long(scene["moduli"]),
        long(scene["relaxation_times"]),
    )

    def integrals(w):
        e_inf, moduli, times = inputs
        weights = 2 * moduli * (e_inf + (moduli / (1 + times[:, None] / times)).sum(axis=1))
        x = w[:, None] * times
        r = np.sqrt(1 + x * x)
        i1 = 2 * PI * (moduli * x / (r * (r + 1))).sum(axis=1)
        return i1, 2 * PI * (e_inf**2 + (weights * x * x / (r * (r + 1))).sum(axis=1))

    return integrals


def prony_defined(scene):
    """Return w -> (I1, I2) by the trapezoidal rule in z, whose error is exp(-pi^2 / step)."""
    inputs = (
        LONG(scene["equilibrium_modulus"]),
        long(scene["moduli"]),
        long(scene["relaxation_times"]),
    )
    step = LONG(1) / 5
    c = 1 / np.cosh(step * np.arange(240, dtype=LONG))
    weight = 4 * step * c
    weight[0] /= 2

    def block(w):
        storage, loss = tables.prony(w[:, None] * c, *inputs)
        return (weight * c * loss).sum(axis=1), (weight * (storage**2 + loss**2)).sum(axis=1)

    return in_blocks(block)


def in_blocks(function):
    """Return the function computed a hundred frequencies at a time."""

    def integrals(w):
        parts = [function(part) for part in np.array_split(w, max(1, w.size // 100))]
        return [np.concatenate(column) for column in zip(*parts, strict=True)]

    return integrals


def tabulated(scene, variable):
    """Return w -> (I1, I2) by Gauss rules in z or phi, split at the knots; tails closed."""
    exact = Table(*scene["table"])
    knots, x = long(exact.frequency), long(exact.x)
    cubics = [np.array([long(piece) for piece in part]) for part in exact.cubics]
    storage0, loss0 = long([exact.storage[0], exact.loss[0]])
    nodes, weights, _ = FINE
    parts = 1 if variable == "z" else 3
    cut = [knots[0]]
    for a, b in pairwise(knots):
        cut += [a * (b / a) ** (LONG(k) / parts) for k in range(1, parts)] + [b]
    cut, number = np.array(cut, LONG), np.repeat(np.arange(len(knots) - 1), parts)

    def block(w):
        ratio = np.minimum(cut / w[:, None], 1)
        edges = np.arccosh(1 / ratio) if variable == "z" else np.arccos(ratio)
        half = (edges[:, :-1, None] - edges[:, 1:, None]) / 2
        at = edges[:, 1:, None] + half * (1 + nodes)
        c = 1 / np.cosh(at) if variable == "z" else np.cos(at)
        t = np.log(w[:, None, None] * c) - x[number, None]
        t = np.clip(t, 0, np.diff(x)[number, None])  # rounding at the ends
        storage, loss = (
            np.exp(sum(part[number, k, None] * t**k for k in range(4))) for part in cubics
        )
        weight = 4 * half * weights * (c if variable == "z" else 1)
        i1 = (weight * c * loss).sum(axis=(1, 2))
        i2 = (weight * (storage**2 + loss**2)).sum(axis=(1, 2))
        below = knots[0] / w
        angle = np.arcsin(below)
        cosines = angle - below * np.sqrt(1 - below**2)
        i1 += 2 * loss0 / below * cosines
        return i1, i2 + 4 * storage0**2 * angle + 2 * (loss0 / below) ** 2 * cosines

    return in_blocks(block)


def share(g):
    """Return P(G) = erf(1 / (2 sqrt G))."""
    s = 1 / (2 * np.sqrt(g))
    return long([mp.erf(mp.mpf(str(v))) for v in s.ravel()]).reshape(g.shape)


def solve(scene, velocity, integrals, rule, logarithmic):
    """Return mu_H at one velocity, and the width of the front in ln q."""
    q0, q1, hurst = (LONG(scene[key]) for key in ("q0", "q1", "hurst"))
    stiff = 1 / ((1 - LONG(POISSON) ** 2) * LONG(scene["pressure"]))
    amplitude = hurst / PI * (LONG(scene["rms_height"]) / q0) ** 2
    amplitude /= 1 - (q1 / q0) ** (-2 * hurst)
    length, v = np.log(q1 / q0), LONG(velocity)

    def rates(s):
        i1, i2 = integrals((v * q0 * np.exp(s)).ravel())
        power = q0**4 * amplitude * np.exp((2 - 2 * hurst) * s)
        g_rate = power * i2.reshape(s.shape) * stiff**2 / 8
        return g_rate, power * i1.reshape(s.shape) * stiff / 2

    front = 1 / rates(np.zeros(1, LONG))[0][0]
    ends = [length, *(np.log(LONG(w) / (v * q0)) for w in scene["table"][0])]
    ends = sorted({s for s in ends if 0 < s <= length})
    reach = min(front, ends[0])
    if logarithmic:
        start = np.log(reach) - 46
        edges = [np.linspace(start, np.log(ends[0]), 2 + int((np.log(ends[0]) - start) / 0.8))]
        maps = [(np.exp, np.exp)]
    else:
        # P is 1 to 1e-22 in the first panel: it is not analytic at G = 0
        grown = reach / 200 * LONG("1.6") ** np.arange(200, dtype=LONG)
        grown = {0, *grown[grown < ends[0]], *np.arange(0.25, float(ends[0]), 0.25), ends[0]}
        edges, maps = [np.array(sorted(grown), LONG)], [(lambda at: at, np.ones_like)]
    for a, b in pairwise(ends):  # beyond a knot of the table I1 and I2 go with its distance^2.5
        edges.append(np.linspace(0, np.sqrt(b - a), 4 if logarithmic else 6))
        maps.append((lambda at, a=a: a + at * at, lambda at: 2 * at))
    nodes, weights, matrix = rule
    half = np.concatenate([np.diff(e) for e in edges])[:, None] / 2
    at = [(e[:-1] + e[1:])[:, None] / 2 + np.diff(e)[:, None] / 2 * nodes for e in edges]
    s, slope = (np.concatenate([f[k](x) for f, x in zip(maps, at, strict=True)]) for k in range(2))
    g_rate, mu_rate = (rate * slope * half for rate in rates(s))
    before = np.cumsum([np.exp(start) / front if logarithmic else 0, *(g_rate @ weights)])
    p = share(before[:-1, None] + g_rate @ matrix.T)
    factor = GAMMA + (1 - GAMMA) * p * p
    return ((mu_rate * p * factor) @ weights).sum(), front


def row(case, changes):
    """Return one row, both methods compared."""
    scene = {**USUAL, **changes}
    if scene["moduli"]:
        first, second = prony_closed(scene), prony_defined(scene)
    else:
        first, second = tabulated(scene, "z"), tabulated(scene, "phi")
    curve, fronts = [], []
    for velocity in scene["velocities"]:
        one, front = solve(scene, velocity, first, FINE, True)
        two, _ = solve(scene, velocity, second, COARSE, False)
        tables.agree("friction_curves", one, two, 1e-16)
        curve.append(float(one))
        fronts.append(float(front))
    print(f"{case:20s} front {min(fronts):.1e} to {max(fronts):.1e}", curve[0], curve[-1])
    keys = ["rms_height", "hurst", "q0", "q1"]
    rubber = ["equilibrium_modulus", "moduli", "relaxation_times"]
    frequency, storage, loss = scene["table"]
    return (
        {"case": case}
        | {key: scene[key] for key in keys + rubber}
        | {"table_frequency": frequency, "table_storage": storage, "table_loss": loss}
        | {"pressure": scene["pressure"], "poisson_ratio": POISSON, "gamma": GAMMA}
        | {"velocities": scene["velocities"], "hystereses": curve, "rtol": 1e-14}
    )


def main():
    """Write friction_curves.csv."""
    rows = [row(case, changes) for case, changes in SCENES.items()]
    comments = [
        "Friction curves: hysteresis with S of the uncorrected P, article Eqs 8 and 22, THEORY.md",
        "3 to 5; self-affine spectra, Prony series or a table (see master_curve.csv).",
        "Generated by make_friction_curves.py in long double, two methods within 1e-16, rounded.",
        "Units: rms_height m; q0, q1 1/m; moduli, table_storage, table_loss, pressure Pa;",
        "relaxation_times s; table_frequency rad/s; velocities m/s; the rest none.",
    ]
    tables.write("friction_curves", comments, rows)


if __name__ == "__main__":
    main()
