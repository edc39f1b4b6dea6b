"""The numbers that stand for a drop-out in an array, by the conventions of netCDF (CF, 2.5.1).

Zarr arrays of xarray state them as attributes; those of format 2 as the fill value of the array.
"""

import base64
import binascii
import math
import struct
from collections.abc import Mapping
from contextlib import suppress
from typing import Any

import numpy as np
from numpy.typing import NDArray

from asperity._core import InvalidInput
from asperity.base.arguments import brief

_PACKING = ("add_offset", "scale_factor", "_Unsigned")
_STATED = ("_FillValue", "missing_value")


def fill_values(array: Any) -> tuple[Any, ...]:
    """Return the numbers of an array that stand for a drop-out, in its type; NaN is not among them.

    What xarray decodes has lost these attributes. Numbers that are still packed are refused.
    """
    attrs = getattr(array, "attrs", None)
    attributes = dict(attrs) if isinstance(attrs, Mapping) else {}
    packing = [name for name in _PACKING if name in attributes]
    if packing:
        problem = f"is packed ({', '.join(packing)})"
        raise InvalidInput(f"surface {problem}: unpack it first, as xarray.open_zarr does")
    stated = [(name, attributes[name]) for name in _STATED if name in attributes]
    version = getattr(getattr(array, "metadata", None), "zarr_format", None)
    if version == 2 and "_ARRAY_DIMENSIONS" in attributes and array.fill_value is not None:
        stated.append(("fill_value", array.fill_value))
    numbers = [
        _in_type(one, name, array.dtype)
        for name, several in stated
        for one in np.ravel(several).tolist()
        if one is not None
    ]
    return tuple({number for number in numbers if number is not None})


def without(heights: NDArray[Any], fill: tuple[Any, ...], real: np.dtype[Any]) -> NDArray[Any]:
    """Return a copy with NaN where there is one of these numbers."""
    missing = np.zeros(heights.shape, bool)
    for number in fill:
        missing |= heights == number
    with np.errstate(invalid="ignore"):  # a signalling NaN is a drop-out like others
        result: NDArray[Any] = heights.astype(real)
    result[missing] = np.nan
    return result


def _in_type(stated: Any, name: str, dtype: np.dtype[Any]) -> Any:
    """Return a number in the type of the heights, or None where it is NaN, which is no height."""
    number = _decoded(stated)
    if isinstance(number, float) and math.isnan(number):
        return None
    with suppress(TypeError, ValueError, OverflowError), np.errstate(all="ignore"):
        entry = np.asarray(number).astype(dtype)[()]
        close = dtype.kind == "f" and np.isfinite(entry) == np.isfinite(number)
        if close or entry == number:
            return entry
    problem = f"surface: {name} = {brief(stated)} is no number of type {dtype}"
    raise InvalidInput(f"{problem}: correct the attribute, or give an array with NaN instead")


def _decoded(stated: Any) -> Any:
    """Return a number; Zarr 3 arrays of xarray have those that are not whole in base64."""
    if isinstance(stated, str):
        with suppress(ValueError):
            return float(stated)
        with suppress(binascii.Error, struct.error):
            return struct.unpack("<d", base64.b64decode(stated, validate=True))[0]
    return stated
