"""Sweeps of frequency and of strain, as dynamic mechanical analysis measures them, and how strain
softens a rubber."""

from collections.abc import Iterable
from dataclasses import field
from typing import Any

from asperity import _core
from asperity.base.arguments import (
    ABSENT,
    Array,
    Conversion,
    OptionalVector,
    Vector,
    frozen,
    many,
    notes_of,
    number,
    number_or_none,
    of_kind,
)
from asperity.base.diagnostics import Note, refusal
from asperity.base.parameters import column
from asperity.base.table import Table
from asperity.base.value import CoreValue, value


def draw_moduli(
    axes: Any,
    x: Array,
    storage: Array,
    loss: Array,
    *,
    label: str = "Angular frequency $\\omega$ [rad/s]",
    styles: tuple[str, str] = ("-", "-"),
) -> None:
    axes.loglog(x, storage, styles[0], color="C0", markersize=3, label="$E$′")
    axes.loglog(x, loss, styles[1], color="C1", markersize=3, label="$E$″")
    axes.set(xlabel=label, ylabel="Modulus [Pa]")
    axes.legend()


@value
class Isotherm(Table):
    """A frequency sweep at one temperature and small strain.

    Points within 1 % of each other in frequency are averaged in the logarithm; `notes` says so.

    Parameters
    ----------
    temperature : float
        T [K], 100 or more.
    angular_frequency : array_like, shape (n,)
        w = 2 pi f [rad/s], in any order; four different ones or more.
    storage_modulus, loss_modulus : array_like, shape (n,)
        E', E'' [Pa], positive. Where rubber was measured in shear, E = 3 G.
    notes : tuple of str, optional
        Only for rows that come from an Isotherm: they rise, and are taken as they are.

    Attributes
    ----------
    angular_frequency, storage_modulus, loss_modulus : ndarray
        The rows after averaging, in rising frequency.
    notes : tuple of Note
        What was done to the points.

    Raises
    ------
    InvalidInput
        The message names the row.
    """

    temperature: float
    angular_frequency: Vector = column("rad/s", "", "angular_frequency")
    storage_modulus: Vector = column("Pa", "E'", "angular_frequency")
    loss_modulus: Vector = column("Pa", "E''", "angular_frequency")
    notes: Conversion[Iterable[str] | None, tuple[Note, ...]] = ABSENT
    _facts = ("temperature", "notes")

    def __post_init__(self) -> None:
        taken = self._take()
        notes = None if self.notes is None else notes_of(self.notes, "notes")
        core = _core.Isotherm(*taken.values(), notes)
        rows = {name: frozen(getattr(core, name)) for name in (*taken,)[1:]}
        self._set(_core=core, **rows, notes=core.notes)

    def _draw(self, axes: Any) -> None:
        moduli = self.storage_modulus, self.loss_modulus
        draw_moduli(axes, self.angular_frequency, *moduli, styles=("o-", "^:"))
        axes.set_title(f"{self.temperature:.4g} K")


@value
class StrainSweep(Table, CoreValue):
    """A sweep of strain at one temperature and one frequency.

    Parameters
    ----------
    temperature : float
        T [K], 100 or more.
    angular_frequency : float
        w = 2 pi f [rad/s].
    strain : array_like, shape (n,)
        Amplitudes [-], strictly rising; 0.5 is 50 %.
    storage_modulus, loss_modulus : array_like, shape (n,)
        E', E'' [Pa], positive.

    Raises
    ------
    InvalidInput
        The message names the row.
    """

    temperature: float
    angular_frequency: float
    strain: Vector = column("1", "", "strain")
    storage_modulus: Vector = column("Pa", "E'", "strain")
    loss_modulus: Vector = column("Pa", "E''", "strain")
    _facts = ("temperature", "angular_frequency")

    def _draw(self, axes: Any) -> None:
        moduli = self.storage_modulus, self.loss_modulus
        draw_moduli(axes, self.strain, *moduli, label="Strain amplitude [-]", styles=("o-", "^:"))
        axes.set_title(f"{self.temperature:.4g} K, {self.angular_frequency:.3g} rad/s")


@value
class StrainFactors(Table):
    """Factors of E' and E'' over strain, for the strain that each magnification brings.

    E'(w, q) = f(eps(q)) E'(w) and E''(w, q) = g(eps(q)) E''(w), eps(q) = strain_per_slope h'(q),
    h'(q) the rms slope of all roughness up to q. f and g are linear in strain between the rows and
    constant beyond the last; a row (0, 1, 1) is put before a first row above 0. So I1 becomes g I1,
    and I2 becomes f^2 and g^2 times the parts of it that E' and E'' have.

    It is the field's practice for filled rubber, whose modulus falls with strain (Payne), and no
    derivation: what `strain_per_slope` is, and which kind of strain the sweeps have (the amplitude
    in shear or in tension, or peak to peak), is for the caller to state. Greenwood-Williamson's
    separation keeps the modulus of small strain, since its asperities begin the roughness.

    Parameters
    ----------
    strain : array_like, shape (n,)
        Amplitudes [-] from 0 or more, strictly rising; 0.5 is 50 %.
    storage, loss : array_like, shape (n,)
        f, g [-], positive: E' and E'' over those of the master curve's strain. g may rise first.
    strain_per_slope : float
        Strain per rms slope [-], of order 0.5.
    storage_error, loss_error : array_like, shape (n,), optional
        Standard deviations of ln f and ln g, which `friction_band` draws from.

    Attributes
    ----------
    notes : tuple of Note
        What `strain_factors` found.

    Raises
    ------
    InvalidInput
        The message names the row.

    Examples
    --------
    >>> import asperity
    >>> road = asperity.SelfAffineSpectrum(rms_height=265.7e-6, hurst=0.87, q0=2000, q1=2e4)
    >>> rubber = asperity.PronySeries(
    ...     equilibrium_modulus=3e6, moduli=[1e9], relaxation_times=[1e-6]
    ... )
    >>> payne = asperity.StrainFactors(strain=[0.01, 0.1, 1], storage=[0.9, 0.6, 0.3],
    ...                                loss=[1.1, 0.8, 0.4])
    >>> point = {"pressure": 81e3, "velocity": 1e-2}
    >>> soft = asperity.contact_area(road, rubber, strain_factors=payne, **point)
    >>> round(soft / asperity.contact_area(road, rubber, **point), 2)
    2.0
    """

    strain: Vector = column("1", "strain amplitude", "strain", key_name="strain_amplitudes")
    storage: Vector = column("1", "factor of E'", "strain", key_name="storage_factors")
    loss: Vector = column("1", "factor of E''", "strain", key_name="loss_factors")
    strain_per_slope: float = 0.5
    storage_error: OptionalVector = ABSENT
    loss_error: OptionalVector = ABSENT
    notes: tuple[Note, ...] = field(default=(), init=False)
    _facts = ("strain_per_slope",)

    def __post_init__(self) -> None:
        taken = self._take()
        rows = [taken[name] for name in ("strain", "storage", "loss", "strain_per_slope")]
        self._set(_core=_core.StrainFactors(*rows))
        for name in ("storage_error", "loss_error"):
            error = getattr(self, name)
            if error is not None and (error.shape != self.strain.shape or not (error >= 0).all()):
                raise refusal(name, error, f"{self.strain.size} numbers of 0 or more")

    def _draw(self, axes: Any) -> None:
        axes.semilogx(self.strain, self.storage, "o-", color="C0", markersize=3, label="$E$′")
        axes.semilogx(self.strain, self.loss, "^:", color="C1", markersize=3, label="$E$″")
        axes.set(xlabel="Strain amplitude [-]", ylabel="Over that of small strain")
        axes.legend()


def strain_core(strain_factors: StrainFactors | None) -> Any:
    if strain_factors is None:
        return None
    return of_kind(strain_factors, "strain_factors", StrainFactors)._core


def strain_factors(
    sweeps: Iterable[StrainSweep],
    *,
    reference_strain: float | None = None,
    strain_per_slope: float = 0.5,
) -> StrainFactors:
    """Return the factors of E' and E'' over strain that sweeps of strain have.

    Each sweep is divided by its own E' and E'' at the reference, by ln E linear in ln strain. Of
    several, whatever their temperatures and frequencies, ln f and ln g are means, which beyond the
    end of one go on by what the others change; a note tells how far they differ, and so do
    `storage_error` and `loss_error`.

    Parameters
    ----------
    sweeps : iterable of StrainSweep
        With the kind of strain that `strain_per_slope` is meant for.
    reference_strain : float, optional
        That of the master curve [-], at and below which the factors are 1; by default the lowest
        that all sweeps have.
    strain_per_slope : float
        As for `StrainFactors`.

    Returns
    -------
    StrainFactors

    Raises
    ------
    InvalidInput
    OutOfRange
        The sweeps do not hold the reference.
    """
    cores = [sweep._core for sweep in many(sweeps, "sweeps", StrainSweep)]
    reference = number_or_none(reference_strain, "reference_strain")
    per_slope = number(strain_per_slope, "strain_per_slope")
    strain, storage, loss, *errors, notes = _core.strain_factors(cores, reference, per_slope)
    made = StrainFactors(
        strain=strain,
        storage=storage,
        loss=loss,
        strain_per_slope=per_slope,
        storage_error=errors[0] if len(cores) > 1 else None,
        loss_error=errors[1] if len(cores) > 1 else None,
    )
    made._set(notes=notes)
    return made
