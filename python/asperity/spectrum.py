"""Roughness spectra C(q): self-affine or tabulated; their moments, cut-offs and profiles."""

from __future__ import annotations

from collections.abc import Mapping
from functools import cached_property
from typing import Any, ClassVar, Self

from numpy.typing import ArrayLike

from asperity import _core
from asperity.base.arguments import (
    ABSENT,
    Conversion,
    OptionalVector,
    Vector,
    broadcast,
    number,
    number_or_none,
    over,
    shaped,
)
from asperity.base.diagnostics import refusal
from asperity.base.parameters import column, parameter
from asperity.base.quantities import FIRST_WAVENUMBER, LAST_WAVENUMBER, RMS_HEIGHT
from asperity.base.table import Column, Columns, Table
from asperity.base.value import CoreValue, around, like, value
from asperity.spectrum_rows import Flags, Grid, Rows


class _Spectrum(Table):
    """What the spectra of a surface can do alike."""

    @cached_property
    def rms_slope(self) -> float:
        """Root mean square slope h' = sqrt(2 pi int q^3 C dq) [-]."""
        return float(_core.rms_slope(self._core))

    @property
    def nayak_parameter(self) -> float:
        """Nayak's parameter m0 m4 / m2^2 of a profile [-].

        It is 1.5 for a single wavenumber, and the larger the wider the band (P. R. Nayak,
        J. Lubr. Technol. 93, 398 (1971)).
        """
        return float(_core.nayak_parameter(self._core))

    def at(self, wavenumber: ArrayLike) -> Any:
        """Return C(q) [m^4] at wavenumbers [1/m] of any shape.

        A self-affine spectrum is 0 outside its band.

        Raises
        ------
        OutOfRange
            A wavenumber lies beyond the rows of a table.
        """
        return over(wavenumber, "wavenumber", lambda q: _core.density(self._core, q))

    @cached_property
    def is_directional(self) -> bool:
        """Whether it knows directions: `harmonics`, or an axis ratio other than 1."""
        return bool(_core.is_directional(self._core))

    def toward(self, wavenumber: ArrayLike, direction: ArrayLike) -> Any:
        """Return C [m^4] of vectors q, of length `wavenumber` [1/m] towards `direction` [rad].

        The direction is that of q from x towards y; both broadcast. An isotropic spectrum is the
        same in all directions. Harmonics of a scan are few, and their sum may be below 0.
        """
        shape, (q, phi) = broadcast(wavenumber=wavenumber, direction=direction)
        return shaped(_core.plane_density(self._core, q, phi), shape)

    def line_density(self, wavenumber: ArrayLike) -> Any:
        """Return the spectrum of the surface's profiles, C1D(q) = int C(sqrt(q^2 + k^2)) dk [m^3].

        The integral runs over all k, and the spectrum is two-sided: its integral over wavenumbers
        of both signs is the mean square height. `wavenumber` [1/m] may have any shape.
        """
        return over(wavenumber, "wavenumber", lambda q: _core.line_density(self._core, q))

    def autocorrelation(self, distance: ArrayLike) -> Any:
        """Return <h(x) h(0)> = 2 pi int q C J0(q |x|) dq [m^2] (the article's Eqs 5-6).

        `distance` |x| [m] may have any shape. The error is below 1e-8 of the value at 0, which is
        the mean square height.
        """
        return over(distance, "distance", lambda r: _core.autocorrelation(self._core, r))

    def cutoff_for_slope(self, slope: float = 1.3) -> float:
        """Return the wavenumber [1/m] up to which the cumulative rms slope is `slope` [-].

        It is the upper cut-off of the text below Eq. 22, and q1 where the whole spectrum has less.
        """
        return float(_core.cutoff_for_slope(self._core, number(slope, "slope")))

    def cutoff_for_contamination(self, size: float) -> float:
        """Return 2 pi / `size` of the contamination particles [m], but at most q1 [1/m]."""
        return float(_core.cutoff_for_contamination(self._core, number(size, "size")))

    def truncated(self, *, q0: float | None = None, q1: float | None = None) -> Self:
        """Return the same densities on a narrower band, from `q0` to `q1` [1/m].

        Raises
        ------
        InvalidInput
            The band would be wider.
        """
        lower, upper = number_or_none(q0, "q0"), number_or_none(q1, "q1")
        return like(self, _core.truncated(self._core, lower, upper))

    def scaled(self, factor: float) -> Self:
        """Return the spectrum with all densities multiplied by `factor` [-]."""
        return like(self, _core.scaled(self._core, number(factor, "factor")))


@value
class SelfAffineSpectrum(_Spectrum, CoreValue):
    """Spectrum of a self-affine surface.

    C(q) = C_r (q / q_r)^(-2 (H + 1)) on [q_r, q1], flat on [q0, q_r] and zero elsewhere. C_r
    follows from rms_height^2 = 2 pi int_q0^q1 q C dq, so that the rms height is exact on the band.

    Parameters
    ----------
    rms_height : float
        Root mean square height h_rms on the band [m].
    hurst : float
        Hurst exponent H in (0, 1] [-].
    q0, q1 : float
        Lower and upper cut-off, as angular wavenumbers 2 pi / wavelength [1/m].
    rolloff : float, optional
        Roll-off q_r [1/m], q0 < q_r < q1; without it the power law starts at q0.
    axis_ratio : float
        r of a surface with a lay [-], 1 to 10: C(q, phi) is the same law of
        k = q sqrt(r cos^2(phi - lay) + sin^2(phi - lay) / r), flat for k below the roll-off. The
        band is in q, the rms height exact, and `at` the mean over directions.
    lay : float
        Direction of the ridges, from x (the second axis of a map) towards y (the first), in
        radians; scenes have degrees.

    Raises
    ------
    InvalidInput
        A number is out of its range.

    Examples
    --------
    The asphalt of Table 1; its rms slope is above 1.3, at which the cut-off rule ends a spectrum:

    >>> from asperity import SelfAffineSpectrum
    >>> road = SelfAffineSpectrum(rms_height=265.7e-6, hurst=0.87, q0=2000, q1=1e6)
    >>> round(road.rms_slope, 2), round(road.cutoff_for_slope() / 2000, 1)
    (2.76, 11.7)
    """

    rms_height: float = parameter(RMS_HEIGHT, usual=(1e-8, 2e-3), shown_unit="um")
    hurst: float = parameter(usual=(0.05, 1), label="Hurst exponent H")
    q0: float = parameter(FIRST_WAVENUMBER, usual=(10, 1e6))
    q1: float = parameter(LAST_WAVENUMBER)
    rolloff: float | None = parameter(FIRST_WAVENUMBER, default=None)
    axis_ratio: float = parameter(default=1.0, usual=(1.0, 6.0), label="Ridges, long to wide")
    lay: float = parameter(  # of the key in scenes
        unit="deg",
        default=0.0,
        usual=(-90.0, 90.0),
        shown_unit="°",
        label="Direction of the ridges",
    )

    @staticmethod
    def from_article(*, h0: float, hurst: float, q0: float, q1: float) -> SelfAffineSpectrum:
        """Return Eq. 12 as printed, C = (h0 / q0)^2 (H / 2 pi) (q / q0)^(-2 (H + 1)), cut at q1.

        Its rms height is not h0 [m] but h0 / sqrt(2) for q1 >> q0 [1/m]. Use it to reproduce the
        article only.
        """
        arguments = {"h0": h0, "hurst": hurst, "q0": q0, "q1": q1}
        numbers = [number(entry, name) for name, entry in arguments.items()]
        return around(SelfAffineSpectrum, _core.SelfAffineSpectrum.from_article(*numbers))

    def extended(self, *, q0: float | None = None, q1: float | None = None) -> SelfAffineSpectrum:
        """Return the same law on another band [1/m], wider or narrower.

        The power law goes on beyond the old ends, or the flat part below a roll-off. C(q) stays,
        and the rms height follows from it.
        """
        band = number_or_none(q0, "q0"), number_or_none(q1, "q1")
        return around(SelfAffineSpectrum, self._core.extended(*band))

    def _columns(self) -> Columns:
        ends = [self.q0, self.q1] if self.rolloff is None else [self.q0, self.rolloff, self.q1]
        wavenumber = Column(("wavenumber",), ends, "1/m")
        density = Column(("wavenumber",), self.at(ends), "m^4", "roughness spectrum C")
        return Columns({"wavenumber": wavenumber}, {"density": density}, self._arguments())

    def _draw(self, axes: Any) -> None:
        columns = self._columns()
        axes.loglog(columns.coordinates["wavenumber"].values, columns.variables["density"].values)
        axes.set(xlabel="Wavenumber $q$ [1/m]", ylabel="Roughness spectrum $C(q)$ [m$^4$]")


@value
class TabulatedSpectrum(Rows, _Spectrum):
    """Spectrum of a surface, given at wavenumbers.

    It is log-log linear between rows, and linear in q where one of two rows is zero. Beyond the
    rows it raises OutOfRange.

    Parameters
    ----------
    wavenumber : array_like, shape (n,)
        Angular wavenumbers [1/m], strictly rising, n >= 2.
    density : array_like, shape (n,)
        C(q) [m^4], not negative.
    count : array_like, shape (n,), optional
        Modes averaged in each row, which are the weights of a fit.
    standard_error : array_like, shape (n,), optional
        Standard error of the density [m^4].
    flag : array_like of int, shape (n,), optional
        Why a row is not to be trusted, as a sum of numbers. 1: the scan holds fewer than 16 (split
        cosine bell) or 10 (Hann) periods. 2: the row lies above half of pi / pixel, where
        roughness finer than the pixels is folded back. 4: the row has so few modes that their mean
        is uncertain by more than a quarter. 0: the row is reliable. The attribute is uint8.
    correlation : array_like, shape (n, m), optional
        Correlation [-] of the error of each row with those of the next m rows, which a window makes
        alike; rows further apart are independent.
    skewness, kurtosis : float, optional
        Of the heights that the spectrum was measured on [-], both or none. Far from 0 and 3 a
        spectrum is too little to know mu by, which a result notes.
    curvature_kurtosis : float, optional
        Kurtosis of their second differences over two pixels [-], the larger one of both axes, with
        the other two alone: 3 where short waves are spread evenly, above where they are gathered in
        places, which a spectrum does not know either.
    slope_ratio : float, optional
        Rms slope across the lay over that along it [-], as of `anisotropy`, with skewness and
        kurtosis alone. Above 1.5 a result notes that a mean over directions stands for none.
    cosine, sine : array_like, shape (n, m), optional
        Harmonics a_m, b_m of each row [-], both or none, m up to 64:
        C(q, phi) = C(q) (1 + 2 sum_m [a_m cos 2 m phi + b_m sin 2 m phi]), phi the direction of q
        from x (the second axis of a map) towards y. Between rows they are linear in ln q. Fits,
        bins and merged spectra take the mean over directions.
    harmonic_error : array_like, shape (n, m), optional
        Standard error of each of them.
    q1 : float, optional
        Where the band ends [1/m], on which moments, contact and friction are taken; by default at
        the last row. Rows beyond it are kept: `truncated(q1=...)` takes more of them.
    preparation : str, optional
        Window and trend of the heights, as `power_spectrum` says them; results repeat it.

    Raises
    ------
    InvalidInput
        The columns differ in length, or an entry is out of its range.
    """

    wavenumber: Vector = column("1/m", "", "wavenumber")
    density: Vector = column("m^4", "Roughness spectrum $C(q)$", "wavenumber")
    count: OptionalVector = column("1", "modes averaged", "wavenumber", default=ABSENT)
    standard_error: OptionalVector = column("m^4", "", "wavenumber", default=ABSENT)
    flag: Flags = column("1", "why the row is not to be trusted", "wavenumber", default=ABSENT)
    correlation: Grid = ABSENT
    skewness: float | None = None
    kurtosis: float | None = None
    curvature_kurtosis: float | None = None
    slope_ratio: float | None = None
    cosine: Grid = ABSENT
    sine: Grid = ABSENT
    harmonic_error: Grid = ABSENT
    q1: Conversion[float | None, float] = ABSENT
    preparation: str | None = None
    _beside: ClassVar[Mapping[str, Any]] = {"preparation": None}
    _facts = (*Rows._facts, "slope_ratio", "q1", "preparation")
    _grids: ClassVar[Mapping[str, str]] = {
        **Rows._grids,
        **dict.fromkeys(("cosine", "sine", "harmonic_error"), "harmonics"),
    }
    _pairs = (*Rows._pairs, ("slope_ratio", "kurtosis"), ("cosine", "sine"), ("sine", "cosine"))

    def __post_init__(self) -> None:
        self._set(q1=number_or_none(self.q1, "q1"))
        if not isinstance(self.preparation, str | None):
            raise refusal("preparation", self.preparation, "a text, or None")
        super().__post_init__()
        self._set(q1=self._core.q1)

    @cached_property
    def rms_height(self) -> float:
        """Root mean square height sqrt(2 pi int q C dq) [m]."""
        return float(_core.rms_height(self._core))

    @property
    def q0(self) -> float:
        """Wavenumber of the first row [1/m]."""
        return float(self.wavenumber[0])

    def _summary(self) -> dict[str, Any]:
        moments = {"q1": self.q1, "rms_height": self.rms_height, "rms_slope": self.rms_slope}
        return super()._summary() | moments | stated(self.preparation)


@value
class LineSpectrum(Rows):
    """Two-sided spectrum C1D of profiles, at positive wavenumbers.

    Its integral over wavenumbers of both signs is h_rms^2.

    Parameters
    ----------
    wavenumber : array_like, shape (n,)
        Angular wavenumbers [1/m], strictly rising, n >= 2.
    density : array_like, shape (n,)
        C1D [m^3], not negative.
    count, standard_error, flag : array_like, shape (n,), optional
        As in TabulatedSpectrum.
    correlation : array_like, shape (n, m), optional
        As in TabulatedSpectrum. `line_spectrum` leaves it out: its errors are those that give
        averages of many rows theirs.
    skewness, kurtosis, curvature_kurtosis : float, optional
        As in TabulatedSpectrum.

    Raises
    ------
    InvalidInput
        The columns differ in length, or an entry is out of its range.
    """

    wavenumber: Vector = column("1/m", "", "wavenumber")
    density: Vector = column("m^3", "Profile spectrum $C_{1D}(q)$", "wavenumber")
    count: OptionalVector = column("1", "modes averaged", "wavenumber", default=ABSENT)
    standard_error: OptionalVector = column("m^3", "", "wavenumber", default=ABSENT)
    flag: Flags = column("1", "why the row is not to be trusted", "wavenumber", default=ABSENT)
    correlation: Grid = ABSENT
    skewness: float | None = None
    kurtosis: float | None = None
    curvature_kurtosis: float | None = None

    def isotropic(self, *, per_decade: float | None = 10.0) -> TabulatedSpectrum:
        """Return the spectrum C [m^4] of the isotropic surface that has such profiles.

        C(q) = -(1/pi) int_q^inf dC1D/dk dk / sqrt(k^2 - q^2), the inverse Abel transform, is exact
        for the power laws between the rows. Beyond the last row the slope of the last factor of 2
        goes on. Flagged rows that come out negative are left out.

        Parameters
        ----------
        per_decade : float, optional
            Logarithmic bins in a factor 10 of the wavenumber, over which rows are averaged first,
            since the rows of one profile scatter as much as their mean. None takes the rows as
            they are.

        Raises
        ------
        InvalidInput
            A density is zero, or the spectrum rises too steeply for any isotropic surface.
        """
        binned = self if per_decade is None else self.log_binned(per_decade=per_decade)
        return around(TabulatedSpectrum, binned._core.isotropic())


def stated(preparation: str | None) -> dict[str, str]:
    """Return what tables and summaries have of the preparation of heights."""
    return {} if preparation is None else {"preparation": preparation}


Spectrum = SelfAffineSpectrum | TabulatedSpectrum
