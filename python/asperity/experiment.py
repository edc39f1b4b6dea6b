"""A scene held against measured friction: the adhesion that the measurement asks for."""

from collections.abc import Mapping
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from asperity._core import AdhesionFit, InvalidInput, fit_adhesion
from asperity.fields import named
from asperity.read_friction import MeasuredFriction
from asperity.scene import Curves, Progress, Scene

# arguments of Adhesion by the names that files give them
PARAMETERS = {
    "shear_stress_pa": "shear_stress",
    "reference_velocity_m_s": "reference_velocity",
    "width": "width",
}


@dataclass(frozen=True, eq=False)
class Fitted:
    """Friction with the adhesion that a measurement asks for; without, where it leaves none."""

    scene: Scene
    adhesion: AdhesionFit | None
    problem: str  # why there is none
    curves: Curves


def pressures(scene: Scene, measured: MeasuredFriction, path: Path) -> NDArray[np.float64]:
    """Of every measured point [Pa]: the file's, or the scene's only one."""
    if measured.pressure is not None:
        return measured.pressure
    if scene.pressure.size > 1:
        raise InvalidInput(
            f"{path}: has no column of pressure, {scene.path}: [conditions] pressure_pa has "
            f"{scene.pressure.size}: must be one number"
        )
    return np.full(measured.mu.shape, scene.pressure[0])


def fit_scene(
    scene: Scene,
    measured: MeasuredFriction,
    pressure: NDArray[np.float64],
    held: Mapping[str, float],
    path: Path,
    progress: Progress,
) -> Fitted:
    """The fit, and its curves at the scene's velocities and the measured pressures."""
    adhesion, problem = None, ""
    names = {"velocity": f"{path}: velocity", "mu": f"{path}: mu", "fixed": "--hold"}
    try:
        with named(None, names):
            adhesion = fit_adhesion(
                scene.spectrum,
                scene.rubber,
                velocity=measured.velocity,
                mu=measured.mu,
                pressure=pressure,
                fixed={PARAMETERS[key]: value for key, value in held.items()},
                correction=scene.correction,
                **scene.options,
            )
    except InvalidInput as error:
        problem = str(error)
    scene = replace(scene, adhesion=adhesion, pressure=np.unique(pressure))
    curves = scene.friction()
    if scene.has_errors:
        curves = replace(curves, band=scene.band(curves.mu, progress))
    return Fitted(scene, adhesion, problem, curves)


def found(adhesion: AdhesionFit) -> dict[str, float]:
    """Parameters and their standard errors, the scatter left, and how many points are aside."""
    result = {}
    for key, name in PARAMETERS.items():
        result[key] = float(getattr(adhesion, name))
        result[f"{key}_standard_error"] = adhesion.standard_errors[name]
    result["residual"] = adhesion.residual
    result["outliers"] = float(adhesion.outliers.sum())
    return result
