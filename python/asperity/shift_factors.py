"""Shift factors over temperature, and the laws that are fitted to them."""

from collections.abc import Mapping
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from asperity import _core
from asperity.base.arguments import ABSENT, Array, OptionalVector, Vector, brief, number, over
from asperity.base.diagnostics import Argument, InvalidInput, must_be, refusal
from asperity.base.parameters import column, parameter
from asperity.base.quantities import DECADES, TEMPERATURE
from asperity.base.table import Table
from asperity.base.value import CoreValue, Value, value


class _Errors:
    """A field that holds standard errors by name. Everybody who asks gets a copy."""

    def __set_name__(self, owner: type, name: str) -> None:
        self.name = name

    def __get__(self, instance: object, owner: type) -> dict[str, float]:
        if instance is None:
            raise AttributeError(self.name)  # tells dataclass that there is no default
        return dict(instance.__dict__[self.name])

    def __set__(self, instance: object, errors: Mapping[str, float]) -> None:
        if not isinstance(errors, Mapping) or not all(isinstance(name, str) for name in errors):
            raise refusal(self.name, errors, "a dict of numbers")
        checked = {
            name: number(error, f"{self.name}[{brief(name)}]") for name, error in errors.items()
        }
        instance.__dict__[self.name] = checked


class _Law(Value):
    """What a law of the shift factor can do."""

    def log10_a_T(self, temperature: ArrayLike) -> Any:  # noqa: N802
        """Return log10 a_T [-] at a `temperature` [K] of any shape.

        One below 150 K is refused: it was most likely given in Celsius.
        """
        return over(temperature, "temperature", lambda t: _core.shift_at(self._core, t)[0])

    def log10_a_T_slope(self, temperature: ArrayLike) -> Any:  # noqa: N802
        """Return d log10 a_T / dT [1/K] at a `temperature` [K] of any shape."""
        return over(temperature, "temperature", lambda t: _core.shift_at(self._core, t)[1])


class _FittedLaw(_Law):
    """A law that knows the temperatures it was fitted on."""

    lowest_temperature: float | None
    highest_temperature: float | None

    def __post_init__(self) -> None:
        self._take()
        ends = ("lowest_temperature", "highest_temperature")
        lowest, highest = self.lowest_temperature, self.highest_temperature
        if (lowest is None) != (highest is None):
            known, missing = ends if highest is None else ends[::-1]
            raise must_be(missing, f"given where {known} is")
        if lowest is not None and highest is not None and not 0 < lowest < highest:
            raise refusal(
                "lowest_temperature",
                lowest,
                f"positive and below highest_temperature = {highest:g}",
                text=f"{lowest:g}",
            )
        names = self.__match_args__
        law = [getattr(self, name) for name in names[: names.index("standard_errors")]]
        self._set(_core=getattr(_core, type(self).__name__)(*law))


@value
class WLF(_Law, CoreValue):
    """The law of Williams, Landel and Ferry, by constants that are known.

    log10 a_T = -c1 (T - T_ref) / (c2 + T - T_ref) (M. L. Williams, R. F. Landel, J. D. Ferry, J.
    Am. Chem. Soc. 77, 3701 (1955)). At T_ref - c2 and below it has no a_T, and its methods raise
    OutOfRange.

    Parameters
    ----------
    c1 : float
        Constant of the law [-], positive.
    c2 : float
        Constant of the law [K], positive.
    reference_temperature : float
        T_ref [K], where a_T = 1.

    Examples
    --------
    >>> from asperity import WLF
    >>> law = WLF(c1=8.86, c2=101.6, reference_temperature=293.15)
    >>> round(law.log10_a_T(273.15), 3)
    2.172
    """

    c1: float = parameter(DECADES, key_name="wlf_c1")
    c2: float = parameter(unit="K", key_name="wlf_c2")
    reference_temperature: float = parameter(TEMPERATURE)


@value
class WlfFit(_FittedLaw):
    """The law of Williams, Landel and Ferry through shift factors, as `fit_wlf` returns it.

    log10 a_T = -c1 (T - T_ref) / (c2 + T - T_ref).

    Parameters
    ----------
    c1 : float
        [-].
    c2 : float
        [K].
    reference_temperature : float
        T_ref [K].
    standard_errors : dict
        {"c1": [-], "c2": [K]}, from the scatter about the fit.
    residual : float
        Root mean square of log10 a_T about the fit [-].
    lowest_temperature, highest_temperature : float, optional
        Those that it was fitted on [K]. Results that use the law beyond them say so in a note.
    """

    c1: float
    c2: float
    reference_temperature: float
    standard_errors: _Errors = _Errors()
    residual: float
    lowest_temperature: float | None = None
    highest_temperature: float | None = None


@value
class ArrheniusFit(_FittedLaw):
    """Arrhenius' law through shift factors, as `fit_arrhenius` returns it.

    ln a_T = (E_a / R) (1 / T - 1 / T_ref).

    Parameters
    ----------
    activation_energy : float
        E_a [J/mol].
    reference_temperature : float
        T_ref [K].
    standard_errors : dict
        {"activation_energy": [J/mol]}, from the scatter about the fit.
    residual : float
        Root mean square of log10 a_T about the fit [-].
    lowest_temperature, highest_temperature : float, optional
        Those that it was fitted on [K]. Results that use the law beyond them say so in a note.
    """

    activation_energy: float
    reference_temperature: float
    standard_errors: _Errors = _Errors()
    residual: float
    lowest_temperature: float | None = None
    highest_temperature: float | None = None


class HasShiftFactors(Table):
    """What shift factors can do, alone or in a build. `_core` is the core's ShiftFactors."""

    reference_temperature: Any
    temperature: Any
    log10_a_T: Any  # noqa: N815
    standard_deviation: Any

    def shift_factor(self, temperature: ArrayLike) -> Any:
        """Return a_T [-] at temperatures [K] of any shape.

        Steffen's monotone interpolant of log10 a_T. Outside of the measured temperatures it raises
        OutOfRange.
        """
        return over(temperature, "temperature", self._core.shift_factor)

    def _covariance_of_shifts(self) -> Array:
        """Return that of log10_a_T; empty where it is not known."""
        return np.empty(0)

    def fit_wlf(self) -> WlfFit:
        """Fit log10 a_T = -c1 (T - T_ref) / (c2 + T - T_ref) by least squares.

        The law is that of M. L. Williams, R. F. Landel, J. D. Ferry, J. Am. Chem. Soc. 77, 3701
        (1955). Fewer than 4 temperatures raise InvalidInput.
        """
        c1, c2, c1_error, c2_error, residual = self._core.fit_wlf(self._covariance_of_shifts())
        return WlfFit(
            c1=c1,
            c2=c2,
            reference_temperature=self.reference_temperature,
            standard_errors={"c1": c1_error, "c2": c2_error},
            residual=residual,
            **self._fitted_on(),
        )

    def fit_arrhenius(self) -> ArrheniusFit:
        """Fit ln a_T = (E_a / R) (1 / T - 1 / T_ref) by least squares."""
        energy, error, residual = self._core.fit_arrhenius(self._covariance_of_shifts())
        return ArrheniusFit(
            activation_energy=energy,
            reference_temperature=self.reference_temperature,
            standard_errors={"activation_energy": error},
            residual=residual,
            **self._fitted_on(),
        )

    def _fitted_on(self) -> dict[str, float]:
        ends = float(self.temperature[0]), float(self.temperature[-1])
        return dict(zip(("lowest_temperature", "highest_temperature"), ends, strict=True))


@value
class ShiftFactors(HasShiftFactors):
    """Shift factors over temperature, measured or from a table.

    Parameters
    ----------
    reference_temperature : float
        T_ref [K], where a_T = 1.
    temperature : array_like, shape (n,)
        T [K], strictly rising, n >= 2.
    log10_a_T : array_like, shape (n,)
        [-]; above 0 below T_ref.
    standard_deviation : array_like, shape (n,), optional
        That of log10_a_T [-].
    """

    reference_temperature: float
    temperature: Vector = column("K", "", "temperature")
    log10_a_T: Vector = column("1", "shift factor", "temperature")  # noqa: N815
    standard_deviation: OptionalVector = column(
        "1", "standard deviation of log10_a_T", "temperature", default=ABSENT
    )
    _facts = ("reference_temperature",)

    def __post_init__(self) -> None:
        self._take()
        deviation = np.empty(0) if self.standard_deviation is None else self.standard_deviation
        self._set(
            _core=_core.ShiftFactors(
                self.reference_temperature, self.temperature, self.log10_a_T, deviation
            )
        )

    def _draw(self, axes: Any) -> None:
        deviation = self.standard_deviation
        bars = None if deviation is None else 2 * deviation
        label = None if bars is None else "± 2 standard deviations"
        axes.errorbar(self.temperature, self.log10_a_T, bars, fmt="o-", capsize=3, label=label)
        axes.set(xlabel="Temperature $T$ [K]", ylabel="$\\log_{10} a_T$ [-]")
        if label:
            axes.legend()


def shift_factors_of(shifts: Any) -> ShiftFactors:
    if isinstance(shifts, ShiftFactors):
        return shifts
    if isinstance(shifts, HasShiftFactors):
        return shifts.shift_factors  # type: ignore[attr-defined, no-any-return]
    allowed = "a ShiftFactors or what build_master_curve returned"
    raise refusal("shift_factors", shifts, allowed)


TemperatureShift = WLF | WlfFit | ArrheniusFit | HasShiftFactors


def temperature_shift_core(shift: Any) -> Any:
    if isinstance(shift, _Law | HasShiftFactors):
        vertical = getattr(shift, "b_T", None)
        if vertical is not None and np.any(vertical != 1):
            problem = "the modulus is shifted by a_T alone; give its shift_factors to leave b_T out"
            span = f"{vertical.min():.3g} to {vertical.max():.3g}"
            raise InvalidInput(Argument("shift"), f": its build has b_T from {span}, and {problem}")
        return shift._core
    kinds = "a WLF, a WlfFit, an ArrheniusFit, a ShiftFactors or what build_master_curve returned"
    raise refusal("shift", shift, kinds)
