"""What makes the friction of a scene: what 10 % more of each part of its inputs is worth."""

import math
from collections.abc import Iterator
from contextlib import suppress
from dataclasses import dataclass, fields, replace
from itertools import pairwise

import numpy as np

from asperity import _core
from asperity._core import InvalidInput, OutOfRange
from asperity.base.arguments import Array, known
from asperity.results.friction import Friction
from asperity.results.gradients import DENSITIES, SEVERAL, Gradients
from asperity.scan_contact import ScanContact
from asperity.scene.model import Scene
from asperity.shift_factors import TemperatureShift, temperature_shift_core

MORE = np.log(1.1)  # 10 % more, in a logarithm
DEGREES = 10.0  # of direction, for which 10 % have no meaning
DMA_HERTZ = 10.0  # at which tan delta at 0 and 60 C are the trade's handles
_COLDEST, _HOTTEST = 150.0, 700.0  # [K]
# slopes that are no numbers of the scene's parts, or many
_OTHERS = {*DENSITIES, *SEVERAL, "wavenumber", "angular_frequency", "poisson_ratio"}
_OTHERS |= {"pressure", "velocity", "temperature", "direction", "lay", "error_estimate"}
_NUMBERS = tuple(one.name for one in fields(Gradients) if one.name not in _OTHERS)


@dataclass(frozen=True)
class Worth:
    """What a change of one part of the inputs is worth at a point."""

    pressure: float
    velocity: float
    part: str
    change: str
    lower: float | None  # of the decade [rad/s], or of the wavelengths [m]
    upper: float | None
    temperature: float | None  # at which a DMA at 10 Hz has the decade's middle [K]
    mu: float


@dataclass(frozen=True)
class Design:
    """The friction of a scene with its slopes, and what follows for a person who may change it."""

    result: Friction
    worths: tuple[Worth, ...]

    @property
    def gradients(self) -> Gradients:
        return known(self.result.gradients)


def design(scene: Scene) -> Design:
    """Return what 10 % of each decade and number is worth at every point of a scene."""
    result = scene.friction(gradients=True)
    shift, shape = scene.built_rubber.shift, np.shape(result.mu)
    pressure, velocity = scene.points
    rows = [
        row
        for at, p, v in zip(np.ndindex(shape), pressure, velocity, strict=True)
        for row in _at_point(known(result.gradients), at, (float(p), float(v)), shift)
    ]
    return Design(result, tuple(rows))


def design_at_largest(scene: Scene, mu: Array) -> Design | None:
    """Return the design at the point of the largest mu; None where a scene has no slopes, or none
    but by contacts of its scan that nobody has solved."""
    if isinstance(scene.correction, ScanContact):
        return None
    i, k = np.unravel_index(int(mu.argmax()), mu.shape)
    one = replace(scene, pressure=scene.pressure[[i]], velocity=scene.velocity[[k]])
    with suppress(InvalidInput):
        return design(one)
    return None


def worth_text(found: Design) -> str:
    first = found.worths[0]
    here = [
        one
        for one in found.worths
        if one.lower is None and (one.pressure, one.velocity) == (first.pressure, first.velocity)
    ]
    here.sort(key=lambda one: -abs(one.mu))
    said = [f"{one.change} of {one.part.replace('_', ' ')} {one.mu:+.2g}" for one in here]
    return ", ".join(said)


def _at_point(
    of: Gradients, i: tuple[int, ...], point: tuple[float, float], shift: TemperatureShift | None
) -> Iterator[Worth]:
    for part in ("storage", "loss"):
        edges, sums = by_decade(of.angular_frequency, getattr(of, part)[i])
        for k, worth in enumerate(sums):
            middle = float(np.sqrt(edges[k] * edges[k + 1]))
            seen = None if shift is None else temperature_of_dma(shift, middle)
            yield Worth(*point, part, "10 %", edges[k], edges[k + 1], seen, MORE * worth)
    edges, sums = by_decade(2 * np.pi / of.wavenumber[::-1], of.spectrum[i][::-1])
    for k, worth in enumerate(sums):
        yield Worth(*point, "spectrum", "10 %", edges[k], edges[k + 1], None, MORE * worth)
    for part in ("pressure", "velocity"):
        yield Worth(*point, part, "10 %", None, None, None, MORE * getattr(of, part)[i])
    if of.temperature is not None:
        yield Worth(*point, "temperature", "1 K", None, None, None, float(of.temperature[i]))
    if of.direction is not None:
        more = float(np.radians(DEGREES) * of.direction[i])
        yield Worth(*point, "direction", f"{DEGREES:g} degrees", None, None, None, more)
    for name in _NUMBERS:
        if (slope := getattr(of, name)) is not None:
            yield Worth(*point, name, "10 %", None, None, None, MORE * float(slope[i]))


def by_decade(rows: Array, density: Array) -> tuple[list[float], Array]:
    """Return powers of ten and the integral of a density over the logarithm between them, which is
    linear between rows; decades with less than a thousandth of all are left out at the ends."""
    x = np.log(rows)
    low, high = np.floor(np.log10(rows[0])), np.ceil(np.log10(rows[-1]))
    powers = np.arange(low, max(high, low + 1) + 1)
    edges = powers * np.log(10)
    at = np.union1d(x, np.clip(edges, x[0], x[-1]))
    here = np.interp(at, x, density)
    up_to = np.append(0.0, np.cumsum(np.diff(at) * (here[1:] + here[:-1]) / 2))
    sums = np.diff(np.interp(edges, at, up_to))
    of_note = np.flatnonzero(np.abs(sums) > 1e-3 * np.abs(sums).sum())
    first, last = (of_note[0], of_note[-1] + 1) if of_note.size else (0, sums.size)
    return (10.0 ** powers[first : last + 1]).tolist(), sums[first:last]


def temperature_of_dma(shift: TemperatureShift, reduced: float) -> float | None:
    """Return the temperature [K] at which a DMA at 10 Hz has this reduced frequency [rad/s], None
    where the shift does not know it."""
    wanted = np.log10(reduced / (2 * np.pi * DMA_HERTZ))

    core = temperature_shift_core(shift)

    def off(temperature: float) -> float:
        try:
            return float(_core.shift_at(core, np.array([temperature]))[0][0] - wanted)
        except (InvalidInput, OutOfRange):
            return math.nan

    grid = np.arange(_COLDEST, _HOTTEST, 2.0)
    for (lower, above), (upper, below) in pairwise((t, off(t)) for t in grid):
        if above >= 0 >= below:
            return float(lower + (upper - lower) * above / max(above - below, 1e-300))
    return None
