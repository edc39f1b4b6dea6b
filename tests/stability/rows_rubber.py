"""Rows of Prony series: times far from the frequency, none and many terms, a wide span."""

import math
from collections.abc import Iterator
from typing import Any

import naive
import numpy as np
import truth
from rows import Case, row
from rows_contact import ROAD, band_density, surface
from rows_contact import friction as friction_of

import asperity

road_density = band_density(ROAD)


def series(equilibrium: float, moduli: Any, times: Any) -> Any:
    return asperity.PronySeries(
        equilibrium_modulus=equilibrium, moduli=moduli, relaxation_times=times
    )


def friction(rubber: Any, pressure: float = 81e3, velocity: float = 1e-2, **options: Any) -> Any:
    return friction_of(surface(), pressure, velocity, rubber=rubber, **options)


def trapezoid(integrals: Any, pressure: float = 81e3, velocity: float = 1e-2) -> Any:
    q0, q1 = ROAD["q0"], ROAD["q1"]
    return naive.log_trapezoid(road_density, integrals, q0, q1, pressure, velocity)


def brute(integrals: Any, pressure: float = 81e3, velocity: float = 1e-2) -> Any:
    return truth.contact(truth.self_affine(**ROAD), integrals, pressure, velocity)


@row(
    "w tau = 1e-15: E' of a liquid",
    "E' = E_0 - E/(1 + (w tau)^2) cancels",
    naive="from the glassy modulus down",
    truth="closed form E (w tau)^2",
)
def liquid() -> Iterator[Case]:
    yield (
        lambda: 1e6 - 1e6 / (1 + 1e-30),
        lambda: series(0.0, [1e6], [1.0]).modulus(1e-15).real,
        1e6 * 1e-30,
    )


@row(
    "w tau = 1e200",
    "(w tau)^2 overflows: inf / inf",
    naive="x / (r (r + 1)), r = sqrt(1 + x)",
    truth="mpmath, 50 digits",
)
def overflow() -> Iterator[Case]:
    x = np.float64(1e200) ** 2
    r = np.sqrt(1 + x)
    yield (
        lambda: float(2 * math.pi * 1e6 * x / (r * (r + 1)) / 1e200),
        lambda: series(1e5, [1e6], [1.0]).angular_integrals(1e200)[0],
        truth.angular(1e5, [1e6], [1.0], 1e200)[0],
    )


@row(
    "w tau from 1e-15 to 1e15: mu",
    "all of the loss from terms that are far from every v q",
    naive="log-trapezoid of 1000 points, 1 - 1/sqrt(1 + x)",
    truth="brute force, I1 and I2 closed without cancellation",
    allowed=1e-11,
)
def far_terms() -> Iterator[Case]:
    for tau in np.geomspace(1e-15, 1e15, 7) / 1e3:

        def cancelling(w: Any, tau: float = tau) -> Any:
            s = 1 - 1 / np.sqrt(1 + (w * tau) ** 2)
            pairs = 2 * 1e8 * (3e6 + 1e8 / 2) * s
            return 2 * math.pi * 1e8 * s / (w * tau), 2 * math.pi * (9e12 + pairs)

        yield (
            lambda i=cancelling: trapezoid(i)[0],
            lambda tau=tau: friction(series(3e6, [1e8], [tau])).mu,
            brute(truth.prony(3e6, [1e8], [tau])).mu,
        )


@row(
    "no Prony terms",
    "an elastic rubber has no hysteresis, and no shares of it",
    naive="part / whole of mu by decades of v q",
    truth="0",
)
def no_terms() -> Iterator[Case]:
    integrals = truth.prony(4e6, [], [])

    def share() -> float:
        ends = ROAD["q0"], 10 * ROAD["q0"], ROAD["q1"]
        first, whole = (
            naive.log_trapezoid(road_density, integrals, ends[0], end, 81e3, 1e-2)[0]
            for end in ends[1:]
        )
        return float(np.float64(first) / np.float64(whole))

    yield (
        share,
        lambda: friction(series(4e6, [], []), contributions=True).decade_share.sum(),
        0.0,
    )
    result = brute(integrals)
    yield (
        lambda: result.area,
        lambda: friction(series(4e6, [], [])).contact_area,
        result.area,
    )


def by_pairs(moduli: Any, times: Any, w: float) -> float:
    """I2 without E_inf: partial fractions of pairs, a pair of a term with itself in its limit."""
    x = w * np.asarray(times)
    s = 1 - 1 / np.sqrt(1 + x * x)
    a, b = x[:, None], x[None, :]
    apart = ~np.eye(len(x), dtype=bool)
    pairs = (a * a * s[:, None] - b * b * s[None, :] - a * b * (s[:, None] - s[None, :]))[apart]
    pairs /= (a * a - b * b)[apart]
    total = np.sum(np.outer(moduli, moduli)[apart] * pairs) + np.sum(np.square(moduli) * s)
    return float(2 * math.pi * total)


@row(
    "200 Prony terms, nearly equal times (1e-12 apart)",
    "partial fractions of pairs divide a cancelled difference by tau_k^2 - tau_l^2",
    naive="I2 by partial fractions",
    truth="mpmath, 50 digits",
    fails=1e-8,
)
def nearly_equal() -> Iterator[Case]:
    times = 1e-3 * (1 + 1e-12 * np.arange(200))
    moduli = np.full(200, 1e6)
    yield (
        lambda: by_pairs(moduli, times, 1e3),
        lambda: series(0.0, moduli, times).angular_integrals(1e3)[1],
        truth.angular(0.0, moduli, times, 1e3)[1],
    )


@row(
    "1 to 200 Prony terms: mu",
    "the front, with 20 decades of relaxation times",
    naive="log-trapezoid of 1000 points",
    truth="brute force",
    allowed=1e-11,
)
def many_terms() -> Iterator[Case]:
    for n in (1, 20, 200):
        moduli, times = np.geomspace(1e9, 1e5, n), np.geomspace(1e-13, 1e7, n)
        integrals = truth.prony(1e6, moduli, times)
        yield (
            lambda i=integrals: trapezoid(i, 1e4)[0],
            lambda m=moduli, t=times: friction(series(1e6, m, t), pressure=1e4).mu,
            brute(integrals, 1e4).mu,
        )


@row(
    "modulus over 9 decades",
    "E'^2 alone: where tan delta is above 1 it is the lesser part of E E*",
    naive="E' for the absolute modulus in G",
    truth="brute force",
    allowed=1e-11,
)
def nine_decades() -> Iterator[Case]:
    moduli, times = np.geomspace(1e10, 1e2, 9), np.geomspace(1e-8, 1e0, 9)
    integrals = truth.prony(1e1, moduli, times)

    def storage_alone(w: Any) -> Any:
        x = np.multiply.outer(np.asarray(w), np.cos((np.arange(200) + 0.5) * math.pi / 400))
        z = x[..., None] * times
        e = 10 + (moduli * z * z / (1 + z * z)).sum(-1)
        return integrals(w)[0], 2 * math.pi * np.mean(e * e, axis=-1)

    for velocity in (1e-6, 1e-3, 1e0):
        exact = brute(integrals, 1e5, velocity)
        rubber = series(1e1, moduli, times)
        yield (
            lambda v=velocity: (
                truth.contact(truth.self_affine(**ROAD), storage_alone, 1e5, v, panels=40).area
            ),
            lambda v=velocity, r=rubber: friction(r, pressure=1e5, velocity=v).contact_area,
            exact.area,
        )
