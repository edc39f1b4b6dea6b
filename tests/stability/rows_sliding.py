"""Rows of exact sliding contact: what goes wrong where dense systems on sets are solved naively.

A map slides at v along x: u_q = K_q p_q, K_q = 2 (1 - nu^2) / (|q| conj E(v q_x)), p >= 0 where the
gap u - h - delta is 0, <p> = sigma0. Maps, rubbers and results are those of
tests/reference/sliding.csv, which two other methods agree on.
"""

import csv
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from rows import Case, row

import asperity

TABLE = Path(__file__).parents[1] / "reference" / "sliding.csv"
TRUTH = "dense systems and the extragradient method (tests/reference)"


@dataclass(frozen=True)
class Contact:
    heights: Any
    length: float
    rubber: asperity.PronySeries
    poisson_ratio: float
    pressure: float
    velocity: float
    mu: float
    area: float

    def compliance(self) -> Any:
        """K of all modes, those of q_x = 0 relaxed, the finest along x with their real part."""
        n = len(self.heights)
        k = np.fft.fftfreq(n, self.length / (2 * np.pi * n))
        qx, qy = np.meshgrid(k, k)
        q = np.hypot(qx, qy)
        q[0, 0] = np.inf
        modulus = self.rubber.modulus(np.maximum(abs(qx), 1e-9) * self.velocity)
        inverse = 1 / np.where(qx < 0, modulus, np.conj(modulus))
        inverse[:, n // 2] = inverse[:, n // 2].real
        return 2 * (1 - self.poisson_ratio**2) / q * inverse

    def ours(self) -> Any:
        surface = asperity.HeightMap(self.heights, pixel_size=self.length / len(self.heights))
        return asperity.validation.slide(
            surface,
            self.rubber,
            pressure=self.pressure,
            velocity=self.velocity,
            poisson_ratio=self.poisson_ratio,
            periodic=True,
            rtol=1e-11,
        )


def solved(name: str) -> Contact:
    with TABLE.open(encoding="utf-8") as file:
        result = {r["case"]: r for r in csv.DictReader(x for x in file if x[0] != "#")}[name]
    n, length = int(float(result["points"])), float(result["length"])
    y, x = np.meshgrid(np.arange(n), np.arange(n), indexing="ij")
    columns = ("kx", "ky", "amplitude", "phase")
    waves = np.array([[float(w) for w in result[c].split(";")] for c in columns]).T
    angles = [2 * np.pi * (i * x + j * y) / n + phase for i, j, _, phase in waves]
    rubber = asperity.PronySeries(
        equilibrium_modulus=float(result["equilibrium_modulus"]),
        moduli=[float(m) for m in result["moduli"].split(";")],
        relaxation_times=[float(t) for t in result["relaxation_times"].split(";")],
    )
    options = [float(result[c]) for c in ("poisson_ratio", "pressure", "velocity")]
    results = float(result["hysteresis"]), float(result["contact_area"])
    heights = sum(w[2] * np.cos(a) for w, a in zip(waves, angles, strict=True))
    return Contact(heights, length, rubber, *options, *results)


def dense(compliance: Any) -> Any:
    """The matrix of the convolution."""
    n = len(compliance)
    kernel = np.fft.ifft2(compliance).real
    at = (np.arange(n)[:, None] - np.arange(n)) % n
    return kernel[at[:, None, :, None], at[None, :, None, :]].reshape(n * n, n * n)


def on_sets(matrix: Any, heights: Any, pressure: float, start: Any) -> Any:
    """p by plain Newton steps on the set of points in contact, 100 at most."""
    n, touching = heights.size, start
    for _ in range(100):
        m = int(touching.sum())
        system = np.zeros((m + 1, m + 1))
        system[:m, :m] = matrix[np.ix_(touching, touching)]
        system[:m, m], system[m, :m] = -1, 1
        result = np.linalg.solve(system, np.append(heights[touching], pressure * n))
        p = np.zeros(n)
        p[touching] = result[:m]
        new = np.where(touching, p > 0, matrix @ p - heights < result[m])
        if (new == touching).all():
            break
        touching = new
    return p


def friction(contact: Contact, compliance: Any, p: Any) -> float:
    """sum of q_x Im K |p_q|^2 over sigma0."""
    n = len(contact.heights)
    power = np.abs(np.fft.fft2(p.reshape(n, n)) / n**2) ** 2
    k = np.fft.fftfreq(n, contact.length / (2 * np.pi * n))
    k[n // 2] = 0
    return float((power * compliance.imag * k).sum() / contact.pressure)


@row(
    "exact sliding, a loss tangent of 16",
    "where loss dominates, the points in contact flip from step to step for ever",
    naive="Newton's steps on the set, 100 of them",
    truth=TRUTH,
    allowed=1e-9,
    fails=0.1,
)
def lossy() -> Iterator[Case]:
    contact = solved("loss tangent of 16")

    def naive() -> float:
        k, h = contact.compliance(), contact.heights.ravel()
        return friction(contact, k, on_sets(dense(k), h, contact.pressure, h > -np.inf))

    yield naive, lambda: contact.ours().hysteresis, contact.mu


@row(
    "exact sliding, fast: waves along the way, q_x = 0",
    "on a grid they stay relaxed at any speed, but stand for a band of q_x that does not",
    naive="K at q_x = 0 from the relaxed modulus; area",
    truth=TRUTH,
    allowed=1e-9,
    fails=0.1,
)
def along_the_way() -> Iterator[Case]:
    contact = solved("fast")

    def naive() -> float:
        k, h = contact.compliance(), contact.heights.ravel()
        return float(np.mean(on_sets(dense(k), h, contact.pressure, h > -np.inf) > 0))

    yield naive, lambda: contact.ours().contact_area_raw, contact.area
