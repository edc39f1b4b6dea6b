"""Rows of bands, exponents, Poisson ratios and shifts of a self-affine surface."""

import math
from collections.abc import Iterator
from typing import Any

import mpmath
import numpy as np
import truth
from rows import Case, row
from rows_contact import (
    BRUTE,
    ELASTIC,
    INTEGRALS,
    ROAD,
    band_density,
    friction,
    hysteresis,
    surface,
)

import asperity


@row(
    "H = 0.01: mu at 1 kPa",
    "C q^4 rises over the whole band, and the front is narrow",
    naive="log-trapezoid of 1000 points",
    truth=BRUTE,
    allowed=1e-11,
)
def low_hurst_friction() -> Iterator[Case]:
    yield hysteresis({**ROAD, "hurst": 0.01}, 1e3)


@row(
    "H = 1",
    "int q^3 C dq is a logarithm, its power law 0/0",
    naive="(q1^(2-2H) - q0^(2-2H)) / (2 - 2H)",
    truth="closed form, mpmath",
)
def high_hurst() -> Iterator[Case]:
    given = {**ROAD, "hurst": 1.0}

    def closed() -> float:
        q0, q1, e = given["q0"], given["q1"], np.float64(2 - 2 * given["hurst"])
        c = band_density(given)(q0)
        return float(np.sqrt(2 * np.pi * c * q0**4 * ((q1 / q0) ** e - 1) / e))

    yield closed, lambda: surface(**given).rms_slope, truth.slope(**given)


@row(
    "bandwidth 1 + 1e-9: rms slope",
    "differences of powers of nearly equal wavenumbers cancel",
    naive="(q1^e - q0^e) / e, 1 - (q1/q0)^(-2H)",
    truth="closed form, mpmath",
    fails=1e-8,
)
def narrow_band() -> Iterator[Case]:
    given = {**ROAD, "q1": ROAD["q0"] * (1 + 1e-9), "hurst": 0.8}

    def closed() -> float:
        q0, q1, e = given["q0"], given["q1"], 2 - 2 * given["hurst"]
        c = band_density(given)(q0)
        return math.sqrt(2 * math.pi * c * q0**4 * ((q1 / q0) ** e - 1) / e)

    # the norm cancels with the powers here: its amplitude alone shows what is lost
    exact = (given["rms_height"] ** 2) / (2 * math.pi * given["q0"] ** 2)
    width = math.log1p((given["q1"] - given["q0"]) / given["q0"])
    amplitude = exact / width * (1 + given["hurst"] * width)
    yield (
        lambda: band_density(given)(given["q0"]),
        lambda: surface(**given).at(given["q0"]),
        (amplitude),
    )
    yield closed, lambda: surface(**given).rms_slope, truth.slope(**given)


@row(
    "bandwidth 1 + 1e-9: mu",
    "a grid between q0 and q1 has steps of few units in the last place",
    naive="log-trapezoid of 1000 points",
    truth=BRUTE,
    fails=1e-8,
    allowed=1e-11,
)
def narrow_band_friction() -> Iterator[Case]:
    yield hysteresis({**ROAD, "q1": ROAD["q0"] * (1 + 1e-9)}, 81e3)


@row(
    "bandwidth 1e9",
    "9 decades behind a front 8e-4 wide",
    naive="log-trapezoid of 1000 points",
    truth=BRUTE,
    allowed=1e-11,
)
def wide_band() -> Iterator[Case]:
    yield hysteresis({**ROAD, "q0": 100.0, "q1": 1e11, "rms_height": 5e-3}, 81e3)


@row(
    "Poisson ratio 0 and 0.5",
    "E* = E / (1 - nu^2): 4/3 for incompressible rubber",
    naive="E* = E",
    truth=BRUTE,
    allowed=1e-11,
)
def poisson() -> Iterator[Case]:
    for nu in (0.0, 0.5):
        stiff = truth.contact(truth.self_affine(**ROAD), INTEGRALS, 81e3, 1e-2, nu)
        left_out = truth.contact(truth.self_affine(**ROAD), INTEGRALS, 81e3, 1e-2, 0.0)
        yield (
            lambda left_out=left_out: left_out.area,
            lambda nu=nu: friction(surface(), 81e3, poisson_ratio=nu).contact_area,
            stiff.area,
        )
        yield (
            lambda left_out=left_out: left_out.mu,
            lambda nu=nu: friction(surface(), 81e3, poisson_ratio=nu).mu,
            stiff.mu,
        )


@row(
    "p_T from 1 + 1e-12 to 2",
    "C / p^2 changes the front and not the integrand alone",
    naive="mu / p^2 of the unshifted surface",
    truth=BRUTE,
    allowed=1e-11,
)
def shifts() -> Iterator[Case]:
    plain = truth.contact(truth.self_affine(**ROAD), INTEGRALS, 81e3, 1e-2).mu
    for p in (1 + 1e-12, 1.001, 2.0):
        exact = truth.contact(truth.self_affine(**ROAD), INTEGRALS, 81e3, 1e-2, shift=p).mu
        yield (
            lambda p=p: plain / p**2,
            lambda p=p: friction(surface(), 81e3, correction=asperity.AffineShift(p)).mu,
            exact,
        )


@row(
    "S inside G (Eq. 8), light load",
    "dg / S = dG by explicit steps: S falls within the first of them",
    naive="Euler steps over 1000 values of ln q",
    truth="mpmath quad of int dg / S, root in ln G",
    fails=1e-4,
)
def s_inside() -> Iterator[Case]:
    pressure = 1e-3 * 4e6 / 0.75 * truth.slope(**ROAD)

    def euler() -> float:
        q = np.geomspace(ROAD["q0"], ROAD["q1"], 1000)
        c, stress = band_density(ROAD), 0.75 * pressure
        dg = q**4 * c(q) * 2 * math.pi * 4e6**2 / 8 / stress**2
        g = 0.0
        for step, rate in zip(np.diff(np.log(q)), dg, strict=False):
            p = math.erf(0.5 / math.sqrt(g)) if g > 0 else 1.0
            g += rate * step * (0.5 + 0.5 * p * p)
        return math.erf(0.5 / math.sqrt(g))

    with mpmath.workdps(20):
        total = 1 / (8 * mpmath.mpf(1e-3) ** 2)

        def rate(x: Any) -> Any:
            g = mpmath.exp(x)
            p = mpmath.erf(1 / (2 * mpmath.sqrt(g)))
            return g / (0.5 + 0.5 * p * p)

        start = mpmath.mpf(-40)
        edges = [start, -5, -3, -1, 1, 4]
        to_four = mpmath.quad(rate, edges) + mpmath.exp(start)
        root = mpmath.findroot(
            lambda x: to_four + mpmath.quad(rate, [4, 7, x]) - total, mpmath.log(total / 2)
        )
        exact = float(mpmath.erf(1 / (2 * mpmath.exp(root / 2))))
    correction = asperity.SFactor(gamma=0.5, applies_to="area")
    yield (
        euler,
        lambda: asperity.contact_area(
            surface(), ELASTIC, pressure=pressure, velocity=1.0, rtol=1e-11, correction=correction
        ),
        exact,
    )
