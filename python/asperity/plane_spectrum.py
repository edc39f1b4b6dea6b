"""Spectra over the plane of wavevectors, and the lay that they tell."""

from typing import Any

import numpy as np

from asperity import _core
from asperity.base.arguments import Vector, frozen, number_or_none, real_array, vector
from asperity.base.diagnostics import Argument, InvalidInput
from asperity.base.parameters import column
from asperity.base.table import Column, Columns, Table
from asperity.base.value import value
from asperity.measured_spectrum import Window, core_map, prepared
from asperity.surface import Detrend, HeightMap


@value
class SpectralDensity(Table):
    """Spectrum over the plane of wavevectors (see `spectral_density`).

    Attributes
    ----------
    wavenumber_y, wavenumber_x : ndarray, shapes (ny,) and (nx,)
        Components of the wavevector [1/m], rising.
    density : ndarray, shape (ny, nx)
        C [m^4].
    """

    wavenumber_y: Vector = column("1/m", "", "wavenumber_y")
    wavenumber_x: Vector = column("1/m", "", "wavenumber_x")
    density: Vector = column("m^4", "roughness spectrum C", "wavenumber_y", "wavenumber_x")

    def __post_init__(self) -> None:
        q_y, q_x = (
            vector(self.wavenumber_y, "wavenumber_y"),
            vector(self.wavenumber_x, "wavenumber_x"),
        )
        density = np.array(real_array(self.density, "density"), order="C")
        if density.shape != (q_y.size, q_x.size):
            allowed = f"must have {(q_y.size, q_x.size)}, as the wavenumbers have"
            raise InvalidInput(Argument("density"), f" has shape {density.shape}: {allowed}")
        self._set(wavenumber_y=q_y, wavenumber_x=q_x, density=frozen(density))

    def _draw(self, axes: Any) -> None:
        from matplotlib.colors import LogNorm

        shown = np.ma.masked_less_equal(self.density, 0)
        norm = LogNorm() if shown.count() else None  # no logarithm of a plane's zeros
        image = axes.pcolormesh(self.wavenumber_x, self.wavenumber_y, shown, norm=norm)
        axes.set(aspect="equal", xlabel="$q_x$ [1/m]", ylabel="$q_y$ [1/m]")
        axes.figure.colorbar(image, ax=axes, label="Roughness spectrum $C$ [m$^4$]")


def spectral_density(
    surface: HeightMap,
    *,
    window: Window = "split-cosine-bell",
    detrend: Detrend | None = "plane",
) -> SpectralDensity:
    """Return C over the whole plane of wavevectors [m^4], which `power_spectrum` averages.

    Parameters
    ----------
    surface, window, detrend
        As in `power_spectrum`.

    Returns
    -------
    SpectralDensity
        Its wavenumbers [1/m] rise, as numpy.fft.fftshift orders them.

    Raises
    ------
    InvalidInput
        The surface is a LineScan, has drop-outs or fewer than 2 x 2 points.
    """
    how = prepared(window, detrend)
    q_y, q_x, density = map(frozen, _core.spectral_density(core_map(surface), *how))
    return SpectralDensity._made(wavenumber_y=q_y, wavenumber_x=q_x, density=density)


@value
class Anisotropy(Table):
    """Lay of a surface (see `anisotropy`).

    Attributes
    ----------
    across, along : float
        Rms slopes [-] along the two principal axes, across >= along; equal where the surface is
        isotropic.
    direction : float
        Direction of the lay, along which the slope is least: the angle from x towards y (rising
        row index), in radians [-].
    """

    across: float
    along: float
    direction: float

    @property
    def ratio(self) -> float:
        """Ratio across / along [-], 1 for an isotropic surface."""
        return self.across / self.along

    def _columns(self) -> Columns:
        numbers = self._arguments() | {"ratio": self.ratio}
        units = {name: "rad" if name == "direction" else "1" for name in numbers}
        return Columns({}, {name: Column((), x, units[name]) for name, x in numbers.items()})

    def _draw(self, axes: Any) -> None:
        angle = np.linspace(-90, 90, 361)
        from_lay = np.radians(angle) - self.direction
        axes.plot(angle, np.hypot(self.along * np.cos(from_lay), self.across * np.sin(from_lay)))
        axes.axvline(np.degrees(self.direction), color="0.4", linestyle="--", label="lay")
        axes.set_xlim(-90, 90)
        axes.set_ylim(0, 1.1 * self.across or None)
        axes.set(xlabel="Direction from $x$ towards $y$ [°]", ylabel="Rms slope [-]")
        axes.legend(fontsize="small")


def anisotropy(
    surface: HeightMap,
    *,
    window: Window = "split-cosine-bell",
    detrend: Detrend | None = "plane",
    q_min: float | None = None,
    q_max: float | None = None,
) -> Anisotropy:
    """Return the principal axes of the mean square slopes <dh/dx_i dh/dx_j> = int q_i q_j C d^2q.

    The method is that of M. S. Longuet-Higgins, Phil. Trans. R. Soc. Lond. A 249, 321 (1957). A
    radial spectrum averages over directions: where the ratio of the slopes is far from 1, it
    stands for no direction in particular.

    Parameters
    ----------
    surface, window, detrend
        As in `power_spectrum`.
    q_min, q_max : float, optional
        The band [1/m]; by default the band of the rows that `power_spectrum` flags neither for the
        window nor for Nyquist.

    Returns
    -------
    Anisotropy
        The two rms slopes [-] and the direction of the lay.

    Raises
    ------
    InvalidInput
        The band has fewer than 16 modes.
    """
    how = prepared(window, detrend)
    band = number_or_none(q_min, "q_min"), number_or_none(q_max, "q_max")
    across, along, direction = _core.anisotropy(core_map(surface), *how, *band)
    return Anisotropy._made(across=across, along=along, direction=direction)
