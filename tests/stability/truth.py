"""What the catalogue holds everything against: brute force on graded panels, and closed forms.

Nothing here calls asperity. A contact is integrated piece by piece of its spectrum, in ln s with
s = ln(q / a) on a piece that starts at a, by Gauss rules of 16 nodes on panels so many that more
change nothing but rounding.
"""

import itertools
import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any

import mpmath
import numpy as np
from scipy.special import erf

NODES, WEIGHTS = np.polynomial.legendre.leggauss(16)
_VALUES = np.polynomial.legendre.legvander(NODES, 15)
_INTEGRALS = np.array(
    [
        np.polynomial.legendre.legval(NODES, np.polynomial.legendre.legint(row, lbnd=-1))
        for row in np.eye(16)
    ]
).T
CUMULATIVE = _INTEGRALS @ np.linalg.inv(_VALUES)

Integrals = Callable[[Any], tuple[Any, Any]]


@dataclass(frozen=True)
class Piece:
    """A part of a spectrum on which C is smooth, in s = ln(q / start) up to `length`."""

    start: float
    length: float
    density: Callable[[Any], Any]
    from_zero: bool = False  # C(start) = 0


@dataclass(frozen=True)
class Contact:
    """Hysteresis, area and G at the upper end."""

    mu: float
    area: float
    g: float


def prony(equilibrium: float, moduli: Any, times: Any) -> Integrals:
    """I1 and I2 of a Prony series, closed."""
    moduli, times = np.asarray(moduli, float), np.asarray(times, float)
    pairs = (moduli / (1 + times[:, None] / times)).sum(axis=1)
    weights = 2 * moduli * (equilibrium + pairs)

    def integrals(w: Any) -> tuple[Any, Any]:
        t = np.asarray(w)[..., None] * times
        r = np.hypot(1, t)
        s = t / r / (r + 1)
        return 2 * math.pi * (s @ moduli), 2 * math.pi * (equilibrium**2 + (t * s) @ weights)

    return integrals


def self_affine(
    rms_height: float, hurst: float, q0: float, q1: float, rolloff: float | None = None
) -> list[Piece]:
    """Its pieces: normalised by h_rms^2 = 2 pi int q C dq."""
    length = math.log1p((q1 - q0) / q0)
    flat = math.log1p((rolloff - q0) / q0) if rolloff else 0.0
    tail = -math.expm1(-2 * hurst * (length - flat)) / (2 * hurst)
    squares = math.expm1(2 * flat) / 2 + math.exp(2 * flat) * tail
    top = (rms_height / q0) ** 2 / (2 * math.pi * squares)
    fall = -2 * (hurst + 1)
    pieces = [Piece(rolloff or q0, length - flat, lambda s: top * np.exp(fall * s))]
    return [Piece(q0, flat, lambda s: top + 0 * s), *pieces] if rolloff else pieces


def table(wavenumber: Any, density: Any) -> list[Piece]:
    """Pieces between rows: log-log linear, linear in q beside a zero, none between two zeros."""
    pieces = []
    rows = list(zip(map(float, wavenumber), map(float, density), strict=True))
    for (a, low), (b, high) in itertools.pairwise(rows):
        length = math.log1p((b - a) / a)
        if low > 0 and high > 0:
            slope = math.log(high / low) / length
            pieces.append(Piece(a, length, lambda s, c=low, e=slope: c * np.exp(e * s)))
        elif low > 0 or high > 0:
            rise = (high - low) * a / (b - a)
            line = lambda s, c=low, e=rise: c + e * np.expm1(s)  # noqa: E731
            pieces.append(Piece(a, length, line, from_zero=low == 0))
    return pieces


def share(g: Any, form: str = "exact") -> Any:
    """P(G)."""
    if form == "exact":
        return erf(0.5 / np.sqrt(g))
    return (1 + (math.pi * g) ** 1.5) ** (-1 / 3)


def contact(
    surface: Sequence[Piece],
    integrals: Integrals,
    pressure: float,
    velocity: float,
    poisson_ratio: float = 0.5,
    gamma: float | None = None,
    shift: float = 1.0,
    form: str = "exact",
    panels: int = 700,
) -> Contact:
    """Eqs 7 and 22, with S of Eq. 8 in the latter where gamma is given."""
    stiffening = 1 / (1 - poisson_ratio**2)

    def weighted(g: Any) -> Any:
        p = share(g, form)
        return p if gamma is None else p * (gamma + (1 - gamma) * p * p)

    g_end = mu = 0.0
    for piece in surface:

        def rates(s: Any, piece: Piece = piece) -> tuple[Any, Any]:
            q = piece.start * np.exp(s)
            i1, i2 = integrals(velocity * q)
            rough = q**4 * piece.density(s)
            return (
                rough * i2 * (stiffening / pressure / shift) ** 2 / 8,
                rough * i1 * stiffening / pressure / 2 / shift**2,
            )

        # down to where a straight start of G is exact, and G below 1e-20
        last = math.log(piece.length)
        first = last - (80 if g_end < 1 else 20)
        count = max(int(panels * (last - first) / 80), 8)
        edges = np.linspace(first, last, count + 1)
        half = np.diff(edges)[:, None] / 2
        s = np.exp(edges[:-1, None] + half * (1 + NODES))
        dg, dmu = (rate * s for rate in rates(s))
        foot = math.exp(first)
        part = 0.5 if piece.from_zero else 1.0
        foot_g, foot_mu = (float(x[0]) * foot * part for x in rates(np.array([foot])))
        before = g_end + foot_g + np.concatenate([[0.0], np.cumsum((WEIGHTS * dg * half).sum(1))])
        g = before[:-1, None] + half * (dg @ CUMULATIVE.T)
        mu += float(np.sum(WEIGHTS * dmu * half * weighted(g)))
        mu += foot_mu * (float(weighted(g_end)) if g_end > 0 else 1.0)
        g_end = float(before[-1])
    return Contact(mu, float(share(g_end, form)) if g_end > 0 else 1.0, g_end)


def slope(rms_height: float, hurst: float, q0: float, q1: float) -> float:
    """rms slope of a self-affine spectrum, with 50 digits."""
    with mpmath.workdps(50):
        h, exponent, a, b = map(mpmath.mpf, (rms_height, hurst, q0, q1))
        ratio = b / a
        height = (1 - ratio ** (-2 * exponent)) / (2 * exponent)
        square = mpmath.log(ratio) if hurst == 1 else (ratio ** (2 - 2 * exponent) - 1)
        square = square if hurst == 1 else square / (2 - 2 * exponent)
        return float(h * a * mpmath.sqrt(square / height))


def angular(equilibrium: float, moduli: Any, times: Any, w: float) -> tuple[float, float]:
    """I1 and I2 of a Prony series with 50 digits."""
    with mpmath.workdps(50):
        e = mpmath.mpf(equilibrium)
        terms = [(mpmath.mpf(m), mpmath.mpf(t)) for m, t in zip(moduli, times, strict=True)]
        i1, i2 = mpmath.mpf(0), e * e
        for modulus, tau in terms:
            x = (mpmath.mpf(w) * tau) ** 2
            s = 1 - 1 / mpmath.sqrt(1 + x)
            i1 += modulus * s / (mpmath.mpf(w) * tau)
            i2 += 2 * modulus * s * (e + sum(m * t / (tau + t) for m, t in terms))
        return float(2 * mpmath.pi * i1), float(2 * mpmath.pi * i2)


def gaussian_moment(t: float) -> Any:
    """int_t^inf (x - t)^1.5 exp(-x^2 / 2) dx / sqrt(2 pi), by the parabolic cylinder function."""
    with mpmath.workdps(60):
        at = mpmath.mpf(t)
        tail = mpmath.pcfd(mpmath.mpf(-2.5), at) * mpmath.exp(-at * at / 4)
        return +(mpmath.gamma(mpmath.mpf(2.5)) / mpmath.sqrt(2 * mpmath.pi) * tail)
