"""Real contact area and contact pressure at every magnification (Eqs 1-8, Section 6.1)."""

import math
from collections.abc import Mapping
from typing import Any, Literal

import numpy as np
from numpy.typing import ArrayLike

from asperity import _core
from asperity.base.arguments import Shape, choice, number, number_or_none, real_array, shaped
from asperity.base.diagnostics import Note, fatal_first, must_be, must_have, refusal
from asperity.base.quantities import (
    FIRST_WAVENUMBER,
    MODULUS,
    PRESSURE,
    RMS_HEIGHT,
    SLOPE,
    VELOCITY,
    Quantity,
)
from asperity.correction import CORRECTIONS, Correction
from asperity.dma import AnyRubber, rubber_of
from asperity.io.plausible import implausible
from asperity.results.directions import along_x_notes, once, toward_each
from asperity.rubber import Rubber
from asperity.self_affine_fit import AnySpectrum, spectrum_of
from asperity.spectrum import Spectrum
from asperity.sweeps import StrainFactors, strain_core

# in the order of the core's enumerations
Form = Literal["exact", "interpolated"]
Method = Literal["gauss", "qag", "qags", "cquad"]


def contact_model(
    poisson_ratio: float,
    correction: Correction | None,
    form: str,
    rtol: float,
    method: str,
    strain_factors: StrainFactors | None = None,
    direction: float = 0.0,
) -> Any:
    if correction is not None and not isinstance(correction, CORRECTIONS):
        names = ", ".join(kind.__name__ for kind in CORRECTIONS)
        raise refusal("correction", correction, f"None or one of {names}")
    return (
        number(poisson_ratio, "poisson_ratio"),
        None if correction is None else correction._core,
        choice(form, "form", Form),
        number(rtol, "rtol"),
        choice(method, "method", Method),
        strain_core(strain_factors),
        number(direction, "direction"),
    )


def surface_and_rubber(spectrum: AnySpectrum, rubber: AnyRubber) -> tuple[Any, Any]:
    return spectrum_of(spectrum)._core, rubber_of(rubber)._core


def contact_area(
    spectrum: AnySpectrum,
    rubber: AnyRubber,
    *,
    pressure: ArrayLike,
    velocity: ArrayLike,
    poisson_ratio: float = 0.5,
    correction: Correction | None = None,
    form: Form = "exact",
    wavenumber: ArrayLike | None = None,
    rtol: float = 1e-6,
    method: Method = "gauss",
    strain_factors: StrainFactors | None = None,
    direction: ArrayLike = 0.0,
) -> Any:
    """Return the real over the nominal contact area, A/A0 [-].

    A/A0 = erf(1 / (2 sqrt G)), G(q) = (1/8) int_q0^q k^3 C(k) I2(v k) dk / ((1 - nu^2) sigma0)^2
    (Persson 2001; the article's Eq. 7 is its interpolation).

    Parameters
    ----------
    spectrum : SelfAffineSpectrum, TabulatedSpectrum or SelfAffineFit
    rubber : PronySeries, MasterCurve or MasterCurveBuild
    pressure, velocity : array_like
        sigma0 [Pa] and v [m/s], positive; they broadcast.
    poisson_ratio : float
        In [0, 0.5].
    correction : object or None
        One of the classes in `asperity.correction`, for instance `PartialContact()`.
        None is plain Persson.
    form : {"exact", "interpolated"}
        "interpolated" is Eq. 7, (1 + (pi G)^1.5)^(-1/3), which differs by -2.8 to +2.6 %.
    wavenumber : array_like, shape (n,) or (), optional
        Up to where the surface is seen [1/m], within its band: appended as last axis. By default
        q1. The area never rises with it.
    rtol : float
        Relative tolerance, 1e-12 to 0.1.
    method : {"gauss", "qag", "qags", "cquad"}
        Gauss-Legendre panels, or GSL's adaptive integration of that name to check them with, slower
        by hundreds of times; not with PartialContact or ScanContact.
    strain_factors : StrainFactors, optional
        The modulus at the strain of each magnification; by default that of small strain.
    direction : array_like
        Of sliding [rad], as in `friction`; broadcasts with pressure and velocity.

    Returns
    -------
    float or ndarray
        In the broadcast shape of pressure, velocity and direction, then wavenumber.

    Raises
    ------
    InvalidInput
    OutOfRange
        v q0 or v q1 outside of a measured master curve, wavenumber outside of the band.
    NotConverged
    """
    how = poisson_ratio, correction, form, rtol, method, strain_factors
    at = {"pressure": pressure, "velocity": velocity}, direction
    return _over_wavenumber(_core.contact_area, spectrum, rubber, how, at, wavenumber)


def mean_pressure(
    spectrum: AnySpectrum,
    rubber: AnyRubber,
    *,
    pressure: ArrayLike,
    velocity: ArrayLike,
    poisson_ratio: float = 0.5,
    correction: Correction | None = None,
    form: Form = "exact",
    wavenumber: ArrayLike | None = None,
    rtol: float = 1e-6,
    method: Method = "gauss",
    strain_factors: StrainFactors | None = None,
    direction: ArrayLike = 0.0,
) -> Any:
    """Return the mean contact pressure <sigma> = sigma0 A0 / A [Pa] (Eq. 1) at a magnification.

    It is infinite where there is no contact. Arguments, shape and errors are those of
    `contact_area`.
    """
    how = poisson_ratio, correction, form, rtol, method, strain_factors
    at = {"pressure": pressure, "velocity": velocity}, direction
    return _over_wavenumber(_core.mean_pressure, spectrum, rubber, how, at, wavenumber)


def correction_factor(
    spectrum: AnySpectrum,
    rubber: AnyRubber,
    *,
    pressure: ArrayLike,
    velocity: ArrayLike,
    poisson_ratio: float = 0.5,
    correction: Correction | None = None,
    form: Form = "exact",
    wavenumber: ArrayLike,
    rtol: float = 1e-6,
    method: Method = "gauss",
    strain_factors: StrainFactors | None = None,
    direction: ArrayLike = 0.0,
) -> Any:
    """Return the correction factor CF of Section 6.1 [-].

    A_m C_m / (A0 C) = (A_m / A0) / p_T^2 with the corrected area A_m; for the S factor on the
    friction PF-CF = S A / A0 with the uncorrected A. It is what the integrand of Eq. 22 is weighted
    with, 1 in full contact. Arguments, shape and errors are those of `contact_area`.
    """
    how = poisson_ratio, correction, form, rtol, method, strain_factors
    at = {"pressure": pressure, "velocity": velocity}, direction
    return _over_wavenumber(_core.correction_factor, spectrum, rubber, how, at, wavenumber)


def contact_notes(
    spectrum: AnySpectrum,
    rubber: AnyRubber,
    *,
    pressure: ArrayLike,
    velocity: ArrayLike,
    poisson_ratio: float = 0.5,
    correction: Correction | None = None,
    form: Form = "exact",
    rtol: float = 1e-6,
    method: Method = "gauss",
    strain_factors: StrainFactors | None = None,
    direction: ArrayLike = 0.0,
) -> tuple[Note, ...]:
    """Return the notes of the rubber, and where the theory or its input leaves its range.

    They are those that `friction` returns as notes, for who asks for the contact area alone.
    Arguments are those of `contact_area`.
    """
    how = poisson_ratio, correction, form, rtol, method, strain_factors
    surface, solid = spectrum_of(spectrum), rubber_of(rubber)
    _, each = toward_each(direction, {"pressure": pressure, "velocity": velocity})
    notes: list[Note] = []
    for angle, _, place in each:
        model = contact_model(*how, angle)
        notes += _core.contact_notes(surface._core, solid._core, model, *place.values())
    absurd = implausible_notes(surface, solid, pressure, velocity)
    along_x = along_x_notes(surface, direction)
    return tuple(fatal_first(once((*solid.notes, *absurd, *along_x, *notes))))


def pressure_distribution(
    stress: ArrayLike,
    spectrum: AnySpectrum,
    rubber: AnyRubber,
    *,
    pressure: ArrayLike,
    velocity: ArrayLike,
    wavenumber: float | None = None,
    poisson_ratio: float = 0.5,
    correction: Correction | None = None,
    rtol: float = 1e-6,
    method: Method = "gauss",
    strain_factors: StrainFactors | None = None,
    direction: ArrayLike = 0.0,
) -> Any:
    """Return the probability density P(sigma) of the contact pressure [1/Pa] (Eq. 4 solved).

    A Gaussian of variance 2 G sigma0^2 about sigma0 minus its mirror image at -sigma0. Its integral
    over sigma > 0 is A/A0 and its first moment sigma0; the delta at sigma = 0, of weight 1 - A/A0,
    is left out.

    Parameters
    ----------
    stress : array_like
        sigma >= 0 [Pa]; broadcasts with pressure and velocity.
    wavenumber : float, optional
        The magnification [1/m], above q0; by default q1.

    The others, and the errors, are those of `contact_area`.

    Returns
    -------
    float or ndarray
        In the broadcast shape of stress, pressure, velocity and direction.
    """
    how = poisson_ratio, correction, "exact", rtol, method, strain_factors
    at = {"stress": stress, "pressure": pressure, "velocity": velocity}, direction
    q = number_or_none(wavenumber, "wavenumber")
    q = spectrum_of(spectrum).q1 if q is None else q
    return _at_points(_core.pressure_distribution, spectrum, rubber, how, at, q)


Places = tuple[Mapping[str, ArrayLike], ArrayLike]  # points and directions
How = tuple[Any, Any, Any, Any, Any, Any]  # as contact_model takes it


def _over_wavenumber(
    function: Any, spectrum: AnySpectrum, rubber: AnyRubber, how: How, at: Places, wavenumber: Any
) -> Any:
    """Return a function of points and directions, and of wavenumber as last axis."""
    if wavenumber is None:
        return _at_points(function, spectrum, rubber, how, at, np.empty(0))
    q = real_array(wavenumber, "wavenumber")
    if q.ndim > 1:
        raise must_have("wavenumber", "0 or 1", f" has {q.ndim} dimensions")
    if not q.size:
        raise must_be("wavenumber", "1 or more", " has 0 entries")
    return _at_points(function, spectrum, rubber, how, at, q, q.shape)


def _at_points(
    function: Any,
    spectrum: AnySpectrum,
    rubber: AnyRubber,
    how: How,
    at: Places,
    wavenumber: Any,
    more: Shape = (),
) -> Any:
    parts = surface_and_rubber(spectrum, rubber)
    points, direction = at
    shape, each = toward_each(direction, points)
    result = np.empty((math.prod(shape), *more))
    for angle, where, place in each:
        rows = function(*parts, contact_model(*how, angle), *place.values(), wavenumber)
        result[where] = rows.reshape(-1, *more)
    return shaped(result, (*shape, *more))


def implausible_notes(
    spectrum: Spectrum, rubber: Rubber, pressure: ArrayLike, velocity: ArrayLike
) -> tuple[Note, ...]:
    """Return a note where numbers are none of a road, a rubber or a rig."""
    stiff = rubber._stiffest
    numbers: dict[str, tuple[ArrayLike, Quantity]] = {
        "rms_height": (spectrum.rms_height, RMS_HEIGHT),
        "rms_slope": (spectrum.rms_slope, SLOPE),
        "q0": (spectrum.q0, FIRST_WAVENUMBER),
        "largest modulus": (stiff, MODULUS),
        "pressure": (pressure, PRESSURE),
        "velocity": (velocity, VELOCITY),
    }
    return implausible(numbers, stiff)
