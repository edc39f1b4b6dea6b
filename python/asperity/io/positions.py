"""Rows of positions and heights: x, z of a profile, or x, y, z of a map."""

import re
from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from asperity.base.arguments import Array
from asperity.base.diagnostics import MUST_BE, Argument, InvalidInput, must_be, refusal
from asperity.io.instrument import METRES, PixelSize, check_equal_distances, left_out, surface_of
from asperity.surface import Scan

FEWEST = 10  # rows of 2 or 3 numbers that are no map: no spectrum is that of so narrow a one
_OFF = 0.05  # of the step: how far a point may lie from its place on the grid
_SPARSEST = 0.25  # share of the grid that has points: fewer are points at random
_NEAR = 0.01  # relative: of a pixel size and the step that it tells the unit of


def has_positions(matrix: NDArray[Any], fewest: int = FEWEST) -> bool:
    """Whether numbers are taken for rows of x, z or x, y, z."""
    return matrix.ndim == 2 and matrix.shape[0] >= fewest and matrix.shape[1] in (2, 3)


def _stated(names: Sequence[str], columns: int) -> tuple[str | None, str | None]:
    """The units of positions and of heights that the names of columns end in."""
    if len(names) != columns:
        return None, None
    matches = [re.search(r"(?:^|[\[(/,_ ])\s*([munpµμ]?m)\s*[\])]?\s*$", name) for name in names]
    units = [re.sub("^[µμ]", "u", one[1]) if one else None for one in matches]
    if len(set(units[:-1])) != 1:
        raise must_be("", "in one", "has x and y in two units")
    return units[0], units[-1]


def surface_at(
    matrix: NDArray[Any], pixel_size: PixelSize | None, unit: str | None, names: Sequence[str]
) -> Scan:
    """The line scan of rows x, z or the map of rows x, y, z at equal steps.

    Positions are in the unit of the heights, unless the file states one, or `pixel_size` [m] is the
    step in another. `names` are those above the columns.
    """
    stated = _stated(names, matrix.shape[1])
    for name, argument, known in (("unit", unit, stated[1]), ("pixel_size", pixel_size, stated[0])):
        if known is not None:
            left_out(name, argument)
    unit = unit or stated[1]
    if unit is None:
        problem = " is missing: rows of positions and heights do not state it"
        raise InvalidInput(Argument("unit"), problem)
    *places, heights = matrix.T
    if not all(np.isfinite(one).all() for one in places):
        raise must_be("", "numbers", "has rows without a position")
    if len(places) == 1:
        (x,) = places
        backward = x[0] > x[-1]
        x, heights = (x[::-1], heights[::-1]) if backward else (x, heights)
        check_equal_distances(x)
        steps = [(x[-1] - x[0]) / (x.size - 1)]
    else:
        (dx, of_x), (dy, of_y) = map(_steps, places)
        steps = [dy, dx]
        grid = np.full((of_y.max() + 1, of_x.max() + 1), np.nan)
        if heights.size < _SPARSEST * grid.size:
            raise _off_grid(f"{heights.size} on {grid.shape[0]} x {grid.shape[1]}")
        taken = np.zeros(grid.shape, bool)
        taken[of_y, of_x] = True
        if np.count_nonzero(taken) < heights.size:
            raise must_be("", "one at each", "has two heights at one x and y")
        grid[of_y, of_x] = heights
        heights = grid
    metres = METRES[stated[0] or unit] if pixel_size is None else _unit_of(steps, pixel_size)
    sizes = [float(step) * metres for step in steps]
    sides: PixelSize = sizes[0] if len(sizes) == 1 else (sizes[0], sizes[1])
    return surface_of(np.array(heights), METRES[unit], sides)


def _steps(x: Array) -> tuple[float, NDArray[np.int64]]:
    """The step of equally spaced positions, and the place of each."""
    gaps = np.diff(np.unique(x))
    if gaps.size == 0:
        raise _off_grid("one x or one y")
    step = float(np.median(gaps[gaps > 0.1 * gaps.max()]))
    length = float(np.ptp(x))
    step = length / round(length / step)
    place = (x - x.min()) / step
    strayed = float(np.max(np.abs(place - np.rint(place))))
    if strayed > _OFF:
        raise _off_grid(f"up to {strayed:.2g} of their step off")
    return step, np.rint(place).astype(np.int64)


def _off_grid(reason: str) -> InvalidInput:
    problem = f"holds rows x, y, z whose points lie on no regular grid ({reason})"
    return InvalidInput(problem, MUST_BE, "at equal steps of x and y; interpolate them")


def _unit_of(steps: Sequence[float], pixel_size: PixelSize) -> float:
    """Metres per unit of the positions, by the pixel size that their step is."""
    pixel = np.broadcast_to(np.asarray(pixel_size, float), len(steps))
    for metres in METRES.values():
        if np.allclose(np.multiply(steps, metres), pixel, rtol=_NEAR, atol=0):
            return metres
    sides = " x ".join(f"{step:.6g}" for step in steps)
    raise refusal("pixel_size", pixel_size, f"left out, or the file's step ({sides}) in m, mm ...")
