"""Where the tiles of a map lie, and how alike their overlaps make them."""

import math
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from asperity import _core
from asperity.base.arguments import Array, number, whole
from asperity.base.diagnostics import refusal
from asperity.tiles.source import DEFAULT, Box, Shape, Source

SMALLEST = 512  # points a side: the coarsened map, which gives what a tile is too short for, has
# pixels of 1 / 256 of a tile, and is to be smaller than the map
MOST_OVERLAP = 0.75
TileSides = int | tuple[int, int]


@dataclass(frozen=True)
class Grid:
    """Tiles of one shape that cover a map, at equal steps but for rounding."""

    tile: Shape
    starts: tuple[tuple[int, ...], tuple[int, ...]]

    @property
    def boxes(self) -> list[Box]:
        (ny, nx), (down, along) = self.tile, self.starts
        return [(slice(y, y + ny), slice(x, x + nx)) for y in down for x in along]

    def covariances(
        self, window: int, pixel_size: tuple[float, float], used: NDArray[np.bool_]
    ) -> Array:
        """Return covariances of the means of rings 0, 1, ... apart over all used tiles.

        They are in the unit of `tile_covariances`: the sum over all pairs of tiles over the square
        of their number (P. D. Welch, IEEE Trans. Audio Electroacoust. 15, 70 (1967)).
        """
        steps = [(s[-1] - s[0]) / max(1, len(s) - 1) for s in self.starts]
        reach = [
            max((k for k in range(len(s)) if round(k * step) < side), default=0)
            for s, step, side in zip(self.starts, steps, self.tile, strict=True)
        ]
        mask = used.reshape(len(self.starts[0]), len(self.starts[1]))
        total = np.zeros(1)
        for down in range(reach[0] + 1):
            for along in range(reach[1] + 1):
                pairs = _pairs(mask, down, along)
                if not pairs:
                    continue
                shift = round(down * steps[0]), round(along * steps[1])
                covariance = _core.tile_covariances(window, self.tile, pixel_size, shift)
                longer, shorter = sorted((total, pairs * covariance), key=np.size, reverse=True)
                total = longer.copy()
                total[: shorter.size] += shorter
        return total / np.count_nonzero(mask) ** 2


def _pairs(mask: NDArray[np.bool_], down: int, along: int) -> int:
    """How many ordered pairs of used tiles lie so many steps apart, in any of the directions."""
    ny, nx = mask.shape
    upper, lower = mask[: ny - down], mask[down:]
    left, right = slice(0, nx - along), slice(along, nx)
    same = int(np.count_nonzero(upper[:, left] & lower[:, right]))
    other = int(np.count_nonzero(upper[:, right] & lower[:, left]))
    if down and along:
        return 2 * (same + other)
    return same if not (down or along) else 2 * same


def tile_shape(tiles: Any, source: Source) -> Shape:
    """Return the sides of a tile, given as (ny, nx) or as one number for both."""
    shape, pixel_size = source.shape, source.pixel_size
    try:
        ny, nx = tiles
    except TypeError:
        ny = nx = tiles
    except ValueError:
        raise refusal("tiles", tiles, "a number or (ny, nx)") from None
    sides = whole(ny, "tiles"), whole(nx, "tiles")
    for side, whole_side in zip(sides, shape, strict=True):
        if side > whole_side:
            allowed = f"at most {shape}, the map"
            raise refusal("tiles", sides, allowed, text=f"{sides}")
        if side < SMALLEST and sides != shape:
            raise refusal("tiles", sides, f"{SMALLEST} points or more a side", text=f"{sides}")
    shortest = min(n * d for n, d in zip(sides, pixel_size, strict=True))
    if sides != shape and shortest * (1 + 1e-9) < SMALLEST / 2 * max(pixel_size):
        allowed = f"as long as {SMALLEST // 2} of the coarser pixels on either side"
        raise refusal("tiles", sides, f"{allowed}, pixel_size = {pixel_size}", text=f"{sides}")
    return sides


def grid_of(source: Source, tiles: TileSides | None, overlap: Any) -> Grid:
    """Return the fewest tiles that cover the map and overlap at least by that share; without their
    sides those of the default, or of the map."""
    sides = tuple(min(DEFAULT, side) for side in source.shape) if tiles is None else tiles
    tile = tile_shape(sides, source)
    share = 0.5 if overlap is None else number(overlap, "overlap")
    if not 0 <= share <= MOST_OVERLAP:
        raise refusal("overlap", share, f"from 0 to {MOST_OVERLAP}", text=f"{share:.6g}")
    down, along = (
        _starts(side, part, share) for side, part in zip(source.shape, tile, strict=True)
    )
    return Grid(tile, (down, along))


def _starts(side: int, tile: int, overlap: float) -> tuple[int, ...]:
    left = side - tile
    steps = math.ceil(left / (tile * (1 - overlap)) - 1e-9)  # a quotient of 3 is not one of 4
    return tuple(round(k * left / steps) for k in range(steps + 1)) if steps else (0,)
