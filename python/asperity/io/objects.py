"""Surfaces and tables that other libraries hold: SurfaceTopography, xarray, pandas.

They are known by what they can do, and none of the libraries is imported.
"""

from typing import Any

import numpy as np

from asperity.base.diagnostics import Argument, InvalidInput, must_be
from asperity.io.instrument import (
    METRES,
    PixelSize,
    check_equal_distances,
    check_stated_once,
    checked_unit,
    left_out,
    of_topography,
)
from asperity.io.instrument import surface_of as made
from asperity.io.positions import surface_at
from asperity.surface import Scan


def is_frame(candidate: Any) -> bool:
    """Whether it is a table of columns, as pandas has them."""
    return all(hasattr(candidate, name) for name in ("columns", "to_numpy", "iloc"))


def frame_of(candidate: Any) -> Any:
    """A table of columns: itself, or what an xarray.Dataset makes of it; None of all else."""
    if is_frame(candidate):
        return candidate
    if hasattr(candidate, "data_vars") and hasattr(candidate, "to_dataframe"):
        return candidate.to_dataframe().reset_index()
    return None


def surface_from(
    candidate: Any, pixel_size: PixelSize | None = None, unit: str | None = None
) -> Scan | None:
    """The surface that an object of another library is; None of what is none.

    A Topography or line scan of SurfaceTopography; an `xarray.DataArray` along x, or along y and x,
    whose units are in `attrs`, or a Dataset with one; a DataFrame of columns x, (y and) height.
    `pixel_size` [m] and `unit` are those that the object does not state.
    """
    if callable(getattr(candidate, "heights", None)) and hasattr(candidate, "physical_sizes"):
        left_out("pixel_size", pixel_size, "object")
        check_stated_once("unit", unit, getattr(candidate, "unit", None), "object")
        return of_topography(candidate, None if unit is None else METRES[unit], None)
    if hasattr(candidate, "data_vars"):
        maps = [one for one in candidate.data_vars.values() if one.ndim in (1, 2)]
        if len(maps) == 1 and maps[0].dims[-1] == "x":
            return _of_xarray(maps[0], pixel_size, unit)
    elif all(hasattr(candidate, name) for name in ("dims", "coords", "attrs")):
        return _of_xarray(candidate, pixel_size, unit)
    elif is_frame(candidate):
        return _of_frame(candidate, pixel_size, unit)
    return None


def _of_xarray(array: Any, pixel_size: PixelSize | None, unit: str | None) -> Scan:
    stated = array.attrs.get("units")
    if stated is not None:
        left_out("unit", unit, "object")
    of_heights = stated or unit
    if of_heights is None:
        raise InvalidInput(Argument("unit"), ' is missing: attrs have no "units" of the heights')
    steps: list[float | None] = []
    for name in array.dims:
        if name not in array.coords:
            steps.append(None)
            continue
        places = array.coords[name]
        check_equal_distances(np.asarray(places.values, float))
        length = checked_unit(places.attrs.get("units", of_heights))
        steps.append(float(places[-1] - places[0]) / (places.size - 1) * METRES[length])
    if None not in steps:
        left_out("pixel_size", pixel_size, "object")
        sizes: Any = steps  # numbers all
        pixel_size = sizes[0] if len(sizes) == 1 else tuple(sizes)
    elif pixel_size is None:
        raise InvalidInput(Argument("pixel_size"), " is missing: there are no coordinates")
    return made(np.array(array.values), METRES[checked_unit(of_heights)], pixel_size)


def _of_frame(frame: Any, pixel_size: PixelSize | None, unit: str | None) -> Scan:
    names = [name for name in ("x", "y") if name in frame.columns]
    heights = [name for name in ("height", "z") if name in frame.columns]
    if "x" not in names or len(heights) != 1:
        have = ", ".join(map(repr, list(frame.columns)[:6]))
        raise must_be("", "of x, (y,) and height", f"a table of the columns {have}")
    matrix = frame[[*names, *heights]].to_numpy(dtype=float)
    return surface_at(matrix, pixel_size, unit or "m", ())
