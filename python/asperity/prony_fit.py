"""A Prony series through a master curve."""

import warnings
from collections.abc import Mapping
from typing import Any, ClassVar, Literal

import numpy as np

from asperity import _core
from asperity.base.arguments import ABSENT, Conversion, Vector, choice, number_or_none, of_kind
from asperity.base.diagnostics import Note
from asperity.base.table import Columns
from asperity.base.value import around, value
from asperity.dma import MasterCurveBuild
from asperity.rubber import MasterCurve, PronySeries
from asperity.shift_factors import HasShiftFactors, ShiftFactors, shift_factors_of

PronyExtrapolation = Literal["prony"]


def _goes_beyond(extrapolation: Any) -> bool:
    return choice(extrapolation, "extrapolation", ("prony", None)) == 0


@value
class PronyFit(PronySeries):
    """A PronySeries [Pa] that was fitted, and how well it follows the measurement (`fit_prony`).

    Parameters
    ----------
    equilibrium_modulus, moduli, relaxation_times
        As in PronySeries.
    storage_residual, loss_residual : float
        Relative root mean square of E' and of E'' of the rows that it was fitted to about it [-].
        The rows of a `MasterCurveBuild` are a smooth curve through its points, which scatter more:
        `MasterCurveBuild.residual` is what that curve leaves of them.
    causal : bool
        False where E' and E'' contradict each other (Kramers-Kronig) by more than their noise.
    lowest_frequency, highest_frequency : float
        Those that it was fitted on [rad/s]; `shifted` moves them. Beyond them it raises OutOfRange.
    extrapolation : {None, "prony"}
        "prony": the series may be asked beyond them. What comes from there is then counted by the
        `extrapolated_share` of a result, whose notes say so.
    notes : tuple of Note
        What a reader must know, of the master curve too. Every result that is computed with it has
        them.
    shift_factors : ShiftFactors, optional
        Those of the master curve that it was fitted to, which `friction` takes at a temperature.
    """

    moduli: Vector
    relaxation_times: Vector
    storage_residual: float
    loss_residual: float
    causal: bool
    lowest_frequency: float
    highest_frequency: float
    extrapolation: PronyExtrapolation | None = None
    notes: tuple[Note, ...] = ()
    shift_factors: Conversion[HasShiftFactors | None, ShiftFactors | None] = ABSENT
    _beside: ClassVar[Mapping[str, Any]] = dict.fromkeys(
        ("storage_residual", "loss_residual", "causal", "extrapolation", "notes", "shift_factors")
    )

    def __post_init__(self) -> None:
        self._take()
        names = ("equilibrium_modulus", "moduli", "relaxation_times")
        plain = PronySeries(**{name: getattr(self, name) for name in names})
        known = self.lowest_frequency, self.highest_frequency, _goes_beyond(self.extrapolation)
        self._set(_core=plain._core.fitted_on(*known))
        if self.shift_factors is not None:
            self._set(shift_factors=shift_factors_of(self.shift_factors))

    def _drawn_range(self) -> tuple[float, float]:
        return self.lowest_frequency, self.highest_frequency

    def _summary(self) -> dict[str, Any]:
        shown = self._arguments()
        del shown["shift_factors"]
        return shown

    def _columns(self) -> Columns:
        columns = super()._columns()
        facts: dict[str, Any] = {**columns.attributes, **self._summary()}
        del facts["moduli"], facts["relaxation_times"]
        return Columns(columns.coordinates, columns.variables, facts)


def fit_prony(
    master_curve: MasterCurve | MasterCurveBuild,
    *,
    modes_per_decade: float | None = None,
    residual: float | None = None,
    extrapolation: PronyExtrapolation | None = None,
) -> PronyFit:
    """Fit a Prony series to the rows of a master curve.

    Non-negative least squares with relative weights. The relaxation times are equally spaced in the
    logarithm, from a decade below to a decade above those of the measured frequencies. The series
    is known on those frequencies only.

    Parameters
    ----------
    master_curve : MasterCurve or MasterCurveBuild
    modes_per_decade : float, optional
        By default the fewest that reach the noise of the rows.
    residual : float, optional
        The fewest that reach this relative root mean square of E' and E'' together instead.
    extrapolation : {None, "prony"}
        "prony": the series may be asked beyond the measured frequencies, where nothing holds it.

    Returns
    -------
    PronyFit
        A PronySeries [Pa] with its residuals. Prony series are causal: where none follows the rows,
        E' and E'' contradict each other; `causal` is then False, and a UserWarning says why that
        may be.

    Raises
    ------
    InvalidInput
    NotConverged
        No number of modes reaches `residual`.
    """
    measured: Any = ()  # points of a build, which its rows are means of
    if isinstance(master_curve, MasterCurveBuild):
        measured = master_curve.points.angular_frequency
        master_curve = master_curve.master_curve
    curve = of_kind(master_curve, "master_curve", MasterCurve)
    beyond = _goes_beyond(extrapolation)
    core, storage_residual, loss_residual, causal, notes = _core.fit_prony(
        curve._core,
        number_or_none(modes_per_decade, "modes_per_decade"),
        number_or_none(residual, "residual"),
        beyond,
    )
    w = np.append(measured, curve.angular_frequency[[0, -1]])
    core = core.fitted_on(w.min(), w.max(), beyond)
    own = {note.identity for note in notes}  # a build says of its curve what a fit to it does
    if not causal:
        for note in notes:
            warnings.warn(note, UserWarning, stacklevel=2)
    return around(
        PronyFit,
        core,
        storage_residual=storage_residual,
        loss_residual=loss_residual,
        causal=causal,
        extrapolation=extrapolation,
        notes=(*(one for one in curve.notes if one.identity not in own), *notes),
        shift_factors=curve.shift_factors,
    )
