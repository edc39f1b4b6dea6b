"""What `friction` returns: a table of points, with pictures of them."""

from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from asperity.base.arguments import Array, Shape, broadcast, frozen, known, real_array
from asperity.base.diagnostics import Argument, InvalidInput, Note, Value, refusal
from asperity.base.parameters import column
from asperity.base.table import Column, Columns, Table, declared_columns
from asperity.base.value import value
from asperity.results.gradients import Gradients
from asperity.spectrum import stated


class _WhenAsked:
    """A field that is computed when it is first asked for: its value, or a function for it."""

    def __init__(self, default: Any) -> None:
        self.default = default

    def __set_name__(self, owner: type, name: str) -> None:
        self.name = name

    def __get__(self, instance: object, owner: type) -> Any:
        if instance is None:
            return self.default
        entry = instance.__dict__.get(self.name)
        if callable(entry):
            entry = instance.__dict__[self.name] = entry()
        return entry

    def __set__(self, instance: object, entry: Any) -> None:
        instance.__dict__[self.name] = entry


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
        Absolute error of mu [-]; that of `lateral` is not above it.
    extrapolated_share : float or ndarray
        Share of the hysteresis, as it is weighted, whose modulus lies outside of the measured
        frequencies [-], to 1e-4.
    model_error : float or ndarray
        Relative rms error of mu_H that this correction had on exact sliding contacts of Gaussian
        surfaces at such speeds and loads [-]; NaN where nothing is known: for corrections by a p_T,
        for S in Eq. 22 with another gamma than 0.4 and 0.5, for maps whose heights are far from
        Gaussian (a note says so), for q1/q0 outside of 3 to 16384, for loads sigma0 / (E* h')
        outside of 0.0015 to 0.6 (0.005 to 0.3 where q1/q0 is above 128). Over spectra that know
        directions for S, for axis ratios above 6, q1/q0 outside of 4 to 128 and loads outside of
        0.02 to 0.3.
    lateral : float or ndarray
        The force across the sliding over the load [-]: on the moving body it is
        -sigma0 (mu s + lateral n), s the direction of sliding and n that turned by 90 degrees from
        x towards y. 0 where the spectrum is a mean over directions, but with ScanContact.
    direction : float or ndarray, or None
        Of sliding, as given, broadcast [rad]. None where no contact of this kind depends on it.
    temperature : float or ndarray, or None
        As given, broadcast [K]; with heating that of the roughness at q1. None without.
    notes : tuple of Note
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
        diameter. Computed when it is first asked for, some ten milliseconds a point. None without
        heating, and with GSL's methods, which know nothing of the history.
    gradients : Gradients or None
        Slopes of mu, where they were asked for.
    preparation : str or None
        Window and trend of the spectrum's heights, where `power_spectrum` made it.
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
    lateral: Any = column("1", "force across the sliding over the load")
    direction: Any = column("rad", "direction of sliding, from x towards y", default=None)
    temperature: Any = column("K", "temperature", default=None)
    notes: tuple[Note, ...] = ()
    wavenumber: Array | None = None
    dmu_dlnq: Array | None = None
    decade_edges: Array | None = None
    decade_share: Array | None = None
    cold: "Friction | None" = None
    macro_area: Any = column("1", "share of the surface that is heated", default=None)
    gain: Any = column("1", "gain of the heat", default=None)
    branches: Any = column("1", "number of steady states", default=None)
    temperature_profile: Array | None = None
    sliding_length: Any = _WhenAsked(None)
    gradients: Gradients | None = None
    preparation: str | None = None

    def mu_at(self, distance: ArrayLike) -> Any:
        """Return the friction coefficient [-] after a `distance` s [m] slid from rest.

        mu + (mu_cold - mu) exp(-s / s0), s0 the `sliding_length`: the law of B. N. J. Persson
        (Rubber friction and tire dynamics, arXiv:1007.2713), both mu at
        the velocity of the point. It leaves out an undershoot of some per cent of the difference.
        Distances broadcast with the points. Without heating mu does not depend on it. InvalidInput
        for a result with heating by GSL's methods, which has no `sliding_length`.
        """
        s = real_array(distance, "distance")
        if not (s >= 0).all():
            raise refusal("distance", distance, "0 or more")
        broadcast(distance=s, mu=self.mu)  # refuses shapes that do not
        if self.cold is None:
            mu = self.mu + 0 * s
        elif self.sliding_length is None:
            raise InvalidInput(
                Argument("distance"),
                ": needs the sliding_length, which friction gives with method = gauss alone",
            )
        else:
            mu = self.mu + (self.cold.mu - self.mu) * np.exp(-s / self.sliding_length)
        return mu if np.ndim(mu) else float(mu)

    def _summary(self) -> dict[str, Any]:
        names = ("mu", "pressure", "velocity", "temperature", "contact_area", "error_estimate")
        shown = {name: getattr(self, name) for name in names if getattr(self, name) is not None}
        shape = {"shape": np.shape(self.mu)} if np.shape(self.mu) else {}
        return (
            shape | shown | stated(self.preparation) | ({"notes": self.notes} if self.notes else {})
        )

    def _columns(self) -> Columns:
        axes, sweeps = _axes(self)
        swept = sweeps.items()
        coordinates = {name: Column(*one, *MEANINGS[name]) for name, one in swept if name in axes}
        variables = {
            name: Column(axes, getattr(self, name), *said)
            for name, said in MEANINGS.items()
            if name not in coordinates and getattr(self, name) is not None
        }
        if self.cold is not None:
            variables["mu_cold"] = Column(axes, self.cold.mu, "1", "friction without its heat")
            if "temperature" not in coordinates:
                meaning = "temperature of the background"
                variables["background"] = Column(axes, self.cold.temperature, "K", meaning)
        if self.wavenumber is not None:
            coordinates["wavenumber"] = Column(("wavenumber",), self.wavenumber, "1/m")
            variables["dmu_dlnq"] = Column((*axes, "wavenumber"), known(self.dmu_dlnq), "1")
            if self.temperature_profile is not None:
                profile = self.temperature_profile
                variables["temperature_profile"] = Column((*axes, "wavenumber"), profile, "K")
        attributes = {"notes": list(self.notes)} | stated(self.preparation)
        return Columns(coordinates, variables, attributes)

    def _draw(self, axes: Any) -> None:
        from asperity.draw.friction import draw_result  # here: `import asperity` is to be quick

        draw_result(axes, self)

    @property
    def _is_polar(self) -> bool:
        from asperity.draw.friction import is_polar

        return is_polar(self)


_SMALLEST = 1e-4
SWEPT = ("pressure", "velocity", "direction", "temperature")
MEANINGS = {name: (unit, said) for name, (unit, said, _) in declared_columns(Friction).items()}
HEAT = {name: MEANINGS[name] for name in ("temperature", "macro_area", "gain", "branches")}
COLUMNS = {name: said for name, said in MEANINGS.items() if name not in {"direction", *HEAT}}


def small_friction_notes(mu: ArrayLike) -> tuple[Note, ...]:
    """Return a note where mu is below a tenth of what a lubricated bearing has at all points, but
    for a rubber without loss, which has none."""
    largest = mu if type(mu) is float else float(np.max(mu, initial=0))
    if not 0 < largest < _SMALLEST:
        return ()
    about = "mu is ", Value(f"{largest:.3g}", (largest,)), f" at most, below {_SMALLEST:g}"
    said = ", less than rubber has on anything rough: heights, modulus or pressure are in another"
    return (Note(*about, f"{said} unit", code="small-friction"),)


def joined(
    parts: Sequence[Friction], shape: Shape, places: NDArray[np.intp] | None = None
) -> Friction:
    """Return one result of the points of several, in a new shape; without contributions, notes.

    `places` are those of the points, one part after another; by default they are in order.
    """
    first = parts[0]
    names = [name for name in MEANINGS if getattr(first, name) is not None]
    order = slice(None) if places is None else np.argsort(places)
    columns = {
        name: frozen(np.concatenate([np.ravel(getattr(part, name)) for part in parts])[order])
        for name in names
    }
    cold = None if first.cold is None else joined([known(part.cold) for part in parts], shape)
    shaped = {name: column.reshape(shape) for name, column in columns.items()}
    return Friction._made(shaped, cold=cold, preparation=first.preparation)


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
