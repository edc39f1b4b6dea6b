"""Area and friction of a rubber that the strain of each magnification softens, from the definition.

E'(w, q) = f(eps(q)) E'(w), E''(w, q) = g(eps(q)) E''(w), eps(q) = strain_per_slope h'(q), h'(q)^2 =
2 pi int_q0^q k^3 C dk, which stays beyond q1; f and g are linear in eps between their rows, 1 at 0
and constant beyond the last. So I1 -> g I1 and I2 -> f^2 I2' + g^2 I2'', the integrals of Re E^2
and Im E^2. Without correction (Persson), with S = gamma + (1 - gamma) P^2 in Eq. 22, and by the
rule of PartialContact (partial_rule.py).
Both methods are those of make_partial_contact.py, with panels that end where eps(q) passes a row.
The first has I2'' of a Prony series in closed form, the second by its definition; I2' of a table
is (I2 of 2 E' + i E'' less I2) / 3.
"""

import make_hot_partial_contact as hot
import numpy as np
import tables
from make_friction_tabulated import sampled
from make_partial_contact import ROAD, SBR, band, rings, tail_in_logarithm, tail_in_power
from partial_rule import by_inverse, by_kappa, sums
from partial_surface import (
    closed_end,
    closed_moment,
    gauss,
    rows_of,
    summed_end,
    summed_moment,
    surface_columns,
)
from rubber_integrals import angular_integrals, prony_parts
from scipy.optimize import brentq
from scipy.special import erf

PAYNE = {
    "strain": [0.0, 0.001, 0.01, 0.1, 0.3, 0.6],
    "storage": [1.0, 0.95, 0.75, 0.45, 0.34, 0.30],
    "loss": [1.0, 1.1, 1.25, 0.8, 0.5, 0.41],
    "strain_per_slope": 0.5,
}
LATE = {  # the first row lies above 0, the last below the strain of the roughness
    "strain": [0.02, 0.1],
    "storage": [0.8, 0.6],
    "loss": [0.7, 0.65],
    "strain_per_slope": 0.7,
}
TABLE = sampled(-6, 10, 4)
SURFACES = {
    "closed form": ROAD,
    "roll-off": {**ROAD, "rolloff": 9e3},
    "rings": rings(60, 1),
    "rows": [[1e3, 4e3, 2e4, 5e5], [1e-15, 3e-17, 4e-20, 3e-25]],
}
GAMMA = 0.5


def loss_squared(w, rubber):
    """Return int (Im E)^2 over all directions, in closed form: partial fractions over pairs."""
    sum_ = 0 * w
    modes = list(zip(rubber["moduli"], rubber["relaxation_times"], strict=True))
    for e, tau in modes:
        for f, rho in modes:
            r, s = np.sqrt(1 + (w * tau) ** 2), np.sqrt(1 + (w * rho) ** 2)
            sum_ += e * f * (w * tau) * (w * rho) / (r * s * (r + s))
    return 2 * np.pi * sum_


def prony(rubber):
    """Return w -> (I1, I2', I2'') closed, and by trapezoids in z, cos(phi) = sech(z)."""

    def closed(w):
        i1, i2 = tables.prony_integrals(w, *rubber.values(), sqrt=np.sqrt)
        of_loss = loss_squared(w, rubber)
        return i1, i2 - of_loss, of_loss

    return closed, prony_parts(rubber)


def tabulated(table):
    """Return the same of a table: by Gauss rules in z, and in phi."""
    w, storage, loss = table
    doubled = angular_integrals([w, [2 * e for e in storage], loss])

    def split(once, twice):
        def at(w):
            i1, i2 = once(w)
            of_storage = (twice(w)[1] - i2) / 3
            return i1, of_storage, i2 - of_storage

        return at

    return [split(*pair) for pair in zip(angular_integrals(table), doubled, strict=True)]


def softened(scene, integrals, between, places):
    """Return w, q -> (I1, I2), and the q at which eps passes a row."""
    factors = scene["factors"]
    strain, f, g = (np.array(factors[k]) for k in ("strain", "storage", "loss"))
    if strain[0] > 0:
        strain, f, g = (np.concatenate([[at], v]) for at, v in ((0, strain), (1, f), (1, g)))

    def eps(y):
        y = np.minimum(y, places[-1])
        square = between(np.full_like(y, places[0]), y)
        return factors["strain_per_slope"] * np.sqrt(2 * np.pi * np.maximum(square, 0))

    def at(w, wavenumber):
        i1, of_storage, of_loss = integrals(w)
        here = eps(np.log(wavenumber))
        softer, less = np.interp(here, strain, f), np.interp(here, strain, g)
        return less * i1, softer**2 * of_storage + less**2 * of_loss

    last = eps(places[-1:])[0]
    kinks = [
        np.exp(brentq(lambda y, s=s: eps(np.array([y]))[0] - s, *places[[0, -1]], xtol=1e-15))
        for s in strain
        if 0 < s < last
    ]
    return at, kinks


def solved(scene, integrals, moments, end, rule, panels, tail, root):
    """Return G, kappa, areas and hysteresis without correction, with S, and by the rule."""
    places = np.log(rows_of(scene["surface"])[0])
    of_waves, kinks = softened(scene, integrals, moments, places)

    def at(w):
        return of_waves(w, w / scene["velocity"])

    knots = scene["velocity"] * np.array(
        [*kinks, *np.exp(places)]
    )  # eps changes its formula at rows
    scene = scene | {"table": [sorted([*(scene["table"] or [[]])[0], *knots])]}
    nodes = band(scene, at, moments, end, gauss(rule), *panels)
    g, weights, _, ratio, g1 = nodes[:5]
    beyond = tail(scene, at, moments, end)
    kappa = root(nodes, beyond)
    factor = 4 * (1 - scene["poisson_ratio"] ** 2) * scene["pressure"]
    share = erf(0.5 / np.sqrt(np.maximum(g, 1e-300)))
    with_s = share * (GAMMA + (1 - GAMMA) * share**2)
    return {
        "g": g1,
        "kappa": kappa,
        "area": erf(0.5 / np.sqrt(g1)),
        "area_partial": erf(0.5 / np.sqrt(kappa * g1)),
        "hysteresis": factor * (weights * ratio * share).sum(),
        "hysteresis_s": factor * (weights * ratio * with_s).sum(),
        "hysteresis_partial": factor * sums(kappa, nodes, beyond)[1],
    }


HOT = {
    "road": {"surface": ROAD, "velocity": 10.0},
    "slow road": {"surface": ROAD, "velocity": 1e-2},
    "cold road": {"surface": ROAD, "velocity": 3.0, "temperature": 263.15},
    "rings": {**hot.HEAVY, "factors": LATE},
    "light rings": {**hot.HEAVY, "pressure": 3e4},
}


def hot_row(case, changes):
    """Return one row of strain_hot.csv, with the heat that friction makes, by PartialContact."""
    scene = hot.USUAL | {"factors": PAYNE} | changes
    q, c = rows_of(scene["surface"])
    results = []
    for integrals, between, end, rest in zip(
        prony(SBR),
        (closed_moment(q, c), summed_moment(q, c)),
        (closed_end(q, c), summed_end(q, c)),
        hot.METHODS,
        strict=True,
    ):
        at, kinks = softened(scene, integrals, between, np.log(q))
        stops = {"stops": np.unique([*kinks, *q])}
        results.append(hot.solve(scene | stops, between, end, at, *rest))
    for one, two in zip(*results, strict=True):
        tables.agree("strain_hot", one, two, 1e-10)
    print(f"{case:44s}", " ".join(f"{x:.6g}" for x in results[0]), flush=True)
    return {
        "case": case,
        **surface_columns(scene.pop("surface")),
        **SBR,
        **scene.pop("factors"),
        **scene,
        **dict(zip(hot.RESULTS, map(float, results[0]), strict=True)),
        "rtol": 1e-8,
    }


def row(case, scene):
    """Return one row, both methods compared."""
    surface, table = scene["surface"], scene["table"]
    first, second = tabulated(table) if table else prony(SBR)
    q, c = rows_of(surface)
    one = solved(
        scene, first, closed_moment(q, c), closed_end(q, c), 20, (1e-12, 1.5, 0.5),
        tail_in_logarithm, by_kappa,
    )  # fmt: skip
    two = solved(
        scene, second, summed_moment(q, c), summed_end(q, c), 28, (1e-13, 1.7, 0.37),
        tail_in_power, by_inverse,
    )  # fmt: skip
    for name, value in one.items():
        tables.agree("strain", value, two[name], 1e-11)
    print(f"{case:44s}", " ".join(f"{x:.6g}" for x in one.values()), flush=True)
    return {
        "case": case,
        **surface_columns(surface),
        **(dict.fromkeys(SBR) if table else SBR),
        **tables.table_columns(table),
        **scene["factors"],
        **{key: scene[key] for key in ("pressure", "velocity", "poisson_ratio")},
        **{name: float(value) for name, value in one.items()},
        "rtol": 1e-9,
    }


def main():
    """Write strain.csv."""
    comments = [
        "Contact area and hysteretic friction with the strain of each magnification (docstring of",
        "the script): none, S of gamma = 0.5 in Eq. 22 (_s), PartialContact (_partial).",
        "Surfaces and rubbers as in partial_contact.csv; strain, storage, loss: rows of f and g.",
        "Generated by make_strain.py in double precision, two methods within rtol / 100.",
        "Units: rms_height m; q0, q1, rolloff, table_wavenumber 1/m; table_density m^4; moduli,",
        "table_storage, table_loss, pressure Pa; relaxation_times s; table_frequency rad/s;",
        "velocity m/s; the rest none.",
    ]
    rows = []
    for name, surface in SURFACES.items():
        for rubber, table in (("series", None), ("table", TABLE)):
            for pressure in (1e4, 3e5):
                for velocity in (1e-5, 1e-2, 1.0):
                    factors = LATE if name in ("roll-off", "rows") else PAYNE
                    scene = {
                        "surface": surface,
                        "table": table,
                        "factors": factors,
                        "pressure": pressure,
                        "velocity": velocity,
                        "poisson_ratio": 0.5 if velocity < 1 else 0.48,
                    }
                    rows.append(row(f"{name}, {rubber}, {pressure:g} Pa, {velocity:g} m/s", scene))
    tables.write("strain", comments, rows)
    comments = [
        "The same with the heat that friction makes, by PartialContact: a_T shifts w first, then f",
        "and g of the strain. Heat and units as in hot_partial_contact.csv, two methods within",
        "rtol / 100.",
    ]
    tables.write("strain_hot", comments, [hot_row(*scene) for scene in HOT.items()])


if __name__ == "__main__":
    main()
