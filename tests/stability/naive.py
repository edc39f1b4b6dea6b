"""What is usually written instead, each in the few lines that people write."""

import math
from typing import Any

import numpy as np
from scipy.integrate import cumulative_trapezoid, quad
from scipy.optimize import brentq, fsolve
from scipy.special import erf
from truth import Integrals


def band_density(rms_height: float, hurst: float, q0: float, q1: float) -> Any:
    """The same with the amplitude of its band."""
    amplitude = rms_height**2 * hurst / math.pi / q0**2 / (1 - (q1 / q0) ** (-2 * hurst))
    return lambda q: amplitude * (q / q0) ** (-2 * (hurst + 1))


def trapezoid(
    c: Any,
    integrals: Integrals,
    q: Any,
    pressure: float,
    velocity: float,
    poisson_ratio: float = 0.5,
    gamma: float | None = None,
) -> tuple[float, float]:
    """mu and area by the trapezoid rule in ln q, G by the cumulative one; S in mu with gamma."""
    y, rough = np.log(q), q**4 * c(q)
    i1, i2 = integrals(velocity * q)
    stress = (1 - poisson_ratio**2) * pressure
    g = cumulative_trapezoid(rough * i2, y, initial=0) / 8 / stress**2
    with np.errstate(divide="ignore"):
        p = erf(0.5 / np.sqrt(g))
    weight = p if gamma is None else p * (gamma + (1 - gamma) * p * p)
    return float(np.trapezoid(rough * i1 * weight, y) / 2 / stress), float(p[-1])


def log_trapezoid(
    c: Any,
    integrals: Integrals,
    q0: float,
    q1: float,
    pressure: float,
    velocity: float,
    points: int = 1000,
) -> tuple[float, float]:
    return trapezoid(c, integrals, np.geomspace(q0, q1, points), pressure, velocity)


def nested_quad(
    c: Any, integrals: Integrals, q0: float, q1: float, pressure: float, velocity: float
) -> float:
    """mu by SciPy's quad in ln q, G in the integrand by another."""
    stress = 0.75 * pressure

    def rate(y: float, i: int) -> float:
        q = math.exp(y)
        return float(q**4 * c(q) * integrals(velocity * q)[i])

    def integrand(y: float) -> float:
        g = quad(rate, math.log(q0), y, args=(1,))[0] / 8 / stress**2
        return rate(y, 0) * math.erf(0.5 / math.sqrt(g)) if g > 0 else rate(y, 0)

    return float(quad(integrand, math.log(q0), math.log(q1))[0] / 2 / stress)


def angular_trapezoid(modulus: Any, w: float, points: int = 1000) -> tuple[float, float]:
    """I1 and I2 by the trapezoid rule in phi."""
    phi = 2 * math.pi * np.arange(points) / points
    e = modulus(w * np.abs(np.cos(phi)))
    step = 2 * math.pi / points
    return float(step * np.sum(np.abs(np.cos(phi)) * e.imag)), float(step * np.sum(np.abs(e) ** 2))


def moment_quad(t: float) -> float:
    """The integral of Eq. 16 by SciPy's quad."""
    bell = lambda x: (x - t) ** 1.5 * math.exp(-x * x / 2)  # noqa: E731
    return float(quad(bell, t, np.inf)[0] / math.sqrt(2 * math.pi))


def separation(load: float) -> float:
    """t where that integral is `load`, by SciPy's fsolve from the mean plane."""
    return float(fsolve(lambda t: moment_quad(float(t[0])) - load, 0.0)[0])


def partial_contact(
    c: Any, integrals: Integrals, q: Any, end: float, pressure: float, velocity: float
) -> float:
    """mu by the rule of PartialContact as docs/explanation/partial_contact.md writes it, its
    roughness ending at `end`, by the trapezoid rule in ln q and brentq in ln kappa; nu = 0.5."""
    y, rough, stiff = np.log(q), q**4 * c, 1 / (8 * (0.75 * pressure) ** 2)
    mass = cumulative_trapezoid(rough, y, initial=0)
    window = lambda at: (np.interp(at + 1, y, mass) - np.interp(at - 1, y, mass)) / 2  # noqa: E731
    i1, i2 = integrals(velocity * q)
    rate, w, w_end = stiff * rough * i2, window(y), float(window(math.log(end)))
    g = cumulative_trapezoid(rate, y, initial=0)
    x = np.geomspace(1, 33, 1000)
    t1, t2 = integrals(velocity * end * x)
    last = stiff * t2[0]
    excess = 1 - min(1.0, g[-1] / (last * mass[-1]))

    def sums(kappa: float) -> tuple[float, float]:
        """What the variance lacks, and mu."""
        with np.errstate(divide="ignore"):
            a = erf(0.5 / np.sqrt(kappa * g))
        a1, g1 = float(a[-1]), kappa * g[-1]
        s = 0.5 / math.sqrt(g1)
        edge = 0.67 * (4 * w_end / mass[-1]) ** 0.2 * kappa**0.25 * (1 - a1) ** 0.125
        z = edge * (1 + 6.3 * (1 - a1**0.1) ** 3) * a * a * stiff * i2 * w
        r = a / (1 + z) ** 2 * rate
        t = 3.55 * a1 * (1 - a1**0.25) * last * w_end * (t2 / t2[0]) ** 1.25 / x**3
        moment = (1 + 2 * g1) * math.erf(s) + 2 * math.sqrt(g1 / math.pi) * math.exp(-s * s) - 1
        most = moment / 2 * (1 + (0.105 * a1 + 0.45 * excess**4) * (1 - a1**8))
        had = np.trapezoid(r, y) + np.trapezoid(t, np.log(x))
        loss = np.trapezoid(r * i1 / i2, y) + np.trapezoid(t * t1 / t2, np.log(x))
        return float(had - most), float(3 * pressure * loss)

    root = brentq(lambda k: sums(math.exp(k))[0], math.log(1e-2), math.log(1e2))
    return sums(math.exp(root))[1]
