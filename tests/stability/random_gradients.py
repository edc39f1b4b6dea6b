"""Random scenes: are the slopes of mu those of differences, within the stated error?

    python tests/stability/random_gradients.py [--scenes 2000] [--seed 1] [--first 0]

Roads, rings, Prony series, master curves of rows anywhere, corrections, adhesion, heat and thermal
constants are drawn as in random_heat.py, strain factors and ridges beside them; half of the scenes
have no heat. At one velocity some slopes of each are held to central differences of mu of a finer
rtol, and the integrals of the densities to d mu / d ln p, where the hysteresis stands alone. Of a
difference its own error is allowed too, as two steps, what bends between them and the errors of mu
tell it; where that is above a thousandth of mu it says nothing and is left out. Printed: how
many slopes were compared, errors over those stated, which slopes exceeded. Exit status 1 where one
did.
"""

import functools
import inspect
import sys
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field, fields
from typing import Any

import numpy as np
import random_heat
from judge import Held, NoTruth, judged
from options import options

import asperity

SHARES = {"rings": 0.3, "curves": 0.3}
RIDGES = 0.3  # share of roads that know directions
STEP = 1e-3
OF_RIDGES = 5e-3  # whose mu is known to 1e-7 at best
OF_ROWS = 2e-4  # whose interpolant has kinks
TELLING = 1e-3  # of mu
LONGEST = 10  # scalars and rows a scene


@dataclass
class Outcome:
    """Of each slope: its error, what was stated and what the difference leaves, all over mu."""

    errors: dict[str, tuple[float, float, float]] = field(default_factory=dict)
    refused: str = ""


def changed(made: Any, name: str, factor: float, row: int | None = None) -> Any:
    """The object with one number, or one of several, times a factor."""
    arguments = {one: getattr(made, one) for one in inspect.signature(type(made)).parameters}
    if row is None:
        arguments[name] = arguments[name] * factor
    else:
        several = np.array(arguments[name], dtype=float)
        several[row] *= factor
        arguments[name] = several
    return type(made)(**arguments)


def draw(seed: int, scene: int) -> tuple[Any, Any, dict[str, Any]]:
    """Road, rubber and conditions."""
    rng = np.random.default_rng([seed, scene])
    road, rubber, at = random_heat.draw_scene(rng, **SHARES)
    at["velocity"] = float(at["velocity"][0])
    if rng.random() < 0.5:
        del at["heating"]
    if rng.random() < 0.4:
        strain = np.sort(10 ** rng.uniform(-3, 0.5, int(rng.integers(1, 6))))
        factors = {one: np.cumprod(rng.uniform(0.6, 1.05, strain.size)) for one in ("a", "b")}
        at["strain_factors"] = asperity.StrainFactors(
            strain=strain, storage=factors["a"], loss=factors["b"], strain_per_slope=0.5
        )
    if rng.random() < RIDGES:
        at["direction"] = float(rng.uniform(-np.pi, np.pi))
        road = with_ridges(road, rng)
    return road, rubber, at


def with_ridges(road: Any, rng: Any) -> Any:
    """The road with ellipses, or with harmonics of each ring about those of all."""
    kept = {one: getattr(road, one) for one in inspect.signature(type(road)).parameters}
    if isinstance(road, asperity.SelfAffineSpectrum):
        lay, ratio = float(rng.uniform(0, np.pi)), float(rng.uniform(1.2, 6))
        return type(road)(**kept | {"axis_ratio": ratio, "lay": lay})
    count = int(rng.integers(1, 7))
    size = rng.uniform(0.05, 0.3) / np.arange(1, count + 1) ** 2
    each = [
        size * (rng.uniform(-1, 1, count) + 0.3 * rng.uniform(-1, 1, (road.density.size, count)))
        for _ in range(2)
    ]
    return type(road)(**kept | {"cosine": each[0], "sine": each[1]})


def weights(rows: Any) -> Any:
    steps = np.diff(np.log(rows)) / 2
    return np.append(steps, 0) + np.append(0, steps)


def numbers(
    road: Any, rubber: Any, at: dict[str, Any], of: asperity.Gradients, rng: Any
) -> Iterator[tuple[str, float, Callable[[float], Any]]]:
    """Names, slopes, and what changes road, rubber and conditions by a logarithm."""

    def condition(name: str) -> Callable[[float], Any]:
        return lambda x: (road, rubber, at | {name: at[name] * np.exp(x)})

    def part(name: str, of_part: str, row: int | None = None) -> Callable[[float], Any]:
        return lambda x: (
            road,
            rubber,
            at | {name: changed(at[name], of_part, float(np.exp(x)), row)},
        )

    def of_road(name: str, row: int | None = None) -> Callable[[float], Any]:
        return lambda x: (changed(road, name, float(np.exp(x)), row), rubber, at)

    def of_rubber(name: str, row: int | None = None) -> Callable[[float], Any]:
        return lambda x: (road, changed(rubber, name, float(np.exp(x)), row), at)

    for name in ("pressure", "velocity"):
        yield name, getattr(of, name), condition(name)
    yield (
        "temperature",
        10 * of.temperature,
        lambda x: (road, rubber, at | {"temperature": at["temperature"] + 10 * x}),
    )
    if isinstance(road, asperity.SelfAffineSpectrum):
        for name in ("rms_height", "hurst", "q0", "q1", "rolloff", "axis_ratio"):
            if getattr(of, name) is not None and (name != "hurst" or road.hurst < 0.98):
                yield name, getattr(of, name), of_road(name)
    else:
        row = int(rng.choice(np.flatnonzero(road.density)))
        yield (
            "spectrum",
            float(of.spectrum[row] * weights(of.wavenumber)[row]),
            of_road("density", row),
        )
    if of.direction is not None:
        yield (
            "direction",
            of.direction,
            lambda x: (road, rubber, at | {"direction": at["direction"] + x}),
        )
    w = weights(of.angular_frequency)
    if isinstance(rubber, asperity.PronySeries):
        row = int(rng.integers(len(rubber.moduli)))
        yield "equilibrium_modulus", of.equilibrium_modulus, of_rubber("equilibrium_modulus")
        for name in ("moduli", "relaxation_times"):
            yield name, float(getattr(of, name)[row]), of_rubber(name, row)
    else:
        for name, density in (("storage_modulus", of.storage), ("loss_modulus", of.loss)):
            row = int(np.argmax(np.abs(density * w) * rng.uniform(0, 1, w.size)))
            yield name, float((density * w)[row]), of_rubber(name, row)
    if at["adhesion"] is not None:
        for name in ("shear_stress", "reference_velocity", "width"):
            yield name, getattr(of, name), part("adhesion", name)
    for name in ("gamma", "friction_gamma", "p", "z_max", "z_min", "correction_rms_height"):
        slope, argument = getattr(of, name), name.removeprefix("correction_")
        value = None if slope is None else getattr(at["correction"], argument)
        if value is not None and not (argument == "gamma" and value > 0.99) and value != 1:
            yield name, slope, part("correction", argument)
    if (factors := at.get("strain_factors")) is not None:
        yield "strain_per_slope", of.strain_per_slope, part("strain_factors", "strain_per_slope")
        row = int(rng.integers(len(factors.strain)))
        for name in ("storage", "loss"):
            slope = getattr(of, f"{name}_factors")
            yield f"{name}_factors", float(slope[row]), part("strain_factors", name, row)
    if (heating := at.get("heating")) is not None:
        for one in fields(heating):
            value, slope = getattr(heating, one.name), getattr(of, one.name, None)
            if slope is not None and not (
                one.name in ("interface_share", "macro_area") and value > 0.98
            ):
                yield one.name, slope, part("heating", one.name)


def compute(seed: int, scene: int) -> Outcome:
    road, rubber, at = draw(seed, scene)
    rng = np.random.default_rng([seed, scene, 1])
    table = isinstance(road, asperity.TabulatedSpectrum)
    measured = isinstance(rubber, asperity.MasterCurve)
    finer = 1e-7 if road.is_directional else 1e-8 if table or measured else 1e-10
    usual = OF_RIDGES if road.is_directional else STEP
    outcome = Outcome()

    def mu(of: tuple[Any, Any, dict[str, Any]]) -> Any:
        return asperity.friction(of[0], of[1], **of[2], rtol=finer)

    try:
        result = asperity.friction(road, rubber, **at, gradients=True)
    except asperity.Error as error:
        outcome.refused = type(error).__name__
        return outcome
    of, whole = result.gradients, result.mu
    if not whole > 1e-12:
        outcome.refused = "no friction"
        return outcome
    all_numbers = list(numbers(road, rubber, at, of, rng))
    middle = functools.cache(lambda: mu((road, rubber, at)))
    chosen = rng.permutation(len(all_numbers))[:LONGEST]
    for name, slope, change in (all_numbers[k] for k in chosen):
        step = OF_ROWS if name.endswith("modulus") and measured else usual
        try:
            near, far = ([mu(change(side * h)) for side in (-1, 1)] for h in (step, 2 * step))
            here = middle().mu
        except asperity.Error:
            continue
        two, four = ((b.mu - a.mu) / h for (a, b), h in ((near, 2 * step), (far, 4 * step)))
        best = (4 * two - four) / 3
        # four to three is what the error of mu does to it; kinks leave part of what steps tell
        left = abs(best - two) / 2 + 3 * sum(one.error_estimate for one in near) / (2 * step)
        # a kink has a slope on each side: unlike a curvature it bends as much on half of a step;
        # twice that, as it may lie beside the middle
        bend, wider = (abs(a.mu + b.mu - 2 * here) for a, b in (near, far))
        left += 2 * abs(bend - wider / 4) / step
        if left <= TELLING * whole:
            stated = of.error_estimate * (10 if name == "temperature" else 1)
            outcome.errors[name] = tuple(
                float(one / whole) for one in (abs(slope - best), stated, left)
            )
    shifted = isinstance(at["correction"], asperity.GreenwoodWilliamson)
    if at["adhesion"] is None and "heating" not in at and not shifted:
        over_e = (of.storage + of.loss) @ weights(of.angular_frequency)
        stated = of.error_estimate / whole
        outcome.errors["int E"] = abs(over_e + of.pressure) / whole, stated, 0
        if "strain_factors" not in at:
            over_c = of.spectrum @ weights(of.wavenumber)
            off = abs(over_c - (whole - of.pressure) / 2) / whole
            outcome.errors["int C"] = off, stated, 0
    return outcome


def main() -> int:
    asked = options(__doc__, scenes=2000, seed=1, first=0)

    def held(scene: int) -> list[Held]:
        outcome = compute(asked.seed, scene)
        if outcome.refused:
            raise NoTruth(outcome.refused)
        return [
            (name, max(error - left, 0) / stated, f"off by {error:.2g} with {left:.2g}")
            for name, (error, stated, left) in outcome.errors.items()
        ]

    return judged(range(asked.first, asked.first + asked.scenes), held)


if __name__ == "__main__":
    sys.exit(main())
