"""A scene at measured points, for numbers of it that change: mu, and its slopes over them."""

import json
from collections.abc import Callable, Mapping, Sequence
from contextlib import suppress
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from asperity._core import InvalidInput, NotConverged, OutOfRange
from asperity.base.diagnostics import must_have
from asperity.io import plausible
from asperity.io.read_friction import MeasuredFriction
from asperity.results.friction import Friction
from asperity.scene.experiment import pressures
from asperity.scene.model import Scene
from asperity.scene.parts import build_correction
from asperity.scene.rubber import BuiltRubber, build_rubber
from asperity.scene.scene import Builders, scene_of
from asperity.scene.surface import READ, Surface, build_surface, read_scans
from asperity.scene.unknowns import Unknown, with_numbers

Array = NDArray[np.float64]
FAILURES = (InvalidInput, OutOfRange, NotConverged)
_MOST_KEPT = 64
_OWN = ("temperature_k", "temperature_c")


class _Kept:
    """Builders of the parts of a scene that keep what they built lately, with its notes."""

    def __init__(self) -> None:
        self._made: dict[Any, Any] = {}

    def builders(self) -> Builders:
        return Builders(self._surface, self._rubber, self._correction)

    def _surface(self, path: Path, table: object) -> Surface:
        build = partial(build_surface, path, table, self._read)
        made: Surface = self._get(("surface", _text(table)), build)
        return made

    def _read(self, path: Path, values: dict[str, Any], every: bool) -> Any:
        which = {key: values[key] for key in READ if key in values}
        key = ("scans", _text(which), every)
        return self._get(key, lambda: read_scans(path, values, every))

    def _rubber(self, path: Path, table: object, at: float | None) -> BuiltRubber:
        key = ("rubber", _text(table), at)
        made: BuiltRubber = self._get(key, lambda: build_rubber(path, table, at))
        return made

    def _correction(self, path: Path, table: object, spectrum: Any, *scan: Any) -> Any:
        key = ("correction", _text(table), id(spectrum))
        build = lambda: (build_correction(path, table, spectrum, *scan), spectrum)  # noqa: E731
        return self._get(key, build)[0]

    def _get(self, key: Any, build: Callable[[], Any]) -> Any:
        if key not in self._made:
            with plausible.collected() as notes:
                made = build()
            while len(self._made) >= _MOST_KEPT:
                self._made.pop(next(iter(self._made)))
            self._made[key] = made, notes
        made, notes = self._made[key] = self._made.pop(key)  # now the latest
        plausible.tell_again(notes)
        return made


def _text(table: object) -> str:
    return json.dumps(table, sort_keys=True, default=str)


class AtPoints:
    """mu of a scene at measured points, each at its own pressure, velocity and temperature."""

    def __init__(
        self, path: Path, tables: Mapping[str, Any], measured: MeasuredFriction, where: Path
    ) -> None:
        self.path, self.tables, self.measured, self.where = path, tables, measured, where
        self._build = _Kept().builders()
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
        """Return ln mu of every point."""
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
        known = ("differences", "gradients")
        return {one.key: known[one.key in self._known] for one in self.unknowns}

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
                assert found.gradients is not None
                for k, one in enumerate(self.unknowns):
                    if one.key in self._known:
                        result[here, k] = one.slope(found.gradients, tables) / found.mu

    def _difference(self, inside: Array, k: int, step: float) -> Array:
        moved = np.zeros(inside.size)
        moved[k] = step
        below, above = self.log_mu(inside - moved), self.log_mu(inside + moved)
        ends = [not np.isfinite(one).all() for one in (below, above)]
        if all(ends):
            assert self.failure is not None
            raise self.failure
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
