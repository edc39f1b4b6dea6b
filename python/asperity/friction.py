"""Rubber friction: hysteresis (Eq. 22), adhesion (Eq. 23) and their sum (Eq. 24)."""

from dataclasses import field
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from asperity import _core
from asperity.adhesion import Adhesion, adhesion_core
from asperity.base.arguments import (
    MOST_THREADS,
    Array,
    broadcast,
    flag,
    frozen,
    whole,
)
from asperity.base.table import Column, Columns, Table
from asperity.base.value import value
from asperity.contact import Form, Method, contact_model, surface_and_rubber
from asperity.correction import Correction
from asperity.rubber import Rubber
from asperity.spectrum import Spectrum

__all__ = ["Friction", "friction"]


def column(unit: str, meaning: str) -> Any:
    """Return a field that is a number a point, with what tables say of it."""
    return field(metadata={"unit": unit, "meaning": meaning})


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
    notes: tuple[str, ...] = ()
    wavenumber: Array | None = None
    dmu_dlnq: Array | None = None
    decade_edges: Array | None = None
    decade_share: Array | None = None

    def _summary(self) -> dict[str, Any]:
        names = ("mu", "pressure", "velocity", "contact_area", "error_estimate")
        shown = {name: getattr(self, name) for name in names}
        shape = {"shape": np.shape(self.mu)} if np.shape(self.mu) else {}
        return shape | shown | ({"notes": self.notes} if self.notes else {})

    def _columns(self) -> Columns:
        axes, sweeps = _axes(self)
        coordinates = {
            name: Column(*one, *_said(name)) for name, one in sweeps.items() if name in axes
        }
        variables = {
            name: Column(axes, getattr(self, name), *_said(name))
            for name in COLUMNS
            if name not in coordinates
        }
        if self.wavenumber is not None:
            coordinates["wavenumber"] = Column(("wavenumber",), self.wavenumber, "1/m")
            variables["dmu_dlnq"] = Column((*axes, "wavenumber"), _known(self.dmu_dlnq), "1")
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


COLUMNS = tuple(name for name, one in Friction.__dataclass_fields__.items() if one.metadata)


def _said(name: str) -> tuple[str, str]:
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
    for name in ("pressure", "velocity"):
        values = np.asarray(getattr(result, name))
        moving = [i for i in range(len(shape)) if not _constant(values, i)]
        if len(moving) == 1 and names[moving[0]].startswith("axis"):
            [axis] = moving
            line: Array = np.moveaxis(values, axis, -1).reshape(-1, shape[axis])[0]
            names[axis] = name
            sweeps[name] = ((name,), line)
    both = [i for i, name in enumerate(names) if name in sweeps]
    for i in both:  # an axis along which the other moves too sweeps neither of them
        other = {"pressure": "velocity", "velocity": "pressure"}[names[i]]
        if not _constant(np.asarray(getattr(result, other)), i):
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

    Returns
    -------
    Friction

    Raises
    ------
    InvalidInput
    OutOfRange
        v q0 or v q1 outside of a measured master curve; the message has the velocities that are
        allowed.
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
    shape, (p, v) = broadcast(pressure=pressure, velocity=velocity)
    model = contact_model(poisson_ratio, correction, form, rtol, method)
    parts = surface_and_rubber(spectrum, rubber)
    added = adhesion_core(adhesion)
    told = flag(contributions, "contributions")
    count = whole(threads, "threads", lowest=1, highest=MOST_THREADS)
    rows, notes, shares = _core.friction(*parts, model, added, p, v, told, count)
    columns = frozen(rows).reshape(-1, *shape) if shape else rows[:, 0].tolist()
    given: dict[str, Any] = dict(zip(COLUMNS, columns, strict=True), notes=notes)
    if shares is not None:
        q, density, edges, share = map(frozen, shares)
        given |= {"wavenumber": q, "dmu_dlnq": density.reshape(*shape, len(q))}
        given |= {"decade_edges": edges, "decade_share": share.reshape(*shape, len(edges) - 1)}
    return Friction._made(given)
