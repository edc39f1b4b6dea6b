"""I1 and I2 of rubbers, each by two rules: functions of frequencies, arrays of any shape.

Prony series: closed, and by trapezoids in z, cos(phi) = sech(z). Tables (steffen.py): Gauss rules
in z and in phi that split where w cos(phi) passes a knot.
"""

import numpy as np
import tables
from steffen import Table, slopes

NODES, WEIGHTS = np.polynomial.legendre.leggauss(20)
FINE_NODES, FINE_WEIGHTS = np.polynomial.legendre.leggauss(40)


def in_blocks(integrals):
    """Return the function of w in blocks that fit the memory."""

    def blocked(w):
        flat = np.ravel(w)
        parts = [integrals(block) for block in np.array_split(flat, 1 + flat.size // 64)]
        return [np.concatenate(column).reshape(np.shape(w)) for column in zip(*parts, strict=True)]

    return blocked


def prony_integrals(rubber):
    """Return w -> (I1, I2) closed, and by trapezoids."""

    def closed(w):
        return tables.prony_integrals(w, *rubber.values(), sqrt=np.sqrt)

    def defined(w):
        i1, storage, loss = prony_parts(rubber)(w)
        return i1, storage + loss

    return closed, defined


def prony_parts(rubber):
    """Return w -> (I1, and the parts of E'^2 and E''^2 in I2) by trapezoids."""
    z, step = np.linspace(0, 45, 2251, retstep=True)
    cosine = 1 / np.cosh(z)
    weights = np.where((z == 0) | (z == 45), 0.5, 1.0) * step * 4 * cosine

    def parts(w):
        storage, loss = tables.prony(w[:, None] * cosine, *rubber.values())
        return [v @ weights for v in (cosine * loss, storage**2, loss**2)]

    return in_blocks(parts)


def angular_integrals(table):
    """Return w -> (I1, I2) of a table by Gauss rules in z, and in phi."""
    return [lambda w, f=f: f(w)[:2] for f in tabulated_integrals(table)]


def extended(columns, extrapolation):
    """Return knots, coefficients [column, interval, power] of ln E', ln E'', measured intervals."""
    exact = Table(*columns)
    knots = list(columns[0])
    cubics = [[[float(v) for v in piece] for piece in column] for column in exact.cubics]
    measured = [True] * len(cubics[0])
    if extrapolation:
        for values, column in zip(columns[1:], cubics, strict=True):
            d = [float(s) for s in slopes(exact.x, [np.log(v) for v in values])]
            low, high = (d[0], d[-1]) if extrapolation == "power-law" else (0.0, 0.0)
            column.insert(0, [np.log(values[0]) - low * np.log(10.0), low, 0.0, 0.0])
            column.append([np.log(values[-1]), high, 0.0, 0.0])
        knots = [knots[0] / 10, *knots, knots[-1] * 10]
        measured = [False, *measured, False]
    return np.array(knots), np.array(cubics), np.array(measured)


def tabulated_integrals(columns, extrapolation=None):
    """Return w -> (I1, I2, I1 from outside of the table) by Gauss rules in z, and in phi."""
    knots, cubics, measured = extended(columns, extrapolation)
    x = np.log(knots)
    storage0, loss0 = np.exp(cubics[:, 0, 0])
    every = np.arange(len(knots) - 1)
    parts = np.ceil(np.diff(x) * 1.5).astype(int)  # the rules in phi need shorter pieces
    numbers = np.repeat(every, parts)
    cuts = [np.geomspace(*knots[i : i + 2], parts[i] + 1)[:-1] for i in every]
    cuts = np.concatenate([*cuts, knots[-1:]])

    def piece(log_w, i):
        """Return E' and E'' at log_w[frequency, interval, node], i the intervals' numbers."""
        t = np.clip(log_w - x[i, None], 0, np.diff(x)[i, None])  # harmless where not used
        k = cubics[:, i, :, None]
        return [np.exp(c[:, 0] + t * (c[:, 1] + t * (c[:, 2] + t * c[:, 3]))) for c in k]

    def in_z(w):
        last = 1 + np.searchsorted(knots[:-1], np.max(w))  # knots above contribute nothing
        edges = np.arccosh(np.maximum(w[:, None] / knots[:last], 1.0))
        half = (edges[:, :-1, None] - edges[:, 1:, None]) / 2
        z = edges[:, 1:, None] + half * (1 + FINE_NODES)
        c = 1 / np.cosh(z)
        storage, loss = piece(np.log(w)[:, None, None] + np.log(c), every[: last - 1])
        weight = 4 * half * FINE_WEIGHTS * c
        i1 = np.sum(weight * c * loss, axis=2)
        i2 = np.sum(weight * (storage**2 + loss**2), axis=(1, 2))
        s = np.arange(0.5, 40.0)  # the tail by Gauss panels in z
        z = edges[:, :1, None] + s[:, None] + 0.5 * NODES
        c = 1 / np.cosh(z)
        loss = loss0 * c * (w / knots[0])[:, None, None]
        weight = 2 * WEIGHTS * c
        tail = np.sum(weight * c * loss, axis=(1, 2))
        i2 += np.sum(weight * (storage0**2 + loss**2), axis=(1, 2))
        return np.sum(i1, axis=1) + tail, i2, i1[:, ~measured[: last - 1]].sum(axis=1) + tail

    def in_phi(w):
        last = 1 + np.searchsorted(cuts[:-1], np.max(w))
        edges = np.arccos(np.minimum(cuts[:last] / w[:, None], 1.0))
        half = (edges[:, :-1, None] - edges[:, 1:, None]) / 2
        phi = edges[:, 1:, None] + half * (1 + FINE_NODES)
        c = np.cos(phi)
        storage, loss = piece(np.log(w[:, None, None] * c), numbers[: last - 1])
        weight = 4 * half * FINE_WEIGHTS
        i1 = np.sum(weight * c * loss, axis=2)
        i2 = np.sum(weight * (storage**2 + loss**2), axis=(1, 2))
        ratio = np.minimum(knots[0] / w, 1.0)
        rest = np.arcsin(ratio)
        square = ratio**2  # where the difference cancels its series, good to 1e-17
        series = ratio**3 * (2 / 3 + square * (1 / 5 + square * (3 / 28 + square * 5 / 72)))
        cosines = np.where(ratio < 0.01, series, rest - ratio * np.sqrt(1 - square))
        tail = 2 * loss0 / ratio * cosines
        i2 += 4 * storage0**2 * rest + 2 * (loss0 / ratio) ** 2 * cosines
        return i1.sum(axis=1) + tail, i2, i1[:, ~measured[numbers[: last - 1]]].sum(axis=1) + tail

    return in_blocks(in_z), in_blocks(in_phi)
