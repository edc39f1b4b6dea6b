"""Rows of contact and hysteresis: fronts, loads, bands, exponents, Poisson ratios, shifts."""

import math
from collections.abc import Iterator
from typing import Any

import mpmath
import naive
import numpy as np
import truth
from rows import Case, row

import asperity

ROAD = {"rms_height": 265.7e-6, "hurst": 0.87, "q0": 2000.0, "q1": 1e6}
MODULI, TIMES = np.geomspace(1e9, 1e6, 20), np.geomspace(1e-10, 1e2, 20)
INTEGRALS = truth.prony(3e6, MODULI, TIMES)
RUBBER = asperity.PronySeries(equilibrium_modulus=3e6, moduli=MODULI, relaxation_times=TIMES)
ELASTIC = asperity.PronySeries(equilibrium_modulus=4e6, moduli=[], relaxation_times=[])


def surface(**given: Any) -> Any:
    return asperity.SelfAffineSpectrum(**{**ROAD, **given})


def friction(spectrum: Any, pressure: float, velocity: float = 1e-2, **options: Any) -> Any:
    rubber = options.pop("rubber", RUBBER)
    options = {"rtol": 1e-11, "pressure": pressure, "velocity": velocity, **options}
    return asperity.friction(spectrum, rubber, **options)


def band_density(given: dict[str, float]) -> Any:
    return naive.band_density(given["rms_height"], given["hurst"], given["q0"], given["q1"])


def hysteresis(given: dict[str, float], pressure: float, points: int = 1000) -> Case:
    """mu of RUBBER on a self-affine surface against the log-trapezoid."""
    c, ends = band_density(given), (given["q0"], given["q1"])
    exact = truth.contact(truth.self_affine(**given), INTEGRALS, pressure, 1e-2).mu
    return (
        lambda: naive.log_trapezoid(c, INTEGRALS, *ends, pressure, 1e-2, points)[0],
        lambda: friction(surface(**given), pressure).mu,
        exact,
    )


BRUTE = "brute force, 11,200 Gauss nodes graded to the front"


@row(
    "the front, 1.8e-4 wide in ln q: Table 1's surface at 81 kPa",
    "the contact breaks up before a grid's first step is done",
    naive="log-trapezoid of 1000 points",
    truth=BRUTE,
    allowed=1e-11,
)
def front() -> Iterator[Case]:
    yield hysteresis(ROAD, 81e3)


@row(
    "the front, 2.7e-8 wide: 1 kPa",
    "an adaptive rule meets its own 1.5e-8 on what its first points show of a root",
    naive="nested SciPy quad in ln q without break points",
    truth=BRUTE,
    allowed=1e-11,
    fails=1e-6,
)
def missed_front() -> Iterator[Case]:
    _, ours, exact = hysteresis(ROAD, 1e3)
    c, ends = band_density(ROAD), (ROAD["q0"], ROAD["q1"])
    yield lambda: naive.nested_quad(c, INTEGRALS, *ends, 1e3, 1e-2), ours, exact


@row(
    "sigma0/E* from 1e-12 to 1e6",
    "over 18 decades of load the width of the front runs over 36",
    naive="log-trapezoid of 1000 points",
    truth=BRUTE,
    allowed=1e-11,
)
def loads() -> Iterator[Case]:
    for load in np.geomspace(1e-12, 1e6, 7):
        yield hysteresis(ROAD, 4e6 * load)


@row(
    "sigma0/E* = 1e-12: P(sigma) at the nominal pressure",
    "two bells as good as equal are subtracted (Eq. 4 solved)",
    naive="exp(-(x-1)^2/4G) - exp(-(x+1)^2/4G)",
    truth="mpmath, 50 digits, G in closed form",
)
def distribution() -> Iterator[Case]:
    pressure = 4e6 / 0.75 * 1e-12
    with mpmath.workdps(50):
        star = mpmath.mpf(4e6) / (mpmath.mpf(3) / 4)
        g = (star * mpmath.mpf(truth.slope(**ROAD)) / mpmath.mpf(pressure)) ** 2 / 8
        bells = (1 - mpmath.exp(-1 / g)) / mpmath.sqrt(4 * mpmath.pi * g)
        exact = float(bells / mpmath.mpf(pressure))
    scale = float(g)
    yield (
        lambda: (
            (math.exp(0) - math.exp(-4 / 4 / scale)) / math.sqrt(4 * math.pi * scale) / pressure
        ),
        lambda: asperity.pressure_distribution(
            pressure, surface(), ELASTIC, pressure=pressure, velocity=1.0, rtol=1e-11
        ),
        exact,
    )


@row(
    "small-load limit, A/A0 = sqrt(8/pi) sigma0/(E* h')",
    "the mean pressure runs into a limit that the interpolation of Eq. 7 misses on its way",
    naive="Eq. 7's (1 + (pi G)^1.5)^(-1/3), at p* = 0.1 to 1e-6",
    truth="erf(1/(2 sqrt G)), G in closed form; limit from p* = 1e-6",
    allowed=1e-12,
)
def small_load() -> Iterator[Case]:
    star, steep = 4e6 / 0.75, truth.slope(**ROAD)
    for load in (0.1, 1e-3, 1e-6):
        pressure = load * star * steep
        g = 1 / (8 * load * load)
        exact = math.sqrt(8 / math.pi) * load if load < 1e-3 else math.erf(0.5 / math.sqrt(g))
        yield (
            lambda g=g: (1 + (math.pi * g) ** 1.5) ** (-1 / 3),
            lambda pressure=pressure: asperity.contact_area(
                surface(), ELASTIC, pressure=pressure, velocity=1.0, rtol=1e-11
            ),
            exact,
        )
