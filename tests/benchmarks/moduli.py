"""The angular integrals I1 and I2 of a rubber in NumPy, as well as they can be written in it.

Both classes take flat arrays of frequencies w [rad/s] and give I1 [Pa] and I2 [Pa^2]. Work goes in
blocks that stay in the second cache, into arrays that are kept.
"""

from itertools import pairwise
from typing import Any

import numpy as np

Array = np.ndarray
BLOCK = 1024  # of frequencies times terms: 160 kB an array of 20 terms


class Prony:
    """Closed forms, one fused pass over the terms; the sums over them are BLAS's."""

    def __init__(self, equilibrium_modulus: float, moduli: Array, relaxation_times: Array) -> None:
        times = np.asarray(relaxation_times)
        self.equilibrium, self.moduli, self.times = equilibrium_modulus, np.asarray(moduli), times
        coupling = (self.moduli / (1 + times[:, None] / times)).sum(axis=1)
        self.weights = 2 * self.moduli * (equilibrium_modulus + coupling)
        self._block = max(1, 20 * BLOCK // max(1, times.size))
        self._kept = np.empty((3, self._block, times.size))

    def __call__(self, w: Array) -> tuple[Array, Array]:
        i1, i2 = np.empty((2, w.size))
        for at, some in _blocks(w, self._block):
            t, share, r = self._kept[:, : some.size]
            np.multiply(some[:, None], self.times, out=t)
            np.multiply(t, t, out=share)
            share += 1
            np.sqrt(share, out=r)
            share += r
            np.divide(t, share, out=share)  # s / t = t / (r (r + 1)), s = 1 - 1 / r
            np.dot(share, self.moduli, out=i1[at])
            share *= t
            np.dot(share, self.weights, out=i2[at])
        i1 *= 2 * np.pi
        i2 += self.equilibrium**2
        i2 *= 2 * np.pi
        return i1, i2


class PlainProny(Prony):
    """The same formulas as most would write them, in whole arrays."""

    def __call__(self, w: Array) -> tuple[Array, Array]:
        t = w[:, None] * self.times
        r = np.sqrt(1 + t * t)
        share = t / (r * (r + 1))
        i1 = 2 * np.pi * share @ self.moduli
        return i1, 2 * np.pi * (self.equilibrium**2 + (t * share) @ self.weights)


class Steffen:
    """Steffen's (1990) interpolant of ln E' and ln E'' in ln w.

    I1 and I2 by Gauss rules of 12 points in z, cos(phi) = sech(z), between the frequencies at which
    w cos(phi) passes a knot; below the table E' is constant and E'' proportional to w.
    """

    def __init__(self, frequency: Array, storage: Array, loss: Array) -> None:
        self.knots, self.lowest = np.asarray(frequency), (storage[0], loss[0])
        self.x = np.log(self.knots)
        self.cubics = [_cubics(self.x, np.log(values)) for values in (storage, loss)]
        self.nodes, self.gauss = np.polynomial.legendre.leggauss(12)

    def __call__(self, w: Array) -> tuple[Array, Array]:
        result = np.empty((2, w.size))
        for at, some in _blocks(w, BLOCK // 8):
            result[:, at] = self._tail(some)
            for i in range(np.searchsorted(self.knots[:-1], some.max())):
                result[:, at] += self._interval(i, some)  # of no width above w
        return tuple(result)  # type: ignore

    def _interval(self, i: int, w: Array) -> Array:
        near, far = (np.arccosh(np.maximum(w / self.knots[k], 1)) for k in (i + 1, i))
        half = (far - near)[:, None] / 2
        z = near[:, None] + half * (1 + self.nodes)
        c = 1 / np.cosh(z)
        t = np.log(w[:, None] * c)
        t -= self.x[i]
        np.clip(t, 0, self.x[i + 1] - self.x[i], out=t)  # of no width where w is below the interval
        storage, loss = (
            np.exp(a + t * (b + t * (d + t * e)))
            for a, b, d, e in (part[i] for part in self.cubics)
        )
        weight = c * half * (4 * self.gauss)
        columns = c * loss, storage**2 + loss**2
        return np.array([np.einsum("ij,ij->i", weight, column) for column in columns])

    def _tail(self, w: Array) -> Array:
        storage, loss = self.lowest
        below = np.minimum(self.knots[0] / w, 1)
        angle = np.arcsin(below)
        cosines = angle - below * np.sqrt(1 - below**2)  # 2 int cos^2 over the tail
        rates = 2 * loss / below * cosines, 2 * (loss / below) ** 2 * cosines
        return np.array([rates[0], 4 * storage**2 * angle + rates[1]])


def _cubics(x: Array, y: Array) -> Array:
    """Power coefficients of each interval."""
    h = np.diff(x)
    s = np.diff(y) / h
    d = np.empty_like(x)
    p = (s[:-1] * h[1:] + s[1:] * h[:-1]) / (h[:-1] + h[1:])
    least = np.minimum(np.minimum(abs(s[:-1]), abs(s[1:])), abs(p) / 2)
    d[1:-1] = (np.sign(s[:-1]) + np.sign(s[1:])) * least
    for end, (a, b) in ((0, (0, 1)), (-1, (-1, -2))):
        p0 = s[a] * (1 + h[a] / (h[a] + h[b])) - s[b] * h[a] / (h[a] + h[b])
        d[end] = 0 if p0 * s[a] <= 0 else np.sign(s[a]) * min(abs(p0), 2 * abs(s[a]))
    second, third = (3 * s - 2 * d[:-1] - d[1:]) / h, (d[:-1] + d[1:] - 2 * s) / h**2
    return np.stack([y[:-1], d[:-1], second, third], axis=1)


def _blocks(w: Array, size: int) -> Any:
    edges = [*range(0, w.size, size), w.size]
    return ((slice(a, b), w[a:b]) for a, b in pairwise(edges))
