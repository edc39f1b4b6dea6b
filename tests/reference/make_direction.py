"""Friction of elliptic spectra by direction: plane sums from the definition.

With x along the velocity, phi the angle of q from it, k = q sqrt(r cos^2(phi - lay) + sin^2(phi -
lay) / r) and C(q, phi) ~ k^(-2 - 2 H) on q0 < q < q1,
  G(q) = 1/8 int_{|q'| < q} d^2q' q'^2 C |E(q'_x v)|^2 / ((1 - nu^2) sigma0)^2,
  mu_i = 1/2 int d^2q q q_i C W Im E(q_x v) / ((1 - nu^2) sigma0), i = x: drag, y: across,
with W = erf(1 / (2 sqrt G)), or the stress of PartialContact's rule (partial_rule.py), in which I2
is that of the plane, int |E|^2 C dphi / mean C, and c the mean over directions; beyond q_e C has
the shape that it has there, and T is times (h_r / h_c)^(0.4 cos^2), the rms slopes along the ridges
and across them and the angle of the velocity to the way across; the force across has A^(1/8) of
R dG.
Method one: Gauss rules in z, cos(phi) = sech(z), between the frequencies of a table; method two:
in phi, other panels in ln q and another search for kappa, as in make_partial_contact.py.
"""

import numpy as np
import tables
from make_friction_tabulated import sampled
from make_partial_contact import SBR
from partial_rule import TAIL_END, by_inverse, by_kappa, sums
from partial_surface import (
    closed_end,
    closed_moment,
    end_window,
    gauss,
    nodes_on,
    summed_end,
    summed_moment,
)
from scipy.special import erf
from steffen import Table

SURFACE = {"rms_height": 1e-4, "hurst": 0.8, "q0": 2e3, "q1": 1e6}
CURVE = sampled(-4, 10, 3)
RUBBERS = {"prony": SBR, "curve": CURVE}
RATIOS, ANGLES = (1.0, 2.0, 3.0, 6.0), (0, 15, 30, 45, 60, 75, 90)
CONDITIONS = {"prony": ((1e-4, 2e5), (0.1, 1e6)), "curve": ((1e-3, 5e4), (1.0, 2e6))}
LAY = 20.0  # degrees
POISSON = 0.5


def circle_in_z(w, knots):
    """Return phi in (0, pi / 2) and weights of int dphi, for one frequency."""
    inside = knots[(knots < w) & (knots > 0)]
    cuts = 2 * np.arcsinh(np.sqrt((w - inside) / (2 * inside)))
    edges = np.unique(np.concatenate([np.arange(0.0, 44.0, 0.2), cuts]))
    z, weights, _ = nodes_on(edges, gauss(16))
    return np.arctan(np.sinh(z)).ravel(), (weights / np.cosh(z)).ravel(), (1 / np.cosh(z)).ravel()


def circle_in_phi(w, knots):
    """Return the same by rules in psi = pi / 2 - phi that grow from 0 on."""
    inside = knots[(knots < w) & (knots > 0)]
    cuts = np.arctan2(inside, np.sqrt((w - inside) * (w + inside)))
    grown = np.concatenate([[0.0], np.pi / 2 * 1.6 ** -np.arange(0.0, 90.0)])
    edges = np.unique(np.concatenate([grown, cuts, np.linspace(0.2, 1.5, 14)]))
    psi, weights, _ = nodes_on(edges, gauss(20))
    return np.pi / 2 - psi.ravel(), (np.ones_like(psi) * weights).ravel(), np.sin(psi).ravel()


def modulus_of(rubber):
    """Return the modulus as a function of the frequency, and its knots."""
    if isinstance(rubber, dict):
        return lambda w: tables.prony(w, *rubber.values()), np.array([])
    knots, curve = np.array(rubber[0]), Table(*rubber)
    x, cubics = np.log(knots), [np.array(c, dtype=float) for c in curve.cubics]

    def modulus(w):
        i = np.clip(np.searchsorted(knots, w, side="right") - 1, 0, len(knots) - 2)
        t = np.log(np.maximum(w, knots[0])) - x[i]
        storage, loss = (np.exp(sum(c[i, k] * t**k for k in range(4))) for c in cubics)
        return storage, loss * np.minimum(w / knots[0], 1.0)

    return modulus, knots


class Plane:
    """Sums over a circle of directions for every shape of it."""

    def __init__(self, rubber, circle):
        self.modulus, self.knots = modulus_of(rubber)
        self.circle = circle

    def __call__(self, frequencies, shapes):
        """Return I2, I1 and its twin across, of each shape over its mean."""
        result = np.empty((3, len(shapes), frequencies.size))
        for n, w in enumerate(frequencies.ravel()):
            phi, weight, cosine = self.circle(w, self.knots)
            storage, loss = self.modulus(w * cosine)
            square, drag, across = (
                2 * weight * part
                for part in (storage**2 + loss**2, cosine * loss, np.sin(phi) * loss)
            )
            for s, shape in enumerate(shapes):
                ahead, behind = shape(phi), shape(-phi)
                result[:, s, n] = (
                    square @ (ahead + behind),
                    drag @ (ahead + behind),
                    across @ (ahead - behind),
                )
        return result.reshape(3, len(shapes), *frequencies.shape)


def shape_of(ratio, angle, hurst=SURFACE["hurst"]):
    """Return C over its mean, at angles from a velocity `angle` degrees off the lay."""
    power = -1 - hurst

    def law(phi):
        a = phi + np.radians(angle)
        return (ratio * np.cos(a) ** 2 + np.sin(a) ** 2 / ratio) ** power

    mean = law(2 * np.pi * np.arange(8192) / 8192).mean()
    return lambda phi: law(phi) / mean


def crossed_edges(shape):
    """Return the edges that are crossed over those of isotropic roughness."""
    phi = 2 * np.pi * np.arange(8192) / 8192
    along, across = ((shape(phi) * f(2 * phi)).mean() for f in (np.cos, np.sin))
    size = np.hypot(along, across)
    if size < 1e-12:
        return 1.0
    return np.sqrt((1 - size) / (1 + size)) ** (0.4 * (1 + along / size) / 2)


def edges_of(start, end, knots, places, first, growth, longest):
    """Return the ends of panels in ln q."""
    grown = start + (end - start) * first * growth ** np.arange(
        np.ceil(-np.log(first) / np.log(growth))
    )
    edges = np.concatenate([places, places - 1, places + 1, grown, knots])
    edges = np.unique(np.concatenate([edges, np.arange(start, end, longest)]))
    edges = edges[(edges > start) & (edges < end)]
    return np.concatenate([[start], edges, [end]])


def solve(rubber, circle, velocity, pressure, shapes, method, surface=SURFACE):
    """Return G, area, mu along and across without correction, the same and kappa by the rule."""
    rule, first, growth, longest, moments, end_of, root = method
    q0, q1, h = surface["q0"], surface["q1"], surface["hurst"]
    top = surface["rms_height"] ** 2 / (2 * np.pi)
    top /= q0**2 * (1 - (q1 / q0) ** (-2 * h)) / (2 * h)
    q, c = np.array([q0, q1]), top * np.array([1.0, (q1 / q0) ** (-2 * h - 2)])
    places = np.log(q)
    between, last = moments(q, c), end_of(q, c)
    plane = Plane(rubber, circle)
    knots = np.log(plane.knots / velocity) if plane.knots.size else np.array([])
    edges = edges_of(places[0], places[1], knots, places, first, growth, longest)
    y, weights, half = nodes_on(edges, rule)
    i2, i1, across = plane(velocity * np.exp(y), shapes)
    # beyond the end of the roughness
    inside = knots[(knots > last) & (knots < last + np.log(TAIL_END))] - last
    z, tail_weights, _ = nodes_on(
        np.unique(np.concatenate([np.linspace(0, np.log(TAIL_END), 24), inside])), rule
    )
    t2, t1, t_across = plane(velocity * np.exp(last + z), shapes)
    e2 = plane(np.array([velocity * np.exp(last)]), shapes)[0]
    stiff = 1 / ((1 - POISSON**2) * pressure)
    density = top * np.exp(4 * y - (2 * h + 2) * (y - places[0]))
    window = between(y - 1, y + 1) / 2
    whole = between(places[:1], places[-1:])[0]
    w_e = end_window(between, places, np.array([last]))
    for s in range(len(shapes)):
        rate = stiff**2 / 8 * density * i2[s]
        before = np.cumsum([0.0, *(rate * weights).sum(axis=1)])
        g = before[:-1, None] + half * (rate @ rule[2].T)
        g1, force = before[-1], 4 * (1 - POISSON**2) * pressure
        share = erf(0.5 / np.sqrt(np.maximum(g, 1e-300))) * rate * weights
        plain = [g1, erf(0.5 / np.sqrt(g1))]
        plain += [force * (share * part[s] / i2[s]).sum() for part in (i1, across)]
        factor = (
            crossed_edges(shapes[s])
            * stiff**2
            / 8
            * w_e
            * (t2[s] / e2[s]) ** 0.25
            * tail_weights
            * np.exp(-3 * z)
        )
        excess = 1 - g1 / (stiff**2 / 8 * whole * e2[s, 0])
        found, steering = [], 1.0
        for part, tail in ((i1, t1), (across, t_across)):
            nodes = (
                g,
                rate * weights,
                stiff**2 / 8 * i2[s] * window,
                steering * part[s] / i2[s],
                g1,
                4 * w_e / whole,
                excess,
            )
            beyond = (factor * t2[s]).sum(), (factor * tail[s]).sum()
            if not found:
                kappa = root(nodes, beyond)
                found = [kappa, erf(0.5 / np.sqrt(kappa * g1))]
                steering = erf(0.5 / np.sqrt(kappa * np.maximum(g, 1e-300))) ** 0.125
            found.append(force * sums(kappa, nodes, beyond)[1])
        yield [*plain, *found]


METHODS = (
    (circle_in_z, (gauss(20), 1e-9, 1.7, 0.5, closed_moment, closed_end, by_kappa)),
    (circle_in_phi, (gauss(24), 1e-10, 2.0, 0.37, summed_moment, summed_end, by_inverse)),
)
NAMES = ("g", "area", "mu", "lateral", "kappa", "partial_area", "partial_mu", "partial_lateral")


def main():
    """Write direction.csv."""
    shapes = {(r, a): shape_of(r, a) for r in RATIOS for a in ANGLES}
    rows = []
    for rubber, conditions in CONDITIONS.items():
        for velocity, pressure in conditions:
            pair = [
                [*solve(RUBBERS[rubber], circle, velocity, pressure, [*shapes.values()], method)]
                for circle, method in METHODS
            ]
            for (ratio, angle), one, two in zip(shapes, *pair, strict=True):
                for name, a, b in zip(NAMES, one, two, strict=True):
                    scale = one[NAMES.index(name.replace("lateral", "mu"))]
                    tables.agree("direction", float(a), float(b), 1e-9, float(scale))
                rows.append(
                    {
                        "case": f"{rubber} {velocity:g} m/s {pressure:g} Pa {ratio:g} {angle}",
                        **SURFACE,
                        "axis_ratio": ratio,
                        "lay_deg": LAY,
                        "direction_deg": LAY + angle,
                        **(dict.fromkeys(SBR) if rubber == "curve" else SBR),
                        **tables.table_columns(CURVE if rubber == "curve" else None),
                        "velocity": velocity,
                        "pressure": pressure,
                        "poisson_ratio": POISSON,
                        **{n: float(x) for n, x in zip(NAMES, one, strict=True)},
                        "rtol": 1e-7,
                    }
                )
                print(rows[-1]["case"], *(f"{x:.8g}" for x in one), flush=True)
    comments = [
        "Friction of elliptic spectra by direction (make_direction.py): without correction g,",
        "area, mu, lateral; by the rule of PartialContact with plane sums kappa and the rest.",
        "Tolerances are relative, of lateral to mu. Units as in partial_contact.csv.",
    ]
    tables.write("direction", comments, rows)


if __name__ == "__main__":
    main()
