"""Friction of elliptic spectra by direction, with strain factors and the heat that it makes.

The rule of PartialContact as in make_hot_partial_contact.py with sums over the plane in the place
of I1 and I2: a_T(T0 + theta(q)) shifts w first, then f and g of eps(q) (make_strain.py; h'(q) is
that of all directions) scale E' and E'', so that int |E|^2 C dphi is f^2 of what E' has of it plus
g^2 of what E'' has; the force across is summed over A^(1/8) of R dG and over T. Circles by both
methods of make_direction.py. Scenes without heat have no kernel.
"""

from functools import cache

import make_hot_partial_contact as hot
import numpy as np
import tables
from make_direction import (
    LAY,
    SURFACE,
    circle_in_phi,
    circle_in_z,
    crossed_edges,
    modulus_of,
    shape_of,
)
from make_partial_contact import SBR
from make_strain import PAYNE, softened
from numpy.polynomial.chebyshev import chebfit, chebval
from partial_rule import by_inverse, by_kappa
from partial_surface import closed_end, closed_moment, rows_of, summed_end, summed_moment

ROAD = {**SURFACE, "rolloff": None}
ONES = {"strain": [0.0], "storage": [1.0], "loss": [1.0], "strain_per_slope": 0.5}
SCENES = [
    (strain, heat, ratio, angle, velocity)
    for strain, heat in ((True, False), (False, True), (True, True))
    for ratio, angle in ((2.0, 30), (3.0, 75))
    for velocity in (1e-2, 3.0)
]


def no_kernel(_scene, felt, heated):
    """Return no heat at all."""
    return np.zeros((felt.size, heated.size))


def plane_of(circle, ratio, angle):
    """Return w -> sums of Im E cos, of (Re E)^2, of (Im E)^2 and of Im E sin over C / <C>."""
    modulus, knots = modulus_of("prony")
    shape = shape_of(ratio, angle)

    def at(w):
        result = np.empty((4, w.size))
        for i, one in enumerate(w.ravel()):
            phi, weight, cosine = circle(one, knots)
            storage, loss = modulus(one * cosine)
            ahead, behind = 2 * weight * shape(phi), 2 * weight * shape(-phi)
            even, odd = ahead + behind, ahead - behind
            result[:, i] = (
                (cosine * loss) @ even,
                storage**2 @ even,
                loss**2 @ even,
                (np.sin(phi) * loss) @ odd,
            )
        return result.reshape(4, *w.shape)

    return at


@cache
def tabled(circle, ratio, angle):
    """Return the same by Chebyshev's polynomials of ln w on panels of half a unit: 1e-13 of it."""
    plane, length, order = plane_of(circle, ratio, angle), 0.5, 18
    lowest, panels = np.log(1e-6), 80
    points = np.cos(np.pi * (np.arange(order) + 0.5) / order)
    log_w = lowest + length * (np.arange(panels)[:, None] + (points + 1) / 2)
    values = plane(np.exp(log_w)).reshape(4 * panels, order)
    series = chebfit(points, values.T, order - 1).reshape(order, 4, panels)

    def at(w):
        place = (np.log(w).ravel() - lowest) / length
        panel = np.floor(place).astype(int)
        assert panel.min() >= 0
        assert panel.max() < panels
        of = series[:, :, panel]
        return chebval(2 * (place - panel) - 1, of, tensor=False).reshape(4, *w.shape)

    return at


def row(strain, heat, ratio, angle, velocity):
    """Return one row, both methods compared."""
    factors = PAYNE if strain else ONES
    scene = hot.USUAL | {"surface": ROAD, "factors": factors, "velocity": velocity}
    q, c = rows_of(scene["surface"])
    results = []
    for circle, between, end, kernel, rest in zip(
        (circle_in_z, circle_in_phi),
        (closed_moment(q, c), summed_moment(q, c)),
        (closed_end(q, c), summed_end(q, c)),
        (hot.by_closed_kernel, hot.by_time) if heat else (no_kernel, no_kernel),
        ((by_kappa, 12, 2.0, 0.5, False), (by_inverse, 16, 3.0, 0.7, True)),
        strict=True,
    ):
        plane = tabled(circle, ratio, angle)
        _, kinks = softened(scene, plane, between, np.log(q))

        def integrals(w, wavenumber, plane=plane, between=between):
            along, of_storage, of_loss, across = plane(w)

            def soft(first):
                parts = first, of_storage, of_loss
                return softened(scene, lambda _: parts, between, np.log(q))[0](w, wavenumber)

            return *soft(along), soft(across)[0]

        edges = {
            "stops": np.unique([*kinks, *q]),
            "crossed": crossed_edges(shape_of(ratio, angle)),
        }
        results.append(hot.solve(scene | edges, between, end, integrals, kernel, *rest))
    for one, two in zip(*results, strict=True):
        tables.agree("direction_hot", float(one), float(two), 1e-9)
    case = f"{'strain ' * strain}{'heat ' * heat}{ratio:g} {angle} deg {velocity:g} m/s"
    print(case, *(f"{x:.8g}" for x in results[0]), flush=True)
    mu, area, macro_area, _, rise, lateral = (float(x) for x in results[0])
    return {
        "case": case,
        **SURFACE,
        "axis_ratio": ratio,
        "lay_deg": LAY,
        "direction_deg": LAY + angle,
        **SBR,
        **factors,
        "heated": float(heat),
        **{key: scene[key] for key in hot.USUAL if key != "residence"},
        "mu": mu,
        "lateral": lateral,
        "contact_area": area,
        "macro_area": macro_area,
        "rise": rise,
        "rtol": 1e-7,
    }


def main():
    """Write direction_hot.csv."""
    comments = [
        "Friction of elliptic spectra by direction with strain factors and heat, by the rule of",
        "PartialContact (make_direction_hot.py), two methods within rtol / 100. heated: 0 without",
        "heat, then rise is 0. Rubber, heating and units as in hot_partial_contact.csv.",
    ]
    tables.write("direction_hot", comments, [row(*scene) for scene in SCENES])


if __name__ == "__main__":
    main()
