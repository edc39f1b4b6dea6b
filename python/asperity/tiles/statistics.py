"""Statistics of the heights of a map that does not fit in memory, about its least-squares surface.

One reading sums the normal equations of the surface, a second one the moments of what it leaves.
"""

import math
from typing import Any

import numpy as np

from asperity.base.arguments import Array, choice
from asperity.base.diagnostics import Argument, InvalidInput, must_be
from asperity.base.parameters import column
from asperity.base.table import Table
from asperity.base.value import value
from asperity.surface import DETRENDS, Detrend, HeightMap, PixelSize
from asperity.tiles.share import Workers
from asperity.tiles.source import (
    DEFAULT,
    Box,
    Piece,
    Shape,
    boxes_of,
    corner_of,
    refuse_infinite,
    source_of,
)

_ROWS = 64  # that are in the processor's cache at a time
_POWERS = ((0, 0), (0, 1), (1, 0), (0, 2), (1, 1), (2, 0))  # of v and u, in the order of terms
_TERMS = {"offset": 1, "plane": 3, "quadratic": 6}


@value
class HeightStatistics(Table):
    """What the heights of a map are like (see `height_statistics`).

    Attributes
    ----------
    mean : float
        Mean height in the map's own zero [m].
    rms_height : float
        Root mean square height about the mean [m].
    rms_slope : float
        Root mean square slope [-], by central differences.
    skewness, kurtosis : float
        <z^3> / rms^3 and <z^4> / rms^4 [-]; 0 and 3 for Gaussian heights.
    z_max, z_min : float
        Heights of the highest and the lowest point above the mean [m].
    dropout_fraction : float
        Share of the points that were not measured [-].
    """

    mean: float = column("m")
    rms_height: float = column("m")
    rms_slope: float = column("1")
    skewness: float = column("1")
    kurtosis: float = column("1")
    z_max: float = column("m")
    z_min: float = column("m")
    dropout_fraction: float = column("1")

    def _draw(self, axes: Any) -> None:
        axes.axhspan(-self.rms_height, self.rms_height, alpha=0.3, label="± rms height")
        for name, height in (("highest", self.z_max), ("lowest", self.z_min)):
            axes.axhline(height, color="0.4", linestyle="--")
            axes.annotate(name, (0.02, height), xycoords=("axes fraction", "data"))
        axes.set_xticks([])
        axes.set(
            xlabel=f"Skewness {self.skewness:.3g}, kurtosis {self.kurtosis:.3g}",
            ylabel="Height above the mean [m]",
        )
        axes.legend(fontsize="small")


def height_statistics(
    surface: HeightMap | Any,
    *,
    pixel_size: PixelSize | None = None,
    detrend: Detrend = "offset",
    threads: int = 1,
    executor: Any = None,
) -> HeightStatistics:
    """Return the statistics of the heights of a map that need not fit in memory.

    They are those of a `HeightMap`, after its `detrend`, from two readings of the map piece by
    piece. Drop-outs are left out, as there.

    Parameters
    ----------
    surface : HeightMap, or array of shape (ny, nx)
        Heights [m], NaN where there is none: a HeightMap, a `numpy.memmap`, a Zarr or Dask array,
        or any other array that is read as it is sliced.
    pixel_size : float or (float, float), optional
        Spacing of the points of an array [m], or (dy, dx).
    detrend : {"offset", "plane", "quadratic"}
        The least-squares surface of the whole map that heights and slopes are taken from.
    threads : int
        Threads that the call starts for itself, from 1 to 1024. The numbers are the same for any.
    executor : optional
        Anything with the `submit` of `concurrent.futures`, instead of threads.

    Returns
    -------
    HeightStatistics
        Heights [m] and shape numbers [-].

    Raises
    ------
    InvalidInput
        The map is no array of two axes, has infinite heights, only drop-outs, or no point whose
        neighbours are measured.
    """
    source = source_of(surface, pixel_size)
    order = DETRENDS[choice(detrend, "detrend", DETRENDS)]
    workers = Workers(threads, executor)
    if min(source.shape) < 3:
        allowed = "3 x 3 or more for central differences"
        raise must_be("heights", allowed, f" has shape {source.shape}")
    boxes = boxes_of(source.shape, (DEFAULT, DEFAULT))
    anchor = _anchor(source, boxes)
    works = ((source.piece(box), source.shape, corner_of(box), anchor) for box in boxes)
    sums = np.sum([*workers.outcomes(trend_sums, works)], axis=0)
    points = math.prod(source.shape)
    missing = (points - sums[0, 0, 0]) / points
    trend = _trend(sums, _TERMS[order])
    with_halo = ((_wider(box, source.shape), box) for box in boxes)
    moments = (
        (source.piece(wide), source.shape, corner_of(wide), _inside(wide, box), anchor, trend)
        for wide, box in with_halo
    )
    return _from_moments(
        list(workers.outcomes(moment_sums, moments)),
        anchor + float(sums[1, 0, 0] / sums[0, 0, 0]),
        missing,
        source.pixel_size,
    )


def _wider(box: Box, shape: Shape) -> Box:
    down, along = (
        slice(max(0, part.start - 1), min(part.stop + 1, side))
        for part, side in zip(box, shape, strict=True)
    )
    return down, along


def _inside(wide: Box, box: Box) -> Box:
    down, along = (
        slice(part.start - outer.start, part.stop - outer.start)
        for outer, part in zip(wide, box, strict=True)
    )
    return down, along


def _anchor(source: Any, boxes: list[Box]) -> float:
    """A height of the map, about which sums keep the digits of its roughness."""
    for box in boxes:
        corner = slice(box[0].start, min(box[0].stop, box[0].start + _ROWS)), box[1]
        for part in (corner, box):
            heights = source.piece(part).read()
            known = heights[np.isfinite(heights)]
            if known.size:
                return float(known[0])
    raise InvalidInput(Argument("heights"), ": every point is a drop-out (NaN)")


def _coordinates(side: int, first: int, count: int) -> Array:
    """Some of the places of the points of a side, which reach from -1 to 1."""
    return 2 * np.arange(first, first + count) / (side - 1) - 1


def trend_sums(piece: Piece, shape: Shape, corner: Shape, anchor: float) -> Array:
    """Return sums over measured points of v^i u^j and of v^i u^j z, i and j from 0 to 4."""
    heights = piece.read()
    u = _coordinates(shape[1], corner[1], heights.shape[1])
    v = _coordinates(shape[0], corner[0], heights.shape[0])
    powers = u ** np.arange(5)[:, None]
    rows = np.zeros((2, 5, len(v)))  # sums along each
    for first in range(0, len(v), _ROWS):
        part = slice(first, first + _ROWS)
        z = np.subtract(heights[part], anchor, dtype=np.float64)
        measured = ~np.isnan(z)
        if not np.isfinite(z).all():
            refuse_infinite(heights[part], (corner[0] + first, corner[1]))
            z[~measured] = 0
        for j, power in enumerate(powers):
            rows[0, j, part] = np.add.reduce(np.where(measured, power, 0.0), axis=1)
            if j < 3:
                rows[1, j, part] = np.add.reduce(z * power, axis=1)
    weights = (v ** np.arange(5)[:, None])[:, None, :]
    total: Array = np.add.reduce(rows[:, None, :, :] * weights, axis=-1)
    return total


def _trend(sums: Array, terms: int) -> Array:
    """Coefficients of 1, u, v, u^2, u v, v^2; those that are not asked for are 0."""
    powers = _POWERS[:terms]
    matrix = [[sums[0, a + c, b + d] for c, d in powers] for a, b in powers]
    right = [sums[1, a, b] for a, b in powers]
    coefficients = np.zeros(6)
    coefficients[:terms] = np.linalg.lstsq(np.array(matrix), np.array(right), rcond=None)[0]
    return coefficients


def moment_sums(
    piece: Piece, shape: Shape, corner: Shape, inside: Box, anchor: float, trend: Array
) -> tuple[Array, float, float]:
    """Return sums of z^0 ... z^4 and of the squares of slopes with their numbers, and the highest
    and the lowest z above the trend. The piece has the neighbours of the points inside."""
    heights = piece.read()
    u = _coordinates(shape[1], corner[1], heights.shape[1])
    v = _coordinates(shape[0], corner[0], heights.shape[0])[:, None]
    c = trend
    sums, highest, lowest = np.zeros(9), -math.inf, math.inf
    for first in range(inside[0].start, inside[0].stop, _ROWS):
        last = min(first + _ROWS, inside[0].stop)
        part = slice(max(0, first - 1), last + 1)
        z = np.subtract(heights[part], anchor, dtype=np.float64)
        z -= c[0] + v[part] * (c[2] + v[part] * c[5]) + u * (c[1] + v[part] * c[4] + u * c[3])
        own = slice(first - part.start, last - part.start)
        point = z[own, inside[1]]
        known = np.where(np.isnan(point), 0.0, point)
        square = known * known
        sums[:5] += [
            np.count_nonzero(~np.isnan(point)),
            known.sum(),
            square.sum(),
            (square * known).sum(),
            (square * square).sum(),
        ]
        if sums[0]:
            highest = max(highest, float(np.fmax.reduce(point, axis=None, initial=-math.inf)))
            lowest = min(lowest, float(np.fmin.reduce(point, axis=None, initial=math.inf)))
        for k, step in (
            (5, z[own, 2:] - z[own, :-2]),
            (7, z[2:, inside[1]] - z[:-2, inside[1]]),
        ):
            sums[k] += np.nansum(step * step)
            sums[k + 1] += np.count_nonzero(~np.isnan(step))
    return sums, highest, lowest


def _from_moments(
    parts: list[tuple[Array, float, float]],
    mean: float,
    missing: float,
    pixel_size: tuple[float, float],
) -> HeightStatistics:
    sums = np.zeros(9)
    for part, _, _ in parts:
        sums += part
    if not (sums[6] and sums[8]):
        raise InvalidInput(Argument("heights"), ": no point has both neighbours measured")
    offset, *raw = sums[1:5] / sums[0]  # what rounding leaves of the mean
    second = max(raw[0] - offset**2, 0.0)
    third = raw[1] - 3 * offset * raw[0] + 2 * offset**3
    fourth = raw[2] - 4 * offset * raw[1] + 6 * offset**2 * raw[0] - 3 * offset**4
    rms, (dy, dx) = math.sqrt(second), pixel_size
    slope = sums[5] / sums[6] / (2 * dx) ** 2 + sums[7] / sums[8] / (2 * dy) ** 2
    return HeightStatistics(
        mean=mean,
        rms_height=rms,
        rms_slope=math.sqrt(slope),
        skewness=float(third / (second * rms)) if second > 0 else 0.0,  # a flat map has none
        kurtosis=float(fourth / second**2) if second > 0 else 0.0,
        z_max=max(part[1] for part in parts) - float(offset),
        z_min=min(part[2] for part in parts) - float(offset),
        dropout_fraction=float(missing),
    )
