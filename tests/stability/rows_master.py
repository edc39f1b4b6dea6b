"""Rows of tabulated moduli: one interval, kinks, what lies outside."""

import sys
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import naive
import numpy as np
import truth
from rows import Case, row
from rows_rubber import ROAD, friction, road_density, trapezoid

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


@row(
    "kinks: mu on that rubber",
    "panels must end at every knot",
    naive="log-trapezoid of 1000 points",
    truth="brute force between knots, I1 and I2 by definition",
    allowed=1e-9,
)
def kinks_friction() -> Iterator[Case]:
    rows = curve(12, kink=1.0)
    definition, velocity, pressure = Definition(*rows.values()), 1e-2, 3e1

    def integrals(w: Any) -> Any:
        result = np.array([definition(float(x))[:2] for x in np.ravel(w)])
        return result[:, 0].reshape(np.shape(w)), result[:, 1].reshape(np.shape(w))

    knots = rows["angular_frequency"] / velocity
    edges = [ROAD["q0"], *knots[(knots > ROAD["q0"]) & (knots < ROAD["q1"])], ROAD["q1"]]
    pieces = truth.table(edges, road_density(np.array(edges)))
    exact = truth.contact(pieces, integrals, pressure, velocity, panels=60)
    yield (
        lambda: trapezoid(integrals, pressure, velocity)[0],
        lambda: friction(asperity.MasterCurve(**rows), pressure=pressure).mu,
        exact.mu,
    )
