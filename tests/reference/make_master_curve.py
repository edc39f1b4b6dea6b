"""Modulus and angular integrals of tabulated moduli, from their definitions.

I1 and I2 as in make_prony.py with the interpolant of steffen.py: four times the first quadrant,
split where w cos(phi) passes a knot. First evaluation: cos(phi) = sech(z), Gauss-Legendre rules in
z. Second: tanh-sinh rules in phi itself. The tail w cos(phi) < w0 likewise, and in closed form.
"""

from functools import cache
from itertools import pairwise

import mpmath as mp
import numpy as np
import tables
from steffen import Table

mp.mp.dps = 25


def in_z(table, w, degree):
    """Return ([I1, I2] of the table, [I1, I2] of the tail) by Gauss rules in z."""
    nodes = gauss(degree)
    inside = [mp.mpf(0), mp.mpf(0)]
    edges = [mp.acosh(w / knot) if knot < w else mp.mpf(0) for knot in table.frequency]
    for i, (far, near) in enumerate(pairwise(edges)):
        if far == near:
            break
        half = (far - near) / 2
        for node, weight in nodes:
            c = mp.sech(near + half * (1 + node))
            storage, loss = table.piece(i, mp.log(w * c))
            inside[0] += 4 * half * weight * c * c * loss
            inside[1] += 4 * half * weight * c * (storage**2 + loss**2)
    ratio = table.frequency[0] / w  # tail in closed form
    with mp.workdps(3 * mp.mp.dps):
        rest = mp.asin(ratio)
        cosines = rest - ratio * mp.sqrt(1 - ratio**2)  # 2 int cos^2 over the tail
    return inside, [
        2 * table.loss[0] / ratio * cosines,
        4 * table.storage[0] ** 2 * rest + 2 * (table.loss[0] / ratio) ** 2 * cosines,
    ]


def in_phi(table, w):
    """Return the same by tanh-sinh rules in phi."""
    edges = [mp.acos(k / w) if k < w else mp.mpf(0) for k in table.frequency]
    inside = [mp.mpf(0), mp.mpf(0)]
    for i, (far, near) in enumerate(pairwise(edges)):
        if far == near:
            break
        inside[0] += 4 * mp.quad(
            lambda phi, i=i: mp.cos(phi) * table.piece(i, mp.log(w * mp.cos(phi)))[1], [near, far]
        )
        inside[1] += 4 * mp.quad(
            lambda phi, i=i: sum(e * e for e in table.piece(i, mp.log(w * mp.cos(phi)))),
            [near, far],
        )

    def loss(phi):
        return table.loss[0] * w * mp.cos(phi) / table.frequency[0]

    end = mp.pi / 2
    tail = [
        4 * mp.quad(lambda phi: mp.cos(phi) * loss(phi), [edges[0], end]),
        4 * mp.quad(lambda phi: table.storage[0] ** 2 + loss(phi) ** 2, [edges[0], end]),
    ]
    return inside, tail


@cache
def gauss(degree):
    """Return nodes and weights of the Gauss-Legendre rule of `degree` nodes on [-1, 1]."""
    result = []
    for guess in np.polynomial.legendre.leggauss(degree)[0]:
        x = mp.mpf(guess)
        for _ in range(3):  # Newton's rule from 15 digits
            before, value = mp.mpf(1), x
            for n in range(2, degree + 1):
                before, value = value, ((2 * n - 1) * x * value - (n - 1) * before) / n
            slope = degree * (x * value - before) / (x * x - 1)
            x -= value / slope
        result.append((x, 2 / ((1 - x * x) * slope**2)))
    return result


def sampled(per_decade, count, first):
    """Return a table sampled from a Prony series, rounded to 8 digits."""
    frequency = [10.0 ** (first + k / per_decade) for k in range(count)]
    times = [10.0 ** (-9 + k / 2) for k in range(21)]
    moduli = [1e8 / (1 + 10.0 ** (k / 4)) + 2e5 for k in range(21)]
    pairs = [tables.prony(w, 2e6, moduli, times) for w in frequency]
    columns = [frequency, [p[0] for p in pairs], [p[1] for p in pairs]]
    return [[float(f"{value:.8g}") for value in column] for column in columns]


TABLES = {
    "dense": sampled(5, 40, -2),
    "coarse": sampled(2, 12, 0),
    "monotone kinks": [
        [0.01, 0.011, 1.0, 3.0, 3.1, 500.0, 2e4, 1e8],
        [1e6, 1e6, 2e6, 2e6, 9e6, 9.5e6, 4e8, 1e9],
        [1e5, 1.5e5, 1.6e5, 4e5, 4.1e5, 6e6, 6e7, 7e7],
    ],
    "not monotone": [
        [1.0, 2.0, 10.0, 11.0, 400.0, 5e3, 6e3, 1e6],
        [5e6, 4e6, 6e6, 3e6, 8e7, 7e7, 3e8, 2e8],
        [2e5, 3e5, 1e5, 2e6, 9e6, 1e6, 8e7, 2e7],
    ],
    "two rows": [[0.5, 2e4], [3e6, 5e8], [2e5, 9e7]],
    "two flat rows": [[1.0, 100.0], [3e6, 3e6], [2e5, 2e5]],
    "three rows": [[1.0, 30.0, 100.0], [3e6, 2e7, 2.1e7], [2e5, 5e6, 1e6]],
}


def frequencies(table):
    """Return named frequencies: above the lowest, inside, on knots, the highest."""
    w = table[0]
    middle = len(w) // 2
    yield "just above", w[0] * (1 + 1e-6)
    yield "near the bottom", w[0] + 0.3 * (w[1] - w[0])
    if len(w) > 2:
        yield "on the second knot", w[1]
        yield "above a knot", w[middle] * 1.000001
        yield "on a middle knot", w[middle]
    yield "inside", (w[middle - 1] * w[middle]) ** 0.5
    yield "near the top", w[-2] + 0.9 * (w[-1] - w[-2])
    yield "top", w[-1]


def row(case, columns, frequency):
    """Return one row, both evaluations compared."""
    table, w = Table(*columns), mp.mpf(frequency)
    inside, tail = in_z(table, w, 80)
    for other in (in_z(table, w, 64), in_phi(table, w)):
        for k in range(2):
            total = inside[k] + tail[k]
            tables.agree("master_curve", total, other[0][k] + other[1][k], 1e-13)
            tables.agree("master_curve", tail[k], other[1][k], 1e-13)
    storage, loss = table.modulus(w)
    return {
        "case": case,
        "table_frequency": columns[0],
        "table_storage": columns[1],
        "table_loss": columns[2],
        "angular_frequency": frequency,
        "storage_modulus": storage,
        "loss_modulus": loss,
        "i1": inside[0] + tail[0],
        "i2": inside[1] + tail[1],
        "i1_tail_share": tail[0] / (inside[0] + tail[0]),
        "i2_tail_share": tail[1] / (inside[1] + tail[1]),
        "rtol": 1e-10,
    }


def main():
    """Write master_curve.csv."""
    rows = [
        row(f"{name} {place}", columns, w)
        for name, columns in TABLES.items()
        for place, w in frequencies(columns)
    ]
    comments = [
        "Tabulated modulus: Steffen's monotone interpolant (A&A 239 443 1990) of ln E' and ln E''",
        "in ln w; I1 and I2 as in prony.csv, THEORY.md section 2. Below the lowest frequency w0 of",
        "the table E' = E'(w0) and E'' = E''(w0) w / w0; *_tail_share is the part from there.",
        "Generated by make_master_curve.py with 25 digits from the definition.",
        "rtol is relative for the modulus, i1 and i2, absolute for the shares.",
        "Units: frequencies rad/s; storage, loss, i1 Pa; i2 Pa^2; shares none.",
    ]
    tables.write("master_curve", comments, rows)


if __name__ == "__main__":
    main()
