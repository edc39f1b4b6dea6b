"""Rows of heat: friction warms the rubber whose modulus makes the friction.

theta(q) = (2 v sigma0 / (rho c_v P_m)) int q' g(q, q') dmu(q'), the modulus at T0 + theta(q).
Scenes and results are those of tests/reference/flash.csv, on which two other programs agree, and of
heat_kernel.csv.
"""

import csv
import math
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
from rows import Case, row

import asperity

REFERENCE = Path(__file__).parents[1] / "reference"
TRUTH = "two other programs (tests/reference/flash.csv)"
LAW = asperity.WLF(c1=8.86, c2=101.6, reference_temperature=293.15)
TREAD = asperity.Heating(density=1200, heat_capacity=1650, conductivity=0.23, contact_diameter=1e-3)
ASPHALT = asperity.SelfAffineSpectrum(rms_height=265.7e-6, hurst=0.87, q0=2000, q1=1e6)


def lines(name: str) -> list[str]:
    return (REFERENCE / f"{name}.csv").read_text(encoding="utf-8").splitlines()


def of_table(name: str, case: str) -> dict[str, str]:
    rows = csv.DictReader(line for line in lines(name) if line[0] != "#")
    return next(result for result in rows if result["case"] == case)


def compound() -> asperity.PronySeries:
    """The rubber that the comments of flash.csv have."""
    kept = [line.split()[1:] for line in lines("flash") if line.startswith(("# mod", "# relax"))]
    columns = {name: [float(x) for x in numbers] for name, *numbers in kept}
    return asperity.PronySeries(equilibrium_modulus=2e6, **columns)


class Scene:
    """A row of flash.csv, ours, and a pass of its fixed point by 240 Gauss-Legendre nodes."""

    def __init__(self, case: str) -> None:
        result = of_table("flash", case)
        columns = ("pressure", "velocity", "temperature", "mu_h", "rise_q1")
        numbers = [float(result[name]) for name in columns]
        self.pressure, self.velocity, self.temperature, self.mu, self.rise = numbers
        self.road = ASPHALT.truncated(q1=float(result["q1"]))
        self.rubber = compound()
        nodes, weights = np.polynomial.legendre.leggauss(240)
        length = math.log(self.road.q1 / self.road.q0)
        self.q = self.road.q0 * np.exp(length * (nodes + 1) / 2)
        self.weight = length / 2 * weights
        self.kernel = np.stack(
            [asperity.heat_kernel(q, self.q, velocity=self.velocity, heating=TREAD) for q in self.q]
        )

    def ours(self) -> Any:
        return asperity.friction(
            self.road,
            self.rubber,
            pressure=self.pressure,
            velocity=self.velocity,
            temperature=self.temperature,
            shift=LAW,
            heating=TREAD,
            rtol=1e-9,
        )

    def step(self, theta: Any) -> tuple[float, Any]:
        """mu with the rise theta at the nodes, and the rise that it makes."""
        a_t = 10 ** LAW.log10_a_T(self.temperature + theta)
        i1, i2 = self.rubber.angular_integrals(self.velocity * self.q * a_t)
        stiff, q4c = 1 - 0.5**2, self.q**4 * self.road.at(self.q)
        slope = q4c * i2 / (8 * stiff**2 * self.pressure**2)
        g = np.cumsum(self.weight * slope) - self.weight * slope / 2
        share = np.array([math.erf(0.5 / math.sqrt(one)) if one > 0 else 1.0 for one in g])
        dmu = q4c * share * i1 / (2 * stiff * self.pressure)
        macro = np.interp(math.log(2 * math.pi / 1e-3), np.log(self.q), share)
        flux = 2 * self.velocity * self.pressure / (1200 * 1650 * macro)
        rise = flux * self.kernel @ (self.q * dmu * self.weight)
        return float(dmu @ self.weight), rise


@row(
    "heat that softens the rubber, 10 m/s",
    "the rise takes from itself more than it is: the largest eigenvalue of its fixed point is -1.4",
    naive="100 passes of plain iteration from the cold rubber",
    truth=TRUTH,
    allowed=1e-8,
    fails=0.05,
)
def plain_iteration() -> Iterator[Case]:
    scene = Scene("slope13 200000 Pa 10 m/s 1")

    def naive() -> float:
        theta: Any = np.zeros_like(scene.q)
        for _ in range(100):
            mu, theta = scene.step(theta)
        return mu

    yield naive, lambda: scene.ours().mu, scene.mu


@row(
    "heat of a full spectrum, 0.1 m/s and 10 m/s",
    "friction of the cold rubber would heat it by hundreds of kelvin",
    naive="one pass: the rise at q1 from the cold friction",
    truth=TRUTH,
    allowed=1e-8,
    fails=2,
)
def one_pass() -> Iterator[Case]:
    for case in ("full 200000 Pa 0.1 m/s 1", "full 200000 Pa 10 m/s 1"):
        scene = Scene(case)

        def naive(scene: Scene = scene) -> float:
            return float(scene.step(np.zeros_like(scene.q))[1][-1])

        yield naive, lambda scene=scene: scene.ours().temperature - scene.temperature, scene.rise


@row(
    "heat at the glass transition, 10 m/s: three steady states",
    "heat makes more heat; sliding from rest reaches the coldest, searches end in the hottest",
    naive="damped iteration from a rise of 50 K, 400 passes",
    truth=TRUTH,
    allowed=1e-8,
    fails=1e3,
)
def runaway() -> Iterator[Case]:
    scene = Scene("glass_243 200000 Pa 10 m/s 1")

    def naive() -> float:
        theta: Any = np.full_like(scene.q, 50.0)
        for _ in range(400):
            mu, rise = scene.step(theta)
            theta = theta + 0.2 * (rise - theta)
        return mu

    yield naive, lambda: scene.ours().mu, scene.mu


@row(
    "heat kernel, q = 3e4 and 1e6 1/m at 1 mm/s",
    "exp(x^2) overflows before erfc(x) takes it back",
    naive="the kernel with exp(x^2) erfc(x), summed over 400 points of sqrt(tau)",
    truth="mpmath (tests/reference/heat_kernel.csv)",
    allowed=1e-12,
)
def deep_kernel() -> Iterator[Case]:
    for case in ("disc 0.001 1e+06 30000", "box 0.001 1e+06 30000"):
        result = of_table("heat_kernel", case)
        residence: Any = result["residence"]
        q, q_prime, v, diameter, d = (
            float(result[name])
            for name in ("q", "q_prime", "velocity", "contact_diameter", "diffusivity")
        )
        heating = asperity.Heating(
            density=1000,
            heat_capacity=2000,
            conductivity=d * 1000 * 2000,
            contact_diameter=diameter,
            residence=residence,
        )

        def naive(q: float = q, q_prime: float = q_prime, v: float = v, d: float = d) -> float:
            a, b, longest = 2 * q, 2 * q_prime, 1e-3 / v
            total = 0.0
            for i in range(400):
                root = math.sqrt(longest) * (i + 0.5) / 400
                s = math.sqrt(d) * root
                scaled = [math.exp((k * s) ** 2) * math.erfc(k * s) for k in (a, b)]
                k = a * (b * scaled[0] - a * scaled[1]) / (b * b - a * a)
                total += 2 * root * k * math.sqrt(longest) / 400
            return total

        yield (
            naive,
            lambda q=q, p=q_prime, v=v, h=heating: asperity.heat_kernel(
                q, p, velocity=v, heating=h
            ),
            float(result["g"]),
        )
