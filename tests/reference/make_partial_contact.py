"""Area and friction by the rule of PartialContact, from its definition.

The rule is in partial_rule.py, rows and windows of a spectrum in partial_surface.py.
Above the last frequency of a table I1 and I2 keep their last values.
Method one: Gauss panels of 20 nodes that end at every row, a unit of ln q beside every row and
at every frequency of the table, and grow from the front on; windows from closed moments, the end
as y1 - int (M - 0.9 M(q1)) dy / (0.1 M(q1)); closed I1 and I2 (a table's by Gauss rules in z); the
root in ln kappa.
Method two: 28 nodes on other panels, windows by Gauss rules, the end as int y c dy, I1 and I2 by
their definition (a table's by Gauss rules in phi), the tail in 1 / x^3, the root in
1 / (2 sqrt(kappa G1)).
"""

from functools import partial

import numpy as np
import tables
from make_friction_tabulated import sampled
from partial_rule import TAIL_END, by_inverse, by_kappa, sums
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
from rubber_integrals import angular_integrals, prony_integrals
from scipy.special import erf

SBR = {
    "equilibrium_modulus": 1e6,
    "moduli": [1e6, 1e6, 1e6, 1e7, 1e7, 1e7, 3e8, 3e8],
    "relaxation_times": [1e-1, 1e-2, 1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8],
}
SOLID = {"equilibrium_modulus": 3e6, "moduli": [3e9], "relaxation_times": [1e-5]}
ELASTIC = {"equilibrium_modulus": 1e7, "moduli": [], "relaxation_times": []}
ROAD = {"rms_height": 1e-4, "hurst": 0.8, "q0": 2e3, "q1": 1e6, "rolloff": None}


def rings(count, seed, levels=lambda k: 1.0):
    """Return wavenumbers and densities of rings whose means scatter, times `levels` of them."""
    k = np.arange(4, 4 + count)
    scatter = 1 + np.random.default_rng(seed).standard_normal(count) / np.sqrt(np.pi * k)
    density = 1.4e-16 * (k / 4) ** -3.7 * scatter * levels(k)
    return [[float(f"{v:.6g}") for v in column] for column in (500.0 * k, density)]


LINES = np.array([11, 23, 24, 40])
SCENES = {
    "light": {"pressure": 1e3},
    "very light": {"pressure": 1e-2, "velocity": 1e-5},
    "front as wide as the band": {"pressure": 5e5},
    "heavy": {"pressure": 2e7},
    "complete": {"pressure": 1e9},
    "slow": {"velocity": 1e-7, "pressure": 3e5},
    "fast": {"velocity": 10.0, "pressure": 3e5},
    "one relaxation": {"rubber": SOLID, "pressure": 1e5, "velocity": 1e-2},
    "one steep relaxation": {"rubber": SOLID, "pressure": 1e6, "velocity": 1e-1},
    "elastic": {"rubber": ELASTIC},
    "roll-off": {"surface": {**ROAD, "rolloff": 9e3}, "poisson_ratio": 0.3},
    "steep spectrum": {"surface": {**ROAD, "hurst": 1.0, "q1": 1e5}, "pressure": 1e4},
    "rough spectrum": {"surface": {**ROAD, "hurst": 0.3, "q1": 1e5, "rms_height": 1e-5}},
    "band of half a unit": {"surface": {**ROAD, "q1": 3.2e3}, "pressure": 1e4},
    "band of one and a half": {"surface": {**ROAD, "q1": 9e3}, "pressure": 2e4},
    "rings": {"surface": rings(60, 1), "pressure": 5e4, "velocity": 1e-2},
    "light rings": {"surface": rings(60, 1), "pressure": 10.0, "velocity": 1e-4},
    "heavy rings": {"surface": rings(60, 1), "pressure": 1e6, "velocity": 1e-3},
    "levels": {"surface": rings(48, 2, lambda k: 1000.0 ** (k // 8 % 2)), "pressure": 1e5},
    "lines": {"surface": rings(48, 3, lambda k: np.where(np.isin(k, LINES), 1e3, 1.0))},
    "zero rows": {"surface": rings(40, 4, lambda k: (k > 6) & ((k < 15) | (k > 19)))},
    "blurred rings": {
        "surface": rings(60, 6, lambda k: np.exp(-((k / 16) ** 2.0))),
        "pressure": 3e3,
    },
    "nearly empty rows": {"surface": rings(60, 1, lambda k: np.where(k > 20, 1e-6, 1.0))},
    "faint rows after a gap": {
        "surface": rings(60, 7, lambda k: np.where(k > 15, np.where(k > 40, 0.02, 0.0), 1.0)),
        "pressure": 1e5,
    },
    "steep end": {"surface": [[1e3, 1e4, 1e6], [1e-15, 1e-18, 1e-30]], "pressure": 2e4},
    "ramp to zero": {"surface": [[1e3, 1e4, 1e6], [1e-15, 1e-18, 0.0]], "pressure": 1e5},
    "stiff beyond the end": {
        "surface": [[1e3, 4e3, 4.1e3, 1e6], [1e-15, 3.9e-18, 3.5e-20, 1e-29]],
        "rubber": SOLID,
        "velocity": 0.1,
        "pressure": 1e5,
    },
    "stiff rows beyond the end": {
        "surface": [[1e3, 4e3, 4.1e3, 1e6], [1e-15, 3.9e-18, 3.5e-25, 1e-34]],
        "rubber": SOLID,
        "velocity": 0.1,
        "pressure": 1e4,
    },
    "two rows": {"surface": [[1e3, 4e4], [1e-15, 1e-21]], "pressure": 3e4},
    "table": {"table": sampled(-4, 10, 5), "velocity": 1e-3},
    "light table": {"table": sampled(-4, 10, 5), "velocity": 1e-3, "pressure": 1e3},
    "table on rings": {
        "table": sampled(-4, 10, 5),
        "surface": rings(40, 5),
        "velocity": 1e-2,
        "pressure": 5e4,
    },
    "table that ends in the tail": {"table": sampled(-4, 7, 5), "velocity": 4.0, "pressure": 1e6},
    "table that ends at q1": {"table": sampled(-4, 6, 3), "velocity": 1.0, "pressure": 1e6},
}
RESULTS = ("g", "kappa", "contact_area", "hysteresis")
USUAL = {"surface": ROAD, "rubber": SBR, "pressure": 2e5, "velocity": 1e-2, "poisson_ratio": 0.5}


def held(integrals, highest):
    """Return I1, I2 of frequencies that are held at `highest`."""
    return lambda w: integrals(np.minimum(w, highest * (1 - 1e-15)))


def band(scene, integrals, between, last, rule, first, growth, longest):
    """Return G, its weights, g' and I1 / I2 on the band, G(q1), 4 c_e / M, 1 - 1 / rho."""
    q, c = rows_of(scene["surface"])
    at, _, _ = roughness(q, c)
    places = np.log(q)
    stiff = 1 / ((1 - scene["poisson_ratio"] ** 2) * scene["pressure"])
    rough = np.flatnonzero((c[:-1] > 0) | (c[1:] > 0))[0]
    start, end = places[rough], places[-1]
    grown = start + (end - start) * first * growth ** np.arange(
        np.ceil(-np.log(first) / np.log(growth))
    )
    knots = np.log(np.array(scene.get("table", [[]])[0]) / scene["velocity"])
    edges = [places, places - 1, places + 1, grown, knots, np.arange(start, end, longest)]
    edges = np.unique(np.concatenate(edges))
    edges = edges[(edges > start) & (edges < end)]
    edges = np.concatenate([[start], edges, [end]])
    y, weights, half = nodes_on(edges, rule)
    i = np.searchsorted(places, (edges[:-1] + edges[1:]) / 2, side="right") - 1
    i1, i2 = integrals(scene["velocity"] * np.exp(y))
    rate = stiff**2 / 8 * at(y, i[:, None]) * i2
    whole = (rate * weights).sum(axis=1)
    before = np.cumsum([0.0, *whole])
    g = before[:-1, None] + half * (rate @ rule[2].T)
    steepness = stiff**2 / 8 * i2 * between(y - 1, y + 1) / 2
    last = np.array([last])
    window, whole = end_window(between, places, last), between(places[:1], places[-1:])[0]
    at_end = stiff**2 / 8 * whole * integrals(scene["velocity"] * np.exp(last))[1][0]
    return (
        g,
        rate * weights,
        steepness,
        i1 / i2,
        before[-1],
        4 * window / whole,
        1 - before[-1] / at_end,
    )


def tail_sums(scene, integrals, between, last, in_power):
    """Return int K c_w I (I2 / I2(v q_e))^0.25 x^-3 dln x for I2 and I1, in ln x or in x^-3."""
    q_e = np.exp(last)
    knots = np.array(scene.get("table", [[]])[0]) / (scene["velocity"] * q_e)
    knots = knots[(knots >= 1) & (knots <= TAIL_END)]
    if in_power:
        edges = np.unique([*np.geomspace(TAIL_END**-3, 1, 60), *knots**-3.0])
        u, weights, _ = nodes_on(edges, gauss(28))
        x, weights = u ** (-1 / 3), weights / 3
    else:
        edges = np.unique([*np.linspace(0, np.log(TAIL_END), 40), *np.log(knots)])
        z, weights, _ = nodes_on(edges, gauss(20))
        x, weights = np.exp(z), weights * np.exp(-3 * z)
    i1, i2 = integrals(scene["velocity"] * q_e * x)
    stiff = 1 / ((1 - scene["poisson_ratio"] ** 2) * scene["pressure"])
    excess = (i2 / integrals(np.array([scene["velocity"] * q_e]))[1]) ** 0.25
    places, end = np.log(rows_of(scene["surface"])[0]), np.array([last])
    factor = stiff**2 / 8 * end_window(between, places, end) * excess * weights
    return (factor * i2).sum(), (factor * i1).sum()


tail_in_logarithm = partial(tail_sums, in_power=False)
tail_in_power = partial(tail_sums, in_power=True)


def row(case, changes):
    """Return one row, both methods compared."""
    scene = USUAL | changes
    table = scene.get("table")
    first, second = angular_integrals(table) if table else prony_integrals(scene["rubber"])
    highest = table[0][-1] if table else np.inf
    first, second = held(first, highest), held(second, highest)
    q, c = rows_of(scene["surface"])
    moments, summed = closed_moment(q, c), summed_moment(q, c)
    ends = closed_end(q, c), summed_end(q, c)
    tables.agree("partial_contact", *ends, 1e-13)
    result = []
    for nodes, tail, root in (
        (
            band(scene, first, moments, ends[0], gauss(20), 1e-12, 1.5, 0.5),
            tail_in_logarithm(scene, first, moments, ends[0]),
            by_kappa,
        ),
        (
            band(scene, second, summed, ends[1], gauss(28), 1e-13, 1.7, 0.37),
            tail_in_power(scene, second, summed, ends[1]),
            by_inverse,
        ),
    ):
        kappa = root(nodes, tail)
        share = erf(0.5 / np.sqrt(kappa * nodes[4]))
        friction = sums(kappa, nodes, tail)[1] * 4 * (1 - scene["poisson_ratio"] ** 2)
        result.append((nodes[4], kappa, share, friction * scene["pressure"]))
    for one, two in zip(*result, strict=True):
        tables.agree("partial_contact", one, two, 1e-12)
    print(f"{case:28s}", " ".join(f"{x:.10g}" for x in result[0]), flush=True)
    return {
        "case": case,
        **surface_columns(scene["surface"]),
        **(dict.fromkeys(SBR) if table else scene["rubber"]),
        **tables.table_columns(table),
        **{key: scene[key] for key in ("pressure", "velocity", "poisson_ratio")},
        **dict(
            zip(("g", "kappa", "contact_area", "hysteresis"), map(float, result[0]), strict=True)
        ),
        "rtol": 1e-10,
    }


def main():
    """Write partial_contact.csv."""
    comments = [
        "Contact area and hysteretic friction by the rule of PartialContact (see its docstring);",
        "surfaces and rubbers as in friction.csv, friction_measured.csv, friction_tabulated.csv.",
        "Generated by make_partial_contact.py in double precision, two methods within rtol / 100.",
        "Units: rms_height m; q0, q1, rolloff, table_wavenumber 1/m; table_density m^4; moduli,",
        "table_storage, table_loss, pressure Pa; relaxation_times s; table_frequency rad/s;",
        "velocity m/s; the rest none.",
    ]
    tables.write("partial_contact", comments, [row(*scene) for scene in SCENES.items()])


if __name__ == "__main__":
    main()
