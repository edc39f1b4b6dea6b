"""I1 and I2 of a tabulated modulus from their definition, by brute force.

Steffen's interpolant (Astron. Astrophys. 239, 443 (1990)) of ln E' and ln E'' in ln w; below the
lowest frequency E' is constant and E'' proportional to w. With cos(phi) = sech(z) a quadrant is
z > 0, and between the knots Gauss rules converge to rounding.
"""

import numpy as np

NODES, WEIGHTS = np.polynomial.legendre.leggauss(24)


def steffen(x, y):
    """Coefficients of 1 to t^3 in each interval, t from its lower end; the slopes at the rows."""
    h, s = np.diff(x), np.diff(y) / np.diff(x)
    if len(s) == 1:
        slope = np.array([s[0], s[0]])
    else:
        p = (s[:-1] * h[1:] + s[1:] * h[:-1]) / (h[:-1] + h[1:])
        least = np.minimum(np.minimum(np.abs(s[:-1]), np.abs(s[1:])), np.abs(p) / 2)
        inner = (np.sign(s[:-1]) + np.sign(s[1:])) * least
        slope = np.array([end(s[0], s[1], h[0], h[1]), *inner, end(s[-1], s[-2], h[-1], h[-2])])
    low, high = slope[:-1], slope[1:]
    return np.array([y[:-1], low, (3 * s - 2 * low - high) / h, (low + high - 2 * s) / h**2]), slope


def end(s0, s1, h0, h1):
    p = s0 * (1 + h0 / (h0 + h1)) - s1 * h0 / (h0 + h1)
    if p * s0 <= 0:
        return 0.0
    return 2 * s0 if abs(p) > 2 * abs(s0) else p


class Definition:
    """Call it at an angular frequency for I1, I2 and the shares of both from outside the table."""

    def __init__(self, angular_frequency, storage_modulus, loss_modulus, extrapolation=None):
        w = np.asarray(angular_frequency)
        knots, self.origin = w, w[:-1]
        measured = np.ones(len(w) - 1, dtype=bool)
        self.cubics = []
        for column in (storage_modulus, loss_modulus):
            cubic, slope = steffen(np.log(w), np.log(column))
            if extrapolation:
                slope *= extrapolation == "power-law"
                ends = ([[np.log(column[i])], [slope[i]], [0], [0]] for i in (0, -1))
                cubic = np.insert(cubic, [0, len(w) - 1], np.hstack([*ends]), axis=1)
            self.cubics.append(cubic)
        if extrapolation:
            knots = np.array([w[0] / 10, *w, w[-1] * 10])
            self.origin = np.array([w[0], *w])
            measured = np.array([False, *measured, False])
        # short enough for one rule, in ln w and in the change of the modulus
        intervals = np.arange(len(knots) - 1)
        change = np.subtract(*(self.logarithms(intervals, at) for at in (knots[1:], knots[:-1])))
        length = np.diff(np.log(knots))
        parts = 1 + np.maximum(length / 0.1, np.abs(change).max(axis=0) / 0.5).astype(int)
        self.interval = np.repeat(intervals, parts)
        part = np.concatenate([np.arange(n) for n in parts])
        fraction = part / parts[self.interval]
        self.edges = np.append(
            knots[self.interval] * np.exp(length[self.interval] * fraction), knots[-1]
        )
        self.measured = measured[self.interval]

    def logarithms(self, interval, w):
        """ln E' and ln E''."""
        t = np.log(w / self.origin[interval])
        powers = (np.ones_like(t), t, t**2, t**3)
        return np.array(
            [sum(c[interval] * p for c, p in zip(k, powers, strict=True)) for k in self.cubics]
        )

    def __call__(self, w):
        below = self.edges[:-1] < w
        far = z_of(w, self.edges[:-1][below])[:, None]
        near = z_of(w, np.minimum(self.edges[1:][below], w))[:, None]
        half = (far - near) / 2
        cosine = 1 / np.cosh(near + half * (1 + NODES))
        storage, loss = np.exp(self.logarithms(self.interval[below][:, None], w * cosine))
        weight = 4 * half * WEIGHTS * cosine
        parts = np.array([weight * cosine * loss, weight * (storage**2 + loss**2)]).sum(axis=2)
        # the tail, in psi = pi / 2 - phi
        lowest = self.edges[0]
        storage, loss = np.exp(self.logarithms(0, lowest))
        psi = np.arctan2(lowest, np.sqrt((w - lowest) * (w + lowest)))
        squares = psi / 2 * WEIGHTS @ np.sin(psi / 2 * (1 + NODES)) ** 2
        slope = loss * w / lowest
        tail = 4 * np.array([slope * squares, storage**2 * psi + slope**2 * squares])
        total = parts.sum(axis=1) + tail
        outside = parts[:, ~self.measured[below]].sum(axis=1) + tail
        return *total, *(outside / total)


def z_of(w, edge):
    """z > 0 with cosh(z) = w / edge."""
    return 2 * np.arcsinh(np.sqrt((w - edge) / (2 * edge)))
