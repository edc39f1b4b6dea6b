"""Other ways to integrate a friction curve, vectorised in NumPy: without an error test, as written.

With s = ln(q / q0) all of them compute, of a curve of `curves.py`,
  G = int dG/ds ds, mu_H = int dmu/ds P S ds, P = erf(1 / (2 sqrt G)), S = gamma + (1 - gamma) P^2.
"""

from functools import cache

import numpy as np
from curves import Curve
from moduli import Array
from scipy.integrate import cumulative_trapezoid, quad, trapezoid
from scipy.special import erf


def factors(curve: Curve) -> tuple[float, float]:
    """Of dG/ds = g q^4 C I2 and dmu/ds = m q^4 C I1, with C(q0) q0^4 taken in."""
    stiff = 1 / ((1 - curve.inputs["poisson_ratio"] ** 2) * curve.inputs["pressure"])
    at_q0 = curve.road.q0**4 * curve.density
    return at_q0 * stiff**2 / 8, at_q0 * stiff / 2


def rates(curve: Curve, s: Array, velocity: Array) -> tuple[Array, Array]:
    """dG/ds, and dmu/ds without P S; `velocity` goes with the first axis of s."""
    g, m = factors(curve)
    w = np.exp(s)
    w *= (np.asarray(velocity) * curve.road.q0).reshape(-1, *[1] * (s.ndim - 1))
    i1, i2 = (column.reshape(s.shape) for column in curve.modulus(w.ravel()))
    power = curve.power(s)
    i2 *= power
    i2 *= g
    i1 *= power
    i1 *= m
    return i2, i1


def weight(curve: Curve, g: Array) -> Array:
    """P S."""
    gamma = curve.inputs["gamma"]
    with np.errstate(divide="ignore"):
        p = erf(0.5 / np.sqrt(g))
    s = p * p
    s *= 1 - gamma
    s += gamma
    s *= p
    return s


@cache
def gauss(count: int) -> tuple[Array, Array, Array]:
    """Nodes, weights, and the matrix that integrates the interpolant from -1 to each node."""
    x, w = np.polynomial.legendre.leggauss(count)
    p = np.polynomial.legendre.legvander(x, count)
    matrix = np.outer(1 + x, w / 2)
    for k in range(1, count):
        matrix += np.outer((p[:, k + 1] - p[:, k - 1]) / 2, p[:, k] * w)
    return x, w, matrix.T.copy()


def graded_panels(
    curve: Curve, nodes: int = 16, growth: float = 4, first: float = 0.3, longest: float = 0.7
) -> Array:
    """Gauss-Legendre panels that grow from the front of each velocity, ending at a table's rows.

    The first panel is `first` fronts long, the next grow by factors of about `growth` up to a
    length `longest` in ln q; `nodes` in each. Rows are those of the modulus, and of a scan's rings.
    """
    front = first / rates(curve, np.zeros((curve.velocity.size, 1)), curve.velocity)[0]
    front = np.minimum(front, longest)
    grown = max(1, int(np.ceil(np.log(longest / front.min()) / np.log(growth))))
    steps = (longest / front) ** (np.arange(grown + 1) / grown)
    rest = np.linspace(0, curve.length, 1 + int(np.ceil(curve.length / longest)))
    rest = np.union1d(rest, curve.rings[:-1])
    edges = np.sort(_merged(front * steps, rest, _knots(curve)).clip(0, curve.length), axis=1)
    half = np.diff(edges)[:, :, None] / 2
    x, w, matrix = gauss(nodes)
    s = half * x
    s += edges[:, :-1, None]
    s += half
    g_rate, mu_rate = rates(curve, s, curve.velocity)
    g_rate *= half
    mu_rate *= half
    g = (g_rate.reshape(-1, nodes) @ matrix).reshape(s.shape)
    g[:, 1:] += np.cumsum(g_rate @ w, axis=1)[:, :-1, None]
    mu_rate *= weight(curve, g)
    return (mu_rate.reshape(-1, nodes) @ w).reshape(s.shape[:2]).sum(axis=1)


def _merged(front: Array, rest: Array, knots: Array) -> Array:
    """Edges by velocity, not in order."""
    grown = np.concatenate([np.zeros((len(front), 1)), front, knots], axis=1)
    return np.concatenate([grown, np.tile(rest[1:], (len(front), 1))], axis=1)


def _knots(curve: Curve) -> Array:
    """Where w passes the knots of a table, s by velocity; 0 where outside of the band."""
    if not hasattr(curve.modulus, "knots"):
        return np.zeros((curve.velocity.size, 0))
    s = np.log(curve.modulus.knots / (curve.velocity[:, None] * curve.road.q0))
    s = np.sort(np.where((s > 0) & (s < curve.length), s, 0), axis=1)
    return s[:, (s > 0).any(axis=0)]


def log_trapezoid(curve: Curve, points: int) -> Array:
    """Both integrals by the trapezoidal rule on a logarithmic grid, as published programs do."""
    s = np.linspace(0, curve.length, points)
    found = []
    for velocity in curve.velocity:  # a row at a time stays in the cache
        g_rate, mu_rate = rates(curve, s[None], velocity)
        g = cumulative_trapezoid(g_rate[0], s, initial=0)
        found.append(trapezoid(mu_rate[0] * weight(curve, g), s))
    return np.array(found)


def nested_quad(curve: Curve, rtol: float) -> Array:
    """scipy's quad of a quad, one velocity at a time."""

    def mu(velocity: float) -> float:
        def rate(s: float, k: int) -> float:
            return float(rates(curve, np.array([[s]]), velocity)[k][0, 0])

        def integrand(s: float) -> float:
            g = quad(rate, 0, s, args=(0,), epsabs=0, epsrel=rtol)[0]
            return rate(s, 1) * float(weight(curve, np.array(g)))

        return quad(integrand, 0, curve.length, epsabs=0, epsrel=rtol)[0]

    return np.array([mu(velocity) for velocity in curve.velocity])
