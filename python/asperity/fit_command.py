"""The verb `fit`: the adhesion of Eq. 23 from measured friction."""

from argparse import Namespace
from collections.abc import Mapping
from dataclasses import replace
from pathlib import Path
from typing import Any

from asperity import plot_fit
from asperity._core import InvalidInput
from asperity.commands import band_progress, check_outputs, deliver, spare
from asperity.experiment import PARAMETERS, Fitted, fit_scene, found, pressures
from asperity.fields import nearest
from asperity.read_friction import read_friction
from asperity.scene import load_scene
from asperity.table import Table

_COLUMNS = ("mu", "hysteresis", "adhesion", "contact_area")


def fit(args: Namespace) -> None:
    """Fit the adhesion; beside a scene's correction also with the original theory, without it."""
    path = Path(args.measured)
    outputs = check_outputs(args)
    held = _held(args.hold or {})
    scene = load_scene(args.scene)
    spare(outputs, [*scene.sources, path])
    measured = read_friction(path)
    pressure = pressures(scene, measured, path)
    models = [scene] if scene.correction is None else [scene, replace(scene, correction=None)]
    fits = [
        fit_scene(model, measured, pressure, held, path, band_progress(model)) for model in models
    ]
    fitted, *original = fits
    if fitted.adhesion is None:
        raise InvalidInput(fitted.problem)
    table = _table(args, fitted, original, held)
    deliver(
        args,
        table,
        lambda picture: plot_fit.fit_figure(fits, measured, pressure, picture),
        found(fitted.adhesion),
    )


def _held(given: Mapping[str, str]) -> dict[str, float]:
    held = {}
    for key, text in given.items():
        if key not in PARAMETERS:
            raise InvalidInput(f"--hold {key}: {nearest(key, PARAMETERS)}")
        try:
            held[key] = float(text)
        except ValueError:
            raise InvalidInput(f"--hold {key} = {text!r}: must be a number") from None
    return held


def _table(
    args: Namespace, fitted: Fitted, original: list[Fitted], held: Mapping[str, float]
) -> Table:
    pressure, velocity = fitted.scene.points
    columns: dict[str, Any] = {"pressure_pa": pressure, "velocity_m_s": velocity}
    for fit, suffix in zip([fitted, *original], ("", "_original"), strict=False):
        columns |= {f"{name}{suffix}": getattr(fit.curves, name).ravel() for name in _COLUMNS}
        if fit.curves.band is not None:
            low, high = fit.curves.band
            columns |= {f"mu_low{suffix}": low.ravel(), f"mu_high{suffix}": high.ravel()}
    inputs: dict[str, Any] = {
        "scene": str(fitted.scene.path),
        "measured": args.measured,
        "held": dict(held),
        **{key: value for key, value in fitted.scene.inputs.items() if key != "adhesion"},
        "derived": fitted.scene.derived,
    }
    notes = list(fitted.curves.notes)
    if "adhesion" in fitted.scene.inputs:
        notes.append("the scene's [adhesion] gave way to the fitted one")
    known = set(notes)
    for fit, key in zip([fitted, *original], ("found", "found_original"), strict=False):
        said: tuple[str, ...] = (fit.problem,)
        if fit.adhesion is not None:
            inputs[key] = {**found(fit.adhesion), "covariance": fit.adhesion.covariance.tolist()}
            said = fit.adhesion.notes
        prefix = "" if fit is fitted else "without the correction: "
        notes += [prefix + note for note in said if note not in known]
    return Table("fit", [inputs], notes, {name: list(column) for name, column in columns.items()})
