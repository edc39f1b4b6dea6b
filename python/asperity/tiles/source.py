"""Heights that need not fit in memory: memory maps, Zarr, Dask and other arrays, read in pieces."""

import base64
import binascii
import math
import struct
from collections.abc import Mapping
from contextlib import suppress
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from asperity.base.arguments import brief, is_masked
from asperity.base.diagnostics import Argument, Error, InvalidInput, must_be, must_have, refusal
from asperity.base.executors import in_one_line
from asperity.surface import HeightMap, LineScan, pixel_sizes
from asperity.tiles.file_array import FileArray, file_behind

Box = tuple[slice, slice]
Shape = tuple[int, int]
DEFAULT = 4096  # points a side of what is read at a time


@dataclass(frozen=True)
class Piece:
    """A rectangle of a map that a worker reads for itself; of a map in memory, its heights."""

    array: Any
    box: Box
    scale: float
    fill: tuple[Any, ...] = ()

    def read(self) -> NDArray[Any]:
        """Return float32 or float64 heights in memory of their own, or views of what is there."""
        try:
            block = self.array[self.box]
            if callable(getattr(block, "compute", None)):  # Dask
                block = block.compute(scheduler="synchronous")
            if is_masked(block):
                block = np.where(block.mask, np.nan, block.data)
            block = np.asarray(block)
        except (Error, MemoryError):
            raise
        except Exception as error:
            raise InvalidInput(
                Argument("heights"), f": cannot be read: {in_one_line(error)}"
            ) from error
        wanted = tuple(part.stop - part.start for part in self.box)
        if block.shape != wanted:
            raise InvalidInput(
                Argument("heights"), f": gave {block.shape} points where {wanted} were asked for"
            )
        single = block.dtype.kind == "f" and block.dtype.itemsize == 4
        real = np.dtype(np.float32 if single else np.float64)
        if self.fill:
            block = without(block, self.fill, real)
        if self.scale != 1:
            block = np.multiply(block, self.scale, dtype=real, casting="same_kind")
        with np.errstate(invalid="ignore"):  # a signalling NaN is a drop-out like others
            heights: NDArray[Any] = block.astype(real, copy=False)
        return heights


@dataclass(frozen=True)
class Source:
    """A map, wherever it is."""

    array: Any
    shape: Shape
    pixel_size: tuple[float, float]
    scale: float = 1.0  # metres in a unit of the numbers
    fill: tuple[Any, ...] = ()  # numbers that stand for a drop-out

    def piece(self, box: Box) -> Piece:
        """Return a rectangle, which holds no more than a worker needs."""
        if isinstance(self.array, np.ndarray):
            part = self.array[box]
            whole = slice(0, part.shape[0]), slice(0, part.shape[1])
            return Piece(part, whole, self.scale, self.fill)
        return Piece(self.array, box, self.scale, self.fill)


def source_of(surface: Any, pixel_size: Any, scale: float = 1.0) -> Source:
    """Return the heights of a HeightMap or of an array, checked but not read; a source as it is."""
    if isinstance(surface, Source):
        if pixel_size is not None:
            raise InvalidInput(Argument("pixel_size"), ": an opened map has its own")
        return surface
    if isinstance(surface, LineScan):
        raise must_be("surface", "a map; a line scan has no tiles", " = a LineScan")
    if isinstance(surface, HeightMap):
        if pixel_size is not None:
            raise InvalidInput(
                Argument("pixel_size"), ": a HeightMap has its own; give it with an array only"
            )
        return Source(_held(surface.heights), _shape(surface.heights.shape), surface.pixel_size)
    array = _array(surface)
    fill = fill_values(array)
    if pixel_size is None:
        raise InvalidInput(
            Argument("pixel_size"), " is missing: an array does not state the distance [m]"
        )
    sizes = pixel_sizes(pixel_size)
    for size in sizes:
        if not (math.isfinite(size) and size > 0):
            raise refusal("pixel_size", size, "positive and finite", text=f"{size}")
    held = _held(array) if isinstance(array, np.ndarray) else array
    return Source(held, _shape(array.shape), sizes, scale, fill)


def _array(array: Any) -> Any:
    """Return an array of two axes of real numbers that can be sliced."""
    if isinstance(array, list | tuple):
        array = np.array(array)
    if _is_group(array):
        names = ", ".join(sorted(map(str, array))) or "none"
        raise InvalidInput(Argument("surface"), f" = a group of arrays: give one of them ({names})")
    dtype, shape = getattr(array, "dtype", None), getattr(array, "shape", None)
    if dtype is None or shape is None or not hasattr(array, "__getitem__"):
        allowed = "a HeightMap or an array of two axes (NumPy, Zarr, Dask ...)"
        raise refusal("surface", array, allowed)
    if len(shape) != 2:
        raise must_have("surface", "two axes, (ny, nx)", f" has shape {tuple(shape)}")
    if not all(isinstance(side, int | np.integer) and side > 0 for side in shape):
        allowed = "known and not empty"
        raise must_be("surface", allowed, f" has shape {tuple(shape)}")
    if getattr(dtype, "kind", "?") not in "biuf":
        raise must_be("surface", "real numbers", f" holds {dtype} values")
    return array


def _held(array: NDArray[Any]) -> Any:
    if is_masked(array):
        return array
    file: FileArray | None = file_behind(array)
    return array if file is None else file


def _is_group(candidate: Any) -> bool:
    """Whether this is a Zarr or HDF5 group, or anything else that holds arrays by names."""
    named = isinstance(candidate, Mapping) or callable(getattr(candidate, "arrays", None))
    return named and getattr(candidate, "dtype", None) is None


def _shape(shape: Any) -> Shape:
    ny, nx = shape
    return int(ny), int(nx)


def boxes_of(shape: Shape, step: Shape) -> list[Box]:
    """Return the rectangles of that shape, smaller at the ends, that make up a map."""
    (ny, nx), (down, along) = shape, step
    return [
        (slice(y, min(y + down, ny)), slice(x, min(x + along, nx)))
        for y in range(0, ny, down)
        for x in range(0, nx, along)
    ]


def refuse_infinite(heights: NDArray[Any], corner: Shape) -> None:
    """Refuse an infinite height by its place in the map; `corner` is that of the first one."""
    endless = np.isinf(heights)
    if endless.any():
        y, x = np.unravel_index(int(endless.argmax()), heights.shape)
        place = f"heights[{corner[0] + int(y)}, {corner[1] + int(x)}]"
        allowed = "finite, or NaN for a drop-out"
        raise refusal(place, heights[y, x], allowed, text=f"{heights[y, x]}")


def corner_of(box: Box) -> Shape:
    return box[0].start, box[1].start


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
    missing = np.zeros(heights.shape, bool)
    for number in fill:
        missing |= heights == number
    with np.errstate(invalid="ignore"):  # a signalling NaN is a drop-out like others
        result: NDArray[Any] = heights.astype(real)
    result[missing] = np.nan
    return result


def _in_type(stated: Any, name: str, dtype: np.dtype[Any]) -> Any:
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
