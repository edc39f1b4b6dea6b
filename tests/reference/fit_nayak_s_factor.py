"""The fit behind NayakSFactor, done again: S inside G against the areas of bem_area.csv.

S(P) = gamma + a sqrt(P) + (1 - gamma - a) P^n, gamma = g (1 - c alpha^(-1/4)), by least
squares in A / A_exact over all rows. Prints the four numbers with their errors, what rounding them
costs, what leaving out one map at a time or one bandwidth at a time does to the rows left out, and
the same figures of the shapes that were tried beside it.

    python fit_nayak_s_factor.py
"""

import csv
from pathlib import Path

import numpy as np
from scipy.optimize import least_squares
from scipy.special import erfinv

FILE = Path(__file__).parents[2] / "python/asperity_scripts/validate/bem_area.csv"
SHARES = np.unique(np.r_[1 - np.logspace(-14, -0.31, 1500), np.logspace(-0.32, -5, 2500)])[:0:-1]
G = 1 / (4 * erfinv(SHARES) ** 2)

with FILE.open() as file:
    ROWS = list(csv.DictReader(file))
HURST, Q0, Q1, LOAD, AREA = (
    np.array([float(row[name]) for row in ROWS])
    for name in ("H", "q0", "q1", "p_over_Eh", "A_over_A0_corrected")
)
BAND = np.round(Q1 / Q0)
MAP = np.array([row["case"] for row in ROWS])


def nayak():
    m0, m2, m4 = ((BAND ** (n - 2 * HURST) - 1) / (n - 2 * HURST) for n in (0, 2, 4))
    return 1.5 * m0 * m4 / m2**2


ALPHA = nayak()


def area(s, uncorrected):
    """Return P with int_0^G dg / S(P(g)) = uncorrected, by trapezoids over a fine table."""
    rate = 1 / s(SHARES)
    steps = (rate[1:] + rate[:-1]) / 2 * np.diff(G)
    total = G[0] + np.r_[0, np.cumsum(steps)]
    return np.interp(np.log(uncorrected), np.log(total), SHARES)


def errors(shape, numbers):
    """Return A / A_exact - 1 of every row; G = 1 / (8 p*^2) for one modulus."""
    result = np.empty(len(ROWS))
    for alpha, load in set(zip(ALPHA, LOAD, strict=True)):
        same = (alpha == ALPHA) & (load == LOAD)
        result[same] = area(lambda p, a=alpha: shape(p, a, numbers), 1 / (8 * load**2))
    return result / AREA - 1


def persson(p, alpha, t):
    return t[0] + (1 - t[0]) * p**2


def chosen(p, alpha, t, bend=lambda alpha, t: t[0] * (1 - t[1] * alpha**-0.25)):
    gamma = bend(alpha, t)
    return gamma + t[2] * np.sqrt(p) + (1 - gamma - t[2]) * p ** t[3]


def with_log(p, alpha, t):
    return chosen(p, alpha, t, lambda alpha, t: t[0] + t[1] * np.log(alpha))


def with_root(p, alpha, t):
    return chosen(p, alpha, t, lambda alpha, t: t[0] * (1 - t[1] * alpha**-0.5))


def without_band(p, alpha, t):
    return chosen(p, alpha, [*t[:1], 0, *t[1:]])


def linear(p, alpha, t):
    gamma = t[0] * (1 - t[1] * alpha**-0.25)
    return gamma + t[2] * p + (1 - gamma - t[2]) * p ** t[3]


def persson_with_band(p, alpha, t):
    gamma = t[0] * (1 - t[1] * alpha**-0.25)
    return gamma + (1 - gamma) * p**2


def tell(name, error):
    worst = np.abs(error).max()
    print(f"{name:42s} mean {np.abs(error).mean():.4f} worst {worst:.4f}", end="  ")
    print(*(f"{b:.0f}: {100 * e.min():+.1f}..{100 * e.max():+.1f}"
            for b in np.unique(BAND) for e in [error[b == BAND]]))  # fmt: skip


def left_out(groups, start):
    error = np.empty(len(ROWS))
    for group in np.unique(groups):
        out = groups == group
        fit = least_squares(lambda t, out=out: errors(chosen, t)[~out], start)
        error[out] = errors(chosen, fit.x)[out]
    return error


def main():
    tell("S inside G, gamma 0.5", errors(persson, [0.5]))
    tell("S inside G, gamma 5/9", errors(persson, [5 / 9]))
    start = [0.6, 0.4, 0.3, 8]
    for shape, guess in (
        (persson, [0.5]),
        (persson_with_band, [0.6, 0.4]),
        (without_band, [0.5, 0.3, 8]),
        (linear, start),
        (with_log, [0.4, 0.04, 0.3, 8]),
        (with_root, start),
        (chosen, start),
    ):
        fit = least_squares(lambda t, shape=shape: errors(shape, t), guess)
        tell(f"{shape.__name__} {fit.x.round(3)}", fit.fun)
    spread = np.sum(fit.fun**2) / (len(ROWS) - 4) * np.linalg.inv(fit.jac.T @ fit.jac)
    print("errors of the four numbers", np.sqrt(np.diag(spread)).round(3))
    tell("rounded, as in the core", errors(chosen, [0.63, 0.50, 0.29, 13]))
    tell("each map predicted by the others", left_out(MAP, fit.x))
    tell("each bandwidth predicted by the others", left_out(BAND, fit.x))


if __name__ == "__main__":
    main()
