"""From isotherms to a rubber: the master curve that they share."""

from collections.abc import Iterable
from dataclasses import field
from typing import Any, Literal

import numpy as np
from numpy.typing import ArrayLike, NDArray

from asperity import _core
from asperity.base.arguments import (
    ABSENT,
    Array,
    Conversion,
    Vector,
    flag,
    frozen,
    many,
    number,
    of_kind,
    quoted,
    real_array,
    vector,
)
from asperity.base.diagnostics import Argument, InvalidInput, Note, refusal, unfit
from asperity.base.parameters import column
from asperity.base.table import Column, Columns, Table
from asperity.base.value import around, value
from asperity.rubber import Extrapolation, MasterCurve, PronySeries, Rubber, extrapolation_number
from asperity.shift_factors import HasShiftFactors, ShiftFactors, shift_factors_of
from asperity.sweeps import Isotherm, draw_moduli

REDUCED = "Reduced frequency $a_T\\, \\omega$ [rad/s]"


def _require_length(array: NDArray[Any], name: str, length: int) -> None:
    if array.size != length:
        raise InvalidInput(Argument(name), f" has {array.size} entries; it must have {length}")


@value
class MasterPoints(Table):
    """The measured points of a master curve, in rising frequency.

    Parameters
    ----------
    angular_frequency : array_like, shape (n,)
        Reduced, a_T w [rad/s].
    storage_modulus, loss_modulus : array_like, shape (n,)
        Reduced, E' / b_T and E'' / b_T [Pa].
    isotherm : array_like of int, shape (n,)
        The isotherm that a point comes from: its index in rising temperature.
    """

    angular_frequency: Vector = column("rad/s", "", "angular_frequency")
    storage_modulus: Vector = column("Pa", "E'", "angular_frequency")
    loss_modulus: Vector = column("Pa", "E''", "angular_frequency")
    isotherm: Conversion[ArrayLike, NDArray[np.int64]] = column(
        "1", "index of the isotherm", "angular_frequency"
    )

    def __post_init__(self) -> None:
        for name, rows in self._arguments().items():
            self._set(**{name: vector(rows, name)})
            _require_length(getattr(self, name), name, self.angular_frequency.size)
        origin = self.isotherm
        if not np.all((origin >= 0) & (origin < 2**53) & (origin == np.floor(origin))):
            raise refusal("isotherm", origin, "whole numbers, 0 or more")
        self._set(isotherm=frozen(origin.astype(np.int64)))

    def _draw(self, axes: Any) -> None:
        moduli = self.storage_modulus, self.loss_modulus
        draw_moduli(axes, self.angular_frequency, *moduli, label=REDUCED, styles=("o", "^"))


@value
class MasterCurveBuild(HasShiftFactors):
    """What `build_master_curve` returns: a master curve, and a_T [-] over temperature [K].

    Parameters
    ----------
    master_curve : MasterCurve
        At T_ref.
    shift_factors : ShiftFactors
        Those of the isotherms.
    b_T : array_like, shape (n,)
        Vertical shifts [-]: moduli were divided by them.
    points : MasterPoints
        Every measured point, reduced, with its isotherm.
    residual : float
        Root mean square of ln E' and ln E'' about the master spline [-].
    covariance : array_like, shape (n, n), optional
        That of log10_a_T [-], zero at the isotherm nearest to T_ref.
    notes : tuple of Note
        What a reader must know: averaged points, small overlaps, undetermined shifts, outliers, and
        what the other vertical shift would do.

    Attributes
    ----------
    reference_temperature : float
        T_ref [K].
    temperature, log10_a_T : ndarray, shape (n,)
        Temperatures of the isotherms [K], rising, and their shift factors [-].
    standard_deviation : ndarray, shape (n,)
        Standard deviation of log10_a_T against the isotherm nearest to T_ref [-]. Above 0.3 the
        data do not fix the shift: see `undetermined` and `notes`.
    """

    master_curve: MasterCurve
    shift_factors: Conversion[HasShiftFactors, ShiftFactors]
    b_T: Vector  # noqa: N815
    points: MasterPoints
    residual: float
    covariance: Conversion[ArrayLike | None, NDArray[Any] | None] = ABSENT
    notes: tuple[Note, ...] = ()
    reference_temperature: float = field(init=False)
    temperature: Array = field(init=False)
    log10_a_T: Array = field(init=False)  # noqa: N815
    standard_deviation: Array = field(init=False)

    def __post_init__(self) -> None:
        self._take()
        shifts = shift_factors_of(self.shift_factors)
        deviation = shifts.standard_deviation
        self._set(
            shift_factors=shifts,
            reference_temperature=shifts.reference_temperature,
            temperature=shifts.temperature,
            log10_a_T=shifts.log10_a_T,
            standard_deviation=frozen(np.empty(0)) if deviation is None else deviation,
        )
        n = self.temperature.size
        _require_length(self.b_T, "b_T", n)
        if np.any(self.points.isotherm >= n):
            highest = self.points.isotherm.max()
            raise InvalidInput(f"points.isotherm has {highest}; it must be from 0 to {n - 1}")
        if self.covariance is not None:
            covariance = np.array(real_array(self.covariance, "covariance"))
            if covariance.shape != (n, n) or not np.isfinite(covariance).all():
                problem = f"must be finite, of shape ({n}, {n})"
                raise unfit("covariance", covariance, problem)
            self._set(covariance=frozen(covariance))
        self._set(_core=self.shift_factors._core)

    def _covariance_of_shifts(self) -> Array:
        return np.empty(0) if self.covariance is None else self.covariance

    @property
    def undetermined(self) -> NDArray[np.bool_]:
        """Whether the data leave a shift open: its standard deviation exceeds 0.3 decades."""
        return frozen(self.standard_deviation > 0.3)

    def _summary(self) -> dict[str, Any]:
        return {
            "reference_temperature": self.reference_temperature,
            "temperature": self.temperature,
            "log10_a_T": self.log10_a_T,
            "residual": self.residual,
            "notes": self.notes,
        }

    def _columns(self) -> Columns:
        columns = self.shift_factors._columns()
        b_T = Column(("temperature",), self.b_T, "1", "vertical shift")  # noqa: N806
        variables = {**columns.variables, "b_T": b_T}
        facts = {**columns.attributes, "residual": self.residual, "notes": self.notes}
        return Columns(columns.coordinates, variables, facts)

    def _draw(self, axes: Any) -> None:
        """Draw the measured points, reduced; `shift_factors.plot()` draws a_T."""
        self.points._draw(axes)
        axes.set_title(f"{self.reference_temperature:.4g} K")


AnyRubber = Rubber | MasterCurveBuild


def rubber_of(rubber: AnyRubber) -> Rubber:
    solid: Any = of_kind(rubber, "rubber", PronySeries, MasterCurve, MasterCurveBuild)
    return solid.master_curve if isinstance(solid, MasterCurveBuild) else solid


def build_master_curve(
    isotherms: Iterable[Isotherm],
    *,
    reference_temperature: float,
    vertical_shift: Literal["T/T_ref"] | ArrayLike | None = None,
    shift_factors: HasShiftFactors | None = None,
    smooth: bool = True,
    extrapolation: Extrapolation | None = None,
) -> MasterCurveBuild:
    """Shift isotherms in frequency until neighbours overlap (the article's Section 5.1).

    E(w; T) = b_T E(a_T w; T_ref), for E' and E'' together: neighbours in pairs first, then all
    shifts at once, with one penalised cubic spline of ln E' and one of ln E'' in ln w that all
    isotherms share. Shifts and smoothness maximise the restricted likelihood (REML), whose
    determinant makes an overlap that is given up no gain; residuals that are correlated within
    isotherms make the data count by as much less. a_T falls with temperature.

    Parameters
    ----------
    isotherms : iterable of Isotherm
        At two temperatures or more, in any order. Neighbours should overlap by 0.3 decades.
    reference_temperature : float
        T_ref [K], within the measured ones.
    vertical_shift : {None, "T/T_ref"} or array_like
        b_T: 1, T / T_ref, or one for each isotherm in rising temperature. Moduli are divided by it.
        It moves a_T, by more than a decade on some rubbers: `notes` says by how much.
    shift_factors : ShiftFactors, optional
        a_T from outside, instead of a fit.
    smooth : bool
        True: the rows are the master spline at ten frequencies a decade. False: they are the
        points, those within 0.02 decades averaged.
    extrapolation : {None, "power-law", "clamp"}
        As in MasterCurve.

    Returns
    -------
    MasterCurveBuild

    Raises
    ------
    InvalidInput
        There is one temperature only, or neighbours have no modulus in common.
    OutOfRange
        `reference_temperature` [K] lies outside of the isotherms, or a temperature outside of
        `shift_factors`.
    """
    # numbers of the core's enumeration: 0 for b_T = 1, 1 for T / T_ref, 2 for a table
    kind, table = 0, np.empty(0)
    if isinstance(vertical_shift, str):
        if vertical_shift != "T/T_ref":
            allowed = 'must be None, "T/T_ref" or an array of b_T'
            raise unfit("vertical_shift", vertical_shift, allowed, quoted(vertical_shift))
        kind = 1
    elif vertical_shift is not None:
        kind, table = 2, vector(vertical_shift, "vertical_shift")
    parts = _core.build_master_curve(
        [isotherm._core for isotherm in many(isotherms, "isotherms", Isotherm)],
        number(reference_temperature, "reference_temperature"),
        kind,
        table,
        None if shift_factors is None else shift_factors_of(shift_factors)._core,
        flag(smooth, "smooth"),
        extrapolation_number(extrapolation),
    )
    return _built(parts, extrapolation)


def _built(parts: tuple[Any, ...], extrapolation: Extrapolation | None) -> MasterCurveBuild:
    curve, shifts, b_T, points, residual, covariance, notes = parts  # noqa: N806
    shift_factors = around(ShiftFactors, shifts)
    beside = {"extrapolation": extrapolation, "shift_factors": shift_factors, "notes": notes}
    return MasterCurveBuild(
        master_curve=around(MasterCurve, curve, **beside),
        shift_factors=shift_factors,
        b_T=b_T,
        points=MasterPoints(**dict(zip(MasterPoints.__match_args__, points, strict=True))),
        residual=residual,
        covariance=covariance,
        notes=notes,
    )


def draw_master_curve(build: MasterCurveBuild, seed: int) -> MasterCurveBuild:
    """Return a build as its errors would have it: a_T drawn from `covariance`, the points moved.

    The coefficients of the spline through the points are drawn from their own covariance. The curve
    has the extrapolation of the build's, or a power law, and reaches further at both ends: drawn
    shifts move what was measured, and a draw is to answer wherever the build's curve does.
    """
    parts = _core.draw_master_curve(_parts(build), seed)
    return _built(parts, build.master_curve.extrapolation or "power-law")


def master_curve_modes(
    build: MasterCurveBuild, angular_frequency: Array
) -> tuple[Array, Array, Array]:
    """Return what the independent unit normals behind a draw change to first order, a row each: ln
    E' and ln E'' at these frequencies [rad/s], and log10 a_T of the isotherms."""
    result: tuple[Array, Array, Array] = _core.master_curve_modes(_parts(build), angular_frequency)
    return result


def _parts(build: MasterCurveBuild) -> tuple[Any, ...]:
    if build.covariance is None:
        raise InvalidInput(Argument("build"), ": has no covariance to draw from")
    return (
        build.master_curve._core,
        build.shift_factors._core,
        build.b_T,
        *build.points._arguments().values(),
        build.residual,
        build.covariance,
    )
