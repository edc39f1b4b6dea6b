"""asperity beside the field's commercial program, on its C(q), modulus, a_T and strain factors.

    python tests/benchmarks/outside/program.py CLONE

CLONE is one of k100kan35-dotcom/psfinal_hysteresis_redesign. Scheme of the program: S = g + (1 - g)
P^2 inside G and on the integrand of Eq. 22, one number g, P that of G with S. asperity does not
offer it; here it is made of its parts, d mu / d ln q without correction times S P over the P there.
"""

import re
from dataclasses import dataclass
from typing import Any

import clone
import numpy as np

import asperity

Array = np.ndarray
FASTEST = 100.0  # m/s, to which the heat stays where a_T is known
EVERY = 6  # of the program's 300 velocities
GAMMA = (0.50, 0.55, 0.60, 0.65, 0.70)
OWN = {
    "none": None,
    "S on the integrand, 0.50": asperity.SFactor(),
    "`NayakSFactor`": asperity.NayakSFactor(),
    "`PartialContact`": asperity.PartialContact(),
}


@dataclass(frozen=True)
class Scene:
    name: str
    dataset: str
    compound: str
    pressure: float = clone.PRESSURE
    q1: float = clone.Q1
    factors: str | None = clone.ONE_FOR_ALL
    last_strain: float = 1.0  # f and g are held from there on


SCENES = (
    Scene("S100, 0.3 MPa", "S100_final", "S100"),
    Scene("S100, 0.5 MPa", "S100_0.5 MPa Load", "S100", pressure=0.5e6),
    Scene("S140, 0.3 MPa", "S140", "S140", factors=clone.COMPOUNDS["S140"].strain),
    Scene("S100, f and g held from 0.22 on", "S100_final", "S100", last_strain=0.22),
    Scene("S100, small strain, $q_1$ 1.05e6", "linear", "S100", q1=1.05e6, factors=None),
)
# rubber and contact by the defaults of the clone's own program; the commercial one's are not stored
HEATING = asperity.Heating(
    density=1150, heat_capacity=1500, conductivity=0.3, contact_diameter=1e-3
)


def inputs(presets: clone.Presets, scene: Scene, velocity: Any) -> dict[str, Any]:
    factors = presets.factors(scene.factors) if scene.factors else None
    if factors:
        kept = factors.strain <= scene.last_strain
        factors = asperity.StrainFactors(
            strain=factors.strain[kept], storage=factors.storage[kept], loss=factors.loss[kept]
        )
    return {
        "spectrum": presets.road(scene.q1),
        "rubber": presets.rubber(scene.compound),
        "pressure": scene.pressure,
        "velocity": velocity,
        "strain_factors": factors,
    }


def cold(given: dict[str, Any], shift: asperity.ShiftFactors) -> dict[str, Any]:
    return given | {"rubber": given["rubber"].shifted(shift.shift_factor(clone.TEMPERATURE))}


def scheme(given: dict[str, Any], gamma: float) -> tuple[Array, Array]:
    """mu and A/A0 with S in both places."""
    plain = asperity.friction(**given, contributions=True, rtol=1e-4)
    q = plain.wavenumber
    assert q is not None
    inside = asperity.SFactor(gamma=gamma, applies_to="area")
    bare, area = (
        asperity.contact_area(**given, correction=correction, wavenumber=q)
        for correction in (None, inside)
    )
    s = gamma + (1 - gamma) * area**2
    mu = np.trapezoid(plain.dmu_dlnq * s * area / bare, np.log(q), axis=-1)
    return mu, area[..., -1]


def percent(error: Array) -> str:
    return f"{100 * error.mean():+.1f} ({100 * error.min():+.0f} to {100 * error.max():+.0f})"


def profile(presets: clone.Presets) -> tuple[float, Array, Array]:
    """v, zeta and T(q) [K] of the program, which the clone's main.py prints as pairs."""
    text = (presets.root / "main.py").read_text(encoding="utf-8")
    block = text[text.index("_preset_zeta_dT = [") :]
    block = block[: block.index("]")]
    pairs = np.array(re.findall(r"\(([\d.e+-]+), ([\d.e+-]+)\)", block), dtype=float)
    return 0.6758, 10 ** pairs[:, 0], pairs[:, 1] + 273.15


def compare(presets: clone.Presets) -> dict[str, dict[str, tuple[Array, Array, Array, Array]]]:
    """By scene and model: v, mu of the model, and mu and A over the program's, less 1."""
    result: dict[str, dict[str, tuple[Array, Array, Array, Array]]] = {}
    for scene in SCENES:
        velocity, mu, area = (x[::EVERY] for x in presets.program(scene.dataset))
        given = cold(inputs(presets, scene, velocity), presets.shift(scene.compound))
        models = {f"S twice, {gamma:.2f}": scheme(given, gamma) for gamma in GAMMA}
        for name, correction in OWN.items():
            own = asperity.friction(**given, correction=correction, rtol=1e-4)
            models[name] = own.mu, own.contact_area
        result[scene.name] = {
            name: (velocity, m, m / mu - 1, a / area - 1) for name, (m, a) in models.items()
        }
    return result


def heat(presets: clone.Presets) -> dict[str, Any]:
    """Hot over cold mu and A, the program's and ours; T(q) at one speed."""
    v, mu, area = presets.program("Flash _\uc815\ud488 S100")
    v_cold, mu_cold, area_cold = presets.program("S100_final")
    v, mu, area = (x[::EVERY] for x in (v, mu, area))
    shared = v <= FASTEST
    v, mu, area = v[shared], mu[shared], area[shared]
    still = [np.interp(np.log(v), np.log(v_cold), y) for y in (mu_cold, area_cold)]
    given = inputs(presets, SCENES[0], v) | {
        "temperature": clone.TEMPERATURE,
        "shift": presets.shift("S100"),
        "correction": asperity.PartialContact(),
    }
    own = asperity.friction(**given, heating=HEATING, rtol=1e-3)
    speed, zeta, rise = profile(presets)
    at = asperity.friction(
        **given | {"velocity": speed}, heating=HEATING, rtol=1e-3, contributions=True
    )
    return {
        "velocity": v,
        "program": (mu / still[0], area / still[1]),
        "own": (own.mu / own.cold.mu, own.contact_area / own.cold.contact_area),
        "profile": (given["spectrum"].q0 * zeta, rise),
        "own_profile": (at.wavenumber, at.temperature_profile),
    }


def main() -> None:
    presets = clone.Presets(
        clone.given("k100kan35-dotcom/psfinal_hysteresis_redesign", "reference_datasets.json")
    )
    result = compare(presets)
    print("mu; A over the program's, %, mean (lowest to highest):\n")
    print("| model | " + " | ".join(result) + " |\n" + "| --- " * (1 + len(result)) + "|")
    for model in next(iter(result.values())):
        cells = (
            f"{percent(rows[model][2])}; {percent(rows[model][3])}" for rows in result.values()
        )
        print(f"| {model} | " + " | ".join(cells) + " |")
    hot = heat(presets)
    print(
        "\n| v [m/s] | hot over cold mu, program | ours | A, program | ours |\n"
        + "| --- " * 5
        + "|"
    )
    for target in (1e-3, 1e-2, 0.1, 1, 10, 100):
        i = int(np.argmin(abs(np.log(hot["velocity"] / target))))
        cells = [hot["velocity"][i]] + [hot[k][n][i] for n in (0, 1) for k in ("program", "own")]
        print("| " + " | ".join(f"{cell:.3g}" for cell in cells) + " |")
    q, rise = hot["profile"]
    own = np.interp(np.log(q), np.log(hot["own_profile"][0]), hot["own_profile"][1])
    print("\n| q [1/m] | T(q) - T0 of the program [K] | ours |\n| --- | --- | --- |")
    for i in np.searchsorted(q, (1e2, 1e3, 1e4, 3e4, 1.04e5)):
        print(f"| {q[i]:.3g} | {rise[i] - 293.15:.2f} | {own[i] - 293.15:.2f} |")


if __name__ == "__main__":
    main()
