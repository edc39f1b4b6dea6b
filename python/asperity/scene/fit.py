"""Numbers of a scene from measured friction by least squares; with none free, a comparison."""

import os
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from asperity._core import InvalidInput, NotConverged
from asperity.base.arguments import Array, frozen, number, path_of
from asperity.base.diagnostics import Argument, Note, fatal_first, must_have, refusal
from asperity.base.table import imported
from asperity.io.read_friction import MeasuredFriction, measured_friction
from asperity.scene.at_points import AtPoints, Slopes, predicted, sentence_on
from asperity.scene.model import Scene
from asperity.scene.scene import check_tables, read_tables
from asperity.scene.scene_fit import SceneFit
from asperity.scene.unknowns import Unknown, unknowns_of, with_numbers

_SAME = 1e-4  # least singular value of normed slopes: below it their own errors show
_UNKNOWN = 1.0  # standard error of a logarithm, or of a coordinate in its step: a factor e
_ALIKE = 0.9  # correlation
_TOGETHER = 0.3  # component of a direction that the points do not know
_PULL = 0.01  # cosine of residuals and a slope at a minimum
_TURNS = 30  # of fits and scatter


@dataclass(frozen=True)
class _Solution:
    """Where the sum of squares is least."""

    inside: Array  # coordinates
    residual: Array  # ln mu - ln measured
    jacobian: Array  # of the residual
    prior: Array  # slopes of the priors over their deviations, 0 without


def fit_scene(
    scene: str | os.PathLike[str] | Mapping[str, Any] | Scene,
    measured: str | os.PathLike[str] | Mapping[str, Any],
    *,
    free: Sequence[str] = (),
    priors: Mapping[str, Any] | None = None,
    scatter: float | None = None,
) -> SceneFit:
    """Fit numbers of a scene to measured friction, or hold the scene against it.

    The sum of squares of ln(mu / measured), over the scatter of the points, and of the distances
    from the priors is made least by SciPy's trust region (`scipy.optimize.least_squares`), from the
    numbers that the scene has. Slopes are those of mu where it has them (adhesion, the law of a
    surface, a Prony series, the temperature), and central differences for all other numbers. A
    repeated measurement counts as a point of its own.

    Parameters
    ----------
    scene : path-like, dict or Scene
        A file, its tables, or what `read_scene` returned. Pressures and velocities are those of the
        points.
    measured : path-like or dict
        A file with columns ``mu``, ``velocity_m_s`` and perhaps ``pressure_pa`` and
        ``temperature_k`` (or as ``velocity_km_h``, ``pressure_kpa``, ``temperature_c`` ...), or
        arrays "mu" [-], "velocity" [m/s], "pressure" [Pa], "temperature" [K]. Without pressures
        those of the scene hold, without temperatures so do its.
    free : list of str
        Keys of the unknown numbers: "adhesion.shear_stress_pa", "surface.q1_per_m",
        "rubber.moduli_pa[2]". Temperatures and angles are fitted as they are, all others in their
        logarithm. Without any the scene is compared as it is.
    priors : dict, optional
        What is known before: (value, standard deviation), or (value, relative standard deviation,
        "ln").
    scatter : float, optional
        Relative standard deviation of the points. By default that about the fit, over the points
        less the numbers that they settle.

    Returns
    -------
    SceneFit

    Raises
    ------
    InvalidInput
        A key that is no number of the scene; too few points; numbers that the points do not settle
        (`code` "undetermined"): mu does not change with them, only a combination of them counts, or
        a standard error is above a factor of e (100 K, 60 degrees). The message names them. Hold
        one, or give it a prior.
    NotConverged
    ImportError
        With free numbers, without SciPy.

    Examples
    --------
    >>> fit = fit_scene(  # doctest: +SKIP
    ...     "scene.toml", "measured.csv", free=["adhesion.shear_stress_pa", "surface.q1_per_m"]
    ... )
    >>> print(fit.value, fit.sentence)  # doctest: +SKIP
    """
    path, tables = _tables_of(scene)
    points, where = measured_friction(measured)
    model = AtPoints(path, tables, points, where)
    if priors is not None and not isinstance(priors, Mapping):
        raise refusal("priors", priors, "a dict")
    hot = points.temperature is not None
    unknowns = unknowns_of(path, tables, free, priors or {}, hot=hot)
    if scatter is not None and not 0 < number(scatter, "scatter") < np.inf:
        raise refusal("scatter", scatter, "positive and finite")
    if not unknowns:
        prediction = predicted(model, tables, scatter)
        return _result(model, prediction, [], np.zeros((0, 0)), {}, scatter, None)
    _check_count(points, unknowns, where, given=scatter is not None)
    start = np.array([one.inside(one.start) for one in unknowns])
    slopes = Slopes(model, unknowns, start)
    solution, noise = _with_scatter(slopes, start, scatter)
    covariance = _covariance(slopes, solution, noise)
    left_out = _left_out(slopes, solution, noise, covariance)
    prediction = predicted(
        model,
        with_numbers(tables, unknowns, solution.inside),
        noise,
        np.einsum("ik,kl,il->i", solution.jacobian, covariance, solution.jacobian),
    )
    numbers = _numbers(unknowns, solution.inside, covariance, _spare(solution, noise))
    return _result(
        model, prediction, unknowns, covariance, {**numbers, "slopes": slopes.how}, noise, left_out
    )


def _tables_of(scene: Any) -> tuple[Path, Mapping[str, Any]]:
    if isinstance(scene, Scene):
        return scene.path, scene.tables
    if isinstance(scene, Mapping):
        path = Path("scene")
        if not all(isinstance(table, Mapping) for table in scene.values()):
            raise refusal("scene", scene, "the path of a scene, or its tables")
        check_tables(path, scene)
        return path, scene
    path = path_of(scene, "scene")
    return path, read_tables(path)


def _check_count(
    points: MeasuredFriction, unknowns: Sequence[Unknown], where: Path, *, given: bool
) -> None:
    without = sum(one.prior is None for one in unknowns)
    needed = without + (not given)
    if points.mu.size < needed:
        raise must_have(
            "",
            f"{needed} or more to fit {without} numbers without a prior",
            f"has {points.mu.size} points",
            where=where,
        )


def _with_scatter(slopes: Slopes, start: Array, given: float | None) -> tuple[_Solution, float]:
    """Return the solution that goes with the scatter, and the scatter that goes with it."""
    noise = 0.05 if given is None else given
    with_priors = any(one.prior is not None for one in slopes.unknowns)
    for _ in range(_TURNS):
        solution = _solved(slopes, start, noise)
        if given is not None:
            return solution, noise
        spare = _spare(solution, noise)
        before, rest = noise, float(solution.residual @ solution.residual)
        noise = max(np.sqrt(rest / max(spare, 1e-3)), slopes.model.rtol)
        if not with_priors or abs(np.log(noise / before)) < 1e-3:
            return solution, noise
        start = solution.inside
    raise NotConverged(f"the scatter of the points is not settled in {_TURNS} fits")


def _spare(solution: _Solution, noise: float) -> float:
    """Return how many points there are more than numbers that they settle, not their priors."""
    told = solution.jacobian.T @ solution.jacobian / noise**2
    known = told + np.diag(solution.prior**2)
    return float(solution.residual.size - np.trace(np.linalg.pinv(known) @ told))


def _solved(
    slopes: Slopes, start: Array, noise: float, without: int | None = None, rtol: float = 1e-10
) -> _Solution:
    least_squares = imported("scipy.optimize", "fit").least_squares
    unknowns, log_measured = slopes.unknowns, np.log(slopes.model.measured.mu)
    weight = np.full(log_measured.size, 1 / noise)
    if without is not None:
        weight[without] = 0

    def priors(inside: Array) -> Array:
        pairs = [one.off_prior(at) for one, at in zip(unknowns, inside.tolist(), strict=True)]
        return np.array(pairs).T

    trials: list[Exception] = []  # those that had no mu

    def off(inside: Array) -> Array:
        log_mu = slopes.log_mu(inside)
        if not np.isfinite(log_mu).all():
            trials.extend([slopes.failure] if slopes.failure else [])
            return np.full(log_mu.size + len(unknowns), np.inf)
        return np.append((log_mu - log_measured) * weight, priors(inside)[0])

    def slope(inside: Array) -> Array:
        return np.vstack([slopes.jacobian(inside) * weight[:, None], np.diag(priors(inside)[1])])

    found = least_squares(off, start, slope, x_scale="jac", ftol=rtol, xtol=rtol, gtol=rtol)
    n = log_measured.size
    solution = _Solution(found.x, found.fun[:n] * noise, found.jac[:n] * noise, priors(found.x)[1])
    if without is None and trials:
        _check_pull(slopes, found, trials[-1])
    if found.status == 0:
        _covariance(slopes, solution, noise)  # which knows why
        raise NotConverged(f"the fit is not settled in {found.nfev} trials")
    return solution


def _check_pull(slopes: Slopes, found: Any, failure: Exception) -> None:
    """Refuse a fit that ended where a number may not go on."""
    norms = np.linalg.norm(found.jac, axis=0) * np.linalg.norm(found.fun)
    pull = np.abs(found.grad) / np.where(norms > 0, norms, 1)
    worst = int(np.argmax(pull))
    if pull[worst] > _PULL:
        one = slopes.unknowns[worst]
        value = one.value(float(found.x[worst]))
        raise InvalidInput(
            Argument(f"free: {one.key}"),
            f": is drawn to {value:.4g} and beyond it, where ",
            f"{failure}; hold it, or give it a prior",
            code="undetermined",
        )


def _covariance(slopes: Slopes, solution: _Solution, noise: float) -> Array:
    """Return that of the coordinates; refuse numbers that points and priors do not settle."""
    unknowns, where = slopes.unknowns, slopes.model.where
    rows = np.vstack([solution.jacobian / noise, np.diag(solution.prior)])
    step = np.array([one.step for one in unknowns])
    norms = np.linalg.norm(rows, axis=0)
    told = np.linalg.norm(solution.jacobian, axis=0) * step / np.sqrt(len(solution.jacobian))
    keys = np.array([one.key for one in unknowns])
    deaf = (told < _SAME) & (solution.prior == 0)
    if deaf.any():
        _refuse(keys[deaf], ": mu does not change", where)
    _, sizes, directions = np.linalg.svd(rows / norms)
    if sizes[-1] < _SAME * sizes[0]:
        share = np.abs(directions[-1])
        _refuse(keys[share > _TOGETHER * share.max()], ": mu knows their combination alone", where)
    covariance: Array = ((directions.T / sizes**2) @ directions) / np.outer(norms, norms)
    error = np.sqrt(np.diag(covariance))
    wide = error > _UNKNOWN * step
    if wide.any():
        k = int(np.argmax(error / step))
        alike = np.abs(covariance[k] / error / error[k]) > _ALIKE
        alike[k] = False
        more = f", alike in mu to {' and '.join(keys[alike])}" if alike.any() else ""
        size = f"a factor of {np.exp(error[k]):.2g}" if step[k] == 1 else f"{error[k]:.2g}"
        wide[k] = False
        which = "the first has" if wide.any() else "it has"
        text = f": {which} a standard error of {size}{more}"
        _refuse([keys[k], *keys[wide]], text, where)
    return covariance


def _refuse(keys: Iterable[str], why: str, where: Path) -> None:
    raise InvalidInput(
        "the points do not settle ",
        Argument(", ".join(keys)),
        why,
        "; hold one of them, give it a prior, or measure where they differ",
        code="undetermined",
        where=where,
    )


def _left_out(slopes: Slopes, solution: _Solution, noise: float, covariance: Array) -> Array:
    log_measured = np.log(slopes.model.measured.mu)
    result = np.empty(log_measured.size)
    for i, row in enumerate(solution.jacobian):
        share = row @ covariance @ row / noise**2
        toward = covariance @ row * (solution.residual[i] / noise**2) / max(1 - share, 1e-6)
        start = solution.inside + toward
        if not np.isfinite(slopes.log_mu(start)).all():
            start = solution.inside
        found = _solved(slopes, start, noise, i, 1e-5)
        result[i] = np.exp(slopes.log_mu(found.inside)[i])
    return result


def _numbers(
    unknowns: Sequence[Unknown], inside: Array, covariance: Array, spare: float
) -> dict[str, Any]:
    """Return values and the ends of their intervals, by Student's t."""
    quantile = imported("scipy.special", "fit").stdtrit(max(spare, 1.0), 0.975)
    away = quantile * np.sqrt(np.diag(covariance))
    ends = {"value": inside, "lower": inside - away, "upper": inside + away}
    return {
        name: {one.key: one.value(float(x)) for one, x in zip(unknowns, at, strict=True)}
        for name, at in ends.items()
    }


def _result(
    model: AtPoints,
    prediction: dict[str, Any],
    unknowns: Sequence[Unknown],
    covariance: Array,
    numbers: dict[str, Any],
    scatter: float | None,
    left_out: Array | None,
) -> SceneFit:
    points, log_measured = model.measured, np.log(model.measured.mu)
    off = log_measured - np.log(prediction["mu"])
    n = off.size
    distances = {
        "rms": off,
        "rms_left_out": off if left_out is None else log_measured - np.log(left_out),
        "rms_same_mu": (log_measured - log_measured.mean()) * (n / max(n - 1, 1)),
    }
    rms: dict[str, Any] = {name: float(np.sqrt(np.mean(x**2))) for name, x in distances.items()}
    inside = (points.mu >= prediction["band_lower"]) & (points.mu <= prediction["band_upper"])
    notes = prediction.pop("notes")
    if rms["rms_left_out"] >= rms["rms_same_mu"]:
        notes.append(_no_better(rms["rms_left_out"], rms["rms_same_mu"]))
    for k, one in enumerate(unknowns):
        prior = one.off_prior(one.inside(numbers["value"][one.key]))[1]
        if prior and np.sqrt(covariance[k, k]) * prior > 0.9:
            notes.append(Note(Argument(one.key), ": stays its prior", code="prior-stays"))
    of_fit = {"value": {}, "lower": {}, "upper": {}, "slopes": {}, **numbers}
    return SceneFit(
        free=tuple(one.key for one in unknowns),
        **of_fit,
        covariance=covariance,
        pressure=frozen(model.pressure),
        velocity=frozen(points.velocity),
        temperature=None if points.temperature is None else frozen(points.temperature),
        measured=frozen(points.mu),
        left_out=left_out,
        **prediction,
        scatter=None if scatter is None else float(scatter),
        **rms,
        inside=float(inside.mean()),
        sentence=sentence_on(prediction, int(inside.sum()), scatter, len(unknowns), rms),
        notes=tuple(fatal_first(notes)),
    )


def _no_better(of_scene: float, of_mean: float) -> Note:
    text = (
        f"the scene predicts mu to {100 * of_scene:.2g} % rms, the same mu everywhere to "
        f"{100 * of_mean:.2g} %: it tells these points nothing"
    )
    return Note(text, code="no-better-than-mean")
