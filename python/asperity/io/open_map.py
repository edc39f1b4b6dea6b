"""Maps that need not fit in memory: .npy files and Zarr arrays, opened but not read."""

import os
from pathlib import Path
from typing import Any

import numpy as np

from asperity.base.arguments import path_of, reading
from asperity.base.diagnostics import InvalidInput, must_be
from asperity.base.table import imported
from asperity.io import plausible
from asperity.io.files import check_file
from asperity.io.instrument import PixelSize, check_channel, checked_unit, understood
from asperity.io.read_surface import required
from asperity.tiles.source import Source, source_of

_SAMPLED = 64  # rows that tell the order of the heights


def open_map(
    path: str | os.PathLike[str],
    *,
    channel: int = 0,
    pixel_size: PixelSize | None = None,
    unit: str | None = None,
) -> Source:
    """Return the map of a file: a .npy file, mapped read-only, or a Zarr array or group.

    Of a group `channel` counts the arrays of two axes by their names.
    """
    path = path_of(path, "path")
    with reading(path):
        known = None if unit is None else checked_unit(unit)
        array = _zarr(path, channel) if path.is_dir() else _npy(path, channel)
        metres, pixel = required(path, pixel_size, known)
        source = source_of(array, pixel, metres)
        plausible.check_scan(path, _sample(source), min(source.pixel_size), known or "m")
    return source


def _npy(path: Path, channel: int) -> Any:
    check_file(path)
    if path.suffix.lower() != ".npy":
        allowed = "a .npy file or a Zarr array; others are read whole"
        raise must_be("", allowed, "cannot be read by tiles")
    check_channel(channel, 1)
    with understood("not a sound .npy file"):
        return np.load(path, mmap_mode="r", allow_pickle=False)


def _zarr(path: Path, channel: int) -> Any:
    zarr = imported("zarr", "sweep")
    with understood("not a Zarr array or group"):
        opened = zarr.open(path, mode="r")
    if not isinstance(opened, zarr.Group):
        check_channel(channel, 1)
        return opened
    arrays = dict(sorted(opened.arrays()))
    maps = [array for array in arrays.values() if array.ndim == 2]
    if not maps:
        held = ", ".join(f"{name} {array.shape}" for name, array in arrays.items()) or "none"
        raise InvalidInput(f"a Zarr group without an array of two axes; it has {held}")
    check_channel(channel, len(maps))
    return maps[channel]


def _sample(source: Source) -> Any:
    """Some rows of the map, from the first to the last."""
    ny, nx = source.shape
    rows = np.unique(np.linspace(0, ny - 1, min(ny, _SAMPLED)).astype(int))
    return np.concatenate(
        [source.piece((slice(int(y), int(y) + 1), slice(0, nx))).read() for y in rows]
    )
