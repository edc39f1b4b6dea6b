"""Spectra of few rows for the rule of PartialContact: c = q^4 C, its integrals, and where it ends.

C is a power law between rows and, beside rows of zero, straight. Integrals over ln q are closed, or
sums of Gauss rules; ln q_e is the mean of ln q over the last tenth of the integral.
"""

from functools import cache

import numpy as np
from scipy.optimize import brentq

LAST = 0.1  # of M(q1), about the end


@cache
def gauss(n):
    """Return nodes, weights and the matrix of integrals up to each node, from -1 to 1."""
    nodes, weights = np.polynomial.legendre.leggauss(n)
    powers = np.polynomial.legendre.legvander(nodes, n - 1)
    integrals = [np.polynomial.legendre.legint(row, lbnd=-1) for row in np.eye(n)]
    values = np.array([np.polynomial.legendre.legval(nodes, row) for row in integrals]).T
    return nodes, weights, values @ np.linalg.inv(powers)


def nodes_on(edges, rule):
    """Return nodes, weights and half lengths of panels between edges."""
    half = np.diff(edges)[:, None] / 2
    return edges[:-1, None] + half * (1 + rule[0]), half * rule[1], half


def rows_of(surface):
    """Return wavenumbers and densities between which C is a power law or, at zeros, straight."""
    if not isinstance(surface, dict):
        return [np.array(column) for column in surface]
    h, q0, q1 = surface["hurst"], surface["q0"], surface["q1"]
    knee = surface["rolloff"] or q0
    moment = (knee**2 - q0**2) / 2 + knee**2 * (1 - (q1 / knee) ** (-2 * h)) / (2 * h)
    top = surface["rms_height"] ** 2 / (2 * np.pi * moment)
    q = np.array([q0, knee, q1] if knee > q0 else [q0, q1])
    return [q, top * np.maximum(q / knee, 1.0) ** (-2 * (h + 1))]


def surface_columns(surface):
    """Return the columns of a closed form, or of rows."""
    closed = isinstance(surface, dict)
    names = ("rms_height", "hurst", "q0", "q1", "rolloff")
    rows = (None, None) if closed else surface
    return {
        **(surface if closed else dict.fromkeys(names)),
        **dict(zip(("table_wavenumber", "table_density"), rows, strict=True)),
    }


def roughness(q, c):
    """Return c = q^4 C as a function of y and of the number of the interval."""
    power = np.zeros(len(c) - 1)
    straight = (c[:-1] == 0) | (c[1:] == 0)
    slopes = np.diff(np.log(np.where(c > 0, c, 1))) / np.diff(np.log(q))
    power[~straight] = slopes[~straight]

    def at(y, i):
        k = np.exp(y)
        with np.errstate(divide="ignore", invalid="ignore"):
            law = c[i] * np.exp(power[i] * (y - np.log(q[i])))
        line = c[i] + (c[i + 1] - c[i]) * (k - q[i]) / (q[i + 1] - q[i])
        return k**4 * np.where(straight[i], line, law)

    return at, power, straight


def closed_moment(q, c):
    """Return y, y' -> int c dy between them, in closed form."""
    _, power, straight = roughness(q, c)
    places, p = np.log(q), 4 + power
    slope = np.where(straight, np.diff(c) / np.diff(q), 0)
    level = np.where(straight, c[:-1] - slope * q[:-1], 0)
    divisor = np.where(p == 0, 1, p)

    def inside(y, i):
        k, s = np.exp(y), y - places[i]
        line = level[i] * (k**4 - q[i] ** 4) / 4 + slope[i] * (k**5 - q[i] ** 5) / 5
        grown = np.where(np.abs(p[i] * s) > 1e-9, np.expm1(p[i] * s) / divisor[i], s)
        return np.where(straight[i], line, c[i] * q[i] ** 4 * grown)

    before = np.cumsum([0.0, *inside(places[1:], np.arange(len(q) - 1))])

    def moment(y):
        y = np.clip(y, places[0], places[-1])
        i = np.clip(np.searchsorted(places, y, side="right") - 1, 0, len(q) - 2)
        return before[i] + inside(y, i)

    return lambda low, high: moment(high) - moment(low)


def summed_moment(q, c):
    """Return the same by Gauss rules on the parts between rows."""
    at, _, _ = roughness(q, c)
    nodes, weights, _ = gauss(28)
    places = np.log(q)

    def between(low, high):
        low = np.maximum(low[..., None], places[:-1])
        high = np.minimum(high[..., None], places[1:])
        half = np.maximum(high - low, 0)[..., None] / 2
        rate = at(low[..., None] + half * (1 + nodes), np.arange(len(q) - 1)[:, None])
        return (half * weights * rate).sum(axis=(-2, -1))

    return between


def closed_end(q, c):
    """Return ln q_e from closed moments."""
    between, places = closed_moment(q, c), np.log(q)
    end = places[-1:]
    whole = between(places[:1], end)[0]
    start = brentq(
        lambda y: between(np.array([y]), end)[0] - LAST * whole, places[0], end[0], xtol=1e-15
    )
    y, weights, _ = nodes_on(np.array([start, *places[places > start]]), gauss(20))
    risen = between(np.full(y.shape, start), y)
    return end[0] - (weights * risen).sum() / (LAST * whole)


def summed_end(q, c):
    """Return the same by Gauss rules over y c."""
    between, places = summed_moment(q, c), np.log(q)
    end = places[-1:]
    whole = between(places[:1], end)[0]
    start = brentq(
        lambda y: between(np.array([y]), end)[0] / whole - LAST, places[0], end[0], xtol=1e-15
    )
    edges = np.array([start, *places[places > start]])
    i = np.searchsorted(places, (edges[:-1] + edges[1:]) / 2, side="right") - 1
    y, weights, _ = nodes_on(edges, gauss(28))
    mass = weights * roughness(q, c)[0](y, i[:, None])
    return (mass * y).sum() / mass.sum()


def end_window(between, places, end):
    """Return c_e, half of the integral of c within a unit of the end, or LAST of all if more."""
    whole = between(places[:1], places[-1:])[0]
    return max(between(end - 1, end + 1)[0], LAST * whole) / 2
