"""Make sliding_length.csv: how far the rubber of flash.csv slides from rest until it is warm.

theta(q, t) = int_0^t dt' h(v (t - t') / 2 R) int dq' K(q, q', t - t') f(q', t') with the overlap h
of two discs and K = a (b erfcx(a s) - a erfcx(b s)) / (b^2 - a^2), a = 2 q, b = 2 q', s = sqrt(D (t
- t')), at a velocity that is held: nodes in sqrt(ln q), all of them with a temperature of their
own; times that grow as squares, f linear between them, and Gauss rules in sqrt(t - t') on each
interval; the last heat by iteration. The length is where mu has come to within 1 / e of its value
after 1.5 diameters. `spread` is what half as many times change of it. Nothing of the project is
used.

    python tests/reference/make_sliding_length.py
"""

from pathlib import Path

import numpy as np
from scipy.special import erf, erfcx

HERE = Path(__file__).parent
RADIUS, DENSITY, CAPACITY, CONDUCTIVITY = 5e-4, 1200.0, 1650.0, 0.23
DIFFUSIVITY = CONDUCTIVITY / (DENSITY * CAPACITY)
PRESSURE, BACKGROUND, NU, Q0, HURST, RMS = 2e5, 293.15, 0.5, 2000.0, 0.87, 265.7e-6
FULL = 1e6
REACH = 1.5  # diameters
SCENES = [(23339.76848083597, v) for v in (0.1, 1.0, 10.0)]
SCENES += [(FULL, v) for v in (0.01, 0.1, 1.0, 10.0)]


def terms():
    lines = (HERE / "flash.csv").read_text(encoding="utf-8").splitlines()
    columns = {line.split()[1]: line.split()[2:] for line in lines if line.startswith("# ")}
    return (np.array(columns[name], float) for name in ("moduli", "relaxation_times"))


MODULI, TIMES = terms()
REST = 2e6
WEIGHTS = np.array(
    [2 * e * (REST + (MODULI / (1 + t / TIMES)).sum()) for e, t in zip(MODULI, TIMES, strict=True)]
)


def angular_integrals(w):
    t = w[:, None] * TIMES
    r = np.sqrt(1 + t * t)
    s = t / (r * (r + 1))
    return 2 * np.pi * (MODULI * s).sum(1), 2 * np.pi * (REST**2 + (WEIGHTS * t * s).sum(1))


class Road:
    """Nodes of ln q, and the integrals over them."""

    def __init__(self, q1, velocity, count):
        x, w = np.polynomial.legendre.leggauss(count)
        length, t = np.log(q1 / Q0), (x + 1) / 2
        self.q, self.velocity = Q0 * np.exp(length * t * t), velocity
        self.slope = 2 * length * t  # of ln q
        self.weight = w / 2
        unit = RMS**2 / (2 * np.pi) * 2 * HURST / Q0**2 / (1 - (FULL / Q0) ** (-2 * HURST))
        self.fourth = self.q**4 * unit * (self.q / Q0) ** (-2 - 2 * HURST)
        inverse = np.linalg.inv(np.polynomial.legendre.legvander(x, count - 1))
        powers = np.polynomial.legendre.legint(np.eye(count), lbnd=-1, axis=0)
        at = 2 * np.sqrt(np.log(np.pi / RADIUS / Q0) / length) - 1  # of q_m
        self.up_to = np.polynomial.legendre.legval(x, powers).T / 2 @ inverse
        self.up_to_macro = np.polynomial.legendre.legval(at, powers) / 2 @ inverse

    def heat(self, rise):
        """mu, and f of the nodes [K/s]."""
        warmer = BACKGROUND + rise - 293.15
        i1, i2 = angular_integrals(
            self.velocity * self.q * 10 ** (-8.86 * warmer / (101.6 + warmer))
        )
        rate = self.fourth * i2 * self.slope / (8 * ((1 - NU**2) * PRESSURE) ** 2)
        share = erf(0.5 / np.sqrt(np.maximum(self.up_to @ rate, 1e-300)))
        macro = erf(0.5 / np.sqrt(self.up_to_macro @ rate))
        mu = self.fourth * share * i1 * self.slope * self.weight / (2 * (1 - NU**2) * PRESSURE)
        return mu.sum(), 2 * self.velocity * PRESSURE / (DENSITY * CAPACITY * macro) * self.q * mu

    def kernel(self, time):
        """K of all pairs of nodes after a time."""
        a, b = 2 * self.q[:, None], 2 * self.q[None, :]
        root = np.sqrt(DIFFUSIVITY * time)
        left = erfcx(2 * self.q * root)
        apart = b * b - a * a
        np.fill_diagonal(apart, 1)
        k = a * (b * left[:, None] - a * left[None, :]) / apart
        z = 2 * self.q * root
        np.fill_diagonal(k, (left - z * (2 * z * left - 2 / np.sqrt(np.pi))) / 2)
        return k


def overlap(w):
    return 1 - 2 / np.pi * (w * np.sqrt(1 - w * w) + np.arcsin(w))


def length(q1, velocity, steps, count):
    road = Road(q1, velocity, count)
    s = REACH * (np.arange(steps + 1) / steps) ** 2
    t, diameter = s * 2 * RADIUS / velocity, 2 * RADIUS
    node, weight = np.polynomial.legendre.leggauss(6)
    mu, f = road.heat(np.zeros(count))
    mus, heats = [mu], [f]
    for k in range(1, steps + 1):
        known, last = np.zeros(count), np.zeros((count, count))
        for j in range(1, k + 1):
            begin, end = t[k] - t[j], t[k] - t[j - 1]
            if begin * velocity >= diameter:
                continue
            lower, upper = np.sqrt(begin), np.sqrt(min(end, diameter / velocity))
            for r, w in zip(
                (lower + upper + (upper - lower) * node) / 2,
                (upper - lower) / 2 * weight,
                strict=True,
            ):
                part = (
                    2 * r * w * overlap(min(1.0, velocity * r * r / diameter)) * road.kernel(r * r)
                )
                later = (end - r * r) / (end - begin)
                known += (1 - later) * (part @ heats[j - 1])
                if j < k:
                    known += later * (part @ heats[j])
                else:
                    last += later * part
        f = heats[-1]
        for _ in range(6):
            mu, f = road.heat(np.maximum(known + last @ f, 0))
        mus.append(mu)
        heats.append(f)
    left = (np.array(mus) - mus[-1]) / (mus[0] - mus[-1])
    i = int(np.argmax(left <= np.exp(-1)))
    return s[i - 1] + (s[i] - s[i - 1]) * (left[i - 1] - np.exp(-1)) / (left[i - 1] - left[i])


def main():
    rows = [
        "# Sliding length over the contact's diameter, from the history of heat by brute force:",
        "# make_sliding_length.py. Scenes of flash.csv at 0.2 MPa, 293.15 K. q1 1/m, velocity m/s.",
        "q1,velocity,length_over_diameter,spread",
    ]
    for q1, velocity in SCENES:
        fine, coarse = (length(q1, velocity, steps, 32) for steps in (80, 40))
        rows.append(f"{q1!r},{velocity!r},{fine:.5f},{abs(fine - coarse):.5f}")
    (HERE / "sliding_length.csv").write_text("\n".join(rows) + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()
