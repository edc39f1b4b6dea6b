"""A scene at measured points, for numbers of it that change: mu, and its slopes over them."""

from collections.abc import Mapping, Sequence
from contextlib import suppress
from pathlib import Path
from statistics import NormalDist
from typing import Any

import numpy as np
from numpy.typing import NDArray

from asperity._core import InvalidInput, NotConverged, OutOfRange
from asperity.base.arguments import Array, known
from asperity.base.diagnostics import Note, fatal_first, must_have
from asperity.io.read_friction import MeasuredFriction
from asperity.results.friction import Friction
from asperity.scene.experiment import pressures
from asperity.scene.kept import KeptBuilders
from asperity.scene.model import Scene
from asperity.scene.scene import scene_of
from asperity.scene.unknowns import Unknown, with_numbers

FAILURES = (InvalidInput, OutOfRange, NotConverged)
_MOST_KEPT = 64
_OWN = ("temperature_k", "temperature_c")


class AtPoints:
    """mu of a scene at measured points, each at its own pressure, velocity and temperature."""

    def __init__(
        self, path: Path, tables: Mapping[str, Any], measured: MeasuredFriction, where: Path
    ) -> None:
        self.path, self.tables, self.measured, self.where = path, tables, measured, where
        self._build = KeptBuilders(_MOST_KEPT)
        first = self._scene(tables, None)
        self.temperatures = np.unique([] if measured.temperature is None else measured.temperature)
        if first.others and not self.temperatures.size:
            raise must_have(
                "",
                f"temperature_k where {path} has {len(first.others) + 1} temperatures",
                "has no column of temperature",
                where=where,
            )
        self.pressure = pressures(first, measured, where)
        self.rtol = float(first.options["rtol"])

    def parts(self, tables: Mapping[str, Any]) -> list[tuple[Scene, NDArray[np.int64]]]:
        """Return a scene at each temperature, and which points are its."""
        if not self.temperatures.size:
            return [(self._scene(tables, None), np.arange(self.measured.mu.size))]
        own = self.measured.temperature
        return [(self._scene(tables, t), np.flatnonzero(own == t)) for t in self.temperatures]

    def friction(
        self, tables: Mapping[str, Any], *, gradients: bool = False
    ) -> list[tuple[Scene, NDArray[np.int64], Friction]]:
        """Return the same with friction, of flat arrays."""
        p, v = self.pressure, self.measured.velocity
        return [
            (scene, here, scene.friction_at(p[here], v[here], gradients=gradients))
            for scene, here in self.parts(tables)
        ]

    def log_mu(self, tables: Mapping[str, Any]) -> Array:
        result = np.empty(self.measured.mu.shape)
        with np.errstate(divide="ignore"):
            for _, here, found in self.friction(tables):
                result[here] = np.log(found.mu)
        return result

    def _scene(self, tables: Mapping[str, Any], temperature: float | None) -> Scene:
        given = {name: dict(table) for name, table in tables.items()}
        if temperature is not None:
            for name in ("conditions", "rubber"):
                given[name] = {k: v for k, v in given[name].items() if k not in _OWN}
            given["conditions"]["temperature_k"] = float(temperature)
        return scene_of(self.path, given, for_friction=True, builders=self._build)


class Slopes:
    """ln mu over the coordinates of unknowns, and its Jacobian: slopes of mu where they hold an
    unknown, central differences where not."""

    def __init__(self, model: AtPoints, unknowns: Sequence[Unknown], start: Array) -> None:
        self.model, self.unknowns = model, unknowns
        self._step = model.rtol ** (1 / 3)
        self._known = self._by_gradients(start)
        self.failure: Exception | None = None  # of the latest trial that had no mu

    @property
    def how(self) -> dict[str, str]:
        """Return by what each unknown has its slopes."""
        ways = ("differences", "gradients")
        return {one.key: ways[one.key in self._known] for one in self.unknowns}

    def log_mu(self, inside: Array) -> Array:
        """Return ln mu of every point; infinite where a trial is no scene."""
        try:
            return self.model.log_mu(with_numbers(self.model.tables, self.unknowns, inside))
        except FAILURES as error:
            self.failure = error
            return np.full(self.model.measured.mu.shape, np.inf)

    def jacobian(self, inside: Array) -> Array:
        """Return d ln mu, of shape (points, unknowns)."""
        result = np.full((self.model.measured.mu.size, len(self.unknowns)), np.nan)
        if self._known:
            self._take_gradients(inside, result)
        for k, one in enumerate(self.unknowns):
            if np.isnan(result[:, k]).any():
                result[:, k] = self._difference(inside, k, self._step * one.step)
        return result

    def _take_gradients(self, inside: Array, result: Array) -> None:
        """Put the slopes of mu into the columns that they hold; at an end of what a number may be
        they may be unknown."""
        tables = with_numbers(self.model.tables, self.unknowns, inside)
        with suppress(InvalidInput):
            for _, here, found in self.model.friction(tables, gradients=True):
                for k, one in enumerate(self.unknowns):
                    if one.key in self._known:
                        result[here, k] = one.slope(known(found.gradients), tables) / found.mu

    def _difference(self, inside: Array, k: int, step: float) -> Array:
        moved = np.zeros(inside.size)
        moved[k] = step
        below, above = self.log_mu(inside - moved), self.log_mu(inside + moved)
        ends = [not np.isfinite(one).all() for one in (below, above)]
        if all(ends):
            raise known(self.failure)
        if any(ends):  # the last number that a scene may have
            here = self.log_mu(inside)
            return (here - below if ends[1] else above - here) / step
        return (above - below) / (2 * step)

    def _by_gradients(self, start: Array) -> set[str]:
        """Return which unknowns the slopes of mu hold, none where the scene has no slopes."""
        if not self.unknowns:
            return set()
        tables = with_numbers(self.model.tables, self.unknowns, start)
        self.model.log_mu(tables)  # whose errors are those of the scene
        try:
            [(_, _, found), *_] = self.model.friction(tables, gradients=True)
        except InvalidInput:
            return set()
        slopes = {one.key: one.slope(found.gradients, tables) for one in self.unknowns}
        return {key for key, slope in slopes.items() if slope is not None}


_NORMAL = NormalDist().inv_cdf(0.975)


def predicted(
    model: AtPoints,
    tables: Mapping[str, Any],
    scatter: float | None,
    of_fitted: Array | None = None,
) -> dict[str, Any]:
    """Return mu at the points, its errors and interval by the names that SceneFit has for them;
    `of_fitted` is the variance of ln mu by what was fitted, in the place of that of the inputs."""
    size = model.measured.mu.size
    mu, numbers, inputs, theory = (np.full(size, np.nan) for _ in range(4))
    if of_fitted is not None:
        inputs = np.sqrt(of_fitted)
    notes: list[Note] = []
    for scene, here, result in model.friction(tables):
        mu[here] = result.mu
        with np.errstate(divide="ignore", invalid="ignore"):
            numbers[here] = result.error_estimate / result.mu
            theory[here] = result.model_error * result.hysteresis / result.mu
        notes += scene.notes_with(result.notes)
        if of_fitted is None and scene.has_errors:
            band = scene.band_at(model.pressure[here], model.measured.velocity[here])
            width = NormalDist().inv_cdf((1 + scene.sampling["level"]) / 2)
            inputs[here] = np.log(band.upper / band.lower) / (2 * width)
            notes += scene.notes_with(band.notes)
    errors = np.nan_to_num(np.array([numbers, inputs, theory]))
    away = np.exp(_NORMAL * np.sqrt((errors**2).sum(axis=0) + (scatter or 0.0) ** 2))
    return {
        **{"tables": tables, "mu": mu, "notes": fatal_first(notes)},
        **{"numbers_error": numbers, "inputs_error": inputs, "model_error": theory},
        **{"band_lower": mu / away, "band_upper": mu * away},
    }


def sentence_on(
    result: Mapping[str, Any],
    inside: int,
    scatter: float | None,
    fitted: int,
    rms: Mapping[str, float],
) -> str:
    """Return what may be published of a comparison, or of a fit of so many numbers."""
    size = result["mu"].size
    of_inputs = "fitted numbers" if fitted else "inputs"
    parts = {"numbers": "numbers_error", of_inputs: "inputs_error", "model": "model_error"}
    shown = ", ".join(f"{name} {_rms(result[error])}" for name, error in parts.items())
    which = "left out of the fit one at a time, " if fitted else ""
    numbers = "one number of it was" if fitted == 1 else f"{fitted} numbers of it were"
    how = f"{numbers if fitted else 'nothing was'} fitted to them"
    alone = "" if "adhesion" in result["tables"] else ", hysteresis alone without an [adhesion],"
    of_points = "without" if scatter is None else f"with {_share(scatter)} for"
    return (
        f"Of {size} measured friction coefficients, {which}the scene{alone} predicts each to "
        f"{_share(rms['rms_left_out'])} rms; the same mu everywhere would be off by "
        f"{_share(rms['rms_same_mu'])}; {how}. {inside} of {size} lie within the 95 % interval of "
        f"its stated errors ({shown}), {of_points} their own scatter."
    )


def _share(result: float) -> str:
    return f"{100 * result:.2g} %" if result < 1 else f"{100 * result:.0f} %"


def _rms(error: Array) -> str:
    finite = error[np.isfinite(error)]
    if not finite.size:
        return "not known"
    some = "" if finite.size == error.size else f" at {finite.size} points"
    return f"{_share(float(np.sqrt(np.mean(finite**2))))}{some}"
