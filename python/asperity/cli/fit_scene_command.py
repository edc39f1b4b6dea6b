"""The verb `fit` with --free or --compare: numbers of a scene, or the scene as it is, by points."""

from argparse import Namespace
from typing import Any

import numpy as np

from asperity._core import InvalidInput
from asperity.base.arguments import FilePath
from asperity.base.diagnostics import Argument, Sentence
from asperity.cli.friction_commands import check_outputs, refuse_overwrite, write_outputs
from asperity.cli.streams import print_stderr
from asperity.io.table import Table
from asperity.plot.fit import scene_fit_figure
from asperity.scene.fit import fit_scene
from asperity.scene.results import scene_inputs
from asperity.scene.scene import load_scene
from asperity.scene.scene_fit import SceneFit

_COLUMNS = {
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
    try:
        made = fit_scene(
            scene,
            path,
            free=args.free or [],
            priors=dict(args.prior or []),
            scatter=args.scatter,
        )
    except InvalidInput as error:
        raise error.said(_in_options) from error
    inputs = {**scene_inputs(scene), "measured": args.measured, **_found(made)}
    given = {key: getattr(made, name) for key, name in _COLUMNS.items()}
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


def _in_options(sentence: Sentence) -> Sentence:
    """Python's arguments as the options of the command line."""
    names = {"free": "--free", "priors": "--prior", "scatter": "--scatter"}
    said: list[str] = []
    for phrase in sentence:
        if isinstance(phrase, Argument):
            name, mark, key = phrase.partition(": ")
            option = names.get(name, name)
            phrase = phrase.saying(f"{option} {key}" if mark and option != name else option)
        said.append(phrase)
    return tuple(said)
