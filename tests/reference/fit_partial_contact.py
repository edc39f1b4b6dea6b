"""The fit behind PartialContact, done again: stress spectrum, area and friction by one sum rule.

    python fit_partial_contact.py [judge | powers]

With y = ln q, c = q^4 C, M = int c dy from q0, K = 1 / (8 ((1 - nu^2) sigma0)^2), dG = K I2 c dy:
    A(q) = erf(1 / (2 sqrt(kappa G)))                   and A1 = A(q1)
    R = A / (1 + Z)^2,   Z = Q A^2 K I2 w,              w = (M(y + 1) - M(y - 1)) / 2
    Q = obstacle (4 w_e / M(q1))^(1/5) kappa^(1/4) (1 - A1)^(1/8) (1 + light (1 - A1^(1/10))^3)
    T = edges A1 (1 - A1^(1/4)) max(1, 0.1 / rho) K I2(q_e) w_e (I2 / I2(q_e))^(5/4) x^-3,
    x = q / q_e to 33,   rho = K I2(q_e) M(q1) / G1,   w_e = max(w(q_e), M(q1) / 20)
    int R dG + int T d ln x = F(kappa G1) B,            F(g) = int_0^g erf(1 / (2 sqrt(u))) du
    B = 1 + (spread A1 + stiff max(0, 1 - 1 / rho)^4) (1 - A1^8)
    mu = 4 (1 - nu^2) sigma0 (int (I1 / I2) R dG + int (I1 / I2) T d ln x)
where ln q_e is the mean of ln q over the last tenth of M. Least squares in ln A and ln mu, with a
soft loss, over the rows fit of exact_sliding.csv, sliding_contacts.csv and the elastic areas of
bem_area.csv; each contact is weighed by how far maps scatter at its load and how fine its mesh is.
Prints the five numbers, and what leaving out a rubber, an H or a bandwidth does; with `judge` the
errors of the stated constants on the rows that no fit saw; with `powers` the fit in which the
powers are free, too.
"""

import csv
import sys
from dataclasses import dataclass
from pathlib import Path

import make_exact_sliding
import numpy as np
from scipy.optimize import least_squares
from scipy.special import erf, erfc

HERE = Path(__file__).parent
BEM = HERE.parents[1] / "python/asperity_scripts/validate/bem_area.csv"
NU = 0.5
NODES = 35  # a unit of ln q
TAIL_STEP = np.log(33) / 60
TAIL = TAIL_STEP * (np.arange(60) + 0.5)
STATED = {"obstacle": 0.67, "light": 6.3, "edges": 3.55, "spread": 0.105, "stiff": 0.45}
POWERS = {"end": 0.2, "kappa": 0.25, "gap": 0.125, "local": 2, "passed": 2, "far": 3, "tail": 1.25}


@dataclass
class Stress:
    """Of all contacts at their kappa: a row each, of nodes or of TAIL."""

    band: np.ndarray  # R
    beyond: np.ndarray  # T
    area: np.ndarray  # A1
    persson: np.ndarray  # F B


def read(path):
    """Return the rows of a table."""
    with path.open() as file:
        return [*csv.DictReader(line for line in file if line[0] != "#")]


def angular(rubber, frequency):
    """Return I1 and I2 in closed form; rubber: moduli over E_inf, times."""
    moduli, times = (np.array(column) for column in rubber)
    x = np.multiply.outer(frequency, times)
    share = x**2 / (np.hypot(1, x) * (np.hypot(1, x) + 1))
    pairs = 2 * moduli * (1 + (moduli * times / (times[:, None] + times)).sum(-1))
    loss = np.divide(share, x, out=np.zeros_like(x), where=x > 0)
    return 2 * np.pi * loss @ moduli, 2 * np.pi * (1 + share @ pairs)


def shipped():
    """Return contacts: rubber's name, H, k0, k1, velocity, pressure, A, mu, A_raw / A, points."""
    result = {"fit": [], "judge": [], "bent": [], "curve": []}
    for row in make_exact_sliding.rows():
        figures = [float(row[n]) for n in ("hurst", "k0", "k1", "velocity", "pressure", "A", "mu")]
        raw = float(row["A_raw"]) / figures[5]
        result[row["set"]].append((row["rubber"], *figures, raw, False))
    for row in read(HERE / "sliding_contacts.csv"):
        names = ("hurst", "k0", "k1", "velocity", "pressure", "A", "mu")
        if float(row["error"]) <= 1e-4 and float(row["A"]) < 0.96:
            result["fit"].append((row["material"], *(float(row[n]) for n in names), 1.1, False))
    for row in read(BEM):
        h, q0, q1 = (float(row[n]) for n in ("H", "q0", "q1"))
        area, load = (float(row[n]) for n in ("A_over_A0_corrected", "p_over_Eh"))
        if q1 / q0 > 7.5 and 0.3 <= h < 1 and area < 0.96:
            k0, k1 = q0 / (2 * np.pi), q1 / (2 * np.pi)
            pressure = load / (1 - NU**2)  # rms slope 1
            result["fit"].append(("elastic", h, k0, k1, 0.0, pressure, area, 0.0, 1.1, True))
    return result


class Contacts:
    """Nodes on the band and beyond of all contacts, and what the rule needs there."""

    def __init__(self, rows):
        (self.rubber, self.hurst, self.k0, self.k1, velocity, pressure, self.area, self.friction,
         self.raw, self.bem) = (np.array(column) for column in zip(*rows, strict=True))  # fmt: skip
        band = np.log(self.k1 / self.k0)
        n = int(NODES * band.max())
        self.load, self.velocity, rise = pressure, velocity, 2 - 2 * self.hurst[:, None]
        edges = band[:, None] * np.linspace(0, 1, n + 1)

        def mass(y):  # 2 pi M(q1) = 1, the slope's variance
            part = np.expm1(rise * np.clip(y, 0, band[:, None]))
            return part / np.expm1(rise * band[:, None]) / (2 * np.pi)

        step = np.diff(mass(edges))
        y = (edges[:, 1:] + edges[:, :-1]) / 2
        self.window = (mass(y + 1) - mass(y - 1)) / 2
        last = 1 - 0.1 * (np.arange(100) + 0.5) / 100  # of M, and where it is reached
        end = np.log1p(last * np.expm1(rise * band[:, None])) / rise
        end = end.mean(1)[:, None]
        self.end = self.k0 * np.exp(end[:, 0])  # q_e / (2 pi)
        self.end_window = np.maximum((mass(end + 1) - mass(end - 1))[:, 0] / 2, 0.05 / (2 * np.pi))
        self.k = 1 / (8 * ((1 - NU**2) * pressure) ** 2)
        self.i1, self.i2 = np.empty_like(y), np.empty_like(y)
        self.t1, self.t2 = np.empty((len(rows), TAIL.size)), np.empty((len(rows), TAIL.size))
        self.end_i2 = np.empty(len(rows))
        for i, name in enumerate(self.rubber):
            made, speed = make_exact_sliding.RUBBERS[name], 2 * np.pi * velocity[i]
            self.i1[i], self.i2[i] = angular(made, speed * self.k0[i] * np.exp(y[i]))
            at_end = speed * self.k0[i] * np.exp(end[i])
            self.t1[i], self.t2[i] = angular(made, at_end * np.exp(TAIL))
            self.end_i2[i] = angular(made, at_end)[1][0]
        self.dg = self.k[:, None] * self.i2 * step
        self.g = np.cumsum(self.dg, 1) - self.dg / 2
        self.g1 = self.dg.sum(1)
        self.stiffness = self.k * self.end_i2 / (2 * np.pi) / self.g1

    def root(self, numbers, variance=None):
        """Return the stress at the kappa of the sum rule, or at that which has a known variance."""
        low, high = np.full(self.g1.size, np.log(1e-2)), np.full(self.g1.size, np.log(1e2))
        for _ in range(34):
            middle = (low + high) / 2
            stress = self.stress(numbers, np.exp(middle))
            known = self.variance(stress) if variance is None else variance
            above = known > stress.persson
            low, high = np.where(above, middle, low), np.where(above, high, middle)
        return stress

    def solve(self, numbers):
        """Return A1 and mu by the rule."""
        stress = self.root(numbers)
        return stress.area, self.hysteresis(stress)

    def stress(self, numbers, kappa):
        """Return the stress at any kappa; the powers may stand behind the five numbers."""
        obstacle, light, edges, spread, stiff = numbers[:5]
        powers = numbers[5:] if len(numbers) > 5 else POWERS.values()
        end, of_kappa, gap, local, passed, far, tail = powers
        share = erf(0.5 / np.sqrt(kappa[:, None] * self.g))
        g = kappa * self.g1
        s = 0.5 / np.sqrt(g)
        a1, rest = erf(s), erfc(s)
        q = obstacle * (8 * np.pi * self.end_window) ** end * kappa**of_kappa * rest**gap
        q *= 1 + light * (1 - a1**0.1) ** far
        r = share / (1 + (q * self.k)[:, None] * self.i2 * self.window * share**local) ** passed
        t = edges * a1 * (1 - a1**0.25) * self.k * self.end_i2 * self.end_window
        t *= np.maximum(1, 0.1 / self.stiffness)
        t = t[:, None] * (self.t2 / self.end_i2[:, None]) ** tail * np.exp(-3 * TAIL)
        f = g * a1 + np.sqrt(g / np.pi) * np.exp(-(s**2)) - rest / 2
        f = np.where(g < 3e-3, g, f)
        b = 1 + (spread * a1 + stiff * np.maximum(1 - 1 / self.stiffness, 0) ** 4) * (1 - a1**8)
        return Stress(r, t, a1, f * b)

    def variance(self, stress):
        """Return int R dG + int T d ln x."""
        return (stress.band * self.dg).sum(1) + stress.beyond.sum(1) * TAIL_STEP

    def hysteresis(self, stress):
        """Return mu."""
        band = (self.i1 / self.i2 * stress.band * self.dg).sum(1)
        beyond = (self.t1 / self.t2 * stress.beyond).sum(1) * TAIL_STEP
        return 4 * (1 - NU**2) * self.load * (band + beyond)

    def errors(self, numbers):
        """Return relative errors of mu (NaN without friction) and A."""
        area, friction = self.solve(numbers)
        truth = np.where(self.friction > 0, self.friction, np.nan)
        return friction / truth - 1, area / self.area - 1

    def weighted(self, numbers):
        """Return what least squares make small: one map of 4 waves scatters by 3 % and more."""
        light = np.clip(np.log10(0.05 / self.area), 0, 2) * 4 / self.k0
        coarse, rough = np.clip(self.raw - 1.08, 0, 1), np.clip((self.hurst - 0.8) / 0.15, 0, 1)
        of_mu = np.hypot(0.03, 0.05 * light)
        of_area = np.sqrt(
            0.015**2
            + (0.05 * light) ** 2
            + (0.1 * coarse) ** 2
            + (0.03 * rough * 4 / self.k0 * (1 - self.area)) ** 2
        )
        mu, area = self.errors(numbers)
        known = np.where(self.bem, 0.35, 1)
        mu = np.where(np.isfinite(mu), np.log1p(np.maximum(mu, -0.99)), 0)
        return np.r_[0.03 * known * mu / of_mu, 0.02 * known * np.log1p(area) / of_area]


def fit(contacts, start):
    """Return the numbers, as many as there are in `start`."""
    return least_squares(
        contacts.weighted, start, x_scale=start, diff_step=1e-3, loss="soft_l1", f_scale=0.08
    ).x


def told(contacts, numbers):
    """Return errors in %: rms, mean and worst, of mu above and below A = 0.02, and of A."""
    mu, area = contacts.errors(numbers)
    elastic = contacts.rubber == "elastic"
    parts = {
        "mu": mu[(contacts.area > 0.02) & ~elastic],
        "mu where A < 0.02": mu[(contacts.area <= 0.02) & ~elastic],
        "A": area[~elastic],
        "elastic A": area[elastic],
    }
    return "; ".join(
        f"{name} {100 * np.sqrt(np.mean(e**2)):.1f} (mean {100 * e.mean():+.1f}, "
        f"{100 * e.min():+.0f} to {100 * e.max():+.0f}, {e.size})"
        for name, e in parts.items()
        if e.size
    )


def main():
    """Print the fit, its parts, or the judgement."""
    rows = shipped()
    stated = [*STATED.values()]
    if sys.argv[1:] == ["judge"]:
        print("judge:", told(Contacts(rows["judge"]), stated))
        return
    everything = Contacts(rows["fit"])
    if sys.argv[1:] == ["powers"]:
        found = fit(everything, [*stated, *POWERS.values()])
        print("fitted:", dict(zip([*STATED, *POWERS], found.round(3), strict=True)))
        print("  ", told(everything, found))
        return
    found = fit(everything, stated)
    print("fitted:", dict(zip(STATED, found.round(3), strict=True)))
    print("  ", told(everything, found))
    print("stated:", STATED)
    print("  ", told(everything, stated))
    left_out = [("rubber", 0, name) for name in ("sls10", "sls100", "sls1000", "sbr", "broad20")]
    left_out += [("H", 1, h) for h in (0.35, 0.5, 0.65, 0.8, 0.95)]
    for what, column, value in left_out:
        kept = Contacts([row for row in rows["fit"] if row[column] != value])
        numbers = fit(kept, stated)
        out = Contacts([row for row in rows["fit"] if row[column] == value])
        print(f"without {what} {value}:", numbers.round(3), told(out, numbers))
    for ratio in (8, 16, 32, 64):
        parts = [[], []]
        for row in rows["fit"]:
            parts[round(row[3] / row[2]) == ratio].append(row)
        numbers = fit(Contacts(parts[0]), stated)
        out = Contacts(parts[1])
        print(f"without q1/q0 {ratio}:", numbers.round(3), told(out, numbers))


if __name__ == "__main__":
    main()
