"""Rows of single-scale asperities: Hertz, Greenwood-Williamson, its states, peaks and shifts."""

import math
from collections.abc import Iterator
from typing import Any

import mpmath
import naive
import numpy as np
import truth
from rows import Case, row
from rows_contact import INTEGRALS, ROAD, RUBBER
from scipy.optimize import brentq

import asperity

MACRO = {"rms_height": 1e-4, "q0": 1e3}
STIFFNESS = 2e3 / (3 * math.pi**2 * math.sqrt(3 * math.sqrt(2) * 1e-4)) * 1e-6  # times h^1.5


def pressure_at(t: float) -> float:
    """sigma0 / E* of a separation of t rms heights."""
    with mpmath.workdps(60):
        h, q0 = mpmath.mpf(1e-4), mpmath.mpf(1e3)
        stiffness = 2 * q0 / (3 * mpmath.pi**2 * mpmath.sqrt(3 * mpmath.sqrt(2) * h))
        return float(stiffness * h ** mpmath.mpf(1.5) * truth.gaussian_moment(t))


def ours(load: float, **options: Any) -> float:
    """d~ in rms heights."""
    result = asperity.separation(pressure=load, effective_modulus=1.0, **MACRO, **options)
    return float(result.effective / MACRO["rms_height"])


def separation(t: float) -> Case:
    load = pressure_at(t)
    return lambda: naive.separation(load / STIFFNESS), lambda: ours(load), t


@row(
    "Hertz: forces of 1e-200 and 1e160 N",
    "F^2 leaves the range of a double before the root is drawn",
    naive="(9 F^2 / (16 E*^2 R))^(1/3)",
    truth="mpmath",
)
def hertz() -> Iterator[Case]:
    for force, modulus in ((1e-200, 1e6), (1e160, 1e140)):
        with mpmath.workdps(50):
            ratio = mpmath.mpf(force) / mpmath.mpf(modulus)
            exact = float(mpmath.cbrt(9 * ratio**2 / (16 * mpmath.mpf(1e-3))))
        f, e = np.float64(force), np.float64(modulus)
        yield (
            lambda f=f, e=e: float((9 * f**2 / (16 * e**2 * 1e-3)) ** (1 / 3)),
            lambda force=force, modulus=modulus: asperity.hertz_penetration(
                force=force, effective_modulus=modulus, radius=1e-3
            ),
            exact,
        )


@row(
    "IGW's integral at d = -400 rms",
    "a Gaussian of width 1 in an interval that starts 400 away",
    naive="SciPy quad over (d, inf), fsolve from the mean plane",
    truth="parabolic cylinder function, mpmath",
)
def deep() -> Iterator[Case]:
    yield separation(-400.0)


@row(
    "IGW at sigma0/E* = 1e-12",
    "quad and fsolve stop at 1e-8, and that is more than there is",
    naive="SciPy quad over (d, inf), fsolve from the mean plane",
    truth="parabolic cylinder function, root by mpmath",
    fails=1e-8,
)
def light() -> Iterator[Case]:
    yield root(1e-12)


@row(
    "IGW at sigma0/E* = 1e6",
    "half a million rms heights deep",
    naive="SciPy quad over (d, inf), brentq down to it",
    truth="all asperities touch: moments of the Gaussian",
)
def heavy() -> Iterator[Case]:
    load = 1e6
    depth = (load / STIFFNESS) ** (2 / 3)
    yield (
        lambda: brentq(lambda t: naive.moment_quad(t) - load / STIFFNESS, -2 * depth, 0),
        lambda: ours(load),
        -(depth - 1 / (4 * depth)),
    )


def root(load: float) -> Case:
    with mpmath.workdps(40):
        target = mpmath.log(mpmath.mpf(load) / mpmath.mpf(STIFFNESS))
        exact = float(
            mpmath.findroot(lambda t: mpmath.log(truth.gaussian_moment(t)) - target, (4.0, 8.0))
        )
    return lambda: naive.separation(load / STIFFNESS), lambda: ours(load), exact


def igw(pressure: float, z_max: float = 1.5e-3, z_min: float = -1.5e-3) -> Any:
    return asperity.friction(
        asperity.SelfAffineSpectrum(**ROAD),
        RUBBER,
        pressure=pressure,
        velocity=1e-2,
        rtol=1e-8,
        correction=asperity.GreenwoodWilliamson(z_max=z_max, z_min=z_min),
    )


def shift_of(pressure: float, z_max: float, z_min: float) -> tuple[float, float]:
    """Eq. 21 and d~ at a load on ROAD, by quad and brentq."""
    e = abs(RUBBER.modulus(ROAD["q0"] * 1e-2)) / 0.75
    h = ROAD["rms_height"]
    stiffness = 2 * ROAD["q0"] * h / (3 * math.pi**2 * math.sqrt(3 * math.sqrt(2)))
    d = brentq(lambda t: naive.moment_quad(t) - pressure / e / stiffness, -8, 20) * h
    return (z_max - z_min) / (z_max - d), d


@row(
    "IGW, no contact: d~ above z_max",
    "Eq. 21 changes its sign",
    naive="p_T = (z_max - z_min) / (z_max - d~), mu / p_T",
    truth="no contact, mu = 0 and p_T infinite",
)
def no_contact() -> Iterator[Case]:
    pressure, z_max = 1e3, 3e-4
    plain = truth.contact(truth.self_affine(**ROAD), INTEGRALS, pressure, 1e-2).mu
    yield (
        lambda: plain / shift_of(pressure, z_max, -1.5e-3)[0],
        lambda: igw(pressure, z_max).mu,
        0.0,
    )
    yield (
        lambda: 1 / shift_of(pressure, z_max, -1.5e-3)[0],
        lambda: 1 / igw(pressure, z_max).shift_factor,
        0.0,
    )


@row(
    "IGW, full contact: d~ below z_min",
    "Eq. 21 falls below 1 and makes the surface rougher than it is",
    naive="p_T = (z_max - z_min) / (z_max - d~)",
    truth="p_T = 1, mu by brute force",
    allowed=1e-8,
)
def full_contact() -> Iterator[Case]:
    pressure, z_min = 1e7, -1e-4
    p, _ = shift_of(pressure, 1.5e-3, z_min)
    yield lambda: p, lambda: igw(pressure, z_min=z_min).shift_factor, 1.0
    surface = truth.self_affine(**ROAD)
    yield (
        lambda: truth.contact(surface, INTEGRALS, pressure, 1e-2, shift=p).mu,
        lambda: igw(pressure, z_min=z_min).mu,
        truth.contact(surface, INTEGRALS, pressure, 1e-2).mu,
    )


@row(
    "p_T to 1: d~ 1e-6 rms above z_min",
    "a fixed p_T knows no load",
    naive="p_T = 2, the article's average",
    truth="parabolic cylinder function, mpmath",
    allowed=1e-11,
)
def nearly_full() -> Iterator[Case]:
    e = abs(RUBBER.modulus(ROAD["q0"] * 1e-2)) / 0.75
    h, t = ROAD["rms_height"], -0.5
    stiffness = 2 * ROAD["q0"] * h / (3 * math.pi**2 * math.sqrt(3 * math.sqrt(2)))
    pressure = float(truth.gaussian_moment(t)) * e * stiffness
    z_max, z_min = 4 * h, (t - 1e-6) * h
    exact = (4 - t + 1e-6) / (4 - t)
    yield lambda: 2.0, lambda: igw(pressure, z_max, z_min).shift_factor, exact
