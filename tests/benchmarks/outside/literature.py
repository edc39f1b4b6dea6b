"""What others found of viscoelastic sliding contacts, asked of exact contacts and the theory here.

    python tests/benchmarks/outside/literature.py

Universal area: M. Scaraggi, B. N. J. Persson, arXiv:1406.7236. Limits at high speed: S.
Sukhomlinov, M. H. Muser, arXiv:2104.15056. The force across: L. Afferrante, C. Putignano, N. Menga,
G. Carbone, Eur. Phys. J. E 42, 80 (2019). Maps of 256 x 256 points, 4 to 32 waves to the side.
Prints Markdown.
"""

import math

import numpy as np
from program import scheme

import asperity
from asperity.validation import slide

Array = np.ndarray
SIDE, POINTS = 0.01, 256
ROUGH = {"rms_height": 1e-4, "hurst": 0.8, "q0": 8 * np.pi / SIDE, "q1": 64 * np.pi / SIDE}
LAW = asperity.SelfAffineSpectrum(**ROUGH)
GRID = {"shape": (POINTS, POINTS), "pixel_size": SIDE / POINTS}
RUBBERS = {
    "one term, 10": asperity.PronySeries(
        equilibrium_modulus=1e6, moduli=[9e6], relaxation_times=[1e-3]
    ),
    "one term, 100": asperity.PronySeries(
        equilibrium_modulus=1e6, moduli=[99e6], relaxation_times=[1e-3]
    ),
    "eight terms, 100": asperity.PronySeries(
        equilibrium_modulus=1e6,
        moduli=1e6 * 100 ** ((np.arange(8) + 1) / 8) * (1 - 100 ** (-1 / 8)),
        relaxation_times=np.geomspace(1e2, 1e-5, 8),
    ),
}
SPEEDS = (1e-4, 1e-2, 0.1, 1.0, 10.0, 1e3)
LOADS = (0.02, 0.1, 0.3)  # p*
TWICE = (0.5, 0.6, 0.65)  # g of S inside G and on the integrand, the scheme of program.py
ELASTIC = asperity.PronySeries(equilibrium_modulus=1e6, moduli=[], relaxation_times=[])


def pressure_of(rubber: asperity.PronySeries, load: float, velocity: float) -> float:
    """[Pa], at which 1 / sqrt(8 G(q1)) is the load: G falls as 1 / pressure^2."""
    area = asperity.contact_area(LAW, rubber, pressure=1e6, velocity=velocity)
    low, high = 0.0, 10.0  # of 1 / (2 sqrt(G))
    for _ in range(80):
        middle = (low + high) / 2
        low, high = (middle, high) if math.erf(middle) < area else (low, middle)
    return 1e6 * load * math.sqrt(2) / middle


def sliding(rubber: asperity.PronySeries, load: float, velocity: float) -> dict[str, float]:
    """Exact area and friction, and the theory's over them."""
    surface = asperity.synthesize(LAW, **GRID, seed=1)
    at = {"pressure": pressure_of(rubber, load, velocity), "velocity": velocity}
    exact = slide(surface, rubber, **at, periodic=True, rtol=1e-4)
    result = {"area": exact.contact_area, "mu": exact.hysteresis}
    for name, correction in (("none", None), ("rule", asperity.PartialContact())):
        said = asperity.friction(LAW, rubber, **at, correction=correction)
        result |= {
            f"area, {name}": said.contact_area / exact.contact_area,
            f"mu, {name}": said.mu / exact.hysteresis,
        }
    for gamma in TWICE:
        mu, area = scheme({"spectrum": LAW, "rubber": rubber} | at, gamma)
        result |= {
            f"area, {gamma}": area / exact.contact_area,
            f"mu, {gamma}": mu / exact.hysteresis,
        }
    return result


def areas() -> None:
    surface = asperity.synthesize(LAW, **GRID, seed=1)
    print("area at the same p* over that of the elastic contact of the same map\n")
    print(
        "| p* | elastic A | " + " | ".join(RUBBERS) + " |\n" + "| --- " * (2 + len(RUBBERS)) + "|"
    )
    result = {}
    for load in LOADS:
        at = {"pressure": pressure_of(ELASTIC, load, 1.0), "velocity": 0.0}
        still = slide(surface, ELASTIC, **at, periodic=True, rtol=1e-4).contact_area
        cells = []
        for name, rubber in RUBBERS.items():
            result[load, name] = [sliding(rubber, load, velocity) for velocity in SPEEDS]
            ratio = [one["area"] / still for one in result[load, name]]
            cells.append(", ".join(f"{x:.2f}" for x in ratio))
        print(f"| {load:g} | {still:.4f} | " + " | ".join(cells) + " |")
    print("\nspeeds in m/s: " + ", ".join(f"{v:g}" for v in SPEEDS))
    print("\nmu without correction, of PartialContact, over exact\n")
    print("| p* | rubber | " + " | ".join(f"{v:g} m/s" for v in SPEEDS) + " |")
    print("| --- " * (2 + len(SPEEDS)) + "|")
    for (load, name), row in result.items():
        cells = (f"{one['mu, none']:.2f}, {one['mu, rule']:.2f}" for one in row)
        print(f"| {load:g} | {name} | " + " | ".join(cells) + " |")
    print("\nerrors of all of these, rms (mean) in %\n\n| model | mu | A |\n| --- | --- | --- |")
    for model in ("none", "rule", *map(str, TWICE)):
        cells = []
        for quantity in ("mu", "area"):
            rows = [one[f"{quantity}, {model}"] for row in result.values() for one in row]
            off = 100 * (np.array(rows) - 1)
            cells.append(f"{np.sqrt(np.mean(off**2)):.0f} ({off.mean():+.0f})")
        print(f"| {model} | " + " | ".join(cells) + " |")


def at_one_pressure() -> None:
    """Error of mu by how far sliding has reduced the area."""
    surface = asperity.synthesize(LAW, **GRID, seed=1)
    print(
        "\nA over that at rest, mu without correction and of PartialContact over exact, 0.1 MPa\n"
    )
    print("| rubber | " + " | ".join(f"{v:g} m/s" for v in SPEEDS) + " |")
    print("| --- " * (1 + len(SPEEDS)) + "|")
    for name, rubber in RUBBERS.items():
        still = slide(surface, rubber, pressure=1e5, velocity=0.0, periodic=True, rtol=1e-4)
        cells = []
        for velocity in SPEEDS:
            at = {"pressure": 1e5, "velocity": velocity}
            exact = slide(surface, rubber, **at, periodic=True, rtol=1e-4)
            errors = [
                asperity.friction(LAW, rubber, **at, correction=correction).mu / exact.hysteresis
                for correction in (None, asperity.PartialContact())
            ]
            left = exact.contact_area / still.contact_area
            cells.append(", ".join(f"{x:.2f}" for x in (left, *errors)))
        print(f"| {name} | " + " | ".join(cells) + " |")


def across() -> None:
    """The force across the sliding over that along it, ridges of axis ratio 2."""
    print("\nacross over along, exact and of PartialContact, axis ratio 2, 0.15 MPa\n")
    ridged = asperity.SelfAffineSpectrum(**ROUGH, axis_ratio=2.0, lay=np.pi / 2)
    surface = asperity.synthesize(ridged, **GRID, seed=1)
    angles = (0, 30, 45, 60, 90)
    print("| v [m/s] | " + " | ".join(f"{angle} deg" for angle in angles) + " |")
    print("| --- " * (1 + len(angles)) + "|")
    rubber = RUBBERS["one term, 10"]
    for velocity in (0.02, 1.0):
        cells = []
        for angle in angles:
            at = {"pressure": 1.5e5, "velocity": velocity, "direction": np.radians(angle)}
            exact = slide(surface, rubber, **at, periodic=True, rtol=1e-4)
            said = asperity.friction(
                ridged, rubber, **at, correction=asperity.PartialContact(), rtol=1e-5
            )
            ratios = exact.lateral / exact.hysteresis, said.lateral / said.mu
            cells.append(", ".join(f"{x:+.2f}" for x in ratios))
        print(f"| {velocity:g} | " + " | ".join(cells) + " |")


if __name__ == "__main__":
    areas()
    at_one_pressure()
    across()
