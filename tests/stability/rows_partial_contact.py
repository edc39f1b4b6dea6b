"""Rows of friction in partial contact: where corrections fail against exact sliding contact.

Contacts are those that no fit has seen, of tests/reference/exact_sliding.csv: mu of maps of rms
slope 1, nu = 0.5. What is allowed is the worst that docs/explanation/partial_contact.md states,
rounded up.
"""

import sys
from collections.abc import Callable, Iterator
from functools import partial
from pathlib import Path
from typing import Any

import naive
import numpy as np
import truth
from rows import Case, row

import asperity

sys.path.insert(0, str(Path(__file__).parents[1] / "reference"))
import make_exact_sliding

EXACT = "exact sliding contacts (tests/reference)"


def ours(spectrum: Any, row: dict[str, str]) -> float:
    found = asperity.friction(
        spectrum,
        make_exact_sliding.rubber(row["rubber"]),
        pressure=float(row["pressure"]),
        velocity=float(row["velocity"]),
        correction=asperity.PartialContact(),
    )
    return float(found.hysteresis)


def self_affine(row: dict[str, str]) -> Any:
    """The spectrum of a map, at rms slope 1."""
    made = asperity.SelfAffineSpectrum(
        rms_height=1,
        hurst=float(row["hurst"]),
        q0=2 * np.pi * float(row["k0"]),
        q1=2 * np.pi * float(row["k1"]),
    )
    return made.scaled(1 / made.rms_slope**2)


def sliding(chosen: Callable[[dict[str, str]], bool], gamma: float | None) -> Iterator[Case]:
    """Eq. 22 with or without S, and ours, on the contacts that are chosen."""
    for given in make_exact_sliding.rows():
        if given["set"] not in ("judge", "curve") or given["rubber"] == "elastic":
            continue
        if not chosen(given):
            continue
        hurst, k0, k1, load, speed = (
            float(given[name]) for name in ("hurst", "k0", "k1", "pressure", "velocity")
        )
        q0, q1 = 2 * np.pi * k0, 2 * np.pi * k1
        height = 1 / truth.slope(1.0, hurst, q0, q1)
        rubber = truth.prony(1.0, *make_exact_sliding.RUBBERS[given["rubber"]])
        c = naive.band_density(height, hurst, q0, q1)
        q = np.geomspace(q0, q1, 1000)
        usual = partial(naive.trapezoid, c, rubber, q, load, speed, gamma=gamma)
        yield (
            lambda usual=usual: usual()[0],
            partial(ours, self_affine(given), given),
            float(given["mu"]),
        )


@row(
    "partial contact at light load, A/A0 from 0.003 to 0.01: mu",
    "a third of the loss comes from the edges of the spots, beyond q1, and S takes from the rest",
    naive="Eq. 22 with S on the integrand, gamma = 0.40",
    truth=EXACT,
    allowed=0.3,
    fails=0.5,
)
def light() -> Iterator[Case]:
    yield from sliding(lambda row: float(row["A"]) < 0.01, 0.4)


@row(
    "partial contact, fast, E0/E_inf of 30 to 300: mu",
    "waves that are strong against the local pressure are not followed, in Eq. 22 they are",
    naive="Eq. 22 as it stands",
    truth=EXACT,
    allowed=0.3,
    fails=0.5,
)
def fast() -> Iterator[Case]:
    steep = ("two", "sls30", "sls300")
    yield from sliding(lambda row: row["rubber"] in steep and float(row["n"]) < -0.3, None)
