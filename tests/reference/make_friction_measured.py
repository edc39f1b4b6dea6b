"""Contact area and hysteretic friction on tabulated (measured) spectra, also extrapolated moduli.

The spectrum is that of make_tabulated_spectrum.py, the friction that of THEORY.md sections 3 to 5.
The band is split at the spectrum's rows and where v q passes a knot of the modulus; in every piece
t = ln(q / qa) counts from its start, so that fronts of any width and steep rows are resolved.
Method one: Gauss panels in t, graded towards the start. Method two: a differential equation in
ln t. Prony angular integrals: trapezoid in z, cos(phi) = sech(z), and closed forms. Tabulated
ones: Gauss rules in z and in phi. Some rows are also compared with plain sums, to 1e-4.
"""

import random
from itertools import pairwise

import numpy as np
import tables
from friction_scene import CUMULATIVE, NODES, WEIGHTS, area_law, corrected_area
from make_friction import SBR
from make_friction_tabulated import KINKY, sampled
from rubber_integrals import prony_integrals, tabulated_integrals
from scipy.integrate import cumulative_trapezoid, solve_ivp, trapezoid
from scipy.interpolate import CubicHermiteSpline
from steffen import slopes

P = area_law("exact")


def table(wavenumber, density):
    """Return the columns, rounded as a measured file would be."""
    return [[float(f"{v:.6g}") for v in column] for column in (wavenumber, density)]


def measured_asphalt():
    """Return 40 smooth rows: roll-off, power law, drop at the end of the instrument's band."""
    q = np.geomspace(120.0, 4e5, 40)
    c = 3e-14 * (1 + (q / 900) ** 2) ** -1.85 / (1 + (q / 2.5e5) ** 4)
    return table(q, c)


def scattered():
    """Return 30 rows, flat then a power law, each within 30 % of it."""
    dice = random.Random(30)
    q = np.geomspace(500.0, 1e6, 30)
    c = 4e-17 * np.maximum(q / 4000, 1.0) ** -3.6
    return table(q, [v * dice.uniform(0.7, 1.3) for v in c])


def with_zeros(*spans):
    """Return 24 rows of a power law with zero rows in the given ranges of row numbers."""
    q = np.geomspace(1e3, 1e6, 24)
    c = 5e-15 * (q / 1e3) ** -3.7
    for first, last in spans:
        c[first:last] = 0.0
    return table(q, c)


def rings(count, change):
    """Return rows at equal steps of q, as of a scan, a power law times change(dice, k)."""
    dice = random.Random(count)
    q = 2e3 * np.arange(1, count + 1)
    return table(q, [2e-15 * k**-3.6 * change(dice, k) for k in range(1, count + 1)])


def many_modes(dice, k):
    """Return the scatter of a ring: the further out, the more modes are averaged."""
    return np.exp(0.5 * dice.gauss(0, 1) / np.sqrt(k))


ASPHALT = measured_asphalt()
SCATTERED = scattered()
STEEP = [[1e3, 3e3, 1e4, 1e5, 1e6], [2e-12, 2e-15, 5e-18, 1e-24, 4e-29]]
FIRST_ZERO = with_zeros((0, 7))
ISLAND = with_zeros((9, 14), (15, 24))
ALL_ZEROS = with_zeros((0, 3), (8, 13), (14, 18), (20, 24))
JUMP_UP = [[2e3, 1e4, 1.1e4, 8e4, 5e5], [1e-21, 2e-23, 2e-17, 4e-21, 1e-24]]
JUMP_DOWN = [[2e3, 1e4, 1.002e4, 8e4, 5e5], [3e-15, 2e-16, 2e-22, 4e-21, 1e-23]]
SMOOTH_TABLE = [[1e3, 1e4, 1e5, 1e6], [1e-16, 3e-20, 6e-24, 8e-28]]

DENSE = sampled(-4, 10, 3)
SHORT = sampled(3, 5, 4)
USUAL = {"velocity": 1e-2, "pressure": 2e5, "poisson_ratio": 0.5, "gamma": 0.5}
USUAL |= {"rubber": None, "extrapolation": None}

SCENES = {
    "asphalt": {"spectrum": ASPHALT},
    "asphalt fast": {"spectrum": ASPHALT, "velocity": 3.0, "poisson_ratio": 0.48, "gamma": 0.4},
    "asphalt low load": {"spectrum": ASPHALT, "pressure": 10.0, "velocity": 1e-3},
    "asphalt near full contact": {"spectrum": ASPHALT, "pressure": 1.5e7, "velocity": 1e-4},
    "asphalt tabulated": {"spectrum": ASPHALT, "rubber": DENSE},
    "steep": {"spectrum": STEEP, "velocity": 0.1},
    "steep low load": {"spectrum": STEEP, "pressure": 1e3, "gamma": 0.0},
    "scattered": {"spectrum": SCATTERED, "velocity": 1e-3},
    "scattered tabulated": {"spectrum": SCATTERED, "rubber": sampled(0, 9, 2), "velocity": 4e-3},
    "first rows zero": {"spectrum": FIRST_ZERO, "gamma": 0.4},
    "first rows zero low load": {"spectrum": FIRST_ZERO, "pressure": 50.0},
    "first rows zero high load": {"spectrum": FIRST_ZERO, "pressure": 1e8, "velocity": 1.0},
    "island": {"spectrum": ISLAND},
    "island high load": {"spectrum": ISLAND, "pressure": 1e8, "velocity": 1.0},
    "zeros everywhere": {"spectrum": ALL_ZEROS, "velocity": 0.3},
    "zeros everywhere low load": {"spectrum": ALL_ZEROS, "pressure": 2e3, "gamma": 0.0},
    "zeros everywhere tabulated": {"spectrum": ALL_ZEROS, "rubber": KINKY, "velocity": 2e-3},
    "jump up": {"spectrum": JUMP_UP, "pressure": 1e6},
    "jump up tabulated": {"spectrum": JUMP_UP, "rubber": DENSE, "pressure": 3e4, "velocity": 1e-3},
    "jump up high load": {"spectrum": JUMP_UP, "pressure": 3e7, "poisson_ratio": 0.4},
    "jump down": {"spectrum": JUMP_DOWN, "velocity": 1.0},
    "jump down high load": {"spectrum": JUMP_DOWN, "pressure": 2e8},
    "power-law below": {"spectrum": ASPHALT, "rubber": KINKY, "velocity": 1.2e-3},
    "power-law both ends": {"spectrum": SMOOTH_TABLE, "rubber": SHORT, "velocity": 0.25},
    "power-law first rows zero": {"spectrum": FIRST_ZERO, "rubber": KINKY, "velocity": 250.0},
    "clamp above": {"spectrum": SCATTERED, "rubber": KINKY, "velocity": 280.0},
    "clamp both ends": {"spectrum": SMOOTH_TABLE, "rubber": SHORT, "velocity": 0.3, "gamma": 0.4},
    "clamp above low load": {"spectrum": ASPHALT, "rubber": SHORT, "velocity": 2.3},
    "rings": {"spectrum": rings(90, many_modes)},
    "rings high load": {"spectrum": rings(90, many_modes), "pressure": 3e7, "velocity": 1.0},
    "rings low load": {"spectrum": rings(90, many_modes), "pressure": 1e3, "gamma": 0.4},
    "rings and lines": {
        "spectrum": rings(60, lambda _, k: 1000.0 if k % 20 == 7 else 1.0),
        "velocity": 0.3,
    },
    "rings that jump": {"spectrum": rings(50, lambda dice, _: 1000 ** dice.random())},
    "rings with empty rows": {"spectrum": rings(70, lambda dice, _: dice.random() > 0.25)},
    "rings after a trace": {
        "spectrum": rings(50, lambda dice, k: 10 ** dice.uniform(-12, -3) if k < 12 else 1.0),
        "velocity": 1e-4,
    },
}
SCENES["clamp above low load"]["pressure"] = 1e4
for _name in SCENES:
    for _kind in ("power-law", "clamp"):
        if _name.startswith(_kind):
            SCENES[_name]["extrapolation"] = _kind
LITERAL = {"asphalt near full contact", "asphalt", "power-law both ends", "clamp both ends"}
LITERAL |= {"scattered tabulated", "first rows zero high load"}


def pieces(scene, knots):
    """Return (start, length, segment, offset) of every piece of the band that is not all zero."""
    result = []
    for (qa, qb), (ca, cb) in zip(*map(pairwise, scene["spectrum"]), strict=True):
        if ca == cb == 0:
            continue
        edges = [qa, *sorted(k for k in knots if qa * (1 + 1e-12) < k < qb * (1 - 1e-12)), qb]
        for a, b in pairwise(edges):
            offset = np.log1p((a - qa) / qa)
            result.append((a, np.log1p((b - a) / a), (qa, qb, ca, cb), offset))
    return result


def density(segment, t):
    """Return C at ln(q / qa) = t."""
    qa, qb, ca, cb = segment
    if ca == 0 or cb == 0:
        return ca + (cb - ca) * np.expm1(t) * (qa / (qb - qa))
    return ca * np.exp(np.log(cb / ca) / np.log(qb / qa) * t)


def density_again(segment, t):
    """Return the same from the weights of both ends."""
    qa, qb, ca, cb = segment
    length = np.log1p((qb - qa) / qa)
    if ca == 0:
        return cb * np.expm1(t) / np.expm1(length)
    if cb == 0:
        return ca * np.exp(t) * np.expm1(length - t) / np.expm1(length)
    return np.exp((np.log(ca) * (length - t) + np.log(cb) * t) / length)


def rates(scene, integrals, law, piece, t):
    """Return dG/dt, d hysteresis/dt without P, and the part of the latter from extrapolation."""
    q = piece[0] * np.exp(t)
    load = (1 - scene["poisson_ratio"] ** 2) * scene["pressure"]
    i1, i2, outside = integrals(scene["velocity"] * q)
    power = (q * q) * (q * q) * law(piece[2], piece[3] + t)
    return power * i2 / (8 * load**2), power * i1 / (2 * load), power * outside / (2 * load)


def first_step(scene, integrals, piece, g):
    """Return a length in t over which P(G) is a constant or a smooth function."""
    highest = np.max(rates(scene, integrals, density, piece, np.linspace(0, piece[1], 65))[0])
    return min(1e-3 * piece[1], max(g / 20, 5e-3) / highest)


def refine(scene, integrals, parts):
    """Return the results by Gauss panels, made denser until they change by less than 3e-12."""
    old = None
    for level in (1, 2, 3, 4, 6):
        new = by_panels(scene, integrals, parts, level)
        if old is not None and np.allclose(new, old, rtol=3e-12, atol=0):
            return new
        old = new
    raise AssertionError(("not converged", scene["case"], old, new))


def by_panels(scene, integrals, parts, level):
    """Return the results with panels at most 2^(1/level) times as long as what is before them."""
    gamma, g = scene["gamma"], 0.0
    total, total_s, outside = 0.0, 0.0, 0.0
    for piece in parts:
        step = first_step(scene, integrals, piece, g)
        count = 1 + int(level * np.log2(piece[1] / step))
        ends = np.geomspace(step, piece[1], count + 1)
        pairs = [(0.0, step), *pairwise(ends)]
        edges = [np.linspace(a, b, 2 + int(8 * level * (b - a) / piece[1]))[:-1] for a, b in pairs]
        edges = np.concatenate([*edges, ends[-1:]])
        half = np.diff(edges)[:, None] / 2
        t = edges[:-1, None] + half + half * NODES
        values = rates(scene, integrals, density, piece, t.ravel())
        g_rate, h_rate, o_rate = (v.reshape(t.shape) for v in values)
        before = g + np.concatenate([[0.0], np.cumsum(np.sum(WEIGHTS * g_rate * half, axis=1))])
        p = P(np.maximum(before[:-1, None] + half * (g_rate @ CUMULATIVE.T), 1e-99))
        weight = WEIGHTS * half * p
        total += np.sum(weight * h_rate)
        total_s += np.sum(weight * h_rate * (gamma + (1 - gamma) * p * p))
        outside += np.sum(weight * o_rate)
        g = before[-1]
    return np.array([P(g), corrected_area(g, gamma, P), total, total_s, g, outside])


def by_differential_equation(scene, integrals, parts):
    """Return the results by DOP853 in ln t; G and the corrected G as logarithms."""
    gamma = scene["gamma"]
    g, g_s, sums = 0.0, 0.0, np.zeros(3)

    def s_factor(p):
        return gamma + (1 - gamma) * p * p

    for piece in parts:

        def derivative(x, state, piece=piece):
            values = rates(scene, integrals, density_again, piece, np.exp([x]))
            g_rate, h_rate, o_rate = (v[0] * np.exp(x) for v in values)
            g, g_s = np.exp(state[:2])
            p = P(g)
            h = h_rate * p
            return [
                g_rate / g,
                s_factor(P(g_s)) * g_rate / g_s,
                h,
                h * s_factor(p),
                o_rate * p,
            ]

        start = first_step(scene, integrals, piece, g) * np.exp(-25.0)
        order = 2 if piece[3] == 0 and piece[2][2] == 0 else 1  # G = t^order at the start
        values = rates(scene, integrals, density_again, piece, np.array([start]))
        skipped = [v[0] * start / order for v in values]
        p, p_s = (P(max(value, 1e-99)) for value in (g, g_s))
        sums += np.array([skipped[1], skipped[1] * s_factor(p), skipped[2]]) * p
        state = [np.log(g + skipped[0]), np.log(g_s + skipped[0] * s_factor(p_s)), *sums]
        state = solve_ivp(
            derivative,
            (np.log(start), np.log(piece[1])),
            state,
            method="DOP853",
            rtol=1e-12,
            atol=[1e-12, 1e-12, 1e-99, 1e-99, 1e-14],
        ).y[:, -1]
        g, g_s = np.exp(state[:2])
        sums = state[2:]
    return np.array([P(g), P(g_s), sums[0], sums[1], g, sums[2]])


def with_nothing_outside(integrals):
    """Return w -> (I1, I2, 0)."""
    return lambda w: (*integrals(w), 0 * w)


def row(case, changes):
    """Return one row, both methods compared."""
    scene = {"case": case, **USUAL, **changes}
    q = scene["spectrum"][0]
    columns, knots = scene["rubber"], []
    prony = SBR if columns is None else dict.fromkeys(SBR)
    if columns is None:
        integrals = [with_nothing_outside(each) for each in prony_integrals(SBR)]
    else:
        integrals = tabulated_integrals(columns, scene["extrapolation"])
        beyond = 10.0 if scene["extrapolation"] else 1.0
        low, high = columns[0][0], columns[0][-1]
        assert low / beyond <= scene["velocity"] * q[0]
        assert scene["velocity"] * q[-1] <= high * beyond
        inside = low <= scene["velocity"] * q[0] and scene["velocity"] * q[-1] <= high
        assert inside == (scene["extrapolation"] is None)
        knots = [w / scene["velocity"] for w in (low / 10, *columns[0], high * 10)]
    parts = pieces(scene, knots)
    first = refine(scene, integrals[0], parts)
    second = by_differential_equation(scene, integrals[1], parts)
    for a, b, scale in zip(first, second, [None] * 5 + [first[2]], strict=True):
        tables.agree("friction_measured", a, b, 1e-8, scale)
    area, area_s, hysteresis, hysteresis_s, g, outside = (float(value) for value in first)
    share = None if columns is None else outside / hysteresis
    print(f"{case:28s}", " ".join(f"{x:.10g}" for x in first))
    if case in LITERAL:
        check_literally(scene, first)
    return {
        "case": case,
        "table_wavenumber": q,
        "table_density": scene["spectrum"][1],
        **prony,
        **tables.table_columns(columns),
        "extrapolation": scene["extrapolation"],
        **{key: scene[key] for key in ("pressure", "velocity", "poisson_ratio", "gamma")},
        "g": g,
        "contact_area": area,
        "contact_area_s": area_s,
        "hysteresis": hysteresis,
        "hysteresis_s": hysteresis_s,
        "extrapolated_share": share,
        "rtol": 1e-6,
    }


def check_literally(scene, answer):
    """Compare with trapezoids over q (graded at the front) and midpoints in phi, written out."""
    rows, c = (np.array(column) for column in scene["spectrum"])
    start = rows[np.flatnonzero(c)[0] - 1] if c[0] == 0 else rows[0]
    length = np.log(rows[-1] / start)
    fine = np.geomspace(1e-11, 1, 5000) * length
    q = start * np.exp(np.concatenate([fine, np.linspace(0, length, 3001)[1:-1]]))
    q = np.unique(np.concatenate([q, rows[rows >= start]]).clip(start, rows[-1]))
    with np.errstate(divide="ignore"):
        spectrum = np.exp(np.interp(np.log(q), np.log(rows), np.log(c)))
    zero = np.interp(q, rows, c == 0) > 0
    spectrum[zero] = np.interp(q, rows, c)[zero]
    cosine = np.cos((np.arange(500) + 0.5) * np.pi / 1000)  # first quadrant, times 4
    i1, i2, outside = np.empty((3, q.size))
    for number, w in enumerate(scene["velocity"] * q):
        storage, loss, extrapolated = literal_modulus(scene, w * cosine)
        i1[number] = np.mean(cosine * loss) * 2 * np.pi
        i2[number] = np.mean(storage**2 + loss**2) * 2 * np.pi
        outside[number] = np.mean(cosine * loss * extrapolated) * 2 * np.pi
    load = (1 - scene["poisson_ratio"] ** 2) * scene["pressure"]
    weight = q**3 * spectrum / load
    g = cumulative_trapezoid(weight * i2 / 8 / load, q, initial=0)
    p = P(np.maximum(g, 1e-99))
    s = scene["gamma"] + (1 - scene["gamma"]) * p**2
    sums = [trapezoid(0.5 * weight * i * p * f, q) for i, f in ((i1, 1), (i1, s), (outside, 1))]
    literal = np.array([p[-1], *sums[:2], g[-1], sums[2]])
    error = np.max(np.abs(literal[:4] / answer[[0, 2, 3, 4]] - 1))
    print(f"    literally {error:.1e}")
    # the share converges slowly in phi: half of it may lie between two midpoints
    assert np.allclose(literal[:4], answer[[0, 2, 3, 4]], rtol=1e-4, atol=0), (literal, answer)
    assert abs(literal[4] - answer[5]) < 5e-4 * answer[2], (literal, answer)


def literal_modulus(scene, w):
    """Return E', E'' and whether w lies outside of the table."""
    if scene["rubber"] is None:
        return *tables.prony(w, *SBR.values()), np.zeros(w.size, bool)
    frequency, *moduli = (np.array(column) for column in scene["rubber"])
    x, low, high = np.log(w), np.log(frequency[0]), np.log(frequency[-1])
    decade = np.log(10.0) if scene["extrapolation"] else 0.0
    result = []
    for column in np.log(moduli):
        d = np.array(slopes(list(np.log(frequency)), list(column)), float)
        inside = CubicHermiteSpline(np.log(frequency), column, d)(np.clip(x, low, high))
        ends = d[[0, -1]] if scene["extrapolation"] == "power-law" else (0, 0)
        below = ends[0] * np.clip(x - low, -decade, 0)
        result.append(np.exp(inside + below + ends[1] * np.maximum(x - high, 0)))
    result[1] *= np.exp(np.minimum(x - low + decade, 0))
    return *result, (w < frequency[0]) | (w > frequency[-1])


def main():
    """Write friction_measured.csv."""
    rows = [row(case, changes) for case, changes in SCENES.items()]
    comments = [
        "Contact area and hysteretic friction on tabulated spectra (log-log linear between rows,",
        "linear in q where an end is zero): article Eqs 5-8 and 22, THEORY.md sections 2 to 5.",
        "Generated by make_friction_measured.py in double precision, two methods within 1e-8.",
        "g, contact_area, hysteresis and their forms with S (_s) as in friction.csv, exact form.",
        "Rubber: Prony series, or Steffen's interpolant of a table as in master_curve.csv.",
        "extrapolation power-law: for one decade beyond either end ln E' and ln E'' are linear in",
        "ln w with Steffen's slope at that end; clamp: constant there. Below that decade (empty:",
        "below the table) E' is constant and E'' proportional to w. extrapolated_share: part of",
        "hysteresis (no S) whose I1 comes from outside of the table, good to 1e-3 absolute (empty",
        "for Prony series).",
        "Units: table_wavenumber 1/m; table_density m^4; moduli, table_storage, table_loss,",
        "pressure Pa; relaxation_times s; table_frequency rad/s; velocity m/s; the rest none.",
    ]
    tables.write("friction_measured", comments, rows)


if __name__ == "__main__":
    main()
