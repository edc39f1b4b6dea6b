"""What is computed of a scene for the page, beside its curves."""

from contextlib import nullcontext
from dataclasses import replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from asperity.friction import friction
from asperity.scene.mapped import rubber_of_map
from asperity.scene.model import Progress, Scene, SceneFriction


def without_heat(scene: Scene) -> Scene:
    """The scene as it slides cold: what is shown first."""
    return replace(scene, heating=None)


def with_band(
    scene: Scene, curves: SceneFriction, progress: Progress = nullcontext
) -> SceneFriction:
    """The curves with the band of the measured inputs, where their errors are known."""
    return curves.within(scene.band(curves.mu, progress)) if scene.has_errors else curves


def contributions(scene: Scene, velocity: float) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Wavenumbers [1/m], and dmu / d ln q there, at the first pressure and one velocity [m/s]."""
    result = friction(
        scene.spectrum,
        rubber_of_map(scene),
        pressure=scene.pressure[0],
        velocity=velocity,
        correction=scene.correction,
        adhesion=scene.adhesion,
        contributions=True,
        **scene.options,
        **({} if scene.heating is None else _heat(scene)),
    )
    assert result.wavenumber is not None
    assert result.dmu_dlnq is not None
    return result.wavenumber, result.dmu_dlnq


def _heat(scene: Scene) -> dict[str, Any]:
    shift = scene.built_rubber.shift
    return {"temperature": scene.temperature, "shift": shift, "heating": scene.heating}
