"""How far the errors of the measured inputs carry into mu: a band, by sampling."""

from collections.abc import Callable
from contextlib import AbstractContextManager, nullcontext
from typing import Any, Literal, NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from asperity._core import InvalidInput, NotConverged, OutOfRange
from asperity.adhesion import Adhesion, AdhesionFit, adhesion_core
from asperity.base.arguments import (
    MOST_THREADS,
    Array,
    Shape,
    broadcast,
    choice,
    number,
    shaped,
    whole,
)
from asperity.base.diagnostics import Argument, Note, refusal
from asperity.base.executors import in_order
from asperity.base.parameters import column
from asperity.base.table import Table
from asperity.base.value import value
from asperity.correction import Correction, PartialContact
from asperity.dma import AnyRubber, MasterCurveBuild, rubber_of
from asperity.friction import Branch, Friction, friction, known_shift
from asperity.heating import Heating
from asperity.prony_fit import PronyFit
from asperity.results.friction import MEANINGS
from asperity.rubber import Rubber
from asperity.scan_contact import ScanContact
from asperity.self_affine_fit import AnySpectrum, spectrum_of
from asperity.shift_factors import TemperatureShift
from asperity.spectrum import Spectrum
from asperity.sweeps import StrainFactors, strain_core
from asperity.uncertainty.draws import (
    Generator,
    Inputs,
    ShiftedRubber,
    draw_adhesion,
    draw_strain,
    drawn_rubber,
    drawn_spectrum,
)
from asperity.uncertainty.linear import linear_band
from asperity.uncertainty.scan import HeldScan, beyond_scan

DrawAdhesion = Callable[[Spectrum, Rubber, Generator], Adhesion]

Method = Literal["draws", "linear"]
_SWEPT = 13  # velocities at which the band of a sweep is computed
_FAILURES = (InvalidInput, NotConverged, OutOfRange)
_FAILED = 0.1  # share of draws that may fail: without more of them a band would be another


class Bounds(NamedTuple):
    """The two ends of a band, and what there is to say of it."""

    lower: Array
    upper: Array
    notes: tuple[Note, ...]


@value
class FrictionBand(Table):
    """What `friction_band` returns: a band on mu. Scalars for scalar arguments, else arrays.

    Attributes
    ----------
    mu : float or ndarray
        That of the inputs as they are [-].
    lower, upper : float or ndarray
        A share `level` of the draws has its mu [-] between the two.
    pressure, velocity : float or ndarray
        As given, broadcast [Pa], [m/s].
    level : float
        In (0, 1) [-].
    samples : int
        How many draws there were; 0 of a linear band.
    direction : float or ndarray, or None
        As of `Friction` [rad].
    notes : tuple of Note
        What `friction` says of the same points, since a band is no wiser than the rows and the
        modulus it is drawn from, and how many draws failed and were left out, if any.
    """

    mu: Any = column("1", "friction coefficient")
    lower: Any = column("1", "lower end of the band on mu")
    upper: Any = column("1", "upper end of the band on mu")
    pressure: Any = column("Pa", "nominal pressure")
    velocity: Any = column("m/s", "sliding velocity")
    level: float
    samples: int
    direction: Any = column(*MEANINGS["direction"], default=None)
    notes: tuple[Note, ...] = ()
    _facts = ("level", "samples")

    @property
    def band(self) -> tuple[Any, Any]:
        """Both ends."""
        return self.lower, self.upper

    def _draw(self, axes: Any) -> None:
        from asperity.draw.friction import band_text, draw_result  # `import asperity` is quick

        draw_result(axes, self, band=band_text(self.level))

    @property
    def _is_polar(self) -> bool:
        from asperity.draw.friction import is_polar

        return is_polar(self)


def friction_band(
    spectrum: AnySpectrum,
    rubber: AnyRubber,
    *,
    pressure: ArrayLike,
    velocity: ArrayLike,
    poisson_ratio: float = 0.5,
    correction: Correction | None = None,
    adhesion: Adhesion | None = None,
    form: Literal["exact", "interpolated"] = "exact",
    strain_factors: StrainFactors | None = None,
    samples: int = 100,
    seed: int = 0,
    level: float = 0.95,
    threads: int = 1,
    temperature: ArrayLike | None = None,
    shift: TemperatureShift | None = None,
    heating: Heating | None = None,
    branch: Branch = "cold",
    method: Method = "draws",
    direction: ArrayLike = 0.0,
) -> FrictionBand:
    """Return a band on mu, from the standard errors of its measured inputs.

    Parameters
    ----------
    spectrum : SelfAffineFit, TabulatedSpectrum or SelfAffineSpectrum
        A fit is drawn from the covariance of its parameters, a table from the standard errors of
        its rows (of logarithmic bins, ten a decade), those of all directions alike. A plain
        spectrum has no errors.
    rubber : MasterCurveBuild, MasterCurve or PronySeries
        log10 a_T of a build is drawn from its covariance, and the coefficients of the spline
        through the points moved there from theirs: the scatter of the points about the spline,
        less what smoothing averages out, more where residuals are correlated within isotherms. A
        build does not know a calibration error that all isotherms share, nor what vertical shift
        the rubber has: its notes tell what b_T = T / T_ref would do. A plain rubber has no errors.
    pressure, velocity : array_like
        [Pa], [m/s], broadcast.
    poisson_ratio, correction, adhesion, form
        As for `friction`, and held; but an AdhesionFit is drawn from its covariance, apart from
        spectrum and rubber: where those have errors too the band is an upper bound, for the points
        that were fitted hold the sum (`asperity fit` fits them anew for every draw). A ScanContact
        is one scan of the surface: mu of draws has its `model_error`, mostly the scatter of the
        scan's quarters, by Student's t of three degrees of freedom. A spectrum is then drawn beyond
        the scan's waves alone, and a rubber changes mu as with PartialContact: no contact is solved
        for a draw.
    strain_factors : StrainFactors, optional
        As for `friction`. Where they have errors, f is drawn as a whole, and so is g.
    samples : int
        Draws, 20 or more.
    seed : int
        The same band for the same seed.
    level : float
        Share of the draws between the two curves, in (0, 1).
    threads : int
        As many at most compute the curves of the draws. The band is the same for any of them.
    temperature, shift, heating, branch
        As for `friction`. The shift of a build is drawn with its master curve, unless `shift` gives
        another, which is held; so are the constants of the heating, which have no errors here.
    method : {"draws", "linear"}
        "linear" takes the slopes of mu (`friction(..., gradients=True)`) and the covariances, some
        twenty times as fast; `samples` and `seed` are without effect. A note (`code`
        "linear-band-off") says where mu curves too much within the errors. Not with heating, strain
        factors, directional spectra or ScanContact.
    direction : array_like
        As for `friction` [rad].

    Returns
    -------
    FrictionBand

    Raises
    ------
    InvalidInput
        No input has errors; a PronyFit, which does not know its own (give the build).
    """
    plain, of_build = spectrum_of(spectrum), rubber_of(rubber)  # the rows, not in bins
    adhesion_core(adhesion)
    strain_core(strain_factors)
    if isinstance(rubber, PronyFit):
        raise InvalidInput(
            Argument("rubber"),
            ": a PronyFit does not know its errors, give the MasterCurveBuild behind it",
        )
    known = None
    if temperature is not None:
        known = shift if isinstance(rubber, MasterCurveBuild) else known_shift(rubber, shift)
    surface = drawn_spectrum(spectrum)
    solid = drawn_rubber(rubber, known, shifted=temperature is not None)
    with_errors = isinstance(adhesion, AdhesionFit) or isinstance(correction, ScanContact)
    with_errors |= strain_factors is not None and strain_factors.storage_error is not None
    if surface.draw is None and solid.draw is None and not with_errors:
        raise InvalidInput(
            "spectrum, rubber, adhesion, correction: none has errors: one must be a SelfAffineFit, "
            "a TabulatedSpectrum with standard_error, a MasterCurveBuild, an AdhesionFit, a "
            "ScanContact or StrainFactors of several sweeps"
        )
    options: dict[str, Any] = {
        "poisson_ratio": poisson_ratio,
        "correction": correction,
        "form": form,
        "strain_factors": strain_factors,
        "heating": heating,
        "branch": branch,
    }
    given_at: dict[str, Any] = {"pressure": pressure, "velocity": velocity}
    if temperature is not None:
        given_at["temperature"] = temperature
    (given_at if np.ndim(direction) else options)["direction"] = direction
    result = friction(plain, of_build, adhesion=adhesion, shift=shift, **given_at, **options)
    shape, columns = broadcast(**given_at)
    at = dict(zip(given_at, map(np.atleast_1d, columns), strict=True))
    linear = bool(choice(method, "method", Method))
    how: dict[str, Any] = {"samples": samples, "seed": seed, "level": level, "threads": threads}
    band = relative_band(Inputs(surface, solid, adhesion, options | at), method=method, **how)
    return _band(result, band, shape, level, 0 if linear else samples)


def _band(result: Friction, band: Bounds, shape: Shape, level: float, samples: int) -> FrictionBand:
    return FrictionBand(
        mu=result.mu,
        lower=result.mu * shaped(band.lower, shape),
        upper=result.mu * shaped(band.upper, shape),
        pressure=result.pressure,
        velocity=result.velocity,
        level=float(level),
        samples=int(samples),
        direction=result.direction,
        notes=(*result.notes, *band.notes),
    )


def relative_band(
    inputs: Inputs,
    *,
    samples: int,
    seed: int,
    level: float,
    progress: Callable[[Any], AbstractContextManager[Any]] = nullcontext,
    refit: DrawAdhesion | None = None,
    threads: int = 1,
    method: Method = "draws",
) -> Bounds:
    """Return quantiles of mu of drawn inputs over mu of the plain ones; 1 without friction.

    `refit` gives the adhesion that goes with a drawn spectrum and rubber.
    """
    if not 0 < number(level, "level") < 1:
        raise refusal("level", level, "in (0, 1)", text=f"{level}")
    if method == "linear":
        return Bounds(*linear_band(inputs, level, refitted=refit is not None))
    whole(samples, "samples", lowest=20)
    whole(seed, "seed")
    whole(threads, "threads", lowest=1, highest=MOST_THREADS)
    rng = np.random.default_rng(seed)
    spectrum, rubber, adhesion, options = inputs
    options = {**options, "rtol": 1e-4}  # a band is read to two digits
    softening = options.pop("strain_factors", None)

    def at_points(
        surface: Spectrum,
        solid: ShiftedRubber,
        added: Adhesion | None,
        softer: StrainFactors | None = softening,
    ) -> Friction:
        how: dict[str, Any] = {"shift": solid.shift, "adhesion": added, "strain_factors": softer}
        return friction(surface, solid.rubber, **how, **options)

    scan, held, fitted_on = options.get("correction"), None, spectrum.plain
    if isinstance(scan, ScanContact):
        spectrum, fitted_on = beyond_scan(spectrum, scan), spectrum.whole or spectrum.plain
        exact = at_points(fitted_on, rubber.plain, adhesion)
        options["correction"] = PartialContact()
        held = HeldScan(exact, at_points(spectrum.plain, rubber.plain, adhesion), samples, rng)
        centre = exact.mu
    else:
        centre = at_points(spectrum.plain, rubber.plain, adhesion).mu

    def draw() -> tuple[Any, ...]:
        try:
            surface, solid = spectrum(rng), rubber(rng)
            if refit is None:
                added = draw_adhesion(adhesion, rng)
            else:  # on a scan as it is: no contact is solved for a draw
                of_fit = rubber.plain if held else solid
                added = refit(fitted_on if held else surface, of_fit.rubber, rng)
            softer = draw_strain(softening, rng)
            return held.draw() if held else 0.0, surface, solid, added, softer
        except _FAILURES as error:
            return (error,)

    def curve(scatter: Any, *parts: Any) -> Any:
        if not parts:  # the draw itself failed
            raise scatter
        result = at_points(*parts)
        return held.mu(result, scatter) if held else result.mu

    curves: list[Any] = []
    problem: Exception | None = None
    failed = 0
    with progress(range(samples)) as shown:
        for outcome in in_order(curve, (draw() for _ in shown), threads):
            try:
                curves.append(outcome())
            except _FAILURES as error:
                problem, failed = error, failed + 1
                if failed > _FAILED * samples:
                    raise
    notes = () if problem is None else (_left_out(failed, samples, problem),)
    drawn = np.array(curves)
    ratio = np.divide(drawn, centre, out=np.ones_like(drawn), where=centre > 0)
    outside = (1 - level) / 2
    lower, upper = np.quantile(ratio, [outside, 1 - outside], axis=0)
    return Bounds(lower, upper, notes)


def _left_out(failed: int, samples: int, problem: Exception) -> Note:
    text = f"the band leaves out {failed} of {samples} draws that failed, the last with: {problem}"
    return Note(text, code="failed-draws")


def swept_band(inputs: Inputs, pressure: Array, velocity: Array, **sampling: Any) -> Bounds:
    """`relative_band` at every pressure and velocity, of shape (pressures, velocities): computed at
    a few velocities, and between them over ln v."""
    few = np.unique(velocity)
    if few.size > _SWEPT:
        few = np.geomspace(few[0], few[-1], _SWEPT)
    p, v = np.meshgrid(pressure, few, indexing="ij")
    at_few = inputs.with_options(pressure=p.ravel(), velocity=v.ravel())
    band = relative_band(at_few, **sampling)

    def everywhere(bound: Array) -> Array:
        rows = bound.reshape(p.shape)
        return np.array([np.interp(np.log(velocity), np.log(few), row) for row in rows])

    return Bounds(everywhere(band.lower), everywhere(band.upper), band.notes)
