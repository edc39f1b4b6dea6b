"""Measured heights: maps and line scans, their statistics, drop-outs, detrending and peaks."""

from __future__ import annotations

from dataclasses import field
from math import isfinite
from typing import Any, Literal, Self, get_args

import numpy as np
from numpy.typing import ArrayLike, NDArray

from asperity import _core
from asperity.base.arguments import (
    Array,
    Conversion,
    choice,
    flag,
    frozen,
    is_masked,
    number,
    real_numbers,
    whole,
)
from asperity.base.diagnostics import must_be, refusal
from asperity.base.iso_25178 import height_parameters, measured_parameters
from asperity.base.table import Column, Columns, Table
from asperity.base.value import around, value

Detrend = Literal["offset", "plane", "quadratic"]
DETRENDS: tuple[Detrend, ...] = get_args(Detrend)  # in the order of the core's enumeration
Periodic = Literal[True, "mirror", "fade", "blend"]  # likewise
Heights = Conversion[ArrayLike, NDArray[Any]]
PixelSize = Conversion[float | tuple[float, float], tuple[float, float]]

_MOST_PIXELS = 1000  # along a side of a picture; a larger map is thinned out


def pixel_sizes(sizes: Any) -> tuple[float, float]:
    """Return (dy, dx) of an argument that is one number or both."""
    try:
        dy, dx = sizes
    except TypeError:
        dy = dx = sizes
    except ValueError:
        raise refusal("pixel_size", sizes, "a number or (dy, dx)") from None
    return number(dy, "pixel_size"), number(dx, "pixel_size")


def _heights(heights: Any, axes: str) -> NDArray[Any]:
    """Return heights as the core shares them: float32 or float64, strides of whole elements.

    float32 stays what it is, in whatever byte order it came; other real types become float64. No
    array that is like this already is copied.
    """
    masked = is_masked(heights)
    array = real_numbers(heights.data if masked else heights, "heights")
    single = array.dtype.kind == "f" and array.dtype.itemsize == 4
    array = array.astype(np.float32 if single else np.float64, copy=False)
    if array.ndim != axes.count("n"):
        raise must_be("heights", f"of shape {axes}", f" has shape {array.shape}")
    if masked:
        array = np.where(heights.mask, array.dtype.type(np.nan), array)
    packed = any(stride % array.itemsize for stride in array.strides)  # fields of packed records
    return array.copy() if packed or not array.flags.aligned else array


def _of_core(name: str, told: str) -> Any:
    """Return a property: a number that the core has of the surface."""
    return property(lambda surface: float(getattr(surface._core, name)), doc=told)


class _Surface(Table):
    """What maps and line scans can do alike."""

    heights: Any

    dropout_fraction: float = _of_core(
        "dropout_fraction", "Share of the points that were not measured [-]."
    )
    rms_height: float = _of_core("rms_height", "Root mean square height about the mean [m].")
    rms_slope: float = _of_core(
        "rms_slope",
        """Root mean square slope sqrt(<(dh/dx)^2> + <(dh/dy)^2>) [-].

        Slopes are central differences at the points whose neighbours are measured. A line scan
        has the first term alone.
        """,
    )
    skewness: float = _of_core("skewness", "Skewness <z^3> / rms^3 [-]; 0 for Gaussian heights.")
    kurtosis: float = _of_core("kurtosis", "Kurtosis <z^4> / rms^4 [-]; 3 for Gaussian heights.")
    z_max: float = _of_core("z_max", "Height of the highest point above the mean [m].")
    z_min: float = _of_core("z_min", "Height of the lowest point above the mean [m]; negative.")

    def height_histogram(self, *, bins: int = 100) -> tuple[Array, Array]:
        """Return how often heights occur, over equal bins.

        Parameters
        ----------
        bins : int
            Number of bins, from 1 to 10^6.

        Returns
        -------
        edges : ndarray, shape (bins + 1,)
            Heights about their mean [m].
        density : ndarray, shape (bins,)
            Probability density [1/m], whose integral is 1.

        Raises
        ------
        InvalidInput
            All heights are the same.
        """
        edges, density = self._core.height_histogram(whole(bins, "bins", lowest=1, highest=10**6))
        return frozen(edges), frozen(density)

    def fill_dropouts(self, *, max_fraction: float = 0.10) -> Self:
        """Return the surface with drop-outs replaced by linear interpolation.

        On a map, heights are interpolated between measured points along the row and along the
        column, weighted by the cube of (1 / a + 1 / b), where a and b are the distances to the two
        points. Where neither direction has both immediate neighbours, the diagonals count too. A
        plane comes back exactly. On a line scan, heights are interpolated between the neighbours.
        A point outside of the measured hull takes the height of the nearest point. Measured
        points stay as they are. On synthetic maps this came nearer to the truth than linear
        interpolation on triangles.

        Parameters
        ----------
        max_fraction : float
            Largest share of drop-outs that is accepted [-]; 0.10 after the article's Section 5.2.

        Raises
        ------
        InvalidInput
            There are more drop-outs than that.
        """
        share = number(max_fraction, "max_fraction")
        return around(type(self), self._core.fill_dropouts(share))

    def detrend(self, order: Detrend) -> Self:
        """Return the heights without their trend.

        Parameters
        ----------
        order : {"offset", "plane", "quadratic"}
            The least-squares surface that is subtracted; of a line scan the offset, the straight
            line or the parabola. It is fitted to the measured points; drop-outs stay drop-outs.
        """
        return around(type(self), self._core.detrend(choice(order, "order", DETRENDS)))

    def affine_shift(self, p: float) -> Self:
        """Return the shifted heights h_T = (h - z_max) / p + z_max (the article's Eq. 9).

        The heights are those above the mean. The shifted surface has the mean z_max (1 - 1/p), the
        same highest point and the spectrum C / p^2.

        Parameters
        ----------
        p : float
            Shift factor [-], 1 or more.
        """
        return around(type(self), self._core.affine_shift(number(p, "p")))

    def local_peaks(self, *, min_distance: float, periodic: bool = False) -> Array:
        """Return the heights [m] of the local peaks above the mean, highest first.

        Peaks are the maxima among eight neighbours (Section 3.1, for Eq. 13), taken from the
        highest down; each is no closer than `min_distance` to one taken before. A plateau counts
        once.

        Parameters
        ----------
        min_distance : float
            Smallest distance between two peaks [m].
        periodic : bool
            Whether the surface goes on beyond its edges; if not, a point on the edge is no peak.

        Raises
        ------
        InvalidInput
            `min_distance` is not positive, or drop-outs are not filled.
        """
        apart, wraps = number(min_distance, "min_distance"), flag(periodic, "periodic")
        peaks: Array = self._core.local_peaks(apart, wraps)
        return peaks


@value
class HeightMap(_Surface):
    """Heights of a surface on a regular grid.

    Statistics refer to the mean plane at the mean height of the measured points. Tilt and
    curvature are part of a map until `detrend` removes them.

    Parameters
    ----------
    heights : array_like, shape (ny, nx)
        Heights [m]; NaN or a masked entry marks a drop-out. float32 and float64 arrays of any
        strides are shared, not copied, and keep their type: do not change them afterwards. Other
        real types become float64. The attribute is a read-only view.
    pixel_size : float or (float, float)
        Spacing of the points [m], or (dy, dx) where they differ. The attribute is (dy, dx).

    Raises
    ------
    InvalidInput
        The heights are not two-dimensional, empty, infinite or all drop-outs, or the pixel size is
        not positive.

    Examples
    --------
    >>> import asperity, numpy as np
    >>> HeightMap = asperity.HeightMap
    >>> m = HeightMap(np.array([[0.0, 1e-6], [1e-6, 0.0]]), pixel_size=1e-6)
    >>> m
    HeightMap(shape=(2, 2), pixel_size=(1e-06, 1e-06), rms_height=5e-07, dropout_fraction=0)
    >>> round(m.rms_height * 1e6, 6)
    0.5
    """

    heights: Heights = field(kw_only=False)
    pixel_size: PixelSize

    def __post_init__(self) -> None:
        pixel_size = pixel_sizes(self.pixel_size)
        core = _core.HeightMap(_heights(self.heights, "(ny, nx)"), pixel_size)
        self._set(_core=core, heights=frozen(core.heights), pixel_size=pixel_size)

    @property
    def iso_25178(self) -> dict[str, float]:
        """Parameters of ISO 25178-2 by their names, of the map as it is.

        Take trends away and fill drop-outs first. Sq, Sa, Sp, Sv, Sz [m], Ssk, Sku [-]; Sdq and Sdr
        [-] by central differences; Spd [1/m^2] of hills of 5 % of Sz and more, after Wolf's
        pruning, without those whose peaks lie on the edge; of maps of up to 2^22 points, all
        measured.
        """
        known = self.rms_height, self.skewness, self.kurtosis, self.z_max, self.z_min
        more = measured_parameters(self.heights, self.pixel_size)
        return {**height_parameters(*known, self.rms_slope), **more}

    def _summary(self) -> dict[str, Any]:
        shown = {"shape": self.heights.shape, "pixel_size": self.pixel_size}
        return shown | {"rms_height": self.rms_height, "dropout_fraction": self.dropout_fraction}

    def _columns(self) -> Columns:
        axes = zip(("y", "x"), self.heights.shape, self.pixel_size, strict=True)
        places = {name: Column((name,), np.arange(n) * step, "m") for name, n, step in axes}
        return Columns(places, {"height": Column(("y", "x"), self.heights, "m", "height")})

    def _draw(self, axes: Any) -> None:
        step = -(-max(self.heights.shape) // _MOST_PIXELS)
        shown = self.heights[::step, ::step].astype(float)
        height, unit = metric_unit(float(np.nanmax(np.abs(shown))))
        low, high = np.nanpercentile(shown / height, [0.2, 99.8]).tolist()
        axes.set_facecolor("0.6")  # drop-outs
        label = f"height [{unit}]"
        size = self.heights.shape, self.pixel_size
        draw_map(axes, shown / height, *size, label, vmin=low, vmax=high)


@value
class LineScan(_Surface):
    """Heights of a surface along a line, at equal distances.

    Statistics refer to the mean height of the measured points.

    Parameters
    ----------
    heights : array_like, shape (n,)
        Heights [m]; NaN or a masked entry marks a drop-out. They are shared, not copied, as those
        of a HeightMap.
    spacing : float
        Distance between neighbouring points [m].

    Raises
    ------
    InvalidInput
        The heights are not one-dimensional, empty, infinite or all drop-outs, or the spacing is
        not positive.
    """

    heights: Heights = field(kw_only=False)
    spacing: float

    def __post_init__(self) -> None:
        spacing = number(self.spacing, "spacing")
        if not (isfinite(spacing) and spacing > 0):
            raise refusal("spacing", spacing, "positive and finite", text=f"{spacing}")
        core = _core.LineScan(_heights(self.heights, "(n,)"), spacing)
        self._set(_core=core, heights=frozen(core.heights), spacing=spacing)

    def _summary(self) -> dict[str, Any]:
        shown = {"points": self.heights.size, "spacing": self.spacing}
        return shown | {"rms_height": self.rms_height, "dropout_fraction": self.dropout_fraction}

    def _columns(self) -> Columns:
        x = Column(("x",), np.arange(self.heights.size) * self.spacing, "m")
        return Columns({"x": x}, {"height": Column(("x",), self.heights, "m", "height")})

    def _draw(self, axes: Any) -> None:
        x = np.arange(self.heights.size) * self.spacing
        length, length_unit = metric_unit(float(x[-1]))
        height, height_unit = metric_unit(float(np.nanmax(np.abs(self.heights))))
        axes.plot(x / length, self.heights / height, linewidth=0.7)
        axes.set(xlabel=f"$x$ [{length_unit}]", ylabel=f"height [{height_unit}]")


Scan = HeightMap | LineScan


def draw_map(
    axes: Any,
    shown: NDArray[Any],
    shape: tuple[int, ...],
    pixel_size: tuple[float, float],
    label: str,
    **limits: float,
) -> None:
    """Draw the numbers of a map, which may be thinned out, with a bar of their colours."""
    (ny, nx), (dy, dx) = shape, pixel_size
    length, unit = metric_unit(max(ny * dy, nx * dx))
    extent = (0, nx * dx / length, ny * dy / length, 0)
    image = axes.imshow(shown, extent=extent, cmap="cividis", interpolation="nearest", **limits)
    axes.set(xlabel=f"$x$ [{unit}]", ylabel=f"$y$ [{unit}]")
    axes.figure.colorbar(image, ax=axes, label=label, shrink=0.85)


def metric_unit(size: float) -> tuple[float, str]:
    """Return the unit of length, and its name, in which a length is a number from 1 to 1000."""
    for unit, name in ((1.0, "m"), (1e-3, "mm"), (1e-6, "µm")):
        if size >= unit:
            return unit, name
    return 1e-9, "nm"
