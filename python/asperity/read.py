"""Files in: height maps (matrices, instrument formats through SurfaceTopography), master curves."""

import errno
import os
import stat
import warnings
import zipfile
import zlib
from collections.abc import Iterator
from importlib import import_module
from pathlib import Path
from typing import Any, Literal

import numpy as np
from numpy.typing import NDArray

from asperity._core import HeightMap, InvalidInput, MasterCurve

_METRES = {"m": 1.0, "mm": 1e-3, "um": 1e-6, "nm": 1e-9}

_MASTER_CURVE = ["angular_frequency_rad_s", "storage_modulus_pa", "loss_modulus_pa"]

PixelSize = float | tuple[float, float]


def read_surface(
    path: str | os.PathLike[str],
    *,
    channel: int = 0,
    pixel_size: PixelSize | None = None,
    unit: str | None = None,
) -> HeightMap:
    """Height map h(y, x) [m] from a file.

    Matrices in .npy, .npz, .csv and .txt are read directly: one line (or row) per y, cells parted
    by commas, semicolons, tabs or blanks, NaN and empty cells are drop-outs (a separator that ends
    every line is no cell), lines beginning with ``#`` are comments. Such files state neither pixel
    size nor unit, so both are required. Any other format is read through SurfaceTopography
    (``pip install asperity[io]``).

    Parameters
    ----------
    path : path-like
        File to read.
    channel : int
        Index of the map in a file that holds several.
    pixel_size : float or (float, float), optional
        Distance of neighbouring points [m], one number or (dy, dx). Only where the file states
        none.
    unit : {"m", "mm", "um", "nm"}, optional
        Unit of the heights (and of the lengths of an instrument file that names no unit). Only
        where the file states none.

    Returns
    -------
    HeightMap
        Of shape (ny, nx), drop-outs as NaN; float32 in a .npy or .npz file stays float32.

    Raises
    ------
    InvalidInput
        If the file cannot be read, is damaged or is no map, or if `channel`, `pixel_size` or
        `unit` do not fit to it. The message names the file.

    Examples
    --------
    >>> surface = read_surface("scan.npy", pixel_size=(2e-6, 1e-6), unit="um")  # doctest: +SKIP
    """
    path = Path(path)
    if unit is not None and unit not in _METRES:
        raise InvalidInput(f"{path}: unit = {unit!r}: must be one of {', '.join(_METRES)}")
    try:
        _check_file(path)
        loader = _LOADERS.get(path.suffix.lower())
        if loader is None:
            return _read_instrument(path, channel, pixel_size, unit)
        if pixel_size is None or unit is None:
            missing = "pixel_size is missing" if pixel_size is None else "unit is missing"
            unstated = (
                "the distance of its points [m]"
                if pixel_size is None
                else "the unit of its heights"
            )
            raise InvalidInput(f"{missing}: a {path.suffix} file does not state {unstated}")
        heights = loader(path, channel)
        if unit != "m":
            heights = heights * _METRES[unit]
        return HeightMap(heights, pixel_size=pixel_size)
    except OSError as error:
        raise InvalidInput(f"{path}: cannot be read: {error.strerror or error}") from error
    except InvalidInput as error:
        raise InvalidInput(f"{path}: {error}") from error


def read_filled(path: Path, **settings: Any) -> tuple[HeightMap, HeightMap]:
    """A map as `read_surface` reads it, and the same without drop-outs."""
    surface = read_surface(path, **settings)
    try:
        return surface, surface.fill_dropouts()
    except InvalidInput as error:
        raise InvalidInput(f"{path}: {error}") from error


def _check_file(path: Path) -> None:
    """Refuse what cannot be opened, and what one might wait for or read without end."""
    try:
        mode = path.stat().st_mode
    except ValueError as error:
        raise InvalidInput(f"cannot be read: {error}") from error
    if stat.S_ISDIR(mode):
        raise IsADirectoryError(errno.EISDIR, os.strerror(errno.EISDIR))
    if not stat.S_ISREG(mode):
        raise InvalidInput("cannot be read: not a regular file")
    path.open("rb").close()


def _check_channel(channel: int, available: int) -> None:
    if not 0 <= channel < available:
        allowed = "0, the only one" if available == 1 else f"in 0..{available - 1}"
        raise InvalidInput(f"channel = {channel}: must be {allowed}")


def _real(array: NDArray[Any]) -> NDArray[Any]:
    if array.dtype.kind not in "fiu":
        raise InvalidInput(f"holds {array.dtype} values: must be real numbers")
    return array


def _load_npy(path: Path, channel: int) -> NDArray[Any]:
    _check_channel(channel, 1)
    with path.open("rb") as file:
        try:
            array: NDArray[Any] = np.lib.format.read_array(file, allow_pickle=False)
        except (ValueError, EOFError, MemoryError) as error:
            raise InvalidInput(f"not a sound .npy file: {_brief(error)}") from error
    return _real(array)


def _load_npz(path: Path, channel: int) -> NDArray[Any]:
    try:
        with path.open("rb") as file, np.load(file, allow_pickle=False) as archive:
            _check_channel(channel, len(archive.files))
            array: NDArray[Any] = archive[archive.files[channel]]
    except InvalidInput:
        raise
    except (ValueError, EOFError, TypeError, MemoryError, zipfile.BadZipFile, zlib.error) as error:
        raise InvalidInput(f"not a sound .npz file: {_brief(error)}") from error
    return _real(array)


def _load_text(path: Path, channel: int) -> NDArray[Any]:
    _check_channel(channel, 1)
    rows: list[NDArray[Any]] = []
    trailing = True
    for number, cells in _lines(path):
        try:
            rows.append(np.array([_cell(cell) for cell in cells]))
        except ValueError as error:
            raise InvalidInput(f"line {number}: {error}") from error
        if len(cells) != rows[0].size:
            raise InvalidInput(
                f"line {number} has {len(cells)} cells, those before it {rows[0].size}: "
                "must be as many"
            )
        trailing = trailing and len(cells) > 1 and not cells[-1].strip()
    if not rows:
        raise InvalidInput("holds no numbers")
    matrix = np.array(rows)
    return matrix[:, :-1] if trailing else matrix  # every line ends in a separator


def _lines(path: Path) -> Iterator[tuple[int, list[str]]]:
    """Numbers and cells of the lines that are neither blank nor comments."""
    separator: str | None = ""
    with path.open(encoding="utf-8-sig", errors="replace") as file:
        for number, line in enumerate(file, start=1):
            text = line.rstrip("\r\n")
            if not text.strip() or text.lstrip().startswith("#"):
                continue
            if separator == "":
                separator = next((mark for mark in ";,\t" if mark in text), None)
            yield number, text.split(separator)


def _cell(cell: str) -> float:
    text = cell.strip()
    if not text:
        return np.nan
    try:
        if "_" in text:  # float() takes 1_000 for a number
            raise ValueError
        return float(text)
    except ValueError:
        raise ValueError(f"{_brief(text)!r} is not a number") from None


def read_master_curve(
    path: Path, extrapolation: Literal["power-law", "clamp"] | None
) -> MasterCurve:
    """Master curve from a CSV file with a header line that names its three columns."""
    try:
        _check_file(path)
        lines = list(_lines(path))
    except OSError as error:
        raise InvalidInput(f"{path}: cannot be read: {error.strerror or error}") from error
    except InvalidInput as error:
        raise InvalidInput(f"{path}: {error}") from error
    header = ",".join(_MASTER_CURVE)
    if not lines or [cell.strip() for cell in lines[0][1]] != _MASTER_CURVE:
        found = _brief(",".join(lines[0][1])) if lines else "nothing"
        raise InvalidInput(f"{path}: header is {found!r}: must be {header!r}")
    rows = []
    for number, cells in lines[1:]:
        if len(cells) != len(_MASTER_CURVE):
            raise InvalidInput(
                f"{path}: line {number} has {len(cells)} cells: must be 3 ({header})"
            )
        try:
            rows.append([_cell(cell) for cell in cells])
        except ValueError as error:
            raise InvalidInput(f"{path}: line {number}: {error}") from error
    columns = np.array(rows).reshape(-1, 3).T
    try:
        return MasterCurve(
            angular_frequency=columns[0],
            storage_modulus=columns[1],
            loss_modulus=columns[2],
            extrapolation=extrapolation,
        )
    except InvalidInput as error:
        raise InvalidInput(f"{path}: {error}") from error


def _read_instrument(
    path: Path, channel: int, pixel_size: PixelSize | None, unit: str | None
) -> HeightMap:
    try:
        open_topography = import_module("SurfaceTopography.IO").open_topography
    except ModuleNotFoundError as error:
        if (error.name or "").partition(".")[0] != "SurfaceTopography":
            raise
        raise InvalidInput(
            f"{path.suffix or 'this'} files are read by SurfaceTopography: pip install asperity[io]"
        ) from error
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        try:
            with open_topography(str(path)) as reader:
                return _read_channel(reader, channel, pixel_size, unit)
        except InvalidInput:
            raise
        except Exception as error:  # some forty parsers, each with its own ways to fail
            if type(error).__name__ in ("CannotDetectFileFormat", "UnknownFileFormat"):
                raise InvalidInput("of no known format, or damaged") from error
            raise InvalidInput(f"damaged or not supported: {_brief(error)}") from error


def _read_channel(
    reader: Any, channel: int, pixel_size: PixelSize | None, unit: str | None
) -> HeightMap:
    _check_channel(channel, len(reader.channels))
    info = reader.channels[channel]
    if not info.is_height_channel:
        kinds = ", ".join(f"{c.index}: {c.data_kind.value}" for c in reader.channels)
        raise InvalidInput(f"channel = {channel}: must be one of heights ({kinds})")
    if info.dim != 2:
        raise InvalidInput("holds a line scan: must be a map")
    for name, given, stated in (
        ("unit", unit, info.unit),
        ("pixel_size", pixel_size, info.physical_sizes),
    ):
        if given is None and stated is None:
            raise InvalidInput(f"{name} is missing: the file does not state it")
        if given is not None and stated is not None:
            raise InvalidInput(f"{name} = {given!r}: must be left out, the file states its own")

    sizes = {} if pixel_size is None else {"physical_sizes": info.nb_grid_pts}
    topography = reader.topography(channel_index=channel, **sizes)
    factor = 1.0
    if unit is None:
        topography = topography.to_unit("m")
    else:
        factor = _METRES[unit]
    masked: np.ma.MaskedArray[Any, Any] = np.ma.asarray(topography.heights(), dtype=np.float64)
    heights = masked.filled(np.nan).T
    if pixel_size is None:  # SurfaceTopography counts (x, y), we count (y, x)
        dx, dy = (float(d) * factor for d in topography.pixel_size)
        pixel_size = (dy, dx)
    return HeightMap(heights * factor, pixel_size=pixel_size)


def _brief(message: object) -> str:
    """First line of a foreign message, without what a terminal cannot show."""
    lines = str(message).strip().splitlines() or [type(message).__name__]
    text = "".join(c for c in lines[0] if c.isprintable())
    return text if len(text) <= 120 else text[:117] + "..."


_LOADERS = {".npy": _load_npy, ".npz": _load_npz, ".csv": _load_text, ".txt": _load_text}
