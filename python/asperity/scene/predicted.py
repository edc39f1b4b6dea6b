"""mu of a scene at measured points with its three errors, and what may be published of it."""

from collections.abc import Mapping
from dataclasses import dataclass
from statistics import NormalDist
from typing import Any

import numpy as np

from asperity.base.diagnostics import Note, fatal_first
from asperity.scene.at_points import Array, AtPoints

_NORMAL = NormalDist().inv_cdf(0.975)


@dataclass(frozen=True)
class Prediction:
    """mu at the points [-], its relative standard errors, NaN where one is unknown, and the 95 %
    interval on measured points by those that are known and by their scatter, if that is."""

    tables: Mapping[str, Any]
    mu: Array
    numbers: Array
    inputs: Array
    model: Array
    lower: Array
    upper: Array
    notes: list[Note]


def predicted(
    model: AtPoints,
    tables: Mapping[str, Any],
    scatter: float | None,
    of_fitted: Array | None = None,
) -> Prediction:
    """Return the prediction; `of_fitted` is the variance of ln mu by what was fitted, which takes
    the place of that of the inputs."""
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
    known = np.nan_to_num(np.array([numbers, inputs, theory]))
    away = np.exp(_NORMAL * np.sqrt((known**2).sum(axis=0) + (scatter or 0.0) ** 2))
    return Prediction(tables, mu, numbers, inputs, theory, mu / away, mu * away, fatal_first(notes))


def sentence_on(
    result: Prediction,
    inside: int,
    scatter: float | None,
    fitted: int,
    rms_left_out: float,
    rms_same_mu: float,
) -> str:
    """Return what may be published of a comparison, or of a fit of so many numbers."""
    size = result.mu.size
    parts = ("numbers", result.numbers), ("inputs", result.inputs), ("model", result.model)
    shown = [f"{name} {_rms(error)}" for name, error in parts]
    if fitted:
        shown[1] = shown[1].replace("inputs", "fitted numbers")
    which = "left out of the fit one at a time, " if fitted else ""
    numbers = "one number of it was" if fitted == 1 else f"{fitted} numbers of it were"
    how = f"{numbers if fitted else 'nothing was'} fitted to them"
    alone = "" if "adhesion" in result.tables else ", hysteresis alone without an [adhesion],"
    of_points = "without" if scatter is None else f"with {_share(scatter)} for"
    return (
        f"Of {size} measured friction coefficients, {which}the scene{alone} predicts each to "
        f"{_share(rms_left_out)} rms; the same mu everywhere would be off by "
        f"{_share(rms_same_mu)}; {how}. {inside} of {size} lie within the 95 % interval of its "
        f"stated errors ({', '.join(shown)}), {of_points} their own scatter."
    )


def _share(result: float) -> str:
    return f"{100 * result:.2g} %" if result < 1 else f"{100 * result:.0f} %"


def _rms(error: Array) -> str:
    known = error[np.isfinite(error)]
    if not known.size:
        return "not known"
    some = "" if known.size == error.size else f" at {known.size} points"
    return f"{_share(float(np.sqrt(np.mean(known**2))))}{some}"
