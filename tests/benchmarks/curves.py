"""Friction curves known to thirteen digits and more, and ours.

Self-affine surfaces are tests/reference/friction_curves.csv, rings of a scan friction_rings.csv.
"""

import csv
from collections.abc import Callable
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np
from moduli import Array, Prony, Steffen

import asperity

TABLES = Path(__file__).parents[1] / "reference"
MOST = 20  # velocities of a curve of the diagrams


@dataclass(frozen=True, eq=False)
class Curve:
    """A surface, a rubber, a pressure and velocities; S of the uncorrected P in Eq. 22.

    `inputs` holds the row of the table, `modulus` the rubber in NumPy, `truth` mu_H.
    """

    name: str
    inputs: dict[str, Any]
    road: asperity.SelfAffineSpectrum | asperity.TabulatedSpectrum
    rubber: asperity.PronySeries | asperity.MasterCurve
    modulus: Prony | Steffen
    velocity: Array  # [m/s]
    truth: Array

    @property
    def measured(self) -> bool:
        """Whether the surface is rings of a scan."""
        return isinstance(self.road, asperity.TabulatedSpectrum)

    @property
    def density(self) -> float:
        """C(q0) [m^4]."""
        if self.measured:
            return self.inputs["table_density"][0]
        rms, hurst = self.inputs["rms_height"], self.inputs["hurst"]
        q0, q1 = self.road.q0, self.road.q1
        return hurst / np.pi * (rms / q0) ** 2 / (1 - (q1 / q0) ** (-2 * hurst))

    def power(self, s: Array) -> Array:
        """q^4 C over that at q0, at s = ln(q / q0)."""
        if self.measured:
            density = np.log(self.inputs["table_density"] / self.density)
            return np.exp(4 * s + np.interp(s, self.rings, density))
        return np.exp((2 - 2 * self.inputs["hurst"]) * s)

    @property
    def rings(self) -> Array:
        """s of the rows of a scan's spectrum, none of a closed form."""
        return (
            np.log(self.inputs["table_wavenumber"] / self.road.q0) if self.measured else np.empty(0)
        )

    @property
    def length(self) -> float:
        return np.log(self.road.q1 / self.road.q0)

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

    def error(self, result: Array) -> float:
        """The worst of the curve, relative."""
        return float(np.abs(result / self.truth - 1).max())


def curves() -> dict[str, Curve]:
    """The self-affine ones, by their names."""
    return _curves("friction_curves.csv")


def measured_curves() -> dict[str, Curve]:
    """Those on rings, by their names."""
    return _curves("friction_rings.csv")


def _curves(table: str) -> dict[str, Curve]:
    with (TABLES / table).open(encoding="utf-8") as file:
        rows = list(csv.DictReader(line for line in file if not line.startswith("#")))
    return {row["case"]: _curve(row) for row in rows}


def _curve(row: dict[str, str]) -> Curve:
    name = row.pop("case")
    inputs = {
        key: np.array([float(x) for x in cell.split(";")]) if ";" in cell else float(cell)
        for key, cell in row.items()
        if cell
    }
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
    road: Any
    if "hurst" in inputs:
        names = ("rms_height", "hurst", "q0", "q1")
        road = asperity.SelfAffineSpectrum(**{key: inputs[key] for key in names})
    else:
        road = asperity.TabulatedSpectrum(
            wavenumber=inputs["table_wavenumber"], density=inputs["table_density"]
        )
    velocity, truth = inputs["velocities"], inputs["hystereses"]
    return Curve(name, inputs, road, make(**rubber), modulus, velocity, truth)
