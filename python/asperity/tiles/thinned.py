"""Small maps that stand for a large one: thinned out to be drawn, and its tile in the middle."""

import math

import numpy as np

from asperity.surface import HeightMap
from asperity.tiles.coarse import coarsen
from asperity.tiles.grid import TileSides, tile_shape
from asperity.tiles.share import Workers
from asperity.tiles.source import DEFAULT, Source

_MOST_PIXELS = 1000  # along a side


def thinned(source: Source, *, threads: int = 1) -> HeightMap:
    """Return the means over blocks of the map, at most a thousand along a side."""
    side = math.ceil(max(source.shape) / _MOST_PIXELS)
    down, along = (min(side, n) for n in source.shape)
    coarse = coarsen(source, (down, along), (DEFAULT, DEFAULT), Workers(threads))
    return HeightMap(coarse.heights, pixel_size=coarse.pixel_size)


def middle_tile(source: Source, tiles: TileSides, max_dropouts: float) -> HeightMap | None:
    """Return the tile in the middle, its drop-outs filled; None where it has too many."""
    sides = tile_shape(tiles, source.shape, source.pixel_size)
    down, along = ((n - part) // 2 for n, part in zip(source.shape, sides, strict=True))
    box = slice(down, down + sides[0]), slice(along, along + sides[1])
    heights = source.piece(box).read()
    missing = np.count_nonzero(np.isnan(heights))
    if missing == heights.size or missing > max_dropouts * heights.size:
        return None
    tile = HeightMap(heights, pixel_size=source.pixel_size)
    return tile.fill_dropouts(max_fraction=max_dropouts) if missing else tile
