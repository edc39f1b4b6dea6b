"""Rows of fronts that no self-affine surface has: rising, falling to a zero, steep."""

from collections.abc import Iterator
from typing import Any

import naive
import numpy as np
import truth
from rows import Case, row
from rows_contact import BRUTE

import asperity


def case(
    q: Any, c: Any, terms: tuple[float, Any, Any], pressure: float, velocity: float, **options: Any
) -> Case:
    """mu on a table against the log-trapezoid of 1000 points."""
    integrals = truth.prony(*terms)
    spectrum = asperity.TabulatedSpectrum(wavenumber=q, density=c)
    rubber = asperity.PronySeries(
        equilibrium_modulus=terms[0], moduli=terms[1], relaxation_times=terms[2]
    )

    def density(at: Any) -> Any:
        with np.errstate(divide="ignore"):
            logs = np.log(c)
        return np.exp(np.interp(np.log(at), np.log(q), logs))

    form = options.get("form", "exact")
    exact = truth.contact(truth.table(q, c), integrals, pressure, velocity, form=form)
    options = {"pressure": pressure, "velocity": velocity, **options}
    return (
        lambda: naive.log_trapezoid(density, integrals, q[0], q[-1], pressure, velocity)[0],
        lambda: asperity.friction(spectrum, rubber, **options).mu,
        exact.mu,
    )


ONE_TERM = (1e6, [1e8], [1e-3])


@row(
    "a rising front, six in ln q long, interpolated form",
    "G rises by e^33, and a polynomial through its rate makes it negative at the first nodes",
    naive="log-trapezoid of 1000 points",
    truth=BRUTE,
    allowed=1e-9,
    fails=1e-6,
)
def rising() -> Iterator[Case]:
    options: dict[str, Any] = {"form": "interpolated", "rtol": 1e-9}
    for pressure in (1e11, 1e6):
        yield case([1e3, 4e5], [1e-20, 1e-19], ONE_TERM, pressure, 1e-3, **options)


@row(
    "a flat front, three and six in ln q long, alone and before a roll-off, interpolated form",
    "G rises as q^4 along one panel, and its rate is lost at the first nodes",
    naive="log-trapezoid of 1000 points",
    truth=BRUTE,
    allowed=1e-9,
    fails=1e-6,
)
def flat() -> Iterator[Case]:
    options: dict[str, Any] = {"form": "interpolated", "rtol": 1e-9}
    yield case([1e3, 2e4], [1e-18, 1e-18], ONE_TERM, 1e11, 0.1, **options)
    yield case([1e3, 4e5, 1e6], [1e-20, 1e-20, 1e-23], ONE_TERM, 1e11, 1e-3, **options)


@row(
    "a front that falls to a row of zero",
    "dR/dG runs away where the rate of G comes to zero",
    naive="numpy.interp of ln C in ln q, log-trapezoid of 1000 points",
    truth=BRUTE,
    allowed=1e-6,
)
def falls_to_zero() -> Iterator[Case]:
    for form in ("exact", "interpolated"):
        yield case([1e3, 1.6e3], [1e-16, 0], ONE_TERM, 1e4, 1e-2, form=form, rtol=1e-6)


@row(
    "a front 8 to 25 decades steep, down and up, over 1/200 of its wavenumber or all of it",
    "the rate of G is gone, or has only begun, before a long panel's second node",
    naive="log-trapezoid of 1000 points over the band",
    truth=BRUTE,
    allowed=1e-10,
)
def steep() -> Iterator[Case]:
    for fall in (1e-8, 1e-25, 1e8, 1e25):
        q = np.array([1e3, 1.005e3, 1e5])
        c = np.array([1.0, fall, fall * 1e-6]) * 1e-10 / max(1, fall)
        yield case(q, c, ONE_TERM, 1e3, 1e-2, rtol=1e-10)
    yield case([1e3, 2e3], [1e-34, 1e-14], ONE_TERM, 1e4, 1e-4, rtol=1e-10)
