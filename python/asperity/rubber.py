"""Rubber: its complex modulus, a Prony series or a measured master curve, and angular integrals."""

import warnings
from collections.abc import Callable, Iterable, Mapping
from functools import cached_property
from typing import Any, ClassVar, Literal, Self, get_args

import numpy as np
from numpy.typing import ArrayLike, NDArray

from asperity import _core
from asperity.base.arguments import (
    ABSENT,
    Array,
    Conversion,
    Vector,
    broadcast,
    choice,
    many,
    number,
    over,
    real_array,
    shaped,
    whole,
)
from asperity.base.diagnostics import Argument, InvalidInput, Note
from asperity.base.parameters import column, parameter
from asperity.base.quantities import RELAXED_MODULUS
from asperity.base.table import Column, Columns, Table
from asperity.base.value import CoreValue, like, value
from asperity.shift_factors import HasShiftFactors, ShiftFactors, shift_factors_of
from asperity.sweeps import StrainSweep, draw_moduli

Extrapolation = Literal["power-law", "clamp"]  # in the order of the core's enumeration


def extrapolation_number(name: Any) -> int | None:
    at = choice(name, "extrapolation", (*get_args(Extrapolation), None))
    return None if name is None else at


def _two_over(
    frequency: ArrayLike, compute: Callable[[Array], tuple[NDArray[Any], NDArray[Any]]]
) -> tuple[Any, Any]:
    array = real_array(frequency, "angular_frequency")
    first, second = compute(np.ascontiguousarray(array).ravel())
    return shaped(first, array.shape), shaped(second, array.shape)


class _HasModulus(Table):
    """What every rubber can do. Its `notes` go into every result that is computed with it."""

    @property
    def notes(self) -> tuple[Note, ...]:
        """What a reader must know of how it was made; a series given by hand has none."""
        return ()

    def modulus(self, angular_frequency: ArrayLike) -> Any:
        """Return the modulus E' + i E'' [Pa] at an `angular_frequency` [rad/s] of any shape.

        Outside of its range a measured master curve raises OutOfRange, and so does a fit.
        """
        return over(angular_frequency, "angular_frequency", self._core.modulus)

    def shifted(self, a_T: float) -> Self:  # noqa: N803
        """Return the rubber at another temperature: E(w) becomes E(a_T w), a_T > 1 is colder.

        The frequencies of a measurement or a fit become w / a_T; the new rubber has no
        `shift_factors`.
        """
        held = {"shift_factors": None} if "shift_factors" in self._beside else {}
        return like(self, self._core.shifted(number(a_T, "a_T")), **held)

    def angular_integrals(self, angular_frequency: ArrayLike) -> tuple[Any, Any]:
        """Return (I1 [Pa], I2 [Pa^2]) at an `angular_frequency` w = v q [rad/s] of any shape.

        I1 = int_0^2pi cos(phi) Im E(w cos phi) dphi is the integral of Eq. 22, and
        I2 = int_0^2pi \\|E(w cos phi)\\|^2 dphi that of Eq. 7.
        """
        return _two_over(angular_frequency, self._core.angular_integrals)

    def angular_harmonics(self, angular_frequency: ArrayLike, count: int) -> tuple[Any, Any, Any]:
        """Return harmonics m = 0 to `count` of the angular integrals.

        A ring of a directional spectrum needs them.

        Parameters
        ----------
        angular_frequency : array_like
            w = v q [rad/s], of any shape.
        count : int
            The highest m, 0 to 256.

        Returns
        -------
        along : ndarray
            I1_m = int_0^2pi cos(phi) cos(2 m phi) Im E(w cos phi) dphi [Pa], of the force along the
            sliding; shape of the frequencies + (count + 1,).
        across : ndarray
            The same with sin(phi) sin(2 m phi) [Pa], of the force across it.
        square : ndarray
            I2_m = int_0^2pi cos(2 m phi) \\|E(w cos phi)\\|^2 dphi [Pa^2].

        Raises
        ------
        InvalidInput
        OutOfRange
            As of `modulus`.

        Notes
        -----
        Closed forms of a Prony series; of a master curve to 1e-9 of I1 and I2. They do not depend
        on the surface: a spectrum C(q) (1 + 2 sum_m [a_m cos 2 m phi + b_m sin 2 m phi]), phi from
        the velocity, has I2 + 2 sum_m a_m I2_m in place of the I2 of Eq. 7.
        """
        array = real_array(angular_frequency, "angular_frequency")
        most = whole(count, "count", highest=256)
        flat = np.ascontiguousarray(array).ravel()
        loss, square = (
            column.reshape(most + 1, flat.size)
            for column in self._core.angular_harmonics(flat, most)
        )
        before, after = loss[:-1] / 2, loss[1:] / 2
        parts = (
            np.concatenate([loss[:1], before + after]),
            np.concatenate([0 * loss[:1], before - after]),
            square,
        )
        along, across, squares = (part.T.reshape(*array.shape, most + 1) for part in parts)
        return along, across, squares

    def extrapolated_shares(self, angular_frequency: ArrayLike) -> tuple[Any, Any]:
        """Return the shares of I1 and I2 [-] that come from outside of the measured frequencies.

        `angular_frequency` w [rad/s] may have any shape; w cos(phi) always runs to zero. Below the
        lowest one a master curve takes E' as constant and E'' as proportional to w, a fitted Prony
        series goes on. A series given by hand has no range, and no shares.
        """
        return _two_over(angular_frequency, self._core.extrapolated_shares)


@value
class PronySeries(_HasModulus, CoreValue):
    """E(w) = E_inf + sum_k E_k i w tau_k / (1 + i w tau_k).

    The angular integrals are closed forms. Without terms the rubber is elastic.

    Parameters
    ----------
    equilibrium_modulus : float
        E_inf [Pa], not negative.
    moduli : array_like, shape (n,)
        E_k [Pa], positive.
    relaxation_times : array_like, shape (n,)
        tau_k [s], positive, in any order.

    Examples
    --------
    >>> from asperity import PronySeries
    >>> rubber = PronySeries(equilibrium_modulus=1e6, moduli=[1e9], relaxation_times=[1e-6])
    >>> rubber.modulus(1e6)
    (501000000+500000000j)
    """

    equilibrium_modulus: float = parameter(RELAXED_MODULUS)
    moduli: Vector = parameter(unit="Pa")
    relaxation_times: Vector = parameter(unit="s")

    @cached_property
    def _stiffest(self) -> float:
        """The largest |E| [Pa] that the data reach."""
        return self.equilibrium_modulus + float(np.sum(self.moduli))

    def _columns(self) -> Columns:
        rows = ("relaxation_time",)
        return Columns(
            {"relaxation_time": Column(rows, self.relaxation_times, "s", "tau_k")},
            {"modulus": Column(rows, self.moduli, "Pa", "E_k")},
            {"equilibrium_modulus": self.equilibrium_modulus},
        )

    def _drawn_range(self) -> tuple[float, float]:
        times = self.relaxation_times if self.relaxation_times.size else np.ones(1)
        return 0.1 / times.max(), 10 / times.min()

    def _draw(self, axes: Any) -> None:
        w = np.geomspace(*self._drawn_range(), 400)
        modulus = self.modulus(w)
        draw_moduli(axes, w, modulus.real, modulus.imag)


@value
class MasterCurve(_HasModulus):
    """A measured complex modulus.

    Between the rows ln E' and ln E'' over ln w are Steffen's monotone interpolants (M. Steffen,
    Astron. Astrophys. 239, 443 (1990)).

    Parameters
    ----------
    angular_frequency : array_like, shape (n,)
        w = 2 pi f [rad/s], strictly rising, n >= 2.
    storage_modulus, loss_modulus : array_like, shape (n,)
        E', E'' [Pa], positive.
    extrapolation : {None, "power-law", "clamp"}
        How the curve goes on over at most one decade at either end: not at all, with the slope that
        ln E' and ln E'' have at the end, or constant.
    shift_factors : ShiftFactors, optional
        Those of the isotherms behind the curve, or the build that has them. `at_strain` places
        strain sweeps by them, and `friction` takes them at a temperature.
    notes : tuple of Note
        What a reader must know of how it was made, those of a build for instance. Every result that
        is computed with it has them too.

    Raises
    ------
    InvalidInput
    OutOfRange
        The methods raise it where they are asked outside of the measured range.
    """

    angular_frequency: Vector = column("rad/s", "", "angular_frequency")
    storage_modulus: Vector = column("Pa", "E'", "angular_frequency")
    loss_modulus: Vector = column("Pa", "E''", "angular_frequency")
    extrapolation: Extrapolation | None = None
    shift_factors: Conversion[HasShiftFactors | None, ShiftFactors | None] = ABSENT
    notes: tuple[Note, ...] = ()
    _beside: ClassVar[Mapping[str, Any]] = {
        "extrapolation": None,
        "shift_factors": None,
        "notes": (),
    }

    def __post_init__(self) -> None:
        self._take()
        rows = self.angular_frequency, self.storage_modulus, self.loss_modulus
        self._set(_core=_core.MasterCurve(*rows, extrapolation_number(self.extrapolation)))
        if self.shift_factors is not None:
            self._set(shift_factors=shift_factors_of(self.shift_factors))

    @cached_property
    def _stiffest(self) -> float:
        """The largest |E| [Pa] that the data reach."""
        return float(np.max(np.hypot(self.storage_modulus, self.loss_modulus)))

    def at_strain(
        self,
        strain: float,
        sweeps: Iterable[StrainSweep],
        *,
        shift_factors: HasShiftFactors | None = None,
    ) -> "MasterCurve":
        """Return the master curve at a large strain (the article's Section 5.1).

        E' and E'' are each multiplied by their own ratio E(strain) / E(0.5 %). Every sweep gives
        the ratios at its place a_T(T) w on the curve. Between the sweeps the logarithm of a ratio
        is interpolated (Steffen); beyond the first and the last it is held, and a UserWarning says
        so.

        Parameters
        ----------
        strain : float
            Amplitude [-], 0.5 is 50 %.
        sweeps : iterable of StrainSweep
        shift_factors : ShiftFactors, optional
            Those of the small strain; by default those that the curve was built with.

        Raises
        ------
        InvalidInput
            There are no shift factors.
        OutOfRange
            A sweep lies at a temperature outside of theirs, or the strain outside of a sweep's.
        """
        size = number(strain, "strain")
        known = self.shift_factors if shift_factors is None else shift_factors_of(shift_factors)
        if known is None:
            problem = "is missing; the curve does not know at which temperature it holds"
            raise InvalidInput(Argument("shift_factors"), f": {problem}")
        cores = [sweep._core for sweep in many(sweeps, "sweeps", StrainSweep)]
        core, notes = _core.at_strain(self._core, known._core, size, cores)
        for note in notes:
            warnings.warn(note, UserWarning, stacklevel=2)
        return like(self, core, shift_factors=known, notes=(*self.notes, *notes))

    def _summary(self) -> dict[str, Any]:
        shown = self._arguments()
        shifts, notes = shown.pop("shift_factors"), shown.pop("notes")
        known = {} if shifts is None else {"reference_temperature": shifts.reference_temperature}
        return shown | known | ({"notes": notes} if notes else {})

    def _draw(self, axes: Any) -> None:
        draw_moduli(axes, self.angular_frequency, self.storage_modulus, self.loss_modulus)


Rubber = PronySeries | MasterCurve


def effective_modulus(
    *,
    modulus: ArrayLike,
    poisson_ratio: ArrayLike,
    modulus_2: ArrayLike = np.inf,
    poisson_ratio_2: ArrayLike = 0.0,
) -> Any:
    """Return E* [Pa] of two bodies, 1 / E* = (1 - nu^2) / E + (1 - nu_2^2) / E_2 (Eq. 15).

    Parameters
    ----------
    modulus, modulus_2 : array_like
        E, E_2 [Pa], positive. By default the second body is rigid.
    poisson_ratio, poisson_ratio_2 : array_like
        nu, nu_2 [-], in [0, 0.5].

    Returns
    -------
    float or ndarray
        In the shape to which the arguments broadcast.

    Examples
    --------
    >>> from asperity import effective_modulus
    >>> effective_modulus(modulus=3e6, poisson_ratio=0.5)
    4000000.0
    """
    shape, columns = broadcast(
        modulus=modulus,
        poisson_ratio=poisson_ratio,
        modulus_2=modulus_2,
        poisson_ratio_2=poisson_ratio_2,
    )
    return shaped(_core.effective_modulus(*columns), shape)
