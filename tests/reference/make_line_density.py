"""Profile spectrum C1D(q) = int C(sqrt(q^2 + k^2)) dk over all k, from its definition.

Self-affine spectra with and without roll-off and tabulated ones (log-log linear between rows,
linear in q beside a zero), zero outside of their bands. First evaluation: mpmath quadrature in t,
k = q sinh t, piece by piece. Second: closed forms; of a power law C = A q^-s between a and b
A q^(1 - s) int u^((s - 3) / 2) (1 - u)^(-1/2) du, u = (q / p)^2, an incomplete beta function.
"""

from itertools import pairwise

import mpmath as mp
import tables

mp.mp.dps = 40


class Piece:
    """C(q) between two wavenumbers: a power law, or a straight line beside a zero."""

    def __init__(self, low, high, at_low, at_high):
        """Take the two ends."""
        self.low, self.high, self.at_low, self.at_high = (
            mp.mpf(v) for v in (low, high, at_low, at_high)
        )
        self.straight = self.at_low == 0 or self.at_high == 0
        if not self.straight:
            self.fall = -mp.log(self.at_high / self.at_low) / mp.log(self.high / self.low)

    def density(self, p):
        """Return C(p)."""
        if self.straight:
            share = (p - self.low) / (self.high - self.low)
            return self.at_low + (self.at_high - self.at_low) * share
        return self.at_low * (p / self.low) ** -self.fall

    def by_quadrature(self, q):
        """Return its share of C1D(q): 2 int C(q cosh t) q cosh t dt."""
        if self.high <= q:
            return mp.mpf(0)
        start = mp.acosh(max(self.low, q) / q)
        end = mp.acosh(self.high / q)
        edges = mp.linspace(start, end, int(mp.ceil(end - start)) + 1)
        unit = max(self.density(max(self.low, q)), self.at_high)  # mp.quad stops at 10^-digits
        return (
            2
            * q
            * unit
            * mp.quad(lambda t: self.density(q * mp.cosh(t)) / unit * mp.cosh(t), edges)
        )

    def closed(self, q):
        """Return the same in closed form."""
        if self.high <= q:
            return mp.mpf(0)
        low = max(self.low, q)
        if self.straight:
            return 2 * (self.primitive(self.high, q) - self.primitive(low, q))
        level = self.at_low * self.low**self.fall * q ** (1 - self.fall)
        ends = (q / self.high) ** 2, (q / low) ** 2
        return level * mp.betainc((self.fall - 1) / 2, mp.mpf(1) / 2, *ends)

    def primitive(self, p, q):
        """Return int (c + s p) p / sqrt(p^2 - q^2) dp of the straight line c + s p."""
        s = (self.at_high - self.at_low) / (self.high - self.low)
        root = mp.sqrt(p * p - q * q)
        return (self.at_low - s * self.low) * root + s / 2 * (p * root + q * q * mp.log(p + root))


def self_affine(rms_height, hurst, q0, q1, rolloff):
    """Return the pieces of a self-affine spectrum, its amplitude from h_rms^2 = 2 pi int q C dq."""
    h, low, high = (mp.mpf(v) for v in (hurst, q0, q1))
    knee = mp.mpf(rolloff) if rolloff else low
    flat = (knee**2 - low**2) / 2
    level = mp.mpf(rms_height) ** 2 / (2 * mp.pi)
    level /= flat + knee**2 * (1 - (high / knee) ** (-2 * h)) / (2 * h)
    pieces = [Piece(low, knee, level, level)] if rolloff else []
    return [*pieces, Piece(knee, high, level, level * (high / knee) ** (-2 * h - 2))]


def row(case, pieces, wavenumber, columns):
    """Return one row, both evaluations compared."""
    q = mp.mpf(wavenumber)
    first = mp.fsum(piece.by_quadrature(q) for piece in pieces)
    second = mp.fsum(piece.closed(q) for piece in pieces)
    tables.agree("line_density", first, second, 1e-15)
    return {
        "case": f"{case} at {wavenumber!r}",
        **columns,
        "wavenumber": wavenumber,
        "line_density": first,
        "rtol": 1e-12,
    }


NAMES = ("rms_height", "hurst", "q0", "q1", "rolloff", "table_wavenumber", "table_density")


def main():
    """Write line_density.csv."""
    asphalt = (265.7e-6, 0.87, 2000.0, 1e6)
    affine = [
        ("asphalt", (*asphalt, None), [1.0, 500.0, 1999.0, 2000.0, 2500.0, 3e4, 0.999e6, 2e6]),
        ("sandpaper", (76.572e-6, 0.7, 2000.0, 1e6, None), [1e3, 2000.0, 7e3, 5e5]),
        ("rolled off", (*asphalt, 9000.0), [200.0, 2000.0, 5000.0, 8999.0, 9000.0, 9100.0]),
        ("rolled off high", (*asphalt, 9000.0), [2e4, 4e5, 0.999e6]),
        ("hurst 1", (1e-4, 1.0, 2000.0, 1e6, None), [900.0, 2000.0, 4e4, 0.999e6]),
        ("hurst 1 rolled off", (1e-4, 1.0, 2000.0, 1e6, 3e3), [2500.0, 3000.0, 3e5]),
        ("hurst 0.5", (1e-5, 0.5, 2000.0, 1e6, 4e3), [1e3, 3e3, 5e4]),
        ("hurst 0.01", (1e-6, 0.01, 2000.0, 1e6, None), [50.0, 2000.0, 3e5, 0.999e6]),
        ("hurst 0.01 rolled off", (1e-6, 0.01, 2000.0, 1e6, 1e5), [1e3, 5e4, 1e5, 5e5]),
        ("bandwidth 1.01", (1e-4, 0.8, 2000.0, 2020.0, None), [1.0, 1e3, 2000.0, 2010.0]),
        ("bandwidth 1e12", (1e-9, 0.5, 1.0, 1e12, None), [0.5, 1.0, 1e6, 0.999e12]),
        ("nanoscale", (1e-9, 0.8, 1e6, 1e10, None), [1e5, 1e6, 1e8, 9.99e9]),
    ]
    uneven = [2e3, 2.1e3, 5e3, 5.5e3, 1e5]
    tabulated = [
        ("two rows", [1e3, 1e6], [1e-12, 1e-23], [100.0, 1e3, 3e4, 0.999e6, 2e6]),
        ("flat", [1e3, 1e5], [1e-18, 1e-18], [100.0, 1e3, 2e4]),
        ("rising", [1e3, 2e3], [1e-16, 1e-15], [500.0, 1.5e3]),
        ("uneven", uneven, [1e-14, 9e-15, 2e-15, 1e-17, 1e-20], [1e3, 2.05e3, 5e3, 5.2e3, 5e4]),
        ("zero in the middle", uneven, [1e-13, 5e-14, 0.0, 1e-15, 1e-19], [1e3, 3e3, 5e3, 5.3e3]),
        ("zeros at the ends", uneven, [0.0, 1e-13, 1e-14, 1e-15, 0.0], [1e3, 2.05e3, 4e4]),
    ]
    rows = []
    for case, values, places in affine:
        columns = dict(zip(NAMES, (*values, [], []), strict=True))
        rows += [row(case, self_affine(*values), q, columns) for q in places]
    for case, q, c, places in tabulated:
        columns = dict(zip(NAMES, (None,) * 5 + (q, c), strict=True))
        pieces = [Piece(*ab, *c_ab) for ab, c_ab in zip(pairwise(q), pairwise(c), strict=True)]
        rows += [row(case, pieces, place, columns) for place in places]
    comments = [
        "Profile spectrum C1D(q) = int C(sqrt(q^2 + k^2)) dk over all k: THEORY.md section 1.",
        "Of a self-affine spectrum where rms_height stands, else of a table; 0 outside of bands.",
        "Generated by make_line_density.py with 40 digits from the definition.",
        "Units: rms_height m; q0, q1, rolloff, wavenumbers 1/m; densities m^4; line_density m^3.",
    ]
    tables.write("line_density", comments, rows)


if __name__ == "__main__":
    main()
