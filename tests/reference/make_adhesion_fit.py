"""Eq. 23 through measured friction: tau_f0, v0 and c with their errors, from the definitions.

Model: ln mu = ln(mu_H + (tau_f0 / sigma0) (A/A0) exp(-c log10(v / v0)^2)), mu_H and A/A0 by
make_friction.py. "Measured" mu: the model times 1 + noise N(0, 1), outliers times a factor.
Estimator, with rho(u) = 1 - (1 - u^2)^3 up to |u| = 1, else 1, and p fitted parameters:
  parameters: a least sum rho(r / (4.685 s)),
  scale s: sum rho(r / (1.5476 s)) = (n - p) / 2 with the same r; of several such pairs that with
  the least s (M-estimates of both: Huber, Robust Statistics (1981), Chapter 7);
  covariance (the same), of the n' points with |r| < 4.685 s:
    (4.685 s K / mean psi')^2 sum psi^2 / (n' - p) (J^T J)^-1,
    K = 1 + p / n' var psi' / (mean psi')^2.
First evaluation: differential evolution for the least s of all parameters, from there and from
around the truth least_squares and the scale by turns. Second: Newton's method with 30 digits on
numerical derivatives, all conditions at once.
Without noise the parameters are those that mu was made with.
"""

import mpmath as mp
import numpy as np
import tables
from make_friction import ASPHALT, row
from scipy.optimize import brentq, differential_evolution, least_squares, root

mp.mp.dps = 30
NAMES = ("shear_stress", "reference_velocity", "width")
ROBUST, EFFICIENT = 1.5476, 4.685
RUBBER = {
    "equilibrium_modulus": 3e6,
    "moduli": [1e7, 1e8, 1e9],
    "relaxation_times": [1e-2, 1e-4, 1e-6],
}
ELASTIC = {"equilibrium_modulus": 1e7, "moduli": [], "relaxation_times": []}
ROAD = {**ASPHALT, "q1": 23340.0, "shift_factor": 2.0}  # the slope is 1.3 there
TRUTH = {"shear_stress": 8.3e6, "reference_velocity": 6e-3, "width": 0.1}
LOW = {**TRUTH, "shear_stress": 5.3e6}


class Data:
    """Points and the model, in double precision and with mpmath."""

    def __init__(self, known, mu, fixed):
        """Take (velocity, pressure, hysteresis, area) of each point."""
        self.velocity, self.pressure, self.hysteresis, self.area = np.array(known).T
        self.mu, self.fixed = np.array(mu), fixed
        self.free = [k for k, name in enumerate(NAMES) if name not in fixed]

    def full(self, free):
        """Return (ln tau_f0, log10 v0, c) with the held ones."""
        whole = [None] * 3
        if "shear_stress" in self.fixed:
            whole[0] = mp.log(self.fixed["shear_stress"])
        if "reference_velocity" in self.fixed:
            whole[1] = mp.log10(self.fixed["reference_velocity"])
        whole[2] = self.fixed.get("width")
        for k, value in zip(self.free, free, strict=True):
            whole[k] = value
        return whole

    def residual(self, free):
        """Return ln mu - ln model, double."""
        log_tau, x0, c = (float(value) for value in self.full(free))
        decades = np.log10(self.velocity) - x0
        adhesion = np.exp(np.clip(log_tau - c * decades**2, -300, 300)) / self.pressure * self.area
        return np.log(self.mu) - np.log(self.hysteresis + adhesion)

    def exact_residual(self, free):
        """Return the same with 30 digits."""
        log_tau, x0, c = self.full(free)
        points = zip(self.velocity, self.pressure, self.hysteresis, self.area, self.mu, strict=True)
        left = []
        for v, p, h, a, mu in points:
            adhesion = mp.exp(log_tau - c * (mp.log10(mp.mpf(v)) - x0) ** 2) / p * mp.mpf(a)
            left.append(mp.log(mp.mpf(mu)) - mp.log(h + adhesion))
        return left


def rho(u):
    """Return the biweight's rho, double."""
    return 1 - np.maximum(1 - u * u, 0) ** 3


def exact_rho(r, cut):
    """Return the sum of rho with 30 digits."""
    return sum(1 - (1 - (x / cut) ** 2) ** 3 if abs(x) < cut else mp.mpf(1) for x in r)


def scale_of(r, target):
    """Return the M-scale."""

    def miss(log_s):
        return np.sum(rho(r / (ROBUST * np.exp(log_s)))) - target

    return np.exp(brentq(miss, -60, 60, xtol=1e-14))


def loss(z):
    """Return rho(z), rho' and rho'' over z = u^2, for least_squares."""
    rest = np.maximum(1 - z, 0)
    return np.array([1 - rest**3, 3 * rest**2, -6 * rest])


def least_scale(data, start, spread):
    """Return parameters near those of least scale, an S-estimate."""
    target = (len(data.mu) - len(data.free)) / 2

    def scale(free):
        return scale_of(data.residual(free), target)

    bounds = list(zip(start - spread, start + spread, strict=True))
    return differential_evolution(scale, bounds, seed=1, popsize=40, tol=1e-8, polish=False).x


def slopes_of(data, free):
    """Return the derivatives of the residuals after the parameters, by differences."""
    columns = []
    for k in range(len(free)):
        step = np.zeros(len(free))
        step[k] = 1e-5
        columns.append((data.residual(free + step) - data.residual(free - step)) / 2e-5)
    return np.array(columns).T


def by_turns(data, at):
    """Return s and the parameters, by least squares at a scale and the scale that follows."""
    target = (len(data.mu) - len(data.free)) / 2
    s, last = scale_of(data.residual(at), target), 0
    while abs(s - last) > 1e-12 * s:
        cut = EFFICIENT * s
        at = least_squares(data.residual, at, loss=loss, f_scale=cut).x

        def slopes(free, cut=cut):
            u = data.residual(free) / cut
            return slopes_of(data, free).T @ (u * np.maximum(1 - u * u, 0) ** 2)

        at = root(slopes, at, tol=1e-14).x  # a minimum is known to half of the digits only
        s, last = scale_of(data.residual(at), target), s
    return s, tuple(at)


def derivative(k, count):
    """Return the orders of the first derivative after argument k."""
    return tuple(int(i == k) for i in range(count))


def at_once(data, at, s):
    """Return the parameters and s that fulfil all conditions, with 30 digits."""
    target = mp.mpf(len(data.mu) - len(data.free)) / 2

    def conditions(*unknown):
        *free, scale = unknown

        def total(*here):
            return exact_rho(data.exact_residual(here), EFFICIENT * scale)

        slopes = [mp.diff(total, free, derivative(k, len(free))) for k in range(len(free))]
        return [*slopes, exact_rho(data.exact_residual(free), ROBUST * scale) - target]

    *free, scale = mp.findroot(conditions, [*at, s], tol=1e-20, maxsteps=50)
    return np.array([float(value) for value in free]), float(scale)


def errors(data, free, s):
    """Return the standard errors of the fitted ones, zeros for the held ones."""
    cut, p = EFFICIENT * s, len(free)
    r = data.residual(free)
    kept = np.abs(r) < cut
    u = r[kept] / cut
    psi, slope = u * (1 - u * u) ** 2, (1 - u * u) * (1 - 5 * u * u)
    j = slopes_of(data, free)[kept]
    few = 1 + p / len(u) * slope.var() / slope.mean() ** 2
    factor = (cut * few / slope.mean()) ** 2 * np.sum(psi**2) / (len(u) - p)
    result = np.zeros(3)
    result[data.free] = np.sqrt(factor * np.diag(np.linalg.inv(j.T @ j)))
    return result, np.flatnonzero(~kept)


def fit(data, truth):
    """Return the columns of what a fit must find."""
    start = np.array([np.log(truth[NAMES[0]]), np.log10(truth[NAMES[1]]), truth[NAMES[2]]])
    spread = np.array([2.0, 3.0, 0.09])
    draw = np.random.default_rng(0)
    around = [start + spread * draw.uniform(-0.5, 0.5, 3) for _ in range(20)]
    starts = [least_scale(data, start[data.free], spread[data.free])]
    starts += [one[data.free] for one in around]
    rough, found = min(by_turns(data, one) for one in starts)
    exact, s = at_once(data, found, rough)
    tables.agree("adhesion_fit", rough, s, 1e-8)
    error, aside = errors(data, exact, s)
    for a, b, sigma in zip(exact, found, error[data.free], strict=True):
        tables.agree("adhesion_fit", a, b, 1e-8, sigma)
    whole = [float(value) for value in data.full(exact)]
    values = [np.exp(whole[0]), 10 ** whole[1], whole[2]]
    values = [data.fixed.get(name, value) for name, value in zip(NAMES, values, strict=True)]
    error *= [values[0], np.log(10) * values[1], 1]
    return values, list(error), s, [float(i) for i in aside]


def case(name, velocities, pressures=(81e3,), noise=0.05, outliers=(), fixed=(), **scene):
    """Return one row; `outliers` are (index, factor)."""
    truth = scene.pop("truth", TRUTH)
    known = []
    for pressure in pressures:
        for velocity in velocities:
            v = float(f"{velocity:.6g}")
            at = {**ROAD, **RUBBER, **scene, "pressure": pressure, "velocity": v}
            found = row(f"{name}, v {v:g}, p {pressure:g}", at)
            known.append([v, pressure, found["hysteresis"], found["contact_area"]])
    known = np.array(known)
    decades = np.log10(known[:, 0] / truth["reference_velocity"])
    mu = known[:, 2] + truth["shear_stress"] / known[:, 1] * known[:, 3] * np.exp(
        -truth["width"] * decades**2
    )
    held = {key: truth[key] for key in fixed}
    values, error, s, aside = [truth[key] for key in NAMES], [None] * 3, None, None
    if noise:
        mu = mu * (1 + noise * np.random.default_rng(1).standard_normal(len(mu)))
        for i, factor in outliers:
            mu[i] *= factor
        mu = np.array([float(f"{value:.8g}") for value in mu])
        values, error, s, aside = fit(Data(known, mu, held), truth)
    used = {**ROAD, **RUBBER, **scene}
    keys = ("rms_height", "hurst", "q0", "q1", *RUBBER, "shift_factor")
    print(name, values, error, s, aside)
    return {
        "case": name,
        **{key: used[key] for key in keys},
        **{f"fixed_{key}": held.get(key) for key in NAMES},
        "pressures": known[:, 1].tolist(),
        "velocities": known[:, 0].tolist(),
        "measured": mu.tolist(),
        **dict(zip(NAMES, values, strict=True)),
        **{f"{key}_error": one for key, one in zip(NAMES, error, strict=True)},
        "residual": s,
        "outliers": aside,
        "rtol": 1e-6,
    }


def main():
    """Write adhesion_fit.csv."""
    wide, short = np.geomspace(1e-6, 1, 20), np.geomspace(1e-5, 0.1, 12)
    bad = [(2, 3.0), (7, 0.3), (8, 2.0), (14, 0.4)]
    rows = [
        case("exact", wide, noise=0),
        case("noise", wide),
        case("low with noise of 10 %", wide, noise=0.1, truth=LOW),
        case("a fifth of outliers", wide, outliers=bad, truth=LOW),
        case("outliers side by side", wide, outliers=[(i, 3.0) for i in (10, 11, 12, 13)]),
        case("three pressures", short[::2], pressures=(81e3, 2e5, 4e5), outliers=[(4, 2.0)]),
        case("width held", short, fixed=("width",)),
        case("velocity held", short, fixed=("reference_velocity",)),
        case("shear stress held", short, fixed=("shear_stress",)),
        case("all but shear stress held", short, fixed=("width", "reference_velocity")),
        case("elastic", short, noise=0.1, **ELASTIC),
    ]
    comments = [
        "Eq. 23 fitted to friction in ln mu, the M-estimate that make_adhesion_fit.py writes out.",
        "Two evaluations of it agree to 1e-8 standard errors; mu_H and A/A0 as in friction.csv.",
        "outliers: indices of the points put aside. exact: no noise, errors and residual empty.",
        "fixed_*: what is held. measured: mu. residual: the scale s of ln mu.",
        "rtol: of the parameters and of the residual; 10 times it, of the errors.",
        "Units: rms_height m; q0, q1 1/m; moduli, pressure, shear_stress Pa; relaxation_times s;",
        "velocities m/s; the rest none.",
    ]
    tables.write("adhesion_fit", comments, rows)


if __name__ == "__main__":
    main()
