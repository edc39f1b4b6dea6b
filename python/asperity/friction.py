"""Rubber friction: hysteresis (Eq. 22), adhesion (Eq. 23) and their sum (Eq. 24)."""

from collections.abc import Mapping
from functools import partial
from typing import Any, Literal

import numpy as np
from numpy.typing import ArrayLike

from asperity import _core
from asperity.adhesion import Adhesion, adhesion_core
from asperity.base.arguments import (
    MOST_THREADS,
    Shape,
    broadcast,
    choice,
    flag,
    frozen,
    number,
    of_kind,
    whole,
)
from asperity.base.diagnostics import Argument, InvalidInput, Note, fatal_first, unfit
from asperity.contact import Form, Method, contact_model, implausible_notes
from asperity.correction import Correction
from asperity.dma import AnyRubber, rubber_of
from asperity.heating import Heating
from asperity.results.directions import along_x_notes, over_directions
from asperity.results.friction import COLUMNS, HEAT, small_friction_notes
from asperity.results.friction import Friction as Friction
from asperity.results.gradients import Gradients as Gradients
from asperity.results.gradients import of_core as gradients_of_core
from asperity.results.heat_notes import law_notes
from asperity.scan_contact import ScanContact
from asperity.self_affine_fit import AnySpectrum, spectrum_of
from asperity.shift_factors import TemperatureShift, temperature_shift_core
from asperity.sweeps import StrainFactors

Branch = Literal["cold", "hot"]  # in the order of the core's enumeration
ROUGHLY = 1e-3  # rtol of the heat of which a note says the size


@over_directions
def friction(
    spectrum: AnySpectrum,
    rubber: AnyRubber,
    *,
    pressure: ArrayLike,
    velocity: ArrayLike,
    poisson_ratio: float = 0.5,
    correction: Correction | None = None,
    adhesion: Adhesion | None = None,
    form: Form = "exact",
    rtol: float = 1e-6,
    contributions: bool = False,
    method: Method = "gauss",
    strain_factors: StrainFactors | None = None,
    threads: int = 1,
    temperature: ArrayLike | None = None,
    shift: TemperatureShift | None = None,
    heating: Heating | None = None,
    branch: Branch = "cold",
    gradients: bool = False,
    direction: ArrayLike = 0.0,
) -> Friction:
    """Return the friction coefficient of rubber sliding on a rough surface (Eqs 22-24).

    mu_H = (1/2) int q^3 C(q) (A/A0)(q) [S(q)] I1(v q) dq / ((1 - nu^2) sigma0). By parts this is
    4 (1 - nu^2) sigma0 (R F at q1 - int F dR) with R = I1 / I2 and F = int_0^G P S dG, on
    Gauss-Legendre panels as fine as rtol asks for.

    Parameters
    ----------
    spectrum : SelfAffineSpectrum, TabulatedSpectrum or SelfAffineFit
        Of a fit its law.
    rubber : PronySeries, MasterCurve or MasterCurveBuild
        Of a build its master curve. The notes of the rubber are among those of the result.
    pressure, velocity : array_like
        sigma0 [Pa] and v [m/s], positive; they broadcast.
    poisson_ratio : float
        In [0, 0.5].
    correction : object or None
        One of the classes in `asperity.correction`, for instance `PartialContact()`.
        None is plain Persson.
    adhesion : Adhesion, optional
        Without it the adhesion is 0.
    form : {"exact", "interpolated"}
        Of A/A0, see `contact_area`.
    rtol : float
        Relative tolerance of mu, 1e-12 to 0.1.
    contributions : bool
        Also give dmu/dlnq and the share of each decade of frequency.
    method : {"gauss", "qag", "qags", "cquad"}
        "gauss" is as above; the others are GSL's adaptive integration of that name, to check it
        with, slower by hundreds of times; not with PartialContact, ScanContact or heating.
    strain_factors : StrainFactors, optional
        The modulus at the strain of each magnification; by default that of small strain.
    threads : int
        As many at most share the points, a hundred or more each. The numbers are the same for any
        of them.
    temperature : array_like, optional
        T [K], 150 or more; broadcasts with pressure and velocity. E(w) becomes E(a_T(T) w), as
        `rubber.shifted` does it; the adhesion of Eq. 23 stays as it is.
    shift : WLF, WlfFit, ArrheniusFit, ShiftFactors or MasterCurveBuild, optional
        a_T(T); `rubber` is the one at its reference temperature. By default the `shift_factors` of
        a rubber that carries them, as the master curve of a build and its Prony fit do.
    heating : Heating, optional
        Friction warms the rubber to T(q) above `temperature`, and its modulus follows, as roughness
        of each wavenumber feels it: the fixed point of the model of B. N. J. Persson, J. Phys.:
        Condens. Matter 18, 7789 (2006). The error estimate covers quadrature, T(q) and fixed point.
        Greenwood-Williamson's model takes the modulus at T(q0). Not with GSL's methods.
    branch : {"cold", "hot"}
        Where the heat has several steady states, the one that sliding from rest reaches, or the
        hottest.
    gradients : bool
        Also give the slopes of mu over all of these, as `.gradients`, at the cost of some ten
        curves; with `ScanContact` and heating at that of six more contacts a point. Not with GSL's
        methods.
    direction : array_like
        Of sliding [rad], from x (a map's second axis) towards y (its first); broadcasts with
        pressure and velocity. It matters to `ScanContact`, whose scan is turned,
        and to spectra that know directions (`SelfAffineSpectrum(axis_ratio=, lay=)`,
        `power_spectrum(map, directional=True)`): sums over the plane of wavevectors then stand for
        I1 and I2, by as many harmonics as rtol asks for, and `lateral` is the force across. Not
        with GSL's methods. One number where heating, contributions or gradients are asked for.

    Returns
    -------
    Friction

    Raises
    ------
    InvalidInput
    OutOfRange
        v q0 or v q1 outside of a measured master curve, the message has the velocities that are
        allowed; or a temperature at which `shift` has no a_T; with heating also where T(q) takes
        v q a_T out of the measured range, and above 700 K.
    NotConverged

    Examples
    --------
    >>> import asperity
    >>> road = asperity.SelfAffineSpectrum(rms_height=265.7e-6, hurst=0.87, q0=2000, q1=2e4)
    >>> rubber = asperity.PronySeries(
    ...     equilibrium_modulus=3e6, moduli=[1e9], relaxation_times=[1e-6]
    ... )
    >>> result = asperity.friction(road, rubber, pressure=81e3, velocity=[1e-3, 1e-2])
    >>> result.mu.round(4)
    array([0.002 , 0.0205])
    """
    angle = number(direction, "direction")
    surface, solid = spectrum_of(spectrum), rubber_of(rubber)
    law = known_shift(solid, shift)
    at_points = {"pressure": pressure, "velocity": velocity}
    if temperature is not None:
        at_points["temperature"] = temperature
    check_temperature(temperature, shift, law)
    shape, (p, v, *at) = broadcast(**at_points)
    model = contact_model(poisson_ratio, correction, form, rtol, method, strain_factors, angle)
    parts = surface._core, solid._core
    added = adhesion_core(adhesion)
    with_contributions = flag(contributions, "contributions")
    slopes = flag(gradients, "gradients")
    count = whole(threads, "threads", lowest=1, highest=MOST_THREADS)
    which = choice(branch, "branch", Branch)
    t: Any = at[0] if at else None
    heat = None if heating is None else of_kind(heating, "heating", Heating)._core
    if heat is None and which:
        raise unfit("branch", "hot", "needs heating=, without which there is one", '"hot"')
    if heat is not None and t is None:
        raise InvalidInput(
            Argument("heating"), ": needs temperature= and shift=, from which the rubber is heated"
        )
    shifted_by = None if law is None or t is None else temperature_shift_core(law)
    points = (*parts, model, added, p, v, with_contributions, count, shifted_by, t)
    more: dict[str, Any] = {"preparation": getattr(surface, "preparation", None)}
    if surface.is_directional or isinstance(correction, ScanContact):
        more["direction"] = _shaped(np.full(np.size(p), angle), shape)
    if t is not None:
        more["temperature"] = _shaped(t, shape)
    if heat is None:
        result = _core.friction(*points)  # which refuses what cannot be
        of_law = () if t is None else law_notes(law, t)
    else:
        result, cold, hottest, *of_heat, profile = _core.flash_friction(*points, heat, which)
        without = {"temperature": more["temperature"]}
        more["cold"] = _made(cold, shape, solid.notes, without, law_notes(law, t))
        of_law = law_notes(law, np.append(t, hottest))
        for name, column in zip(HEAT, (hottest, *of_heat), strict=True):
            more[name] = _shaped(column, shape)
        if contributions:
            more["temperature_profile"] = frozen(profile).reshape(*shape, len(result[2][0]))
        length = partial(_core.sliding_length, *parts, model, added, p, v, shifted_by, t, heat)
        more["sliding_length"] = lambda: _shaped(length(), shape)
    if slopes:
        of = _core.gradients(*parts, model, added, p, v, count, shifted_by, t, heat, which)
        more["gradients"] = gradients_of_core(of, shape)
        of_law = (*_held_ratio(correction), *of_law)
    absurd, along_x = implausible_notes(surface, solid, p, v), along_x_notes(surface, angle)
    return _made(result, shape, (*solid.notes, *absurd, *along_x), more, of_law)


def _held_ratio(correction: Correction | None) -> tuple[Note, ...]:
    if not isinstance(correction, ScanContact):
        return ()
    text = (
        "slopes over pressure, velocity and temperature are those of the scan's contacts; "
        "all others hold their ratio to PartialContact"
    )
    return (Note(text, code="held-ratio"),)


def _shaped(flat: Any, shape: Shape) -> Any:
    """Return numbers of the points in the shape of the arguments, read-only."""
    array = np.asarray(flat)
    return frozen(array.reshape(shape)) if shape else array.item()


def _made(
    parts: tuple[Any, ...],
    shape: Shape,
    of_input: tuple[Note, ...],
    more: Mapping[str, Any],
    last: tuple[Note, ...],
) -> Friction:
    """Return a result from the core's parts of it and more, with the notes of what was given and
    others after all of them."""
    rows, of_contact, shares = parts
    columns = frozen(rows).reshape(-1, *shape) if shape else rows[:, 0].tolist()
    fields: dict[str, Any] = dict(zip(COLUMNS, columns, strict=True), **more)
    notes = fatal_first((*small_friction_notes(fields["mu"]), *of_input, *of_contact))
    fields["notes"] = (*notes, *last)
    if shares is not None:
        q, density, edges, share = map(frozen, shares)
        fields |= {"wavenumber": q, "dmu_dlnq": density.reshape(*shape, len(q))}
        fields |= {"decade_edges": edges, "decade_share": share.reshape(*shape, len(edges) - 1)}
    return Friction._made(fields)


def known_shift(rubber: AnyRubber, shift: TemperatureShift | None) -> TemperatureShift | None:
    """Return the shift that is given, or else the one that the rubber carries, if it does."""
    return getattr(rubber, "shift_factors", None) if shift is None else shift


def check_temperature(
    temperature: ArrayLike | None, shift: TemperatureShift | None, law: TemperatureShift | None
) -> None:
    if temperature is None and shift is not None:
        raise unfit("shift", shift, "needs temperature=, at which to take a_T")
    if temperature is not None and law is None:
        raise unfit("temperature", temperature, "needs shift=, which gives a_T(T)")
