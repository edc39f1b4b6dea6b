"""Rows of tabulated moduli: one interval, kinks, what lies outside."""

import sys
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import naive
import numpy as np
from rows import Case, row

import asperity

sys.path.insert(0, str(Path(__file__).parents[1] / "python"))

from helpers.by_definition import Definition


def curve(rows: int, kink: float = 0.0) -> dict[str, Any]:
    """A measured modulus from 1 to 1e9 Pa or, with a kink, bent by so much every second row."""
    w = np.geomspace(1e-1, 1e8, rows)
    storage = np.geomspace(1e3, 1e9, rows) * np.exp(kink * (np.arange(rows) % 2))
    return {
        "angular_frequency": w,
        "storage_modulus": storage,
        "loss_modulus": 0.3 * storage * np.exp(-kink * (np.arange(rows) % 2)),
    }


@row(
    "a modulus of one interval",
    "what lies between two rows 9 decades apart is a matter of axes",
    naive="numpy.interp of E' and E'' in w",
    truth="the definition, 24 Gauss nodes a piece between knots",
    allowed=1e-11,
)
def one_interval() -> Iterator[Case]:
    rows = curve(2)
    w, storage, loss = rows.values()

    def linear(x: Any) -> Any:
        return np.interp(x, w, storage) + 1j * np.interp(x, w, loss)

    for at in (1e2, 1e7):
        exact = Definition(*rows.values())(at)
        for i in (0, 1):
            yield (
                lambda i=i, at=at: naive.angular_trapezoid(linear, at)[i],
                lambda i=i, at=at: asperity.MasterCurve(**rows).angular_integrals(at)[i],
                exact[i],
            )


@row(
    "kinks: a table whose slope jumps at every row",
    "periodic rules converge for smooth functions, not across knots",
    naive="trapezoid of 1000 points in phi",
    truth="the definition, 24 Gauss nodes a piece between knots",
    allowed=1e-11,
    fails=1e-5,
)
def kinks() -> Iterator[Case]:
    rows = curve(60, kink=1.5)
    definition, made = Definition(*rows.values()), asperity.MasterCurve(**rows)
    lowest = rows["angular_frequency"][0]

    def modulus(w: Any) -> Any:
        result = made.modulus(np.maximum(w, lowest))
        return result.real + 1j * result.imag * np.minimum(w / lowest, 1)

    for at in (3e2, 1e5, 0.9e8):
        for i in (0, 1):
            yield (
                lambda i=i, at=at: naive.angular_trapezoid(modulus, at)[i],
                lambda i=i, at=at: made.angular_integrals(at)[i],
                definition(at)[i],
            )
