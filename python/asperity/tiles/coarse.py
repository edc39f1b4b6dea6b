"""The map coarsened by means over blocks, and the spectrum below what a tile resolves.

Means over blocks of h pixels leave T(q) = prod_i [sin(q_i h d_i / 2) / (h sin(q_i d_i / 2))]^2 of
|h(q)|^2, and fold what lies beyond their Nyquist wavenumber back: the coarse map has P(q) =
sum_k T(q + k Q) C(q + k Q), Q = 2 pi / (h d). The term k = 0 is wanted. The others, a few per cent
where C is flat and nothing where it falls steeply, are computed from the spectrum of the tiles.
"""

import math
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from asperity.base.arguments import Array
from asperity.surface import HeightMap
from asperity.tiles.grid import TileSides, tile_shape
from asperity.tiles.share import Workers
from asperity.tiles.source import (
    DEFAULT,
    Piece,
    Shape,
    Source,
    boxes_of,
    corner_of,
    refuse_infinite,
)

_BLOCKS = 256  # of the coarse map in the shorter side of a tile
_DIRECTIONS = 16  # in a quarter of a ring
_RADII = 48
_FEW_MODES = 4


def block_of(tile: Shape, pixel_size: tuple[float, float]) -> Shape:
    """Return the sides of a block [points]: as near to a square [m] as whole pixels allow."""
    length = min(n * d for n, d in zip(tile, pixel_size, strict=True)) / _BLOCKS
    down, along = (max(1, math.floor(length / d + 1e-9)) for d in pixel_size)
    return down, along


@dataclass(frozen=True)
class Coarse:
    """Means over blocks; NaN where a block has no measured point."""

    heights: NDArray[Any]
    block: Shape
    pixel_size: tuple[float, float]  # of a block [m]
    dropout_fraction: float  # of the map that it was made from


def coarsen(source: Source, block: Shape, cell: Shape, workers: Workers) -> Coarse:
    """Read the whole map once, in cells of about that shape; points beyond the last block count
    as drop-outs or not, but are in no mean."""
    down, along = (h * max(1, side // h) for h, side in zip(block, cell, strict=True))
    boxes = boxes_of(source.shape, (down, along))
    whole = tuple(side // h for side, h in zip(source.shape, block, strict=True))
    heights, missing = None, 0
    works = ((source.piece(box), block, corner_of(box)) for box in boxes)
    for box, (means, holes) in zip(boxes, workers.outcomes(block_means, works), strict=True):
        if heights is None:
            heights = np.empty(whole, means.dtype)
        y, x = (start // h for start, h in zip(corner_of(box), block, strict=True))
        heights[y : y + means.shape[0], x : x + means.shape[1]] = means
        missing += holes
    assert heights is not None
    sizes = block[0] * source.pixel_size[0], block[1] * source.pixel_size[1]
    return Coarse(heights, block, sizes, missing / math.prod(source.shape))


def block_means(piece: Piece, block: Shape, corner: Shape) -> tuple[NDArray[Any], int]:
    """Return the means over whole blocks of a piece, and how many of all its points are missing."""
    heights = piece.read()
    (ny, nx), (down, along) = heights.shape, block
    rows, columns = ny // down, nx // along
    inner = heights[: rows * down, : columns * along]
    # rows of blocks first, as adding rows runs along memory
    lines = np.add.reduce(inner.reshape(rows, down, columns * along), axis=1, dtype=np.float64)
    sums = np.add.reduce(lines.reshape(rows, columns, along), axis=2)
    edges = heights[rows * down :], heights[: rows * down, columns * along :]
    if np.isfinite(sums).all() and all(np.isfinite(edge).all() for edge in edges):
        return (sums / (down * along)).astype(heights.dtype), 0
    measured = ~np.isnan(heights)
    missing = heights.size - int(np.count_nonzero(measured))
    refuse_infinite(heights, corner)
    blocks = inner.reshape(rows, down, columns, along)
    counted = measured[: rows * down, : columns * along].reshape(blocks.shape)
    sums = np.add.reduce(blocks, axis=(1, 3), dtype=np.float64, where=counted)
    numbers = np.add.reduce(counted, axis=(1, 3), dtype=np.float64)
    with np.errstate(invalid="ignore"):  # a block without points
        return (sums / numbers).astype(heights.dtype), missing


Columns = dict[str, Any]  # arguments of TabulatedSpectrum


def few_modes(density: Array, error: Array) -> NDArray[np.uint8]:
    return np.where(error > density / 4, _FEW_MODES, 0).astype(np.uint8)


def without_blocks(
    rows: Columns, coarse: Coarse, pixel_size: tuple[float, float], fine: Columns
) -> Columns:
    """Return rows of the coarse map as those of the map: what is folded back is taken off, and
    what means over blocks take from a wave is given back.

    The error of a row is that of the coarse map's and that of what is taken off it, for which rows
    of the tiles err together: at most so much. Rows that are not known to a quarter are flagged,
    as those of few modes. No density is below 0: where less than nothing would be left, it is 0,
    and flagged, as its error is positive.
    """
    q = rows["wavenumber"]
    radii = np.linspace(q[0], q[-1], _RADII)
    angle = (np.arange(_DIRECTIONS) + 0.5) * (math.pi / 2 / _DIRECTIONS)
    kept, folded, unsure = np.empty(_RADII), np.empty(_RADII), np.empty(_RADII)
    for i, radius in enumerate(radii):
        down = _let_through(radius * np.sin(angle), coarse.block[0], pixel_size[0])
        along = _let_through(radius * np.cos(angle), coarse.block[1], pixel_size[1])
        kept[i] = np.mean(down[1][0] * along[1][0])
        length = np.hypot(down[0][:, None], along[0][None, :])
        share = down[1][:, None] * along[1][None, :]
        share[0, 0] = 0  # k = 0 in either direction
        for sums, name in ((folded, "density"), (unsure, "standard_error")):
            known = np.interp(length, fine["wavenumber"], fine[name])
            sums[i] = np.mean(np.sum(share * known, axis=(0, 1)))
    through = np.interp(q, radii, kept)
    density = np.maximum(rows["density"] - np.interp(q, radii, folded), 0) / through
    error = np.hypot(rows["standard_error"], np.interp(q, radii, unsure)) / through
    flag = rows["flag"] | few_modes(density, error)
    return {**rows, "density": density, "standard_error": error, "flag": flag}


def _let_through(q: Array, block: int, pixel: float) -> tuple[Array, Array]:
    """Return q + k Q for k = 0, -1, 1, -2 ..., and their shares of |h|^2, of shape (block, n)."""
    order = np.array([(k + 1) // 2 * (-1 if k % 2 else 1) for k in range(block)])
    waves = q + order[:, None] * (2 * math.pi / (block * pixel))
    half = waves * (pixel / 2)
    with np.errstate(invalid="ignore", divide="ignore"):
        share = np.sin(block * half) / (block * np.sin(half))
    return waves, np.where(half == 0, 1.0, share) ** 2


_MOST_PIXELS = 1000  # along a side


def thinned(source: Source, *, threads: int = 1) -> HeightMap:
    """Return the means over blocks of the map, at most a thousand along a side."""
    side = math.ceil(max(source.shape) / _MOST_PIXELS)
    down, along = (min(side, n) for n in source.shape)
    coarse = coarsen(source, (down, along), (DEFAULT, DEFAULT), Workers(threads))
    return HeightMap(coarse.heights, pixel_size=coarse.pixel_size)


def middle_tile(source: Source, tiles: TileSides, max_dropouts: float) -> HeightMap | None:
    """Return the tile in the middle, its drop-outs filled; None where it has too many."""
    sides = tile_shape(tiles, source)
    down, along = ((n - part) // 2 for n, part in zip(source.shape, sides, strict=True))
    box = slice(down, down + sides[0]), slice(along, along + sides[1])
    heights = source.piece(box).read()
    missing = np.count_nonzero(np.isnan(heights))
    if missing == heights.size or missing > max_dropouts * heights.size:
        return None
    tile = HeightMap(heights, pixel_size=source.pixel_size)
    return tile.fill_dropouts(max_fraction=max_dropouts) if missing else tile
