"""Measured inputs as their standard errors would have them, drawn at random."""

from collections.abc import Callable
from dataclasses import dataclass
from functools import partial
from typing import TYPE_CHECKING, Any, Generic, NamedTuple, TypeVar

import numpy as np

from asperity.adhesion import Adhesion, AdhesionFit
from asperity.base.arguments import Array, known
from asperity.dma import MasterCurveBuild, draw_master_curve
from asperity.rubber import Rubber
from asperity.self_affine_fit import SelfAffineFit
from asperity.shift_factors import TemperatureShift
from asperity.spectrum import SelfAffineSpectrum, Spectrum, TabulatedSpectrum
from asperity.sweeps import StrainFactors

if TYPE_CHECKING:
    Generator = np.random.Generator  # which NumPy loads when it is asked for
else:
    Generator = "numpy.random.Generator"


class ShiftedRubber(NamedTuple):
    """A rubber, at the reference of its shift where it has one."""

    rubber: Rubber
    shift: TemperatureShift | None = None


Input = TypeVar("Input", Spectrum, ShiftedRubber)

_ROWS_PER_DECADE = 10.0  # of a measured spectrum whose errors are carried through


@dataclass(frozen=True)
class Drawn(Generic[Input]):
    """An input, and how it is drawn from its standard errors where it has any."""

    plain: Input
    draw: Callable[[Generator], Input] | None = None
    whole: Input | None = None  # the plain one, where that is in bins
    source: Any = None  # what has the errors: a fit, a table or a build, which linear bands take

    def __call__(self, rng: Generator) -> Input:
        return self.plain if self.draw is None else self.draw(rng)


class Inputs(NamedTuple):
    """What a band is drawn of, and the other arguments of `friction`, points among them."""

    spectrum: Drawn[Spectrum]
    rubber: Drawn[ShiftedRubber]
    adhesion: Adhesion | None
    options: dict[str, Any]

    def with_options(self, **more: Any) -> "Inputs":
        return self._replace(options=self.options | more)


def drawn_spectrum(source: Spectrum | SelfAffineFit) -> Drawn[Spectrum]:
    """A fit from the covariance of its parameters; a table from the errors of its rows, in bins: a
    band needs no more of them. Rows that know directions stay, and move with the bins."""
    if isinstance(source, SelfAffineFit):
        return Drawn[Spectrum](source.spectrum, partial(draw_fit, source), source=source)
    if isinstance(source, TabulatedSpectrum) and source.standard_error is not None:
        table = source.log_binned(per_decade=_ROWS_PER_DECADE)
        if source.is_directional:
            return Drawn[Spectrum](source, partial(_draw_rings, source, table), source=source)
        return Drawn[Spectrum](table, partial(_draw_rows, table), source, source)
    return Drawn[Spectrum](source)


def row_covariance(table: TabulatedSpectrum) -> Array:
    """Of ln C of the rows, by their standard errors and correlation."""
    density, error = np.array(table.density), np.asarray(table.standard_error)
    relative = np.divide(error, density, out=np.zeros_like(density), where=density > 0)
    covariance = np.diag(relative**2)
    if table.correlation is not None:
        for lag, column in enumerate(table.correlation.T, start=1):
            first = np.arange(density.size - lag)
            pair = column[first] * relative[first] * relative[first + lag]
            covariance[first, first + lag] = covariance[first + lag, first] = pair
    logarithm: Array = np.log1p(covariance)
    return logarithm


def _draw_rows(table: TabulatedSpectrum, rng: Generator) -> TabulatedSpectrum:
    """Lognormal: positive, with the mean and the deviation of each row, and their correlation."""
    logarithm = row_covariance(table)
    mean = -np.diag(logarithm) / 2
    density = table.density * np.exp(rng.multivariate_normal(mean, logarithm, method="eigh"))
    return rows_like(table, density)


def _draw_rings(
    table: TabulatedSpectrum, bins: TabulatedSpectrum, rng: Generator
) -> TabulatedSpectrum:
    """Waves of all directions scatter alike, those of a bin as its error says: by as many harmonics
    of ln C over a ring as the table has, each with twice the variance of the mean."""
    cosine, sine = known(table.cosine), known(table.sine)
    count = cosine.shape[1]
    twice = 2 * np.pi * np.arange(8 * count) / (8 * count)  # the angle
    each = np.arange(1, count + 1)[:, None] * twice
    waves = np.concatenate([np.cos(each), np.sin(each)])
    plain = 1 + 2 * np.concatenate([cosine, sine], axis=1) @ waves
    covariance = row_covariance(bins)
    changes = rng.multivariate_normal(0 * bins.density, covariance, 1 + 2 * count, method="eigh")
    place = np.log(table.wavenumber), np.log(bins.wavenumber)
    mean, *harmonics = (np.interp(*place, change) for change in changes)
    variance = np.interp(*place, np.diag(covariance))
    # the error of a ring is that of waves as unlike as those of its directions
    alike = 1 / np.sqrt((plain**2).mean(axis=1))[:, None]
    off = alike * (mean[:, None] + np.sqrt(2) * np.transpose(harmonics) @ waves)
    times = np.exp(off - alike**2 * (0.5 + count) * variance[:, None])  # of a mean of 1
    drawn = plain + np.maximum(plain, 0.0) * (times - 1)  # few harmonics may leave it below 0
    level = drawn.mean(axis=1)
    cosine, sine = np.split(drawn @ waves.T / (8 * count) / level[:, None], 2, axis=1)
    size = np.maximum(1.0, np.hypot(cosine, sine))
    return rows_like(table, table.density * level, cosine / size, sine / size)


def rows_like(
    table: TabulatedSpectrum, density: Any, cosine: Any = None, sine: Any = None
) -> TabulatedSpectrum:
    return TabulatedSpectrum(
        wavenumber=table.wavenumber, density=density, cosine=cosine, sine=sine, q1=table.q1
    )


def fit_covariance(fit: SelfAffineFit) -> Array:
    """Of ln of the rms height, of H and, where there is one, of ln of the roll-off."""
    scale = np.array([fit.rms_height, 1, fit.rolloff or 1])[: 2 if fit.rolloff is None else 3]
    covariance: Array = fit.covariance[: scale.size, : scale.size]
    scaled: Array = covariance / np.outer(scale, scale)
    return scaled


def draw_fit(fit: SelfAffineFit, rng: Generator, q1: float | None = None) -> SelfAffineSpectrum:
    """Rms height and roll-off in the logarithm, where they stay positive; H until it is one."""
    covariance = fit_covariance(fit)
    end = fit.q1 if q1 is None else min(q1, fit.q1)  # the band is to keep a self-affine part
    while True:
        drawn = rng.multivariate_normal(np.zeros(len(covariance)), covariance, method="eigh")
        hurst = fit.hurst + drawn[1]
        rolloff = None if fit.rolloff is None else fit.rolloff * float(np.exp(drawn[2]))
        if 0 < hurst <= 1 and (rolloff is None or fit.q0 < rolloff < end):
            return moved_fit(fit, drawn)


def moved_fit(fit: SelfAffineFit, by: Any) -> SelfAffineSpectrum:
    """The law with ln of its rms height, H and ln of its roll-off moved, H to 1 at most."""
    rolloff = None if fit.rolloff is None else fit.rolloff * float(np.exp(by[2]))
    height, hurst = fit.rms_height * float(np.exp(by[0])), min(fit.hurst + float(by[1]), 1.0)
    return SelfAffineSpectrum(rms_height=height, hurst=hurst, q0=fit.q0, q1=fit.q1, rolloff=rolloff)


def drawn_rubber(
    source: Rubber | MasterCurveBuild,
    shift: TemperatureShift | None = None,
    *,
    shifted: bool = False,
) -> Drawn[ShiftedRubber]:
    """A rubber with its shift; of a build, which is one if it is `shifted` by no other, the master
    curve and a_T as the errors of the shifts and of the spline would have them, drawn together."""
    if not isinstance(source, MasterCurveBuild):
        return Drawn(ShiftedRubber(source, shift))

    def of(build: MasterCurveBuild) -> ShiftedRubber:
        return ShiftedRubber(build.master_curve, build if shifted and shift is None else shift)

    return Drawn(of(source), lambda rng: of(draw_build(source, rng)), source=source)


def draw_build(build: MasterCurveBuild, rng: Generator) -> MasterCurveBuild:
    """log10 a_T from its covariance, the spline through the points moved there from its own. No
    search: the likeliest shifts of other noise are not drawn, but errors about these."""
    return draw_master_curve(build, int(rng.integers(2**63)))


def adhesion_covariance(fit: AdhesionFit) -> Array:
    """Of ln tau_f0, ln v0 and c."""
    scale = np.array([fit.shear_stress, fit.reference_velocity, 1])
    return fit.covariance / np.outer(scale, scale)


def draw_adhesion(source: Adhesion | None, rng: Generator) -> Adhesion | None:
    """A fitted adhesion as its errors would have it, tau_f0 and v0 in the logarithm; c until it is
    one."""
    if not isinstance(source, AdhesionFit):
        return source
    covariance = adhesion_covariance(source)
    while True:
        drawn = rng.multivariate_normal(np.zeros(3), covariance, method="eigh")
        if source.width + drawn[2] >= 0:
            return moved_adhesion(source, drawn)


def moved_adhesion(fit: AdhesionFit, by: Any) -> Adhesion:
    """The adhesion with ln tau_f0, ln v0 and c moved, c to 0 at least."""
    return Adhesion(
        shear_stress=fit.shear_stress * float(np.exp(by[0])),
        reference_velocity=fit.reference_velocity * float(np.exp(by[1])),
        width=max(fit.width + float(by[2]), 0.0),
    )


def draw_strain(factors: StrainFactors | None, rng: Generator) -> StrainFactors | None:
    """Factors as their errors would have them: sweeps differ as a whole, not from row to row."""
    if factors is None or (factors.storage_error is None and factors.loss_error is None):
        return factors
    of_storage, of_loss = rng.standard_normal(2)
    return StrainFactors(
        strain=factors.strain,
        storage=factors.storage * np.exp(of_storage * _errors(factors.storage_error)),
        loss=factors.loss * np.exp(of_loss * _errors(factors.loss_error)),
        strain_per_slope=factors.strain_per_slope,
    )


def _errors(error: Array | None) -> Any:
    return 0.0 if error is None else error
