"""What is usually written instead, each in the few lines that people write."""

import math
from typing import Any

import numpy as np
from scipy.integrate import cumulative_trapezoid, quad
from scipy.optimize import fsolve
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
