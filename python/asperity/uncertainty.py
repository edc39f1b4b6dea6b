"""How far the errors of the measured inputs carry into mu: a band, by sampling."""

import warnings
from collections.abc import Callable
from contextlib import AbstractContextManager, nullcontext
from dataclasses import dataclass
from functools import partial
from typing import Any, Generic, Literal, TypeVar

import numpy as np
from numpy.typing import ArrayLike, NDArray

from asperity._core import (
    Adhesion,
    AdhesionFit,
    AffineShift,
    GreenwoodWilliamson,
    InvalidInput,
    Isotherm,
    LocalPeaks,
    MasterCurve,
    MasterCurveBuild,
    NayakSFactor,
    PeaksThenGreenwoodWilliamson,
    PronyFit,
    PronySeries,
    SelfAffineFit,
    SelfAffineSpectrum,
    SFactor,
    TabulatedSpectrum,
    build_master_curve,
    fit_prony,
    friction,
)

Spectrum = SelfAffineSpectrum | TabulatedSpectrum
Rubber = PronySeries | MasterCurve
Generator = np.random.Generator
DrawSpectrum = Callable[[Generator], Spectrum]
DrawRubber = Callable[[Generator], Rubber]
DrawAdhesion = Callable[[Spectrum, Rubber, Generator], Adhesion]
Correction = (
    SFactor
    | NayakSFactor
    | AffineShift
    | LocalPeaks
    | GreenwoodWilliamson
    | PeaksThenGreenwoodWilliamson
    | None
)
Input = TypeVar("Input", Spectrum, Rubber)
Bounds = tuple[NDArray[np.float64], NDArray[np.float64]]

_SWEPT = 13  # velocities at which the band of a sweep is computed
_ROWS_PER_DECADE = 10.0  # of a measured spectrum whose errors are carried through


@dataclass(frozen=True)
class Drawn(Generic[Input]):
    """An input, and how it is drawn from its standard errors where it has any."""

    plain: Input
    draw: Callable[[Generator], Input] | None

    def __call__(self, rng: Generator) -> Input:
        return self.plain if self.draw is None else self.draw(rng)


@dataclass(frozen=True, eq=False)
class FrictionBand:
    """A share `level` of `samples` draws has its mu [-] between `lower` and `upper`, arrays of the
    points' shape."""

    lower: NDArray[np.float64]
    upper: NDArray[np.float64]
    level: float
    samples: int


def friction_band(
    spectrum: Spectrum | SelfAffineFit,
    rubber: Rubber | MasterCurveBuild,
    *,
    pressure: ArrayLike,
    velocity: ArrayLike,
    poisson_ratio: float = 0.5,
    correction: Correction = None,
    adhesion: Adhesion | None = None,
    form: Literal["exact", "interpolated"] = "exact",
    samples: int = 100,
    seed: int = 0,
    level: float = 0.95,
) -> FrictionBand:
    """A band on mu from the standard errors of its measured inputs.

    Parameters
    ----------
    spectrum : SelfAffineFit, TabulatedSpectrum or SelfAffineSpectrum
        A fit is drawn from the covariance of its parameters, a table from the standard errors of
        its rows (of logarithmic bins, ten a decade). A plain spectrum has no errors.
    rubber : MasterCurveBuild, MasterCurve or PronySeries
        The isotherms of a build are drawn with the scatter about its master spline, and shifted
        and smoothed anew, so that shift factors scatter as their standard deviations say. A plain
        rubber has no errors.
    pressure, velocity : array_like
        [Pa], [m/s], broadcast.
    poisson_ratio, correction, adhesion, form
        As for `friction`, and held; but an AdhesionFit is drawn from its covariance, apart from
        spectrum and rubber: where those have errors too the band is an upper bound, for the points
        that were fitted hold the sum (`asperity fit` fits them anew for every draw).
    samples : int
        Draws, 20 or more.
    seed : int
        The same band for the same seed.
    level : float
        Share of the draws between the two curves, in (0, 1).

    Returns
    -------
    FrictionBand

    Raises
    ------
    InvalidInput
        No input has errors; a PronyFit, which does not know its own (give the build).
    """
    if isinstance(rubber, PronyFit):
        raise InvalidInput(
            "rubber: a PronyFit does not know its errors, give the MasterCurveBuild behind it"
        )
    if not any(map(has_errors, (spectrum, rubber, adhesion))):
        raise InvalidInput(
            "spectrum, rubber, adhesion: none has errors: one must be a SelfAffineFit, a "
            "TabulatedSpectrum with standard_error, a MasterCurveBuild or an AdhesionFit"
        )
    p, v = np.broadcast_arrays(np.asarray(pressure, float), np.asarray(velocity, float))
    plain = spectrum.spectrum if isinstance(spectrum, SelfAffineFit) else spectrum
    solid = rubber.master_curve if isinstance(rubber, MasterCurveBuild) else rubber
    options: dict[str, Any] = {
        "poisson_ratio": poisson_ratio,
        "correction": correction,
        "form": form,
    }
    mu = friction(plain, solid, pressure=p, velocity=v, adhesion=adhesion, **options).mu
    lower, upper = relative_band(
        Drawn(coarse(plain), partial(draw_spectrum, spectrum)),
        Drawn(solid, partial(draw_rubber, rubber)),
        adhesion,
        {**options, "pressure": p.ravel(), "velocity": v.ravel()},
        samples=samples,
        seed=seed,
        level=level,
    )
    shape = np.shape(mu)
    return FrictionBand(mu * lower.reshape(shape), mu * upper.reshape(shape), level, samples)


def has_errors(source: object) -> bool:
    """Whether `source` is a measured input that knows its standard errors."""
    if isinstance(source, TabulatedSpectrum):
        return source.standard_error is not None
    return isinstance(source, SelfAffineFit | MasterCurveBuild | AdhesionFit)


def relative_band(
    spectrum: Drawn[Spectrum],
    rubber: Drawn[Rubber],
    adhesion: Adhesion | None,
    options: dict[str, Any],
    *,
    samples: int,
    seed: int,
    level: float,
    progress: Callable[[Any], AbstractContextManager[Any]] = nullcontext,
    refit: DrawAdhesion | None = None,
) -> Bounds:
    """Quantiles of mu of drawn inputs over mu of the plain ones; 1 where there is no friction.
    `refit` gives the adhesion that goes with a drawn spectrum and rubber."""
    if samples < 20:
        raise InvalidInput(f"samples = {samples}: must be 20 or more")
    if seed < 0:
        raise InvalidInput(f"seed = {seed}: must not be negative")
    if not 0 < level < 1:
        raise InvalidInput(f"level = {level}: must be in (0, 1)")
    rng = np.random.default_rng(seed)
    options = {**options, "rtol": 1e-4}  # a band is read to two digits
    centre = friction(spectrum.plain, rubber.plain, adhesion=adhesion, **options).mu

    def draw() -> Any:
        surface, solid = spectrum(rng), rubber(rng)
        of_draw = draw_adhesion(adhesion, rng) if refit is None else refit(surface, solid, rng)
        return friction(surface, solid, adhesion=of_draw, **options).mu

    with progress(range(samples)) as shown:
        drawn = np.array([draw() for _ in shown])
    ratio = np.divide(drawn, centre, out=np.ones_like(drawn), where=centre > 0)
    outside = (1 - level) / 2
    lower, upper = np.quantile(ratio, [outside, 1 - outside], axis=0)
    return lower, upper


def swept_band(
    spectrum: Drawn[Spectrum],
    rubber: Drawn[Rubber],
    adhesion: Adhesion | None,
    pressure: NDArray[np.float64],
    velocity: NDArray[np.float64],
    options: dict[str, Any],
    **sampling: Any,
) -> Bounds:
    """`relative_band` at every pressure and velocity, of shape (pressures, velocities): computed at
    a few velocities, and between them over ln v."""
    few = np.unique(velocity)
    if few.size > _SWEPT:
        few = np.geomspace(few[0], few[-1], _SWEPT)
    p, v = np.meshgrid(pressure, few, indexing="ij")
    points = {"pressure": p.ravel(), "velocity": v.ravel()}
    lower, upper = relative_band(spectrum, rubber, adhesion, {**options, **points}, **sampling)

    def everywhere(bound: NDArray[np.float64]) -> NDArray[np.float64]:
        rows = bound.reshape(p.shape)
        return np.array([np.interp(np.log(velocity), np.log(few), row) for row in rows])

    return everywhere(lower), everywhere(upper)


def coarse(spectrum: Spectrum) -> Spectrum:
    """Rows in bins where their errors are carried through: a band needs no more of them."""
    if isinstance(spectrum, TabulatedSpectrum) and spectrum.standard_error is not None:
        return spectrum.log_binned(per_decade=_ROWS_PER_DECADE)
    return spectrum


def draw_spectrum(source: Spectrum | SelfAffineFit, rng: Generator) -> Spectrum:
    """A spectrum as its errors would have it."""
    if isinstance(source, SelfAffineFit):
        return draw_fit(source, rng)
    table = coarse(source)
    if not isinstance(table, TabulatedSpectrum) or table.standard_error is None:
        return source
    # gamma, as means of squared amplitudes are: positive, of the row's mean and deviation
    with np.errstate(divide="ignore"):
        shape = np.where(table.density > 0, (table.density / table.standard_error) ** 2, np.inf)
    sure = ~np.isfinite(shape)
    factor = np.where(sure, 1, rng.gamma(np.where(sure, 1, shape)) / np.where(sure, 1, shape))
    return TabulatedSpectrum(wavenumber=table.wavenumber, density=table.density * factor)


def draw_fit(fit: SelfAffineFit, rng: Generator, q1: float | None = None) -> SelfAffineSpectrum:
    """Rms height and roll-off in the logarithm, where they stay positive; H until it is one."""
    has_rolloff = fit.rolloff is not None
    count = 3 if has_rolloff else 2
    scale = np.array([fit.rms_height, 1, fit.rolloff or 1])[:count]
    covariance = fit.covariance[:count, :count] / np.outer(scale, scale)
    end = fit.q1 if q1 is None else min(q1, fit.q1)  # the band is to keep a self-affine part
    while True:
        drawn = rng.multivariate_normal(np.zeros(count), covariance, method="eigh")
        hurst = fit.hurst + drawn[1]
        rolloff = None if fit.rolloff is None else fit.rolloff * float(np.exp(drawn[2]))
        if 0 < hurst <= 1 and (rolloff is None or fit.q0 < rolloff < end):
            return SelfAffineSpectrum(
                rms_height=fit.rms_height * float(np.exp(drawn[0])),
                hurst=hurst,
                q0=fit.q0,
                q1=fit.q1,
                rolloff=rolloff,
            )


def draw_build(build: MasterCurveBuild, rng: Generator) -> MasterCurveBuild:
    """The build of isotherms that scatter about its master spline as the measured ones do."""
    points = build.points
    isotherms = []
    for i, temperature in enumerate(build.temperature):
        mine = points.isotherm == i
        noise = np.exp(build.residual * rng.normal(size=(2, int(mine.sum()))))
        isotherms.append(
            Isotherm(
                temperature=temperature,
                angular_frequency=points.angular_frequency[mine] / 10 ** build.log10_a_T[i],
                storage_modulus=points.storage_modulus[mine] * build.b_T[i] * noise[0],
                loss_modulus=points.loss_modulus[mine] * build.b_T[i] * noise[1],
            )
        )
    given = not build.standard_deviation.any()  # then a_T came from a table
    return build_master_curve(
        isotherms,
        reference_temperature=build.reference_temperature,
        vertical_shift=build.b_T,
        shift_factors=build if given else None,
        smooth=True,
        extrapolation="power-law",  # ends move with the shift factors
    )


def draw_adhesion(source: Adhesion | None, rng: Generator) -> Adhesion | None:
    """A fitted adhesion as its errors would have it, tau_f0 and v0 in the logarithm; c until it is
    one."""
    if not isinstance(source, AdhesionFit):
        return source
    scale = np.array([source.shear_stress, source.reference_velocity, 1])
    covariance = source.covariance / np.outer(scale, scale)
    while True:
        drawn = rng.multivariate_normal(np.zeros(3), covariance, method="eigh")
        if source.width + drawn[2] >= 0:
            return Adhesion(
                shear_stress=source.shear_stress * float(np.exp(drawn[0])),
                reference_velocity=source.reference_velocity * float(np.exp(drawn[1])),
                width=source.width + drawn[2],
            )


def draw_rubber(source: Rubber | MasterCurveBuild, rng: Generator) -> Rubber:
    """A rubber as its errors would have it."""
    return draw_build(source, rng).master_curve if isinstance(source, MasterCurveBuild) else source


def quiet_prony(curve: MasterCurve | MasterCurveBuild) -> PronyFit:
    """A Prony fit whose warning is left to the reader of its notes."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", UserWarning)
        return fit_prony(curve)
