"""Temperature that roughness of one wavenumber feels from heat of another, at steady sliding.

Heat of density 2 q' exp(-2 q' z) below an insulated surface z = 0 spreads along z alone. A time tau
later its mean with the weight 2 q exp(-2 q z) is, for a unit of f(q') exp(-2 q' z),

    K(tau) = (1 / pi) int_0^inf 4 q^2 / (k^2 + 4 q^2) 4 q' / (k^2 + 4 q'^2) exp(-D k^2 tau) dk.

g = int_0^t h K dtau: h = 1 up to t = R / v for the box, and for the disc the overlap of two discs
h(w) = 1 - (2 / pi) (w sqrt(1 - w^2) + asin w), w = tau / t, t = 2 R / v.

First evaluation: closed forms with N(x) = int_0^1 h(w) erfcx(x sqrt w) dw. Second: the integral
over k by the trapezoid in ln k, that over time inside it in closed form (box) or by quadrature.
N itself: quadrature over w of erfcx; over w of (4 / pi) w sqrt(1 - w^2) M (disc), a power series
(box). Q = N - x N': the derivative under the integral; quadrature of Q_M = 3 M - 2 erfcx.
"""

import mpmath as mp
import tables

mp.mp.dps = 40


def erfcx(x):
    """Return exp(x^2) erfc(x)."""
    if x < 25:
        return mp.exp(x * x) * mp.erfc(x)
    total, term, n = mp.mpf(0), mp.mpf(1), 0
    while abs(term) > mp.mpf(10) ** -45:
        total += term
        n += 1
        term *= -(2 * n - 1) / (2 * x * x)
    return total / (x * mp.sqrt(mp.pi))


def erfcx_slope(x):
    """Return the derivative of erfcx, with digits to spare for what cancels."""
    with mp.workdps(80):
        return 2 * x * erfcx(x) - 2 / mp.sqrt(mp.pi)


def overlap(w):
    """Return the share of a disc that another one covers, w diameters away."""
    return 1 - 2 / mp.pi * (w * mp.sqrt(1 - w * w) + mp.asin(w))


def box(x):
    """Return M(x) = int_0^1 erfcx(x sqrt w) dw in closed form, and 3 M - 2 erfcx."""
    with mp.workdps(120):
        e = erfcx(x)
        m = (e - 1 + 2 * x / mp.sqrt(mp.pi)) / (x * x)
        return +m, 3 * m - 2 * e


def edges(x):
    """Return ends of panels in u = sqrt w on which a function of x u is smooth."""
    inside = [mp.mpf(s) / x for s in (0.03, 0.3, 1, 3, 10, 100, 1e4) if mp.mpf(s) / x < 0.5]
    return [mp.mpf(0), *inside, mp.mpf(1) / 2, mp.mpf(1)]


def by_erfcx(x, residence):
    """Return N and N - x N' from their definition, w = u^2."""
    h = overlap if residence == "disc" else lambda w: mp.mpf(1)
    n = mp.quad(lambda u: 2 * u * h(u * u) * erfcx(x * u), edges(x))
    slope = mp.quad(lambda u: 2 * u * h(u * u) * x * u * erfcx_slope(x * u), edges(x))
    return n, n - slope


def by_box(x, residence):
    """Return the same by other forms."""
    if residence == "box":
        return box(x)
    weight = lambda u: 8 / mp.pi * u**3 * mp.sqrt(1 - u**4)  # noqa: E731
    return tuple(mp.quad(lambda u, i=i: weight(u) * box(x * u)[i], edges(x)) for i in (0, 1))


def universal_row(case, x, residence):
    """Return a row of heat_universal."""
    first, second = by_erfcx(mp.mpf(x), residence), by_box(mp.mpf(x), residence)
    for one, other in zip(first, second, strict=True):
        tables.agree("heat_universal", one, other, 1e-17)
    values = {"n": second[0], "q": second[1]}
    return {"case": case, "residence": residence, "x": x, **values, "rtol": 2e-14}


def kernel_closed(q, q_prime, diffusivity, time, residence):
    """Return g by N."""
    x, y = (2 * one * mp.sqrt(diffusivity * time) for one in (q, q_prime))
    if q == q_prime:
        return time / 2 * by_box(x, residence)[1]
    psi_x, psi_y = (by_box(z, residence)[0] / z for z in (x, y))
    return time * x * x * y * (psi_x - psi_y) / (y * y - x * x)


def kernel_over_k(q, q_prime, diffusivity, time, residence):
    """Return g by the integral over k."""
    a, b = 4 * q * q, 4 * q_prime * q_prime

    def over_time(z):
        if residence == "box":
            return -mp.expm1(-z) / z
        ends = sorted({mp.mpf(0), mp.mpf(1), *(min(mp.mpf(s) / z, mp.mpf(1)) for s in (1, 8, 60))})
        return mp.quad(lambda w: overlap(w) * mp.exp(-z * w), ends, maxdegree=7)

    def integrand(s):
        k2 = mp.exp(2 * s)
        lorentz = a / (k2 + a) * 4 * q_prime / (k2 + b)
        return lorentz * time * over_time(diffusivity * k2 * time) * mp.exp(s)

    middle, step = mp.log(2 * mp.sqrt(q * q_prime)), mp.mpf("0.07")
    with mp.workdps(20):
        total = mp.fsum(integrand(middle + i * step) for i in range(-700, 320))
    return step * total / mp.pi


def kernel_row(case, q, q_prime, speed, radius, diffusivity, residence):
    """Return a row of heat_kernel."""
    time = mp.mpf(radius) / mp.mpf(speed) * (2 if residence == "disc" else 1)
    arguments = mp.mpf(q), mp.mpf(q_prime), mp.mpf(diffusivity), time, residence
    closed = kernel_closed(*arguments)
    tables.agree("heat_kernel", closed, kernel_over_k(*arguments), 1e-15)
    return {
        "case": case,
        "q": q,
        "q_prime": q_prime,
        "velocity": speed,
        "contact_diameter": 2 * radius,
        "diffusivity": diffusivity,
        "residence": residence,
        "g": closed,
        "rtol": 1e-13,
    }


def main():
    """Write heat_universal.csv and heat_kernel.csv."""
    rows = [
        universal_row(f"{residence} {x:g}", x, residence)
        for residence in ("disc", "box")
        for x in (
            1e-9,
            1e-3,
            0.1,
            0.3,
            0.4999,
            0.5001,
            1,
            2,
            3.7,
            10,
            40,
            300,
            1e4,
            2.7e5,
            3e5,
            1e8,
        )
    ]
    comments = [
        "N(x) = int_0^1 h(w) erfcx(x sqrt w) dw and Q = N - x dN/dx; h is the overlap of two discs",
        "(disc) or 1 (box). Generated by make_heat_kernel.py with 40 digits.",
    ]
    tables.write("heat_universal", comments, rows)
    pairs = [(2e3, 2e3), (2e3, 2.3e4), (2.3e4, 2e3), (1e6, 3e4), (3e4, 3.0001e4), (3e4, 3.1e4)]
    rows = [
        kernel_row(f"{residence} {v:g} {q:g} {k:g}", q, k, v, 5e-4, 1.16e-7, residence)
        for residence in ("disc", "box")
        for v in (1e-3, 1.0)
        for q, k in pairs
    ]
    comments = [
        "g(q, q') [s], temperature of roughness q [1/m] by heat of roughness q' [1/m]: int_0^t h K",
        "dtau, K of heat flow in z alone. Generated by make_heat_kernel.py, closed forms.",
        "Units: velocity m/s, contact_diameter 2 R m, diffusivity m^2/s.",
    ]
    tables.write("heat_kernel", comments, rows)


if __name__ == "__main__":
    main()
