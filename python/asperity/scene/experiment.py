"""A scene held against measured friction: the adhesion that the measurement asks for."""

from collections.abc import Mapping
from contextlib import suppress
from dataclasses import dataclass, replace
from functools import partial
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from asperity.adhesion import Adhesion, AdhesionFit, fit_adhesion
from asperity.base.arguments import Array
from asperity.base.diagnostics import InvalidInput, NotConverged, must_have
from asperity.base.parameters import parameters
from asperity.io.fields import in_keys
from asperity.io.read_friction import MeasuredFriction
from asperity.rubber import Rubber
from asperity.scene.model import Progress, Scene, SceneFriction
from asperity.spectrum import Spectrum
from asperity.uncertainty.band import DrawAdhesion
from asperity.uncertainty.draws import Generator

# arguments of Adhesion by the names that files give them
PARAMETERS = {one.key: one.name for one in parameters(Adhesion)}
_TRIES = 20  # fits of one draw


@dataclass(frozen=True, eq=False)
class Fitted:
    """Friction with the adhesion that a measurement asks for; without, where it leaves none."""

    scene: Scene
    adhesion: AdhesionFit | None
    problem: InvalidInput | None  # why there is none
    curves: SceneFriction


def pressures(scene: Scene, measured: MeasuredFriction, path: Path) -> Array:
    """Of every measured point [Pa]: the file's, or the scene's only one."""
    if measured.pressure is not None:
        return measured.pressure
    if scene.pressure.size > 1:
        raise must_have(
            "",
            f"pressure_pa where [conditions] pressure_pa of {scene.path} has {scene.pressure.size}",
            "has no column of pressure",
            where=path,
        )
    return np.full(measured.mu.shape, scene.pressure[0])


def nearest_pressure(scene: Scene, pressure: Array) -> NDArray[np.int64]:
    """Which of the scene's pressures is nearest to each, by its ratio."""
    distance = np.abs(np.log(pressure[:, None] / scene.pressure))
    return np.asarray(distance.argmin(axis=1))


@dataclass(frozen=True, eq=False)
class Experiment:
    """A measurement, at which pressures, and which parameters are held."""

    path: Path
    measured: MeasuredFriction
    pressure: Array  # of every point [Pa]
    held: Mapping[str, float]  # by the names that files give them

    def fit(self, scene: Scene, spectrum: Spectrum, rubber: Rubber, mu: Array) -> AdhesionFit:
        """The adhesion that `mu` at the measured points asks for."""
        return fit_adhesion(
            spectrum,
            rubber,
            velocity=self.measured.velocity,
            mu=mu,
            pressure=self.pressure,
            fixed={PARAMETERS[key]: value for key, value in self.held.items()},
            correction=scene.correction,
            **scene.options,
        )

    def fit_scene(self, scene: Scene) -> tuple[AdhesionFit | None, InvalidInput | None]:
        try:
            return self.fit(scene, scene.spectrum, scene.rubber, self.measured.mu), None
        except InvalidInput as error:
            options = {one: key for key, one in PARAMETERS.items()} | {"fixed": "--hold"}
            return None, error.said(partial(in_keys, names=options)).within(self.path)

    def curves(
        self, scene: Scene, adhesion: AdhesionFit | None, progress: Progress
    ) -> SceneFriction:
        """mu at the scene's points, with a band where anything has errors. Of a drawn surface or
        rubber the points are fitted anew, with their own scatter: they hold the sum."""
        scene = replace(scene, adhesion=adhesion)
        curves = scene.friction()
        if not scene.has_errors:
            return curves
        refit = None
        if adhesion is not None and scene.has_measured_errors:
            refit = self._refit(scene, adhesion.residual)
        return curves.within(scene.band(curves.mu, progress, refit))

    def _refit(self, scene: Scene, scatter: float) -> DrawAdhesion:
        def refitted(spectrum: Spectrum, rubber: Rubber, rng: Generator) -> AdhesionFit:
            for _ in range(_TRIES):
                noise = np.exp(scatter * rng.normal(size=self.measured.mu.size))
                with suppress(InvalidInput):  # a draw that leaves a parameter open
                    return self.fit(scene, spectrum, rubber, self.measured.mu * noise)
            raise NotConverged(
                f"the points determine no adhesion on {_TRIES} draws of the surface and rubber in "
                "a row: no band",
                where=self.path,
            )

        return refitted


def found(adhesion: AdhesionFit) -> dict[str, float]:
    """Parameters and their standard errors, the scatter left, and how many points are aside."""
    result = {}
    for key, name in PARAMETERS.items():
        result[key] = float(getattr(adhesion, name))
        result[f"{key}_standard_error"] = adhesion.standard_errors[name]
    result["residual"] = adhesion.residual
    result["points"] = float(adhesion.outliers.size)
    result["outliers"] = float(adhesion.outliers.sum())
    return result
