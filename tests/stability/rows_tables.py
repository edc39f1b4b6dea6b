"""Rows of tabulated spectra: empty bins, zeros, few and many rows, kinks, one interval."""

import math
from collections.abc import Iterator
from typing import Any

import naive
import numpy as np
import truth
from rows import Case, row
from rows_contact import BRUTE

import asperity

TERMS = (3e6, [1e7, 1e8, 1e9], [1e-2, 1e-4, 1e-6])
INTEGRALS = truth.prony(*TERMS)
RUBBER = asperity.PronySeries(
    equilibrium_modulus=TERMS[0], moduli=TERMS[1], relaxation_times=TERMS[2]
)


def friction(q: Any, c: Any, pressure: float, rtol: float = 1e-10) -> Any:
    spectrum = asperity.TabulatedSpectrum(wavenumber=q, density=c)
    return asperity.friction(spectrum, RUBBER, pressure=pressure, velocity=1e-2, rtol=rtol)


def brute(q: Any, c: Any, pressure: float, panels: int = 700) -> truth.Contact:
    return truth.contact(truth.table(q, c), INTEGRALS, pressure, 1e-2, panels=panels)


def law(rows: int, scatter: float = 0.0) -> tuple[Any, Any]:
    """Rows of a power law from 2e3 to 1e6 1/m."""
    q = np.geomspace(2e3, 1e6, rows)
    noise = np.random.default_rng(5).standard_normal(rows)
    return q, 1e-13 * (q / 2e3) ** -3.7 * np.exp(scatter * noise)


def log_log(q: Any, c: Any) -> Any:
    """np.interp of the logarithms."""
    with np.errstate(divide="ignore"):
        logs = np.log(c)
    return lambda at: np.exp(np.interp(np.log(at), np.log(q), logs))


def against_grid(q: Any, c: Any, **ours: Any) -> Case:
    """mu at 10 kPa against a logarithmic grid of 1000 points."""
    density = log_log(q, c)
    return (
        lambda: naive.log_trapezoid(density, INTEGRALS, 2e3, 1e6, 1e4, 1e-2)[0],
        lambda: friction(q, c, 1e4, **ours).mu,
        brute(q, c, 1e4, panels=100 if ours else 700).mu,
    )


def against_rows(q: Any, c: Any, pressure: float) -> Case:
    """mu against the trapezoid rule on the rows."""
    return (
        lambda: naive.trapezoid(lambda _: c, INTEGRALS, q, pressure, 1e-2)[0],
        lambda: friction(q, c, pressure).mu,
        brute(q, c, pressure).mu,
    )


@row(
    "empty bins: zeros in the middle",
    "log 0",
    naive="numpy.interp of ln C in ln q, log-trapezoid of 1000 points",
    truth=BRUTE,
    allowed=1e-9,
)
def empty_bins() -> Iterator[Case]:
    q, c = law(50)
    c[[7, 20, 21, 22, 40]] = 0
    yield against_grid(q, c)


@row(
    "zeros at the start: the front stands on a ramp",
    "G starts as a square there, and all of the grid before it is 0",
    naive="trapezoid over 100 points a row",
    truth=BRUTE,
    allowed=1e-9,
    fails=1e-2,
)
def ramp() -> Iterator[Case]:
    q, c = law(20)
    c[:8] = 0

    def linear(at: Any) -> Any:
        return np.interp(at, q, c)

    yield (
        lambda: naive.trapezoid(linear, INTEGRALS, np.geomspace(2e3, 1e6, 2000), 1e2, 1e-2)[0],
        lambda: friction(q, c, 1e2).mu,
        brute(q, c, 1e2).mu,
    )


@row(
    "a spectrum of zeros",
    "no slope to divide by",
    naive="A/A0 = min(1, sqrt(8/pi) sigma0/(E* h'))",
    truth="full contact, mu = 0",
)
def no_roughness() -> Iterator[Case]:
    q, c = law(5)
    steep = math.sqrt(2 * math.pi * np.trapezoid(q**3 * (0 * c), q))
    yield (
        lambda: min(1, math.sqrt(8 / math.pi) * 1e4 / (4e6 * steep)),
        lambda: friction(q, 0 * c, 1e4).contact_area,
        1.0,
    )
    yield lambda: 0.0, lambda: friction(q, 0 * c, 1e4).mu, 0.0


@row(
    "5 rows",
    "a rule on the rows takes what lies between them for straight",
    naive="trapezoid on the rows",
    truth=BRUTE,
    allowed=1e-9,
)
def five_rows() -> Iterator[Case]:
    q, c = law(5)
    yield against_rows(q, c, 1e4)


@row(
    "5,000 noisy rows",
    "a grid of its own passes over four rows in five",
    naive="numpy.interp of ln C, log-trapezoid of 1000 points",
    truth="brute force between all rows",
    allowed=1e-6,
    fails=1e-3,
)
def many_rows() -> Iterator[Case]:
    q, c = law(5000, scatter=1.0)
    yield against_grid(q, c, rtol=1e-6)  # between all rows, with fewer panels in each


@row(
    "kinks: densities that jump by 1e6 from row to row",
    "every row a peak or a gap, some of them a front",
    naive="numpy.interp of ln C, log-trapezoid of 1000 points",
    truth=BRUTE,
    allowed=1e-9,
)
def jumps() -> Iterator[Case]:
    q, c = law(30)
    c = c * 10 ** np.random.default_rng(2).uniform(-3, 3, 30)
    yield against_grid(q, c)


@row(
    "a spectrum of one interval",
    "splines and gradients ask for three rows or more",
    naive="trapezoid on the rows",
    truth=BRUTE,
    allowed=1e-9,
)
def one_interval() -> Iterator[Case]:
    q, c = law(2)
    for pressure in (1e-2, 1e4):
        yield against_rows(q, c, pressure)
