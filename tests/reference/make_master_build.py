"""WLF and Arrhenius fits of shift factors, by least squares with 40 digits.

WLF: log10 a_T = -c1 d / (c2 + d), d = T - T_ref: both derivatives of the sum of squares are zero
(Newton in two unknowns, from scipy's fit). Second evaluation: c1 eliminated, the derivative in c2
bisected. Standard errors: s^2 (J^T J)^-1, s^2 the sum of squares over n - 2, n without
a row at the reference, which any law goes through.
Arrhenius: ln a_T = (E_a / R) (1 / T - 1 / T_ref), a straight line through the origin: the normal
equation, and scipy. R = 8.31446261815324 J/(mol K), exact.
"""

import mpmath as mp
import numpy as np
import tables
from scipy.optimize import curve_fit

mp.mp.dps = 40
GAS = mp.mpf("8.31446261815324")


def wlf_sum(c1, c2, d, y):
    """Return the sum of squares."""
    return mp.fsum((yi + c1 * di / (c2 + di)) ** 2 for di, yi in zip(d, y, strict=True))


def wlf(temperature, y, reference):
    """Return c1, c2, their standard errors and the rms residual."""
    d, y = [mp.mpf(t) - mp.mpf(reference) for t in temperature], [mp.mpf(v) for v in y]

    def gradient(c1, c2):
        left = [yi + c1 * di / (c2 + di) for di, yi in zip(d, y, strict=True)]
        return [
            mp.fsum(r * di / (c2 + di) for r, di in zip(left, d, strict=True)),
            mp.fsum(r * di / (c2 + di) ** 2 for r, di in zip(left, d, strict=True)),
        ]

    def of_c2(c2):
        """Return c1 for a given c2, and the derivative of the sum of squares (over -2 c1)."""
        u = [-di / (c2 + di) for di in d]
        c1 = mp.fdot(u, y) / mp.fdot(u, u)
        return c1, gradient(c1, c2)[1]

    start, _ = curve_fit(
        lambda x, c1, c2: -c1 * x / (c2 + x),
        np.array(d, float),
        np.array(y, float),
        p0=(9.0, float(100 - min(d))),
        xtol=1e-14,
        ftol=1e-14,
        maxfev=100000,
    )
    c1, c2 = mp.findroot(gradient, tuple(map(mp.mpf, start)), tol=1e-60)
    for result, expected in zip((c1, c2), start, strict=True):
        tables.agree("scipy", result, mp.mpf(float(expected)), 1e-4)
    again = mp.findroot(
        lambda c: of_c2(c)[1], (c2 * mp.mpf("0.999"), c2 * mp.mpf("1.002")), solver="anderson"
    )
    tables.agree("master_build", c2, again, 1e-20)
    tables.agree("master_build", c1, of_c2(again)[0], 1e-20)
    for factor in ("0.98", "1.02"):  # a minimum
        assert wlf_sum(of_c2(c2 * mp.mpf(factor))[0], c2 * mp.mpf(factor), d, y) > wlf_sum(
            c1, c2, d, y
        )
    n, total = len(d), wlf_sum(c1, c2, d, y)
    jacobian = mp.matrix([[-di / (c2 + di), c1 * di / (c2 + di) ** 2] for di in d])
    data = sum(1 for di in d if di != 0)  # any law goes through the reference
    covariance = mp.inverse(jacobian.T * jacobian) * total / (data - 2)
    return c1, c2, mp.sqrt(covariance[0, 0]), mp.sqrt(covariance[1, 1]), mp.sqrt(total / n)


def arrhenius(temperature, y, reference):
    """Return E_a, its standard error and the rms residual in log10 a_T."""
    u = [1 / mp.mpf(t) - 1 / mp.mpf(reference) for t in temperature]
    y = [mp.log(10) * mp.mpf(v) for v in y]
    slope = mp.fdot(u, y) / mp.fdot(u, u)
    uu = np.array([float(x) for x in u])
    again = np.linalg.lstsq(uu[:, None], np.array(y, float), rcond=None)[0][0]
    tables.agree("master_build", slope, mp.mpf(float(again)), 1e-12)
    total = mp.fsum((yi - slope * ui) ** 2 for ui, yi in zip(u, y, strict=True))
    data = sum(1 for ui in u if ui != 0)  # any law goes through the reference
    error = mp.sqrt(total / (data - 1) / mp.fdot(u, u))
    return GAS * slope, GAS * error, mp.sqrt(total / len(u)) / mp.log(10)


def row(case, temperature, y, reference):
    """Return one row; shift factors are rounded to 6 digits first, as a file would have them."""
    y = [round(float(v), 6) for v in y]
    c1, c2, c1_error, c2_error, residual = wlf(temperature, y, reference)
    energy, energy_error, arrhenius_residual = arrhenius(temperature, y, reference)
    return {
        "case": case,
        "reference_temperature": reference,
        "temperature": [float(t) for t in temperature],
        "log10_a_t": y,
        "c1": c1,
        "c2": c2,
        "c1_error": c1_error,
        "c2_error": c2_error,
        "wlf_residual": residual,
        "activation_energy": energy,
        "activation_energy_error": energy_error,
        "arrhenius_residual": arrhenius_residual,
        "rtol": 1e-6,
    }


def law(temperature, reference, c1=8.86, c2=101.6):
    """Return log10 a_T of WLF."""
    d = temperature - reference
    return -c1 * d / (c2 + d)


def main():
    """Write master_build.csv."""
    rng = np.random.default_rng(11)
    t = np.arange(243.15, 350, 5.0)
    thermal = 1e5 / float(GAS) / np.log(10) * (1 / t - 1 / 293.15)
    rows = [
        row("WLF rounded to 6 digits", t, law(t, 293.15), 293.15),
        row("WLF and 0.02 decades", t, law(t, 293.15) + rng.normal(0, 0.02, t.size), 293.15),
        row("WLF and 0.3 decades", t, law(t, 293.15) + rng.normal(0, 0.3, t.size), 293.15),
        row("reference at the cold end", t, law(t, t[0], 17.44, 51.6), float(t[0])),
        row("reference at the hot end", t, law(t, t[-1], 4.0, 150.0), float(t[-1])),
        row("four temperatures", t[::6], law(t[::6], 293.15), 293.15),
        row(
            "steps of unlike size",
            t[[0, 1, 5, 6, 15, 21]],
            law(t[[0, 1, 5, 6, 15, 21]], 290.0),
            290,
        ),
        row("Arrhenius rounded to 6 digits", t, thermal, 293.15),
        row("Arrhenius and 0.02 decades", t, thermal + rng.normal(0, 0.02, t.size), 293.15),
    ]
    comments = [
        "Least-squares fits of shift factors. WLF: log10 a_T = -c1 d / (c2 + d), d = T - T_ref.",
        "Arrhenius: ln a_T = (E_a / R) (1 / T - 1 / T_ref). Errors s^2 (J^T J)^-1; residuals: rms",
        "of log10 a_T. Generated by make_master_build.py with 40 digits.",
        "Units: temperatures K; c1, c1_error, residuals -; c2, c2_error K; energies J/mol.",
        "Standard errors and residuals: 100 rtol (squares of small differences).",
    ]
    tables.write("master_build", comments, rows)


if __name__ == "__main__":
    main()
