"""Self-affine laws through measured spectra, and maps made from spectra."""

from __future__ import annotations

from dataclasses import field
from typing import Any, Literal

import numpy as np

from asperity import _core
from asperity.base.arguments import (
    Covariance,
    choice,
    number,
    number_or_none,
    of_kind,
    whole,
)
from asperity.base.diagnostics import refusal
from asperity.base.table import Column, Columns, Table
from asperity.base.value import around, value
from asperity.spectrum import SelfAffineSpectrum, Spectrum, TabulatedSpectrum
from asperity.surface import HeightMap, pixel_sizes

# in the order of the core's enumerations
FitMethod = Literal["least-squares", "slope"]
Rolloff = Literal["find", "require", "none"]


@value
class SelfAffineFit(Table):
    """A power law through a measured spectrum (see `fit_self_affine`).

    Attributes
    ----------
    spectrum : SelfAffineSpectrum
        The fit as a spectrum.
    covariance : ndarray, shape (3, 3)
        Covariance of rms_height [m], hurst [-] and rolloff [1/m], from the scatter of the rows
        about the fit and their correlation, and from the distance to the fit with or without a
        roll-off that was not taken, by its probability; zeros where there is no roll-off.
    residual : float
        Weighted rms of ln(C / fit) [-].
    rows : int
        Number of rows of the measured spectrum that were used; those below q0 are counted where
        there is a roll-off.
    rms_height, hurst : float
        Root mean square height on [q0, q1] [m], Hurst exponent [-].
    q0, q1 : float
        Wavenumber at which the fit begins, of the first reliable row or the first above q_min, and
        that of the last row that was used [1/m].
    rolloff : float or None
        Wavenumber at which the flat part ends [1/m]; None where there is none.
    """

    spectrum: SelfAffineSpectrum
    covariance: Covariance
    residual: float
    rows: int

    rms_height: float = field(init=False)
    hurst: float = field(init=False)
    q0: float = field(init=False)
    q1: float = field(init=False)
    rolloff: float | None = field(init=False)

    def __post_init__(self) -> None:
        super().__post_init__()
        names = ("rms_height", "hurst", "q0", "q1", "rolloff")
        self._set(**{name: getattr(self.spectrum, name) for name in names})

    @property
    def standard_errors(self) -> dict[str, float]:
        """Standard errors of rms_height [m], hurst [-] and rolloff [1/m] where there is one."""
        names = ("rms_height", "hurst", "rolloff")[: 2 if self.rolloff is None else 3]
        return dict(zip(names, np.sqrt(np.diag(self.covariance)).tolist(), strict=False))

    def _summary(self) -> dict[str, Any]:
        names = ("rms_height", "hurst", "rolloff", "q0", "q1", "residual", "rows")
        return {name: getattr(self, name) for name in names}

    def _columns(self) -> Columns:
        units = {"rms_height": "m", "hurst": "1", "rolloff": "1/m", "q0": "1/m", "q1": "1/m"}
        numbers = self._summary() | {"rolloff": np.nan if self.rolloff is None else self.rolloff}
        columns = {name: Column((), n, units.get(name, "1")) for name, n in numbers.items()}
        for name, error in self.standard_errors.items():
            columns[f"{name}_error"] = Column((), error, units[name], "standard error")
        return Columns({}, columns)

    def _draw(self, axes: Any) -> None:
        self.spectrum._draw(axes)
        label = f"$H$ = {self.hurst:.3f} ± {self.standard_errors['hurst']:.3f}"
        axes.lines[-1].set_label(label)
        axes.legend(fontsize="small")


AnySpectrum = Spectrum | SelfAffineFit


def spectrum_of(spectrum: AnySpectrum) -> Spectrum:
    kinds = SelfAffineFit, SelfAffineSpectrum, TabulatedSpectrum
    surface: Spectrum | SelfAffineFit = of_kind(spectrum, "spectrum", *kinds)
    return surface.spectrum if isinstance(surface, SelfAffineFit) else surface


def fit_self_affine(
    spectrum: TabulatedSpectrum,
    *,
    q_min: float | None = None,
    q_max: float | None = None,
    method: FitMethod = "least-squares",
    rolloff: Rolloff = "find",
) -> SelfAffineFit:
    """Fit a self-affine spectrum: H, the rms height on the band, a roll-off where there is one.

    The fit is least squares in ln C over ln q, each row weighted by its count where it has one.
    H = |slope| / 2 - 1 (the article's Eq. 28) is held at 1 where it comes out above by less than
    three of its standard errors.

    Parameters
    ----------
    spectrum : TabulatedSpectrum
        The measured spectrum.
    q_min, q_max : float, optional
        Band of the rows that are used [1/m], whatever their flags. Without q_max the band ends
        with the last reliable row. Without q_min it begins with the first reliable row, and on a
        scan, whose own band begins there, with the first row that has 0.4 of the highest density.
    method : {"least-squares", "slope"}
        "slope" is the article's Eq. 28 alone: a straight line through all rows with equal weights
        and no roll-off.
    rolloff : {"find", "require", "none"}
        "find" takes a flat part below a roll-off where that is more probable than none (Schwarz's
        criterion). Without q_min the rows below the reliable ones tell too: a window smears what
        falls there, but not what is flat. "require" refuses a spectrum in which none is found, as
        on a scan smaller than lambda_0, and takes the one that is found for sure.

    Returns
    -------
    SelfAffineFit
        The law, its covariance and its residual.

    Raises
    ------
    InvalidInput
        There are fewer than 3 rows, a density among them is zero, the slope gives no H in (0, 1],
        or there is no roll-off where one is required.
    """
    core = of_kind(spectrum, "spectrum", TabulatedSpectrum)._core
    band = number_or_none(q_min, "q_min"), number_or_none(q_max, "q_max")
    how = choice(method, "method", FitMethod), choice(rolloff, "rolloff", Rolloff)
    law, covariance, residual, rows = _core.fit_self_affine(core, *band, *how)
    return SelfAffineFit(
        spectrum=around(SelfAffineSpectrum, law),
        covariance=covariance,
        residual=residual,
        rows=rows,
    )


def synthesize(
    spectrum: Spectrum,
    *,
    shape: tuple[int, int],
    pixel_size: float | tuple[float, float],
    seed: int,
    skewness: float = 0.0,
) -> HeightMap:
    """Return a periodic map whose modes have the densities of a spectrum and random phases.

    Parameters
    ----------
    spectrum : SelfAffineSpectrum or TabulatedSpectrum
        The densities, met exactly. The part of its band that the grid's modes, from 2 pi / side to
        the Nyquist corner, do not hold is left out.
    shape : (int, int)
        Number of points (ny, nx), 2 or more each.
    pixel_size : float or (float, float)
        Spacing of the points [m], or (dy, dx).
    seed : int
        The same seed gives the same map on every machine (splitmix64), to rounding.
    skewness : float
        Skewness of the heights [-], from -2 (worn) to 2, met to 1e-3: random phases are bent so
        that the heights follow a gamma distribution (after Wilson and Hilferty) as nearly as the
        densities allow. 0 leaves the phases random, with the skewness that chance gives them.

    Returns
    -------
    HeightMap
        The map, of mean 0.

    Raises
    ------
    InvalidInput
        The band holds no mode of the grid at all.
    NotConverged
        The map has too few long waves to reach the skewness.
    """
    core = of_kind(spectrum, "spectrum", SelfAffineSpectrum, TabulatedSpectrum)._core
    try:
        ny, nx = shape
    except (TypeError, ValueError):
        raise refusal("shape", shape, "two whole numbers (ny, nx)") from None
    grid = whole(ny, "shape"), whole(nx, "shape")
    start = whole(seed, "seed", highest=2**64 - 1)
    options = pixel_sizes(pixel_size), start, number(skewness, "skewness")
    return around(HeightMap, _core.synthesize(core, grid, *options))
