"""Steffen's (1990, A&A 239, 443) monotone interpolant of a tabulated modulus in logarithms.

ln E' and ln E'' are cubic Hermite polynomials in ln w. Below the table's lowest frequency w0 the
angular integrals take E' = E'(w0) and E'' = E''(w0) w / w0.
"""

from itertools import pairwise

import mpmath as mp


def slopes(x, y):
    """Return Steffen's derivatives at the knots."""
    h = [b - a for a, b in pairwise(x)]
    s = [(b - a) / width for (a, b), width in zip(pairwise(y), h, strict=True)]
    if len(s) == 1:
        return [s[0], s[0]]

    def end(s0, s1, h0, h1):
        p = s0 * (1 + h0 / (h0 + h1)) - s1 * h0 / (h0 + h1)
        if p * s0 <= 0:
            return 0 * p
        return 2 * s0 if abs(p) > 2 * abs(s0) else p

    result = [end(s[0], s[1], h[0], h[1])]
    for i in range(1, len(s)):
        p = (s[i - 1] * h[i] + s[i] * h[i - 1]) / (h[i - 1] + h[i])
        sign = (mp.sign(s[i - 1]) + mp.sign(s[i])) * mp.mpf(1)
        result.append(sign * min(abs(s[i - 1]), abs(s[i]), abs(p) / 2))
    result.append(end(s[-1], s[-2], h[-1], h[-2]))
    return result


class Table:
    """Tabulated modulus: x = ln w, and power coefficients of ln E', ln E'' per interval."""

    def __init__(self, frequency, storage, loss):
        """Keep the table as mpmath numbers."""
        self.frequency, self.storage, self.loss = (
            [mp.mpf(value) for value in column] for column in (frequency, storage, loss)
        )
        self.x = [mp.log(w) for w in self.frequency]
        self.cubics = [self._cubics([mp.log(v) for v in c]) for c in (self.storage, self.loss)]

    def _cubics(self, y):
        d = slopes(self.x, y)
        result = []
        for i in range(len(y) - 1):
            h = self.x[i + 1] - self.x[i]
            s = (y[i + 1] - y[i]) / h
            c2 = (3 * s - 2 * d[i] - d[i + 1]) / h
            result.append((y[i], d[i], c2, (d[i] + d[i + 1] - 2 * s) / h**2))
        return result

    def piece(self, i, x, exp=mp.exp):
        """Return (E', E'') at ln w = x with the polynomials of interval i."""
        t = x - self.x[i]
        return [exp(c[i][0] + t * (c[i][1] + t * (c[i][2] + t * c[i][3]))) for c in self.cubics]

    def modulus(self, w):
        """Return (E', E'') at an angular frequency inside the table."""
        x = mp.log(w)
        i = max(k for k in range(len(self.x) - 1) if self.frequency[k] <= w)
        return self.piece(i, x)
