"""A band on mu from slopes of mu and covariances of the inputs, to first order, and whether that is
good enough."""

from collections.abc import Callable
from dataclasses import dataclass
from functools import partial
from statistics import NormalDist
from typing import Any

import numpy as np

from asperity.adhesion import Adhesion, AdhesionFit
from asperity.base.arguments import Array, known
from asperity.base.diagnostics import MUST_BE, Argument, InvalidInput, Note, valued
from asperity.dma import MasterCurveBuild, master_curve_modes
from asperity.friction import Friction, friction
from asperity.rubber import MasterCurve, Rubber
from asperity.scan_contact import ScanContact
from asperity.self_affine_fit import AnySpectrum, SelfAffineFit
from asperity.spectrum import SelfAffineSpectrum, Spectrum, TabulatedSpectrum
from asperity.uncertainty.draws import (
    Inputs,
    adhesion_covariance,
    fit_covariance,
    moved_adhesion,
    moved_fit,
    row_covariance,
    rows_like,
)

MOST_CURVED = 0.5  # standard deviations by which signs of all modes may be off the slopes
_LEAST = 1e-4  # of ln mu: rtol of bands


@dataclass(frozen=True)
class _Input:
    """An input: what unit normals change in it, how mu goes with that, and the input so changed."""

    modes: Array  # (modes, coordinates)
    slopes: Callable[[Friction], Array]  # (points, coordinates)
    moved: Callable[[Array], Any]


def linear_band(
    inputs: Inputs, level: float, *, refitted: bool
) -> tuple[Array, Array, tuple[Note, ...]]:
    """Return both ends of a band over mu at flat points, one temperature after another, and where
    slopes are not good enough. A build is taken at its reference, or at the temperatures."""
    spectrum, rubber, _, options = inputs
    named = Argument("method"), " = ", valued("linear", '"linear"'), MUST_BE
    if refitted:
        raise InvalidInput(*named, '"draws" where each draw is fitted anew')
    if rubber.draw is not None and rubber.source is None:
        raise InvalidInput(*named, '"draws" with a Prony fit of isotherms, or a vertical shift')
    of_scan = isinstance(options.get("correction"), ScanContact)
    for name in ("correction" * of_scan, "heating", "strain_factors"):
        if name and (one := options.get(name)) is not None:
            text = f': {type(one).__name__} has no linear band, take method="draws"'
            raise InvalidInput(Argument(name), text)
    if spectrum.plain.is_directional:
        text = ': knows directions, whose errors have no linear band, take method="draws"'
        raise InvalidInput(Argument("spectrum"), text)
    names = ("poisson_ratio", "correction", "form")
    kept = {name: options[name] for name in names if name in options}
    size = np.size(options["pressure"])
    places = [name for name in ("pressure", "velocity", "temperature") if name in options]
    at = {name: np.broadcast_to(options[name], size) for name in places}
    kelvin = at.get("temperature", np.zeros(size))
    deviation, curved = np.empty(size), np.empty(size)
    for t in np.unique(kelvin):
        here = np.flatnonzero(kelvin == t)
        points: dict[str, Any] = {name: column[here] for name, column in at.items()}
        at_points = inputs._replace(options={**kept, **points, "rtol": 1e-4})
        deviation[here], curved[here] = _deviation(at_points)
    away = np.exp(NormalDist().inv_cdf((1 + level) / 2) * deviation)
    return 1 / away, away, _curvature_notes(curved)


def _deviation(inputs: Inputs) -> tuple[Array, Array]:
    """Return the standard deviation of ln mu at points of one temperature, and by how many of it mu
    leaves the slopes where every mode is at one of its own, with signs at random and opposite."""
    spectrum, solid, adhesion, options = inputs
    inputs_of: dict[str, _Input] = {}
    build, shift = solid.source, solid.plain.shift
    options = {**options, "shift": shift}
    plain: dict[str, Any] = {
        "spectrum": spectrum.plain,
        "rubber": solid.plain.rubber,
        "adhesion": adhesion,
    }
    result = friction(**plain, gradients=True, **options)
    if (surface := _surface(spectrum.source, spectrum.plain)) is not None:
        inputs_of["spectrum"] = surface
    if build is not None:
        own = options["temperature"][0] if shift is build else None
        inputs_of["rubber"] = _rubber(build, result, adhesion, own)
    if isinstance(adhesion, AdhesionFit):
        inputs_of["adhesion"] = _adhesion(adhesion)
    mu = np.where(result.mu > 0, result.mu, 1.0)[:, None]
    parts = {name: one.slopes(result) @ one.modes.T / mu for name, one in inputs_of.items()}
    deviation = np.sqrt(sum((of**2).sum(axis=1) for of in parts.values()))
    rng = np.random.default_rng(0)
    signs = {name: rng.choice([-1.0, 1.0], len(one.modes)) for name, one in inputs_of.items()}
    toward = sum(of @ signs[name] for name, of in parts.items())
    off = []
    for way in (1, -1):
        moved = {name: one.moved(way * signs[name] @ one.modes) for name, one in inputs_of.items()}
        with np.errstate(divide="ignore", invalid="ignore"):
            change = np.log(friction(**{**plain, **moved}, **options).mu / result.mu)
        off.append(change - way * toward)
    curved = np.abs(off).max(axis=0) / (deviation + _LEAST)
    return deviation, np.where(result.mu > 0, curved, 0.0)


def _curvature_notes(curved: Array) -> tuple[Note, ...]:
    wrong = np.flatnonzero(curved > MOST_CURVED)
    if not wrong.size:
        return ()
    text = (
        f"mu is no linear function of the inputs within their errors at {wrong.size} of "
        f"{curved.size} points: up to {curved.max():.2g} standard deviations off its slopes"
    )
    return (Note(text, code="linear-band-off"),)


def _surface(source: AnySpectrum | None, plain: Spectrum) -> _Input | None:
    if isinstance(source, SelfAffineFit):
        return _law(source, plain)
    if not isinstance(plain, TabulatedSpectrum) or plain.standard_error is None:
        return None
    table, weight = plain, _weights(plain.wavenumber)
    return _Input(
        _root(row_covariance(table)),
        lambda result: known(result.gradients).spectrum * weight,
        lambda by: rows_like(table, table.density * np.exp(by)),
    )


def _law(fit: SelfAffineFit, plain: Spectrum) -> _Input:
    """The fitted law, and the rms height of its band: mu may be of another band."""

    def moved(by: Array) -> SelfAffineSpectrum:
        return moved_fit(fit, by).extended(q0=plain.q0, q1=plain.q1)

    def height(by: Array) -> float:
        return float(np.log(moved(by).rms_height / plain.rms_height))

    covariance = fit_covariance(fit)
    step = 1e-4 * np.eye(len(covariance))
    of_height = np.array([(height(one) - height(-one)) / 2e-4 for one in step])

    def slopes(result: Friction) -> Array:
        of = known(result.gradients)
        beside = [0 * of.hurst, of.hurst / fit.hurst, *([of.rolloff] if fit.rolloff else [])]
        both: Array = of.rms_height[:, None] * of_height + np.stack(beside, axis=-1)
        return both

    return _Input(_root(covariance), slopes, moved)


def _rubber(
    build: MasterCurveBuild,
    result: Friction,
    adhesion: Adhesion | None,
    temperature: float | None,
) -> _Input:
    """ln E' and ln E'' at the rows of the slopes, and ln a_T at the temperature."""
    curve, w = build.master_curve, known(result.gradients).angular_frequency
    storage, loss, decades = master_curve_modes(build, w)
    shift = np.zeros((len(storage), 1))
    if temperature is not None:  # between isotherms about as their neighbours
        shift[:, 0] = [np.interp(temperature, build.temperature, row) for row in decades]
        shift *= np.log(10)
    weight = _weights(w)

    def slopes(result: Friction) -> Array:
        of = known(result.gradients)
        by_shift = of.velocity - _adhesion_over_velocity(result, adhesion)
        return np.hstack([of.storage * weight, of.loss * weight, by_shift[:, None]])

    def moved(by: Array) -> Rubber:
        rows = np.log(curve.angular_frequency)
        of_storage, of_loss = (np.interp(rows, np.log(w), one) for one in np.split(by[:-1], 2))
        made = MasterCurve(
            angular_frequency=curve.angular_frequency,
            storage_modulus=curve.storage_modulus * np.exp(of_storage),
            loss_modulus=curve.loss_modulus * np.exp(of_loss),
            extrapolation=curve.extrapolation or "power-law",
            shift_factors=build.shift_factors,
        )
        return made.shifted(float(np.exp(by[-1])))

    return _Input(np.hstack([storage, loss, shift]), slopes, moved)


def _adhesion_over_velocity(result: Friction, adhesion: Adhesion | None) -> Any:
    """Return d mu / d ln v by Eq. 23's own velocity, which no a_T moves."""
    if adhesion is None:
        return 0.0
    decades = np.log10(result.velocity / adhesion.reference_velocity)
    return result.adhesion * (-2 * adhesion.width * decades / np.log(10))


def _adhesion(fit: AdhesionFit) -> _Input:
    def slopes(result: Friction) -> Array:
        of = known(result.gradients)
        width = of.width / fit.width if fit.width else np.zeros_like(of.width)
        return np.stack([of.shear_stress, of.reference_velocity, width], axis=-1)

    return _Input(_root(adhesion_covariance(fit)), slopes, partial(moved_adhesion, fit))


def _weights(rows: Array) -> Array:
    """Return the weights of the trapezoid rule over the logarithm of rows."""
    half = np.diff(np.log(rows)) / 2
    weights: Array = np.append(half, 0) + np.append(0, half)
    return weights


def _root(covariance: Array) -> Array:
    """Return rows that unit normals times them have this covariance, which may be singular."""
    values, vectors = np.linalg.eigh(covariance)
    root: Array = (vectors * np.sqrt(np.maximum(values, 0))).T
    return root
