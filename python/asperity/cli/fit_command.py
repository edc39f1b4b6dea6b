"""The verb `fit`: the adhesion of Eq. 23 from measured friction, or any numbers of a scene."""

from argparse import Namespace
from collections.abc import Mapping
from dataclasses import replace
from functools import partial
from typing import Any

import numpy as np

from asperity.adhesion import Adhesion
from asperity.base.arguments import FilePath
from asperity.base.diagnostics import Argument, InvalidInput, Note, must_be, refusal
from asperity.base.parameters import parameters
from asperity.cli.friction_commands import check_outputs, progress, write_outputs
from asperity.cli.options import exclusive, goes_with, typed_options
from asperity.cli.streams import print_stderr
from asperity.io import plausible
from asperity.io.fields import in_keys, nearest, rename_in_errors
from asperity.io.files import refuse_overwrite
from asperity.io.read_friction import read_friction
from asperity.io.table import Table
from asperity.plot import fit as plot_fit
from asperity.plot.fit import scene_fit_figure
from asperity.scene.experiment import (
    Experiment,
    Fitted,
    found,
    nearest_pressure,
    pressures,
)
from asperity.scene.fit import fit_scene
from asperity.scene.results import scene_inputs
from asperity.scene.scene import load_scene
from asperity.scene.scene_fit import SceneFit

_OF_POINTS = {
    "pressure_pa": "pressure",
    "velocity_m_s": "velocity",
    "temperature_k": "temperature",
    "measured": "measured",
    "mu": "mu",
    "mu_low": "band_lower",
    "mu_high": "band_upper",
    "left_out": "left_out",
    "numbers_error": "numbers_error",
    "inputs_error": "inputs_error",
    "model_error": "model_error",
}


def fit_of_scene(args: Namespace) -> None:
    """Print or write a row a point; what was found and what may be published on stderr."""
    path = FilePath(args.measured)
    outputs = check_outputs(args)
    scene = load_scene(args.scene, for_friction=True)
    refuse_overwrite(outputs, [*scene.sources, path])
    how = {"priors": dict(args.prior or []), "scatter": args.scatter}
    with rename_in_errors(None, {"free": "--free", "priors": "--prior", "scatter": "--scatter"}):
        made = fit_scene(scene, path, free=args.free or [], **how)
    inputs = {**scene_inputs(scene), "measured": args.measured, **_found(made)}
    given = {key: getattr(made, name) for key, name in _OF_POINTS.items()}
    columns = {key: _cells(column) for key, column in given.items() if column is not None}
    table = Table("fit", [inputs], made.notes, columns)
    write_outputs(args, table, lambda picture: scene_fit_figure(made, picture), _lines(made))
    print_stderr(f"{made.sentence}\n")


def _found(fit: SceneFit) -> dict[str, Any]:
    return {
        "found": {key: [fit.lower[key], fit.value[key], fit.upper[key]] for key in fit.free},
        "covariance": fit.covariance.tolist(),
        "slopes": dict(fit.slopes),
        "scatter": fit.scatter,
        **{name: getattr(fit, name) for name in ("rms", "rms_left_out", "rms_same_mu", "inside")},
        "sentence": fit.sentence,
    }


def _lines(fit: SceneFit) -> dict[str, float | None]:
    result: dict[str, float | None] = {}
    for key in fit.free:
        result |= {key: fit.value[key], f"{key}_low": fit.lower[key], f"{key}_high": fit.upper[key]}
    return result


def _cells(column: Any) -> list[Any]:
    return [x if np.isfinite(x) else "" for x in column.tolist()]


_APART = 0.2  # of ln pressure
_WARMER = 2.0  # [K] between points of one temperature
_COLUMNS = ("mu", "hysteresis", "adhesion", "contact_area")


def fit(args: Namespace) -> None:
    """Fit the adhesion, or the numbers that are named; or hold the scene against the points."""
    exclusive(args, "hold free compare")
    if args.free or args.compare:
        fit_of_scene(args)
        return
    goes_with(args, "prior scatter", "free compare")
    _fit_adhesion(args)


def _fit_adhesion(args: Namespace) -> None:
    """Fit the adhesion; beside a scene's correction also with the original theory, without it."""
    path = FilePath(args.measured)
    outputs = check_outputs(args)
    with plausible.collected(typed_options(args)) as unusual:
        held = _held(args.hold or {})
        measured = read_friction(path)
    if measured.temperature is not None and np.ptp(measured.temperature) > _WARMER:
        low, high = measured.temperature.min(), measured.temperature.max()
        result = f"has temperatures from {low:.5g} to {high:.5g} K"
        raise must_be("", "of one temperature, unless --free is given", result, where=path)
    scene = load_scene(args.scene)
    refuse_overwrite(outputs, [*scene.sources, path])
    experiment = Experiment(path, measured, pressures(scene, measured, path), held)
    models = [scene] if scene.correction is None else [scene, replace(scene, correction=None)]
    found_in = [experiment.fit_scene(model) for model in models]
    adhesion, problem = found_in[0]
    if adhesion is None:
        raise problem or AssertionError
    fits = []
    for model, (of_model, problem) in zip(models, found_in, strict=True):
        curves = experiment.curves(model, of_model, progress(f"{model.path}, band"))
        fits.append(Fitted(model, of_model, problem, curves))
    table = _table(args, experiment, fits, unusual)
    draw = partial(plot_fit.fit_figure, fits, experiment)
    write_outputs(args, table, draw, found(adhesion))


def _held(given: Mapping[str, str]) -> dict[str, float]:
    known = {one.key: one.quantity for one in parameters(Adhesion)}
    held = {}
    for key, text in given.items():
        if key not in known:
            raise InvalidInput(Argument(f"--hold {key}"), f": {nearest(key, known)}")
        try:
            held[key] = float(text)
        except ValueError:
            raise refusal(f"--hold {key}", text, "a number") from None
        if (quantity := known[key]) is not None:
            plausible.check(f"--hold {key}", held[key], quantity)
    return held


def _table(
    args: Namespace, experiment: Experiment, fits: list[Fitted], unusual: list[Note]
) -> Table:
    scene = fits[0].scene
    pressure, velocity = scene.points
    columns: dict[str, Any] = {"pressure_pa": pressure, "velocity_m_s": velocity}
    inputs: dict[str, Any] = {
        "scene": str(scene.path),
        "measured": args.measured,
        "held": dict(experiment.held),
        **{key: value for key, value in scene.inputs.items() if key != "adhesion"},
        "derived": scene.derived,
    }
    notes = [*unusual, *fits[0].curves.notes]
    if "adhesion" in scene.inputs:
        text = "the scene's [adhesion] gave way to the fitted one"
        notes.append(Note(text, code="adhesion-replaced"))
    drawn_with = scene.pressure[nearest_pressure(scene, experiment.pressure)]
    if (np.abs(np.log(experiment.pressure / drawn_with)) > _APART).any():
        text = (
            "some points were measured at pressures that the scene's do not come near: they are "
            "fitted at their own, and drawn beside the nearest"
        )
        notes.append(Note(text, code="other-pressures"))
    known = set(notes)
    for fit, suffix in zip(fits, ("", "_original"), strict=False):
        columns |= {f"{name}{suffix}": getattr(fit.curves, name).ravel() for name in _COLUMNS}
        if fit.curves.band is not None:
            low, high = fit.curves.band
            columns |= {f"mu_low{suffix}": low.ravel(), f"mu_high{suffix}": high.ravel()}
        said = [] if fit.problem is None else [Note(f"{fit.problem}", code="no-adhesion")]
        if fit.adhesion is not None:
            inputs[f"found{suffix}"] = {
                **found(fit.adhesion),
                "covariance": fit.adhesion.covariance.tolist(),
                "outlier_rows": (np.flatnonzero(fit.adhesion.outliers) + 1).tolist(),
            }
            said = [*fit.adhesion.notes]
        named = partial(in_keys, names={"outliers": "outlier_rows"})
        new = [note.said(named) for note in said if note not in known]
        notes += [note.within("without the correction: ") for note in new] if suffix else new
    return Table("fit", [inputs], notes, columns)
