"""Contact area and hysteresis of a scene by two methods, shared by the friction scripts.

With y = ln q, x = ln(y - y0) and g(y) = G'(y) (THEORY.md section 3),
  G = int g dy, hysteresis = (1/2) int q^4 (C / p^2) P(G) I1 dy / ((1 - nu^2) sigma0).
The variable x resolves the front of any width, dy = exp(x) dx; it starts 45 e-folds below the
smaller of the front's width 1 / g(y0) and the band, where G and the friction are below 1e-19.
Method one: Gauss panels in x, cumulative integrals by collocation inside each panel.
Method two: the same as ordinary differential equations, with other angular integrals.
"""

from itertools import pairwise

import numpy as np
from scipy.integrate import solve_ivp
from scipy.optimize import brentq
from scipy.special import erf

NODES, WEIGHTS = np.polynomial.legendre.leggauss(16)
_POWERS = np.polynomial.legendre.legvander(NODES, 15)
_INTEGRALS = np.array(
    [
        np.polynomial.legendre.legval(NODES, np.polynomial.legendre.legint(row, lbnd=-1))
        for row in np.eye(16)
    ]
).T
CUMULATIVE = _INTEGRALS @ np.linalg.inv(_POWERS)  # integrals from -1 to each node


def spectrum(scene):
    """Return C(q) with the rms height on the band, the integral of q C done by Gauss panels."""
    h, q0, q1, qr = scene["hurst"], scene["q0"], scene["q1"], scene["rolloff"] or scene["q0"]

    def shape(q):
        return np.maximum(q / qr, 1.0) ** (-2 * (h + 1))

    total = 0.0
    for low, high in ((q0, qr), (qr, q1)):
        length = np.log1p((high - low) / low)
        edges = np.linspace(0, length, 201)
        half = length / 400
        y = (edges[:-1, None] + half) + half * NODES
        q = low * np.exp(y)
        total += half * np.sum(WEIGHTS * q * q * shape(q))
    return lambda q: scene["rms_height"] ** 2 / (2 * np.pi * total) * shape(q)


def spectrum_closed(scene):
    """Return C(q) with the closed amplitude."""
    h, q0, q1, qr = scene["hurst"], scene["q0"], scene["q1"], scene["rolloff"] or scene["q0"]
    tail = -np.expm1(-2 * h * np.log1p((q1 - qr) / qr)) / (2 * h)
    amplitude = scene["rms_height"] ** 2 / (2 * np.pi)
    amplitude /= (qr - q0) * (qr + q0) / 2 + qr * qr * tail
    return lambda q: amplitude * np.maximum(q / qr, 1.0) ** (-2 * (h + 1))


def area_law(form):
    """Return P(G)."""
    if form == "exact":
        return lambda g: erf(0.5 / np.sqrt(g))
    return lambda g: (1 + (np.pi * g) ** 1.5) ** (-1 / 3)


def limits(scene, slope0, knots):
    """Return y0's distances x at the panel limits: start, knots (wavenumbers), end."""
    q0, q1 = scene["q0"], scene["q1"]
    ends = [np.log1p((q - q0) / q0) for q in sorted({*knots, q1}) if q0 < q <= q1]
    return np.log([min(1 / slope0, ends[-1]) * np.exp(-45.0), *ends])


def solve(scene, integrals, other_integrals, knots=()):
    """Return area, corrected area, hysteresis, corrected hysteresis and G by both methods.

    `integrals(w)` and `other_integrals(w)` return I1 and I2 by independent means, `knots` are
    wavenumbers at which the integrands have kinks.
    """
    knots = [*knots, scene["rolloff"] or scene["q1"]]
    first = refine(scene, integrals, knots)
    second = by_differential_equation(scene, other_integrals, knots)
    return first, second


def factors(scene, integrals, density):
    """Return the function q -> (dG/dy, d hysteresis/dy without P)."""
    load = (1 - scene["poisson_ratio"] ** 2) * scene["pressure"]

    def rates(q):
        i1, i2 = integrals(scene["velocity"] * q)
        power = (q * q) * (q * q) * density(q) / scene["shift_factor"] ** 2
        return power * i2 / (8 * load**2), power * i1 / (2 * load)

    return rates


def refine(scene, integrals, knots):
    """Return the results by Gauss panels, doubled until they change by less than 3e-12."""
    panels, old = 256, None
    while panels <= 4096:
        new = by_panels(scene, integrals, knots, panels)
        if old is not None and np.allclose(new, old, rtol=3e-12, atol=0):
            return new
        panels, old = 2 * panels, new
    raise AssertionError(("not converged", scene["case"], old, new))


def by_panels(scene, integrals, knots, panels):
    """Return the results with about `panels` panels in x."""
    rates = factors(scene, integrals, spectrum(scene))
    x_limits = limits(scene, rates(np.array([scene["q0"]]))[0][0], knots)
    width = (x_limits[-1] - x_limits[0]) / panels
    pieces = [np.linspace(a, b, 2 + int((b - a) / width)) for a, b in pairwise(x_limits)]
    edges = np.concatenate([pieces[0], *(piece[1:] for piece in pieces[1:])])
    half = np.diff(edges)[:, None] / 2
    x = edges[:-1, None] + half + half * NODES
    q = scene["q0"] * np.exp(np.exp(x))
    g_rate, h_rate = (rate.reshape(x.shape) for rate in rates(q.ravel()))
    g_rate, h_rate = g_rate * np.exp(x), h_rate * np.exp(x)
    start = g_rate[0, 0] * np.exp(x_limits[0] - x[0, 0])
    whole = np.sum(WEIGHTS * g_rate * half, axis=1)
    before = start + np.concatenate([[0.0], np.cumsum(whole)])
    g = before[:-1, None] + half * (g_rate @ CUMULATIVE.T)
    assert np.all(g > 0)
    gamma, law = scene["gamma"], area_law(scene["form"])
    p = law(g)
    hysteresis = np.sum(WEIGHTS * h_rate * half * p)
    hysteresis_s = np.sum(WEIGHTS * h_rate * half * p * (gamma + (1 - gamma) * p * p))
    g1 = before[-1]
    return np.array([law(g1), corrected_area(g1, gamma, law), hysteresis, hysteresis_s, g1])


def corrected_area(uncorrected, gamma, law):
    """Return P(G) at the G with int_0^G dg / S(P(g)) = uncorrected, by Gauss panels and brentq."""

    def integral(log_g):
        edges = np.linspace(log_g - 50, log_g, 801)
        half = (edges[1] - edges[0]) / 2
        g = np.exp(edges[:-1, None] + half + half * NODES)
        return half * np.sum(WEIGHTS * g / (gamma + (1 - gamma) * law(g) ** 2))

    def miss(log_g):
        return np.log(integral(log_g) / uncorrected)

    top = np.log(uncorrected)
    return law(np.exp(brentq(miss, top / 2 - 8 if top > 0 else top - 8, top + 1e-9, xtol=1e-14)))


def by_differential_equation(scene, integrals, knots):
    """Return the results by DOP853 in x; state: ln G, ln G corrected, both hysteresis sums."""
    rates = factors(scene, integrals, spectrum_closed(scene))
    gamma, law = scene["gamma"], area_law(scene["form"])
    slope0, friction0 = (rate[0] for rate in rates(np.array([scene["q0"]])))
    x_limits = limits(scene, slope0, knots)

    def s_factor(p):
        return gamma + (1 - gamma) * p * p

    def derivative(x, state):
        q = scene["q0"] * np.exp(np.exp(x))
        g_rate, h_rate = (rate[0] * np.exp(x) for rate in rates(np.array([q])))
        g, g_s = np.exp(state[:2])
        p = law(g)
        h = h_rate * p
        return [g_rate / g, s_factor(law(g_s)) * g_rate / g_s, h, h * s_factor(p)]

    start, friction = np.log(slope0) + x_limits[0], friction0 * np.exp(x_limits[0])
    state = np.array([start, start, friction, friction])
    for a, b in pairwise(x_limits):
        state = solve_ivp(
            derivative,
            (a, b),
            state,
            method="DOP853",
            rtol=1e-12,
            atol=[1e-12, 1e-12, 1e-99, 1e-99],
        ).y[:, -1]
    g, g_s = np.exp(state[:2])
    return np.array([law(g), law(g_s), state[2], state[3], g])


def columns(results):
    """Return the columns of a table from what `solve` returns first."""
    area, area_s, hysteresis, hysteresis_s, g = (float(value) for value in results)
    return {
        "g": g,
        "contact_area": area,
        "contact_area_s": area_s,
        "hysteresis": hysteresis,
        "hysteresis_s": hysteresis_s,
        "rtol": 1e-6,
    }
