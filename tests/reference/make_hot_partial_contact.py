"""Friction by the rule of PartialContact with the heat that it makes, from its definition.

The rule is that of partial_rule.py with I1 and I2 at v q a_T(T0 + theta(q)). q' runs over
the band and over the edges, from q_e to 33 q_e whether or not that is beyond q1:
  theta(q) = (2 v sigma0 / (rho c_v P_m)) int q' g(q, q') dmu_H(q'),
  dmu_H = 4 (1 - nu^2) sigma0 (I1 / I2) (R dG + T dln x), P_m = erf(1 / (2 sqrt(kappa G(q_m)))),
with g of make_heat_kernel.py and q_m = 2 pi / contact_diameter, held to the band. Where rho is
below 0.1, it is taken to be what it is at T0 if that is more, but 1 at most. theta is an unknown at
each node, at q_e and at q1; steps of a part of F(theta) - theta go to the fixed point.
Method one: panels of 12 nodes, closed windows, I1 and I2; g by N(x) = int h(w) erfcx(x sqrt w) dw;
the root in ln kappa.
Method two: 16 nodes on other panels, windows by Gauss rules, I1 and I2 by their definition, the
edges in 1 / x^3, the rise summed over time, the root in 1 / (2 sqrt(kappa G1)).
"""

import numpy as np
import tables
from make_partial_contact import ROAD, SBR, rings
from partial_rule import EDGES, LIGHT, OBSTACLE, TAIL_END, by_inverse, by_kappa, sums
from partial_surface import (
    closed_end,
    closed_moment,
    end_window,
    gauss,
    nodes_on,
    roughness,
    rows_of,
    summed_end,
    summed_moment,
    surface_columns,
)
from scipy.special import erf, erfc, erfcx

C1, C2, REFERENCE = 8.86, 101.6, 293.15
DENSITY, CONDUCTIVITY, DIAMETER = 1200.0, 0.23, 1e-3
RISES = {"heat_capacity": 100.0, "temperature": 263.15}  # long waves are hardly warm else
# a fiftieth of the slope variance, and nearly all of G, beyond 2e4 / m
FAINT = [[1e3, 2e4, 2.1e4, 1e10], [1e-16, 2e-21, 4e-24, 7.8e-47]]
HEAVY = RISES | {"surface": rings(24, 5), "pressure": 5e5, "velocity": 3.0}
SCENES = {
    "road": {"surface": ROAD, "velocity": 10.0},
    "slow road": {"surface": ROAD, "velocity": 1e-3},
    "light road in the cold": {"surface": ROAD, "pressure": 3e3, "temperature": 263.15},
    "rings": HEAVY,
    "rings in a box": HEAVY | {"residence": "box"},
    "blurred rings": RISES | {"surface": rings(24, 6, lambda k: np.exp(-((k / 9) ** 2.0)))},
    "nearly empty rows": RISES | {"surface": rings(24, 1, lambda k: np.where(k > 10, 1e-6, 1.0))},
    "faint rows after a gap": RISES
    | {"surface": rings(28, 7, lambda k: np.where(k > 12, np.where(k > 24, 0.02, 0.0), 1.0))},
    "faint rows that are stiff": RISES | {"surface": FAINT, "pressure": 1e5, "velocity": 0.03},
    "faint rows stiffer with heat": RISES | {"surface": FAINT, "pressure": 1e6, "velocity": 0.3},
    "steep end": {"surface": [[1e3, 1e4, 1e6], [1e-15, 1e-18, 1e-30]], "velocity": 10.0},
    "ramp to zero": {"surface": [[1e3, 1e4, 1e6], [1e-18, 1e-21, 0.0]]},
}
RESULTS = ("hysteresis", "contact_area", "macro_area", "rise_at_end", "rise")
USUAL = {
    "pressure": 1e5,
    "velocity": 1.0,
    "temperature": 293.15,
    "poisson_ratio": 0.5,
    "heat_capacity": 1650.0,
    "residence": "disc",
}


def overlap(share, residence):
    """Return the share of a contact that one so many of its lengths away covers."""
    if residence == "box":
        return np.ones_like(share)
    return 1 - 2 / np.pi * (share * np.sqrt(1 - share * share) + np.arcsin(share))


def time_of(scene):
    """Return the longest time that heat stays in a contact."""
    return DIAMETER / scene["velocity"] / (2 if scene["residence"] == "box" else 1)


def in_root(first):
    """Return nodes and weights in u = sqrt(w) from 0 to 1, graded at both ends."""
    graded = np.concatenate([[0.0], np.geomspace(first, 0.5, 40)])
    edges = np.concatenate([graded, (1 - np.geomspace(1e-6, 0.5, 20)[:-1])[::-1], [1.0]])
    u, weights, _ = nodes_on(edges, gauss(12))
    return u.ravel(), weights.ravel()


def by_closed_kernel(scene, felt, heated):
    """Return g of all pairs by N(x)."""
    time = time_of(scene)
    length = np.sqrt(CONDUCTIVITY / (DENSITY * scene["heat_capacity"]) * time)
    u, weights = in_root(1e-9)
    part = 2 * u * weights * overlap(u * u, scene["residence"])

    def psi(x):
        return erfcx(x[:, None] * u) @ part / x

    def slope(x):  # of N / x
        rise = 2 * x[:, None] * u * erfcx(x[:, None] * u) - 2 / np.sqrt(np.pi)
        return (rise @ (part * u) - psi(x)) / x

    x, y = 2 * length * felt, 2 * length * heated
    with np.errstate(divide="ignore", invalid="ignore"):
        g = (psi(x)[:, None] - psi(y)) / (y**2 - x[:, None] ** 2)
    for i, j in zip(*np.nonzero(np.abs(x[:, None] / y - 1) < 1e-5), strict=True):
        middle = np.array([(x[i] + y[j]) / 2])
        g[i, j] = -slope(middle)[0] / (2 * middle[0])
    return time * x[:, None] ** 2 * y * g


def by_time(scene, felt, heated):
    """Return the same summed over the time since the heat came."""
    time = time_of(scene)
    u, weights = in_root(1e-10)
    part = 2 * u * weights * overlap(u * u, scene["residence"]) * time
    a, b = 2 * felt[:, None], 2 * heated
    length = np.sqrt(CONDUCTIVITY / (DENSITY * scene["heat_capacity"]) * time) * u
    of_a, of_b = (erfcx(2 * q[:, None] * length) @ part for q in (felt, heated))
    with np.errstate(divide="ignore", invalid="ignore"):
        g = a * (b * of_a[:, None] - a * of_b) / (b * b - a * a)
    for i, j in zip(*np.nonzero(np.abs(a / b - 1) < 1e-5), strict=True):
        x = (felt[i] + heated[j]) * length
        g[i, j] = (erfcx(x) - x * (2 * x * erfcx(x) - 2 / np.sqrt(np.pi))) @ part / 2
    return g


def brief_definition(w, _wavenumber):
    """Return I1 and I2 by trapezoids in z, cos(phi) = sech(z)."""
    z, step = np.linspace(0, 42, 421, retstep=True)
    cosine = 1 / np.cosh(z)
    weights = np.where((z == 0) | (z == 42), 0.5, 1.0) * step * 4 * cosine
    storage, loss = tables.prony(w[:, None] * cosine, *SBR.values())
    return (cosine * loss) @ weights, (storage**2 + loss**2) @ weights


def closed(w, _wavenumber):
    """Return I1 and I2 in closed form."""
    return tables.prony_integrals(w, *SBR.values(), sqrt=np.sqrt)


def solve(scene, between, last, integrals, kernel, root, count, growth, longest, in_power):
    """Return hysteresis, area, P_m and the rise at q_e and q1, then forces across of what
    `integrals` has beside I1 and I2: A^(1/8) of R dG.

    Panels end at the scene's `stops` too [1/m], in rising order; `crossed`: the edges over those of
    isotropic roughness.
    """
    q, c = rows_of(scene["surface"])
    at, _, _ = roughness(q, c)
    places = np.log(q)
    pressure, velocity = scene["pressure"], scene["velocity"]
    stiff = 1 / ((1 - scene["poisson_ratio"] ** 2) * pressure)
    start, end = places[0], places[-1]
    macro_wavenumber = scene.get("macro_wavenumber") or 2 * np.pi / DIAMETER
    macro = np.clip(np.log(macro_wavenumber), start, end)
    grown = start + (end - start) * 1e-9 * growth ** np.arange(np.ceil(9 / np.log10(growth)))
    stops = np.log(scene.get("stops", [1.0]))
    edges = [places, places - 1, places + 1, grown, [macro], stops, np.arange(start, end, longest)]
    edges = np.unique(np.concatenate(edges))
    edges = edges[(edges >= start) & (edges <= end)]
    rule = gauss(count)
    y, weights, half = nodes_on(edges, rule)
    i = np.searchsorted(places, (edges[:-1] + edges[1:]) / 2, side="right") - 1
    rough = stiff**2 / 8 * at(y, i[:, None])
    window = stiff**2 / 8 * between(y - 1, y + 1) / 2
    here = np.array([last])
    window_at_end, whole = end_window(between, places, here), between(places[:1], places[-1:])[0]
    beyond = stops[(stops > last) & (stops < last + np.log(TAIL_END))] - last
    if in_power:
        cuts = np.sort([*np.geomspace(TAIL_END**-3, 1, 16), *np.exp(-3 * beyond)])
        u, tail_weights, _ = nodes_on(cuts, rule)
        x, tail_weights = u.ravel() ** (-1 / 3), tail_weights.ravel() / 3
    else:
        cuts = np.sort([*np.linspace(0, np.log(TAIL_END), 12), *beyond])
        z, tail_weights, _ = nodes_on(cuts, rule)
        x, tail_weights = np.exp(z.ravel()), (tail_weights * np.exp(-3 * z)).ravel()
    of_band, of_tail = y.size, x.size
    wavenumber = np.concatenate([np.exp(y.ravel()), np.exp(last) * x, [np.exp(last), q[-1]]])
    heats = wavenumber[: of_band + of_tail]
    g = kernel(scene, wavenumber, heats) * heats

    def integrals_at(theta):
        warm = scene["temperature"] + theta - REFERENCE
        return integrals(velocity * wavenumber * 10 ** (-C1 * warm / (C2 + warm)), wavenumber)

    def below_one(i2):  # 1 - 1 / rho
        whole_g = (rough * i2[:of_band].reshape(y.shape) * weights).sum()
        return 1 - whole_g / (stiff**2 / 8 * whole * i2[-2])

    theta, part, missed = np.zeros(wavenumber.size), 0.6, np.inf
    cold = below_one(integrals_at(theta)[1])
    for _ in range(400):
        i1, i2, *others = integrals_at(theta)
        stiffness = i2[:of_band].reshape(y.shape)
        rate = rough * stiffness
        before = np.cumsum([0.0, *(rate * weights).sum(axis=1)])
        g_here = before[:-1, None] + half * (rate @ rule[2].T)
        on_edges = slice(of_band, of_band + of_tail)
        edge = stiff**2 / 8 * window_at_end * (i2[on_edges] / i2[-2]) ** 0.25 * tail_weights
        edge = edge * scene.get("crossed", 1.0)
        excess = below_one(i2)
        if 0.1 * (1 - excess) > 1:
            excess = min(max(excess, cold), 0.0)
        ratio = i1 / i2
        nodes = (
            g_here,
            rate * weights,
            window * stiffness,
            ratio[:of_band].reshape(y.shape),
            before[-1],
            4 * window_at_end / whole,
            excess,
        )
        tail = (edge * i2[on_edges]).sum(), (edge * i1[on_edges]).sum()
        kappa = root(nodes, tail)
        hysteresis = sums(kappa, nodes, tail)[1] * 4 * pressure * (1 - scene["poisson_ratio"] ** 2)
        # the same node by node
        rest = erfc(0.5 / np.sqrt(kappa * before[-1]))
        share = erf(0.5 / np.sqrt(kappa * np.maximum(g_here, 1e-300)))
        tenth, fourth = (1 - (1 - rest) ** p for p in (0.1, 0.25))
        waves = OBSTACLE * nodes[5] ** 0.2 * kappa**0.25 * rest**0.125 * (1 + LIGHT * tenth**3)
        at_edges = EDGES * (1 - rest) * fourth * max(1.0, 0.1 * (1 - excess))
        stress = nodes[1] * share / (1 + waves * share**2 * nodes[2]) ** 2
        per_i2 = np.concatenate([(stress / stiffness).ravel(), at_edges * edge])
        carried = per_i2 * i1[: per_i2.size]
        tables.agree(
            "hot_partial_contact", carried.sum() / hysteresis * 4 * pressure * 0.75, 1, 1e-11
        )
        at_macro = before[np.searchsorted(edges, macro)]
        macro_area = erf(0.5 / np.sqrt(kappa * at_macro)) if at_macro > 0 else 1.0
        flux = 4 * pressure * (1 - scene["poisson_ratio"] ** 2) * carried
        unit = 2 * velocity * pressure / (DENSITY * scene["heat_capacity"] * macro_area)
        rise = unit * (g @ flux)
        if np.abs(rise - theta).max() <= 1e-12 * rise.max():
            force = 4 * pressure * (1 - scene["poisson_ratio"] ** 2)
            across = per_i2 * np.concatenate([share.ravel() ** 0.125, np.ones(of_tail)])
            beside = (force * (across @ other[: across.size]) for other in others)
            return hysteresis, 1 - rest, macro_area, rise[-2], rise[-1], *beside
        if np.abs(rise - theta).max() > 0.9 * missed:
            part = max(0.1, part / 1.5)
        missed = np.abs(rise - theta).max()
        theta += part * (rise - theta)
    raise AssertionError(("no fixed point", missed, rise.max()))


METHODS = (
    (by_closed_kernel, by_kappa, 12, 2.0, 0.5, False),
    (by_time, by_inverse, 16, 3.0, 0.7, True),
)


def row(case, changes):
    """Return one row, both methods compared."""
    scene = USUAL | changes
    q, c = rows_of(scene["surface"])
    ends = closed_end(q, c), summed_end(q, c)
    moments = closed_moment(q, c), summed_moment(q, c)
    result = [
        solve(scene, *given, *method)
        for *given, method in zip(moments, ends, (closed, brief_definition), METHODS, strict=True)
    ]
    for one, two in zip(*result, strict=True):
        tables.agree("hot_partial_contact", one, two, 1e-11)
    print(
        f"{case:28s}",
        *(f"{x:.10g}" for x in result[0]),
        f"{np.exp(ends[0]) / q[-1]:.3g}",
        flush=True,
    )
    return {
        "case": case,
        **surface_columns(scene["surface"]),
        **SBR,
        **{key: scene[key] for key in USUAL},
        "end": float(np.exp(ends[0])),
        **dict(zip(RESULTS, map(float, result[0]), strict=True)),
        "rtol": 1e-10,
    }


def main():
    """Write hot_partial_contact.csv."""
    comments = [
        "Friction by the rule of PartialContact with the heat that it makes, by the docstring of",
        "make_hot_partial_contact.py in double precision, two methods within rtol / 10. Surfaces",
        "and rubber as in partial_contact.csv, the rubber at 293.15 K, WLF c1 8.86, c2 101.6 K.",
        "Heating: density 1200, conductivity 0.23, contact_diameter 1e-3. No adhesion. end is",
        "q_e, rise_at_end and rise those at q_e and q1.",
        "Units: rms_height m; q0, q1, rolloff, table_wavenumber, end 1/m; table_density m^4;",
        "moduli, pressure Pa; relaxation_times s; velocity m/s; temperature, rises K;",
        "heat_capacity J/(kg K); the rest none.",
    ]
    tables.write("hot_partial_contact", comments, [row(*scene) for scene in SCENES.items()])


if __name__ == "__main__":
    main()
