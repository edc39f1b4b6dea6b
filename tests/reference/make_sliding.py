"""Steady sliding contact of small maps with rubber, exact on their grid.

u = K p with K a dense matrix, summed mode by mode from K_q = 2 (1 - nu^2) / (|q| conj E(v q_x)) and
K_0 = 0; modes with q_x = 0 have the mean of 1 / E over |q_x| < pi / L, the finest ones along x the
real part. p >= 0, u - h - delta >= 0, complementary, <p> = sigma0. K is monotone: the solution is
unique.
First evaluation: guesses of the points in contact, each solved densely, until all signs are right.
Second: Korpelevich's extragradient method (Matekon 13 (1977) 35), which knows no sets.
"""

import numpy as np
import tables
from scipy.integrate import quad
from scipy.optimize import brentq

LENGTH = 0.01


def heights(points, waves):
    """Return h [m]: a sum of `amplitude cos(2 pi (k_x x + k_y y) / L + phase)`."""
    y, x = np.meshgrid(np.arange(points), np.arange(points), indexing="ij")
    angle = [2 * np.pi * (kx * x + ky * y) / points + phase for kx, ky, _, phase in waves]
    return sum(wave[2] * np.cos(one) for wave, one in zip(waves, angle, strict=True))


def inverse_modulus(rubber, frequency):
    """Return 1 / conj E."""
    storage, loss = tables.prony(frequency, *rubber)
    return 1 / (storage - 1j * loss)


def compliance(points, rubber, velocity, poisson_ratio):
    """Return K_q of all modes, q_x, and the band's mean of q_x Im K at q_x = 0."""
    k = np.fft.fftfreq(points, 1 / points)
    qx, qy = np.meshgrid(2 * np.pi * k / LENGTH, 2 * np.pi * k / LENGTH)
    q = np.hypot(qx, qy)
    q[0, 0] = np.inf
    inverse = np.where(qx < 0, np.conj(inverse_modulus(rubber, velocity * abs(qx))), 0)
    inverse = np.where(qx >= 0, inverse_modulus(rubber, velocity * abs(qx)), inverse)
    if points % 2 == 0:
        inverse[:, points // 2] = inverse[:, points // 2].real
    end = np.pi / LENGTH
    # in ln q: the modulus changes over decades of it
    pieces = [(np.log(end) - 12 * i, np.log(end) - 12 * (i - 1)) for i in (1, 2, 3)]

    def mean(f):
        def weighed(s):
            return f(inverse_modulus(rubber, velocity * np.exp(s)), np.exp(s)) * np.exp(s) / end

        options = {"epsabs": 0, "epsrel": 1e-13, "limit": 500}
        return sum(quad(weighed, *piece, **options)[0] for piece in pieces)

    band = mean(lambda inverse, q: q * inverse.imag)
    inverse[:, 0] = mean(lambda inverse, q: inverse.real)
    factor = 2 * (1 - poisson_ratio**2) / q
    return factor * inverse, qx, np.where(qx == 0, factor * band, 0)


def dense(stiff):
    """Return the matrix of the convolution with the modes' factors."""
    points = len(stiff)
    index = np.arange(points)
    wave = np.exp(2j * np.pi * np.outer(index, index) / points)
    kernel = (wave @ stiff @ wave).real / points**2  # response to a unit load in the corner
    shift = (index[:, None] - index) % points
    rows = kernel[shift[:, None, :, None], shift[None, :, None, :]]
    return rows.reshape(points**2, points**2)


def by_sets(matrix, h, load):
    """Return p: Newton steps on the set, damped by a proximal term that is let go at the end."""
    n = h.size
    p = np.full(n, load)
    symmetric = (matrix + matrix.T) / 2
    extra = 3.0
    touching = np.ones(n, bool)
    for step in range(4000):
        weight = extra if step % 40 < 39 else 0.0
        held = matrix + weight * symmetric
        m = int(touching.sum())
        system = np.zeros((m + 1, m + 1))
        system[:m, :m] = held[np.ix_(touching, touching)]
        system[:m, m], system[m, :m] = -1, 1
        right = h + weight * (symmetric @ p)
        result = np.linalg.solve(system, np.append(right[touching], load * n))
        trial = np.zeros(n)
        trial[touching] = result[:m]
        gap = held @ trial - right - result[m]
        scale = np.abs(h).max()
        if weight == 0 and trial.min() >= 0 and gap.min() > -1e-11 * scale:
            return trial, gap
        if weight:
            keep = np.where(touching, trial > 0, gap < 0)
            p = np.maximum(trial, 0)
            p *= load * n / p.sum()
            touching = keep
    raise AssertionError("no set was found")


def by_extragradient(k, h, load):
    """Return p by projected steps along the gap, two a step."""

    def gap(p):
        return np.fft.ifft2(np.fft.fft2(p) * k).real - h

    def project(p):
        def excess(shift):
            return np.maximum(p + shift, 0).mean() - load

        wide = np.ptp(p) + load
        shift = brentq(excess, -p.max(), wide - p.min(), xtol=1e-14 * wide)
        return np.maximum(p + shift, 0)

    step = 0.9 / np.abs(k).max()
    p = np.full_like(h, load)
    for count in range(200_000):
        moved = project(p - step * gap(p))
        new = project(p - step * gap(moved))
        if count % 100 == 0 and np.abs(new - p).max() < 1e-13 * p.max():
            break
        p = new
    return p


def figures(p, gap, h, load, modes):
    """Return area, both frictions, energy and mean gap."""
    k, qx, band = modes
    pq, hq = np.fft.fft2(p) / p.size, np.fft.fft2(h) / h.size
    if len(p) % 2 == 0:
        qx = np.where(np.arange(len(p)) == len(p) // 2, 0, qx)
    power = np.abs(pq) ** 2
    u = np.fft.ifft2(np.fft.fft2(p) * k).real
    return {
        "contact_area": float(np.mean(p > 0)),
        "hysteresis": float((power * (qx * k.imag + band)).sum() / load),
        "work_of_slopes": float(-(np.conj(pq) * 1j * qx * hq).sum().real / load),
        "elastic_energy": float(np.mean(p * u) / 2),
        "highest_pressure": float(p.max()),
        "mean_gap": float(gap.mean()),
    }


def row(case, points, waves, rubber, poisson_ratio, load, velocity):
    """Return one row, both evaluations compared."""
    h = heights(points, waves)
    modes = compliance(points, rubber, velocity, poisson_ratio)
    p, gap = by_sets(dense(modes[0]), h.ravel(), load)
    first = figures(p.reshape(h.shape), gap, h, load, modes)
    slow = by_extragradient(modes[0], h, load)
    free = np.fft.ifft2(np.fft.fft2(slow) * modes[0]).real - h
    second = figures(slow, free - free.min(), h, load, modes)
    for name, value in first.items():
        tables.agree("sliding", value, second[name], 1e-7)
    equilibrium, moduli, times = rubber
    return {
        "case": case,
        "points": points,
        "length": LENGTH,
        "kx": [wave[0] for wave in waves],
        "ky": [wave[1] for wave in waves],
        "amplitude": [wave[2] for wave in waves],
        "phase": [wave[3] for wave in waves],
        "equilibrium_modulus": equilibrium,
        "moduli": moduli,
        "relaxation_times": times,
        "poisson_ratio": poisson_ratio,
        "pressure": load,
        "velocity": velocity,
        **first,
        "rtol": 1e-9,
    }


WAVES = [
    (1, 0, 8e-5, 0.3),
    (1, 1, 6e-5, 1.7),
    (0, 1, 7e-5, 4.0),
    (2, -1, 3e-5, 2.2),
    (1, 2, 2.5e-5, 5.1),
    (3, 1, 1.5e-5, 0.9),
    (2, 3, 1e-5, 3.3),
]
SOLID = (1e6, [9e6], [1e-3])
LOSSY = (1e6, [9.9e7], [1e-3])
LOSSIEST = (1e6, [9.99e8], [1e-3])
SERIES = (5e5, [1e6, 4e6, 2e7], [1.0, 1e-2, 1e-4])


def main():
    """Write sliding.csv."""
    rows = [
        row("slow", 24, WAVES, SOLID, 0.5, 2e4, 1e-2),
        row("steepest", 24, WAVES, SOLID, 0.5, 3e4, 1.0),
        row("fast", 24, WAVES, SOLID, 0.5, 3e4, 3e1),
        row("loss tangent of 5", 24, WAVES, LOSSY, 0.5, 1e5, 0.3),
        row("loss tangent of 16", 24, WAVES, LOSSIEST, 0.5, 3e5, 0.03),
        row("a compressible series", 24, WAVES, SERIES, 0.3, 4e4, 0.1),
        row("an odd number of points", 21, WAVES, SOLID, 0.45, 3e4, 1.0),
    ]
    tables.write(
        "sliding",
        [
            "Steady sliding contact on a grid of points x points, p and gap >= 0, <p> = pressure.",
            "h = sum of amplitude cos(2 pi (kx x + ky y) / length + phase), sliding along x.",
            "Generated by make_sliding.py: dense systems on sets, and the extragradient method.",
            "Units: length, amplitude, mean_gap m; moduli, pressures Pa; times s; velocity m/s;",
            "elastic_energy J/m^2; contact_area is the share of points with pressure.",
        ],
        rows,
    )


if __name__ == "__main__":
    main()
