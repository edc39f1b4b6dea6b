"""Tables of moduli that are awkward to integrate over a circle of directions."""

import numpy as np

RNG = np.random.default_rng(20)


def rubber(w):
    """E' and E'' of a glass transition and a slow process [Pa]."""
    modulus = 3e6 + 2e9 / (1 + (1e-7j * w) ** -0.45) + 5e6 / (1 + (1e-2j * w) ** -0.3)
    return modulus.real, modulus.imag


def even(rows, low, high):
    w = np.geomspace(low, high, rows)
    return w, *rubber(w)


def uneven(rows):
    w = np.sort(10 ** RNG.uniform(-6, 9, rows))
    return w, *rubber(w)


def kinks(rows):
    """Nine decades up and down from row to row."""
    return (
        np.geomspace(1e-3, 1e6, rows),
        10 ** RNG.uniform(2, 11, rows),
        10 ** RNG.uniform(1, 10, rows),
    )


def step(gap):
    """Rows so near to each other that E'' jumps."""
    w = np.array([1, 10, 10 * (1 + gap), 100, 1e4])
    return w, np.array([1e6, 2e6, 3e6, 4e6, 4e8]), np.array([1e5, 2e5, 9e5, 1e6, 1e5])


TABLES = {
    "two rows": (*even(2, 1, 1e3),),
    "two rows, 30 decades": (np.array([1e-15, 1e15]), np.array([1e3, 1e12]), np.array([1e2, 1e10])),
    "30 decades": even(61, 1e-15, 1e15),
    "four rows": even(4, 1e-5, 1e10),
    "50 rows": even(50, 1e-5, 1e10),
    "1200 rows": even(1200, 1e-5, 1e10),
    "uneven": uneven(30),
    "hundreds, uneven": uneven(300),
    "kinks": kinks(10),
    "step": step(1e-4),
}
