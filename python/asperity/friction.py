"""Rubber friction: hysteresis (Eq. 22), adhesion (Eq. 23) and their sum (Eq. 24)."""

from dataclasses import field
from functools import partial
from typing import Any, Literal

import numpy as np
from numpy.typing import ArrayLike, NDArray

from asperity import _core
from asperity._core import InvalidInput
from asperity.adhesion import Adhesion, adhesion_core
from asperity.base.arguments import (
    MOST_THREADS,
    Array,
    Shape,
    brief,
    broadcast,
    choice,
    flag,
    frozen,
    of_kind,
    real_array,
    whole,
)
from asperity.base.table import Column, Columns, Table
from asperity.base.value import value
from asperity.contact import Form, Method, contact_model, surface_and_rubber
from asperity.correction import Correction
from asperity.heating import Heating
from asperity.rubber import MasterCurve, Rubber
from asperity.shift_factors import TemperatureShift, temperature_shift_core
from asperity.spectrum import Spectrum

__all__ = ["Friction", "friction"]

Branch = Literal["cold", "hot"]
BRANCHES = ("cold", "hot")  # in the order of the core's enumeration


def column(unit: str, meaning: str) -> Any:
    """Return a field that is a number a point, with what tables say of it."""
    return field(metadata={"unit": unit, "meaning": meaning})


class _WhenAsked:
    """A field that is computed when it is first asked for: its value, or a function for it."""

    def __set_name__(self, owner: type, name: str) -> None:
        self.name = name

    def __get__(self, instance: object, owner: type) -> Any:
        if instance is None:
            return None
        found = instance.__dict__.get(self.name)
        if callable(found):
            found = instance.__dict__[self.name] = found()
        return found

    def __set__(self, instance: object, given: Any) -> None:
        instance.__dict__[self.name] = given


@value
class Friction(Table):
    """What `friction` returns. Scalars for scalar arguments, else arrays.

    Attributes
    ----------
    mu : float or ndarray
        Total friction coefficient, hysteresis + adhesion [-].
    hysteresis, adhesion : float or ndarray
        mu_H of Eq. 22, mu_A of Eq. 23 [-].
    contact_area : float or ndarray
        A/A0 at q1 [-].
    shift_factor : float or ndarray
        p_T [-]; 1 where nothing is shifted, infinite without contact.
    pressure, velocity : float or ndarray
        As given, broadcast [Pa], [m/s].
    error_estimate : float or ndarray
        Absolute error of mu [-].
    extrapolated_share : float or ndarray
        Share of the hysteresis, as it is weighted, whose modulus lies outside of the measured
        frequencies [-], to 1e-4.
    model_error : float or ndarray
        Relative rms error of mu_H that this correction had on exact sliding contacts of Gaussian
        surfaces at such speeds and loads [-]; NaN where nothing is known: for other corrections
        than None, SFactor with gamma 0.4 or 0.5, NayakSFactor and PartialContact, for q1/q0 outside
        of 8 to 128, for loads sigma0 / (E* h') outside of 0.0015 to 0.6.
    temperature : float or ndarray, or None
        As given, broadcast [K]; with heating that of the roughness at q1. None without.
    notes : tuple of str
        Where the theory or its input leaves its range.
    wavenumber : ndarray, shape (n,), or None
        Where the contributions were asked for [1/m]; None without contributions=True, as the others
        below.
    dmu_dlnq : ndarray, shape (..., n), or None
        d mu_H / d ln q.
    decade_edges : ndarray, shape (m + 1,), or None
        Angular frequencies v q, powers of ten [rad/s].
    decade_share : ndarray, shape (..., m), or None
        Share of the hysteresis from each decade of v q; sums to 1.
    cold : Friction or None
        The same without the heat that friction makes; its `temperature` is the one given. None
        without heating, as the others below.
    macro_area : float or ndarray, or None
        P_m [-], the share of the surface that is heated.
    gain : float or ndarray, or None
        How much a rise of the temperature makes of itself [-]: the eigenvalue of largest size of
        the heat's fixed point. Below -1 plain iteration diverges.
    branches : int or ndarray, or None
        How many steady states there are, 1 but for a thermal runaway.
    temperature_profile : ndarray, shape (..., n), or None
        T [K] over `wavenumber`.
    sliding_length : float or ndarray, or None
        s0 [m], how far the rubber slides from rest until mu has come to within 1 / e of the heated
        one, by the history of the heat at a velocity that is held; to about 1 % of the contact's
        diameter. Computed when it is first asked for, some ten milliseconds a point.
    """

    # in the order of the core's `friction_columns`
    mu: Any = column("1", "friction coefficient")
    hysteresis: Any = column("1", "hysteresis")
    adhesion: Any = column("1", "adhesion")
    contact_area: Any = column("1", "real over nominal contact area")
    shift_factor: Any = column("1", "p_T")
    pressure: Any = column("Pa", "nominal pressure")
    velocity: Any = column("m/s", "sliding velocity")
    error_estimate: Any = column("1", "error estimate of mu")
    extrapolated_share: Any = column("1", "share of the hysteresis beyond the measured frequencies")
    model_error: Any = column("1", "relative error of mu seen in exact sliding contacts")
    temperature: Any = None
    notes: tuple[str, ...] = ()
    wavenumber: Array | None = None
    dmu_dlnq: Array | None = None
    decade_edges: Array | None = None
    decade_share: Array | None = None
    cold: "Friction | None" = None
    macro_area: Any = None
    gain: Any = None
    branches: Any = None
    temperature_profile: Array | None = None
    sliding_length: Any = _WhenAsked()

    def mu_at(self, distance: ArrayLike) -> Any:
        """Return the friction coefficient [-] after a `distance` s [m] slid from rest.

        mu + (mu_cold - mu) exp(-s / s0), s0 the `sliding_length`: the law of B. N. J. Persson
        (Rubber friction and tire dynamics, arXiv:1007.2713), both mu at
        the velocity of the point. It leaves out an undershoot of some per cent of the difference.
        Distances broadcast with the points. Without heating mu does not depend on it.
        """
        s = real_array(distance, "distance")
        if not (s >= 0).all():
            raise InvalidInput(f"distance = {brief(distance)}: must be 0 or more")
        if self.cold is None:
            mu = self.mu + 0 * s
        else:
            mu = self.mu + (self.cold.mu - self.mu) * np.exp(-s / self.sliding_length)
        return mu if np.ndim(mu) else float(mu)

    def _summary(self) -> dict[str, Any]:
        names = ("mu", "pressure", "velocity", "temperature", "contact_area", "error_estimate")
        shown = {name: getattr(self, name) for name in names if getattr(self, name) is not None}
        shape = {"shape": np.shape(self.mu)} if np.shape(self.mu) else {}
        return shape | shown | ({"notes": self.notes} if self.notes else {})

    def _columns(self) -> Columns:
        axes, sweeps = _axes(self)
        coordinates = {
            name: Column(*one, *_said(name)) for name, one in sweeps.items() if name in axes
        }
        variables = {
            name: Column(axes, getattr(self, name), *_said(name))
            for name in (*COLUMNS, *HEAT)
            if name not in coordinates and getattr(self, name) is not None
        }
        if self.cold is not None:
            variables["mu_cold"] = Column(axes, self.cold.mu, "1", "friction without its heat")
            if "temperature" not in coordinates:
                given = "temperature of the background"
                variables["background"] = Column(axes, self.cold.temperature, "K", given)
        if self.wavenumber is not None:
            coordinates["wavenumber"] = Column(("wavenumber",), self.wavenumber, "1/m")
            variables["dmu_dlnq"] = Column((*axes, "wavenumber"), _known(self.dmu_dlnq), "1")
            if self.temperature_profile is not None:
                profile = self.temperature_profile
                variables["temperature_profile"] = Column((*axes, "wavenumber"), profile, "K")
        return Columns(coordinates, variables, {"notes": list(self.notes)})

    def _draw(self, axes: Any) -> None:
        v, mu = np.atleast_1d(self.velocity), np.atleast_1d(self.mu)
        p = np.atleast_1d(self.pressure)
        pressures = np.unique(p)
        for pressure in pressures:
            at = p == pressure
            order = np.argsort(v[at])
            axes.plot(v[at][order], mu[at][order], label=f"{pressure:.4g} Pa")
        axes.set(xscale="log", xlabel="velocity [m/s]", ylabel="friction coefficient")
        if 1 < len(pressures) <= 8:
            axes.legend(title="pressure")


SWEPT = ("pressure", "velocity", "temperature")
HEAT = {
    "temperature": ("K", "temperature"),
    "macro_area": ("1", "share of the surface that is heated"),
    "gain": ("1", "gain of the heat"),
    "branches": ("1", "number of steady states"),
}
COLUMNS = tuple(name for name, one in Friction.__dataclass_fields__.items() if one.metadata)


def _said(name: str) -> tuple[str, str]:
    if name in HEAT:
        return HEAT[name]
    metadata = Friction.__dataclass_fields__[name].metadata
    return metadata["unit"], metadata["meaning"]


def _known(array: Array | None) -> Array:
    assert array is not None
    return array


def _axes(result: Friction) -> tuple[tuple[str, ...], dict[str, tuple[tuple[str, ...], Array]]]:
    """Return names for the axes of a result, and the sweeps along those that sweep one thing."""
    shape = np.shape(result.mu)
    names = [f"axis_{i}" for i in range(len(shape))]
    sweeps: dict[str, tuple[tuple[str, ...], Array]] = {}
    result = result if result.cold is None else result.cold  # whose temperature is the one given
    swept = [name for name in SWEPT if getattr(result, name) is not None]
    for name in swept:
        values = np.asarray(getattr(result, name))
        moving = [i for i in range(len(shape)) if not _constant(values, i)]
        if len(moving) == 1 and names[moving[0]].startswith("axis"):
            [axis] = moving
            line: Array = np.moveaxis(values, axis, -1).reshape(-1, shape[axis])[0]
            names[axis] = name
            sweeps[name] = ((name,), line)
    both = [i for i, name in enumerate(names) if name in sweeps]
    for i in both:  # an axis along which another moves too sweeps neither of them
        others = [name for name in swept if name != names[i]]
        if not all(_constant(np.asarray(getattr(result, other)), i) for other in others):
            del sweeps[names[i]]
            names[i] = f"axis_{i}"
    return tuple(names), sweeps


def _constant(values: NDArray[Any], axis: int) -> bool:
    return bool((values == values.take([0], axis=axis)).all())


def friction(
    spectrum: Spectrum,
    rubber: Rubber,
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
    threads: int = 1,
    temperature: ArrayLike | None = None,
    shift: TemperatureShift | None = None,
    heating: Heating | None = None,
    branch: Branch = "cold",
) -> Friction:
    """Return the friction coefficient of rubber sliding on a rough surface (Eqs 22-24).

    mu_H = (1/2) int q^3 C(q) (A/A0)(q) [S(q)] I1(v q) dq / ((1 - nu^2) sigma0). By parts this is
    4 (1 - nu^2) sigma0 (R F at q1 - int F dR) with R = I1 / I2 and F = int_0^G P S dG, on
    Gauss-Legendre panels as fine as rtol asks for.

    Parameters
    ----------
    spectrum : SelfAffineSpectrum or TabulatedSpectrum
    rubber : PronySeries or MasterCurve
    pressure, velocity : array_like
        sigma0 [Pa] and v [m/s], positive; they broadcast.
    poisson_ratio : float
        In [0, 0.5].
    correction : SFactor, NayakSFactor, PartialContact, AffineShift, LocalPeaks, \
GreenwoodWilliamson, PeaksThenGreenwoodWilliamson or None
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
        As above, or GSL's adaptive integration of that name to check it with, slower by hundreds of
        times.
    threads : int
        As many at most share the points, a hundred or more each. The numbers are the same for any
        of them.
    temperature : array_like, optional
        T [K], 150 or more; broadcasts with pressure and velocity. E(w) becomes E(a_T(T) w), as
        `rubber.shifted` does it; the adhesion of Eq. 23 stays as it is.
    shift : WLF, WlfFit, ArrheniusFit, ShiftFactors or MasterCurveBuild, optional
        a_T(T); `rubber` is the one at its reference temperature. By default the `shift_factors` of
        a master curve that knows them.
    heating : Heating, optional
        Friction warms the rubber to T(q) above `temperature`, and its modulus follows, as roughness
        of each wavenumber feels it: the fixed point of the model of B. N. J. Persson, J. Phys.:
        Condens. Matter 18, 7789 (2006). The error estimate covers quadrature, T(q) and fixed point.
        Greenwood-Williamson's model takes the modulus at T(q0). GSL's methods are refused.
    branch : {"cold", "hot"}
        Where the heat has several steady states, the one that sliding from rest reaches, or the
        hottest.

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
    law = _law(rubber, temperature, shift)
    given_at = {"pressure": pressure, "velocity": velocity}
    if temperature is not None:
        given_at["temperature"] = temperature
    shape, (p, v, *at) = broadcast(**given_at)
    model = contact_model(poisson_ratio, correction, form, rtol, method)
    parts = surface_and_rubber(spectrum, rubber)
    added = adhesion_core(adhesion)
    told = flag(contributions, "contributions")
    count = whole(threads, "threads", lowest=1, highest=MOST_THREADS)
    which = choice(branch, "branch", BRANCHES)
    t = at[0] if at else None
    points = (*parts, model, added, p, v, told, count, law, t)
    if heating is None:
        if which:
            raise InvalidInput('branch = "hot": needs heating=, without which there is one')
        result = _made(_core.friction(*points), shape)
        return result if t is None else _with(result, temperature=_shaped(t, shape))
    core = of_kind(heating, "heating", Heating)._core
    if t is None:
        raise InvalidInput(
            "heating: needs temperature= and shift=, from which the rubber is heated"
        )
    hot, cold, hottest, area, gain, branches, profile = _core.flash_friction(*points, core, which)
    given = {
        "cold": _with(_made(cold, shape), temperature=_shaped(t, shape)),
        "temperature": _shaped(hottest, shape),
        "macro_area": _shaped(area, shape),
        "gain": _shaped(gain, shape),
        "branches": _shaped(branches, shape),
    }
    result = _made(hot, shape)
    if result.wavenumber is not None:
        given["temperature_profile"] = frozen(profile).reshape(*shape, result.wavenumber.size)
    length = partial(_core.sliding_length, *parts, model, added, p, v, law, t, core)
    given["sliding_length"] = lambda: _shaped(length(), shape)
    return _with(result, **given)


def _with(result: Friction, **more: Any) -> Friction:
    return Friction._made({**result.__dict__, **more})


def _shaped(flat: Any, shape: Shape) -> Any:
    """Return numbers of the points in the shape of the arguments, read-only."""
    array = np.asarray(flat)
    return frozen(array.reshape(shape)) if shape else array.item()


def _made(parts: tuple[Any, ...], shape: Shape) -> Friction:
    """Return a result from the core's parts of it."""
    rows, notes, shares = parts
    columns = frozen(rows).reshape(-1, *shape) if shape else rows[:, 0].tolist()
    given: dict[str, Any] = dict(zip(COLUMNS, columns, strict=True), notes=notes)
    if shares is not None:
        q, density, edges, share = map(frozen, shares)
        given |= {"wavenumber": q, "dmu_dlnq": density.reshape(*shape, len(q))}
        given |= {"decade_edges": edges, "decade_share": share.reshape(*shape, len(edges) - 1)}
    return Friction._made(given)


def _law(rubber: Rubber, temperature: ArrayLike | None, shift: TemperatureShift | None) -> Any:
    """Return the shift as the core takes it, None without a temperature."""
    if temperature is None:
        if shift is not None:
            raise InvalidInput(f"shift = {brief(shift)}: needs temperature=, at which to take a_T")
        return None
    if shift is None and isinstance(rubber, MasterCurve):
        shift = rubber.shift_factors
    if shift is None:
        raise InvalidInput(f"temperature = {brief(temperature)}: needs shift=, which gives a_T(T)")
    return temperature_shift_core(shift)
