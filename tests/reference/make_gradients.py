"""Slopes of hysteretic friction, as differences of friction from its definition.

Friction as in make_partial_contact.py, by the rule of PartialContact and by Persson's P with S of
Eq. 8. One number of the scene at a time, or one row of a table, is changed by exp(h) and exp(-h);
method one is the central difference at h, freed of its error in h^2 by that at 2 h, method two the
same at h / 2.
"""

import copy

import numpy as np
import tables
from make_friction_tabulated import angular_integrals, sampled
from make_partial_contact import (
    ROAD,
    SBR,
    USUAL,
    band,
    held,
    prony_integrals,
    rings,
    tail_in_logarithm,
)
from partial_rule import by_kappa, sums
from partial_surface import closed_end, closed_moment, gauss, rows_of
from scipy.special import erf

ROLLED = {**ROAD, "rolloff": 9e3}
SCENES = {
    "law": {"surface": ROLLED},
    "heavy law": {"surface": {**ROAD, "q1": 1e5}, "pressure": 1e7, "velocity": 1.0},
    "rings": {"surface": rings(60, 1), "pressure": 5e4},
    "few rows": {"surface": [[1e3, 1e4, 5e4, 1e6], [1e-15, 1e-18, 3e-21, 1e-26]]},
    "table": {"table": sampled(-4, 10, 2), "velocity": 1e-3},
    "table on rings": {"table": sampled(-4, 10, 3), "surface": rings(40, 5), "pressure": 5e4},
}
ROWS = 2  # of each table


def friction(scene, gamma):
    """Return mu_H; gamma None: by the rule of PartialContact."""
    table = scene.get("table")
    integrals = angular_integrals(table)[0] if table else prony_integrals(scene["rubber"])[0]
    integrals = held(integrals, table[0][-1] if table else np.inf)
    q, c = rows_of(scene["surface"])
    moments, end = closed_moment(q, c), closed_end(q, c)
    nodes = band(scene, integrals, moments, end, gauss(20), 1e-12, 1.5, 0.5)
    factor = 4 * (1 - scene["poisson_ratio"] ** 2) * scene["pressure"]
    if gamma is None:
        tail = tail_in_logarithm(scene, integrals, moments, end)
        return factor * sums(by_kappa(nodes, tail), nodes, tail)[1]
    g, weights, _, ratio = nodes[:4]
    share = erf(0.5 / np.sqrt(np.maximum(g, 1e-300)))
    return factor * (weights * ratio * share * (gamma + (1 - gamma) * share**2)).sum()


def numbers(scene):
    """Return the names of all that is changed, with where it stands in the scene."""
    yield "pressure", ("pressure",)
    yield "velocity", ("velocity",)
    if isinstance(scene["surface"], dict):
        for name, found in scene["surface"].items():
            if found is not None:
                yield name, ("surface", name)
    else:
        for k in places(scene["surface"][0]):
            yield f"spectrum {k}", ("surface", 1, k)
    if "table" in scene:
        for k in places(scene["table"][0]):
            yield f"storage {k}", ("table", 1, k)
            yield f"loss {k}", ("table", 2, k)
    else:
        yield "equilibrium_modulus", ("rubber", "equilibrium_modulus")
        for k in places(scene["rubber"]["moduli"]):
            yield f"moduli {k}", ("rubber", "moduli", k)
            yield f"relaxation_times {k}", ("rubber", "relaxation_times", k)


def places(rows):
    """Return numbers of rows inside of a table."""
    return sorted({round(k) for k in np.linspace(0, len(rows) - 1, ROWS + 2)[1:-1]})


def changed(scene, path, factor):
    """Return the scene with one number times a factor."""
    result = copy.deepcopy(scene)
    at = result
    for key in path[:-1]:
        at = at[key]
    at[path[-1]] *= factor
    return result


def slope(mu, h):
    """Return d mu / dx at 0 of a function mu(x)."""
    at = [mu(k * h) for k in (-2, -1, 1, 2)]
    near, far = (at[2] - at[1]) / (2 * h), (at[3] - at[0]) / (4 * h)
    return (4 * near - far) / 3


def scene_rows(case, changes):
    """Return the rows of a scene, the correction and all its numbers."""
    scene = USUAL | changes
    if "table" in scene:
        scene = {key: part for key, part in scene.items() if key != "rubber"}
    for model, gamma in (("partial-contact", None), ("none", 1.0), ("s-factor", 0.5)):
        mu = friction(scene, gamma)
        for name, path in numbers(scene):
            # the interpolant of a table has kinks over its rows
            h = 1e-3 if path[0] == "table" else 1e-2
            first, second = (
                slope(lambda x: friction(changed(scene, path, np.exp(x)), gamma), step)  # noqa: B023
                for step in (h, h / 2)
            )
            tables.agree("gradients", first, second, 1e-5, scale=mu)
            law = isinstance(scene["surface"], dict)
            rough = (None, None) if law else scene["surface"]
            yield {
                "case": f"{case}, {model}, {name}",
                **(scene["surface"] if law else dict.fromkeys(ROAD)),
                **dict(zip(("table_wavenumber", "table_density"), rough, strict=True)),
                **scene.get("rubber", dict.fromkeys(SBR)),
                **dict(
                    zip(
                        ("table_frequency", "table_storage", "table_loss"),
                        scene.get("table", (None, None, None)),
                        strict=True,
                    )
                ),
                **{key: scene[key] for key in ("pressure", "velocity", "poisson_ratio")},
                "mu": mu,
                "slope": second,
                "rtol": 1e-5,
            }


def main():
    """Write gradients.csv."""
    comments = [
        "Slopes d mu / d ln of one number or row of a scene, the hysteresis alone, by the rule of",
        "PartialContact, without correction and with the S of Eq. 8 (gamma 0.5).",
        "Generated by make_gradients.py in double precision, two steps within rtol of mu.",
        "Units: as in partial_contact.csv; slopes have none.",
    ]
    tables.write("gradients", comments, [r for scene in SCENES.items() for r in scene_rows(*scene)])


if __name__ == "__main__":
    main()
