"""Friction curves known to sixteen digits, tests/reference/friction_curves.csv, and ours."""

import csv
from collections.abc import Callable
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np
from moduli import Array, Prony, Steffen

import asperity

TABLE = Path(__file__).parents[1] / "reference" / "friction_curves.csv"
MOST = 20  # velocities of a curve of the diagrams


@dataclass(frozen=True, eq=False)
class Curve:
    """A self-affine surface, a rubber, a pressure and velocities; S of the uncorrected P in Eq. 22.

    `inputs` holds the row of the table, `modulus` the rubber in NumPy, `truth` mu_H.
    """

    name: str
    inputs: dict[str, Any]
    road: asperity.SelfAffineSpectrum
    rubber: asperity.PronySeries | asperity.MasterCurve
    modulus: Prony | Steffen
    velocity: Array  # [m/s]
    truth: Array

    @property
    def density(self) -> float:
        """C(q0) [m^4]."""
        rms, hurst, q0, q1 = (self.inputs[key] for key in ("rms_height", "hurst", "q0", "q1"))
        return hurst / np.pi * (rms / q0) ** 2 / (1 - (q1 / q0) ** (-2 * hurst))

    @property
    def length(self) -> float:
        return np.log(self.inputs["q1"] / self.inputs["q0"])

    @property
    def correction(self) -> asperity.SFactor:
        return asperity.SFactor(gamma=self.inputs["gamma"])

    def ours(self, rtol: float, method: Any = "gauss") -> Array:
        return asperity.friction(
            self.road,
            self.rubber,
            pressure=self.inputs["pressure"],
            velocity=self.velocity,
            poisson_ratio=self.inputs["poisson_ratio"],
            correction=self.correction,
            rtol=rtol,
            method=method,
        ).mu

    def thinned(self, most: int = MOST) -> "Curve":
        """Every so many velocities of it, `most` at most."""
        step = -(-self.velocity.size // most)
        return self.of_velocities(slice(None, None, step))

    def of_velocities(self, some: slice) -> "Curve":
        return replace(self, velocity=self.velocity[some], truth=self.truth[some])

    def error(self, found: Array) -> float:
        """The worst of the curve, relative."""
        return float(np.abs(found / self.truth - 1).max())


def curves() -> dict[str, Curve]:
    """All of the table, by their names."""
    with TABLE.open(encoding="utf-8") as file:
        rows = list(csv.DictReader(line for line in file if not line.startswith("#")))
    return {row["case"]: _curve(row) for row in rows}


def _curve(row: dict[str, str]) -> Curve:
    name = row.pop("case")
    inputs = {
        key: np.array([float(x) for x in cell.split(";")]) if ";" in cell else float(cell)
        for key, cell in row.items()
        if cell
    }
    surface = {key: inputs[key] for key in ("rms_height", "hurst", "q0", "q1")}
    rubber: Any
    make: Callable[..., Any]
    if "moduli" in inputs:
        names = ("equilibrium_modulus", "moduli", "relaxation_times")
        rubber, make = {key: inputs[key] for key in names}, asperity.PronySeries
        modulus = Prony(**rubber)
    else:
        columns = ("angular_frequency", "storage_modulus", "loss_modulus")
        table = [inputs[key] for key in ("table_frequency", "table_storage", "table_loss")]
        rubber, make = dict(zip(columns, table, strict=True)), asperity.MasterCurve
        modulus = Steffen(*table)
    road = asperity.SelfAffineSpectrum(**surface)
    velocity, truth = inputs["velocities"], inputs["hystereses"]
    return Curve(name, inputs, road, make(**rubber), modulus, velocity, truth)
