"""How far mu may be off, in words: by the numbers, by the inputs, by the model."""

from typing import NamedTuple

import numpy as np

from asperity.report.texts import percent_text
from asperity.scan_contact import COLUMNS, ScanContact
from asperity.scene.model import Scene, SceneFriction

_POINTS = [[*COLUMNS].index(name) for name in ("points_y", "points_x")]
_PARTS = {
    "between them": "interpolation",
    "by their points": "pixels",
    "by having one scan": "scan",
}


class Told(NamedTuple):
    name: str
    size: str
    meaning: str


def errors_of(scene: Scene, result: SceneFriction) -> list[Told]:
    """The three errors of a result, each with its largest size on the curve."""
    return [_numerical(scene, result), _of_inputs(scene, result), _of_model(scene, result)]


def _numerical(scene: Scene, result: SceneFriction) -> Told:
    mu = result.mu
    share = np.divide(result.error_estimate, mu, out=np.zeros_like(mu), where=mu > 0)
    rtol = scene.inputs["solver"]["rtol"]
    size = f"at most {float(share.max()):.2g} of mu"
    return Told("the numbers", size, f"estimated by the solver, which was asked for {rtol:.2g}")


def _of_inputs(scene: Scene, result: SceneFriction) -> Told:
    if result.band is None:
        problem = "neither the surface nor the rubber has standard errors"
        meaning = f"{problem}: they are known of scans and of isotherms"
        return Told("the inputs", "not known", meaning)
    low, high = result.band
    known = result.mu > 0
    down = 100 * (1 - low[known] / result.mu[known]).max(initial=0)
    up = 100 * (high[known] / result.mu[known] - 1).max(initial=0)
    sampling = scene.sampling
    size = f"mu is down to {percent_text(down)} lower and up to {percent_text(up)} higher"
    meaning = "by the slopes of mu and the standard errors of the inputs"
    if sampling["method"] != "linear":
        draws = f"of {sampling['samples']} draws of the measured inputs"
        meaning = f"{draws} within their standard errors (seed {sampling['seed']})"
    return Told("the inputs", size, f"{100 * sampling['level']:.4g} % {meaning}")


def solved_contacts(scene: Scene) -> tuple[int, str] | None:
    """How many contacts of the scan are solved, and the points of the largest; None without."""
    if not isinstance(scene.correction, ScanContact):
        return None
    rows = scene.correction.contacts.rows
    ny, nx = max((row[_POINTS] for row in rows), key=np.prod)
    return len(rows), f"{ny:.0f} x {nx:.0f} points"


def _of_model(scene: Scene, result: SceneFriction) -> Told:
    off = result.model_error
    known = np.isfinite(off)
    if not known.any():
        return Told("the model", "not known", "no exact sliding contacts are like this one")
    low, high = 100 * float(off[known].min()), 100 * float(off[known].max())
    least, most = percent_text(low), percent_text(high)
    spread = most if least == most else f"{least.removesuffix(' %')} to {most}"
    size = f"{spread} of the hysteresis"
    if not known.all():
        size += f"; not known at {int((~known).sum())} of {known.size} points"
    if not isinstance(scene.correction, ScanContact):
        return Told("the model", size, "seen in exact sliding contacts of the same regime")
    rows = scene.correction.contacts.rows
    columns = {said: rows[:, [*COLUMNS].index(name)] for said, name in _PARTS.items()}
    worst = {said: np.max(x, where=np.isfinite(x), initial=0) for said, x in columns.items()}
    parts = ", ".join(f"{said} {percent_text(100 * float(x))}" for said, x in worst.items())
    return Told("the model", size, f"of {len(rows)} exact contacts of the scan, at most: {parts}")
