"""Maps and line scans from files: matrices here, any other format in `instrument`."""

import os
import re
from array import array
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from asperity.base.arguments import path_of, reading
from asperity.base.diagnostics import Argument, InvalidInput, must_be
from asperity.io import plausible
from asperity.io.archive import Archive, read_array
from asperity.io.files import check_file
from asperity.io.instrument import (
    METRES,
    PixelSize,
    UnrecognisedError,
    brief,
    check_channel,
    checked_unit,
    left_out,
    read_container,
    read_instrument,
    surface_of,
    understood,
)
from asperity.io.objects import surface_from
from asperity.io.positions import FEWEST, has_positions, surface_at
from asperity.io.source import WORKBOOKS, text_lines
from asperity.surface import HeightMap, Scan

_TEXT = (".csv", ".txt", ".xyz", *WORKBOOKS)
_MOST_HEADER = 50  # lines above rows of positions


def read_surface(
    path: str | os.PathLike[str] | Any,
    *,
    channel: int = 0,
    pixel_size: PixelSize | None = None,
    unit: str | None = None,
) -> Scan:
    """Height map h(y, x) or line scan h(x) [m] from a file, or from an object of another library.

    Matrices in .npy, .npz, .csv, .txt and workbooks (.xlsx, .xls) are read directly. Such files
    state neither pixel size nor unit, so both are required. An array of one dimension and a text of
    one column or one line are line scans. Files larger than memory: give numpy.load(path,
    mmap_mode="r") to `power_spectrum` and `height_statistics`, which read it by tiles.

    Text has one line per y, cells parted by semicolons, tabs, commas or blanks; where they are not
    parted by commas, a comma is a decimal one. NaN and empty cells are drop-outs (a separator that
    ends every line is no cell), blank lines and those that begin with ``#`` are passed over. A text
    that is no matrix but begins with a header, and one for which neither `pixel_size` nor `unit` is
    given, is taken where SurfaceTopography knows it and finds its unit stated.

    Rows of two or three numbers, 10 or more, are positions and heights: x, z of a line scan or
    x, y, z of a map, at equal steps. Lines above them may name the columns and their units; else
    `unit` is that of all, unless `pixel_size` is the step and so tells the unit of x and y.

    A ZIP archive of contact.engineering has one scan a channel. It and any other format is read
    through SurfaceTopography (``pip install asperity[io]``). Of a line
    scan with positions they must be equally spaced, to within their last printed digit.

    Parameters
    ----------
    path : path-like, or an object
        File to read; or a Topography of SurfaceTopography, an `xarray.DataArray` with its units in
        `attrs` (also what `HeightMap.to_xarray` gives), a DataFrame of x, (y,) and height.
    channel : int
        Index of the map or line scan in a file that holds several.
    pixel_size : float or (float, float), optional
        Distance of neighbouring points [m], one number or (dy, dx); one number for a line scan.
        Only where the file states none, or one above 0.1 m, which no scan has.
    unit : {"m", "mm", "um", "nm", "pm"}, optional
        Unit of the heights (and of the lengths of an instrument file that names no unit); "µm" is
        "um". Only where the file states none.

    Returns
    -------
    HeightMap or LineScan
        Of shape (ny, nx) or (n,), drop-outs as NaN; float32 in a .npy or .npz file stays float32.

    Raises
    ------
    InvalidInput
        If the file cannot be read, is damaged or is no surface, or if `channel`, `pixel_size` or
        `unit` do not fit to it. The message names the file.

    Examples
    --------
    >>> surface = read_surface("scan.npy", pixel_size=(2e-6, 1e-6), unit="um")  # doctest: +SKIP
    """
    if not isinstance(path, str | os.PathLike):
        check_channel(channel, 1)
        conversion = surface_from(path, pixel_size, None if unit is None else checked_unit(unit))
        if conversion is not None:
            return conversion
    path = path_of(path, "path")
    with reading(path):
        unit = None if unit is None else checked_unit(unit)
        check_file(path)
        surface = _read(path, channel, pixel_size, unit)
    spacing = surface.pixel_size if isinstance(surface, HeightMap) else surface.spacing
    plausible.check_scan(path, surface.heights, spacing, unit or "m")
    return surface


def _read(path: Path, channel: int, pixel_size: PixelSize | None, unit: str | None) -> Scan:
    suffix = path.suffix.lower()
    if suffix == ".toml":
        allowed = "a scan (.npy, .npz, .csv, .txt or the file of an instrument)"
        raise must_be("", allowed, "is a scene, not a surface")
    if suffix == ".zip":
        left_out("pixel_size", pixel_size)
        return read_container(path, channel, unit)
    if suffix in _TEXT:
        return _read_text(path, channel, pixel_size, unit)
    if suffix not in _LOADERS:
        return read_instrument(path, channel, pixel_size, unit)
    scale = required(path, pixel_size, unit)
    return surface_of(_LOADERS[suffix](path, channel), *scale)


def required(path: Path, pixel_size: PixelSize | None, unit: str | None) -> tuple[float, PixelSize]:
    """Metres per unit and pixel size, which files of numbers alone do not state."""
    problem = f" is missing: a {path.suffix} file does not state "
    if pixel_size is None:
        raise InvalidInput(Argument("pixel_size"), f"{problem}the distance of its points [m]")
    if unit is None:
        raise InvalidInput(Argument("unit"), f"{problem}the unit of its heights")
    return METRES[unit], pixel_size


def _real(values: object) -> NDArray[Any]:
    if not isinstance(values, np.ndarray):
        raise must_be("", "an array of real numbers", "holds something else")
    if values.dtype.kind not in "fiu":
        raise must_be("", "real numbers", f"holds {values.dtype} values")
    return np.asarray(values)


def _load_npy(path: Path, channel: int) -> NDArray[Any]:
    check_channel(channel, 1)
    with understood("not a sound .npy file"):
        return np.array(_real(np.load(path, mmap_mode="r", allow_pickle=False)))


def _load_npz(path: Path, channel: int) -> NDArray[Any]:
    with understood("not a sound .npz file"), path.open("rb") as file:
        archive = Archive(file)
        if not archive.members:
            raise InvalidInput("holds no arrays")
        check_channel(channel, len(archive.members))
        return _real(read_array(archive, archive.members[channel]))


_LOADERS = {".npy": _load_npy, ".npz": _load_npz}


def _read_text(path: Path, channel: int, pixel_size: PixelSize | None, unit: str | None) -> Scan:
    """A matrix of numbers, or what SurfaceTopography knows and finds the unit of."""
    names: list[str] = []
    try:
        heights, no_matrix = _load_text(path), None
    except UnrecognisedError as error:
        heights, no_matrix = np.empty(0), error
    if no_matrix is not None or (pixel_size is None and unit is None):
        try:
            return read_instrument(path, channel, pixel_size, unit, must_state_unit=True)
        except UnrecognisedError as error:
            if no_matrix is not None:
                heights, names = _below_header(path)
                if not has_positions(heights):
                    message = f"{no_matrix} (and as the file of an instrument: {error})"
                    raise InvalidInput(message) from error
    check_channel(channel, 1)
    if has_positions(heights, fewest=2 if path.suffix.lower() == ".xyz" else FEWEST):
        return surface_at(heights, pixel_size, unit, names)
    return surface_of(heights, *required(path, pixel_size, unit))


def _below_header(path: Path) -> tuple[NDArray[Any], list[str]]:
    """Numbers below lines of text, with the names that the last of these has for them."""
    names: list[str] = []
    for number, text in enumerate(text_lines(path), start=1):
        cells = _split(text, _separator(text))
        try:
            if any(np.isfinite([cell(one) for one in cells])):
                return _load_text(path, begin=number), names
        except ValueError:
            names = cells
        if number > _MOST_HEADER:
            break
    return np.empty(0), names


def _load_text(path: Path, begin: int = 1) -> NDArray[Any]:
    """Matrix, or the vector of one line or column; UnrecognisedError where a header begins it."""
    values = array("d")
    width = blank = gap = 0  # numbers of cells, of the first blank line, of one between numbers
    trailing = True
    separator: str | None = ""
    for number, line in enumerate(text_lines(path), start=1):
        if number < begin or line.lstrip().startswith("#"):
            continue
        if not line.strip(" " if separator == "\t" else None):
            blank = blank or (number if values else 0)
            continue
        if separator == "":
            separator = _separator(line)
        cells = _split(line, separator)
        try:
            row = [cell(text) for text in cells]
        except ValueError as error:
            kind = InvalidInput if values else UnrecognisedError
            raise kind(f"line {number}: {error}") from error
        width = width or len(row)
        if len(row) != width:
            must = f"it must have {width}, as those before it"
            raise InvalidInput(f"line {number} has {len(row)} cells; {must}")
        trailing = trailing and width > 1 and not cells[-1].strip()
        gap = blank
        values.extend(row)
    if not values:
        raise InvalidInput("holds no numbers")
    matrix = np.frombuffer(values).reshape(-1, width)
    if trailing:  # every line ends in a separator
        matrix = matrix[:, :-1]
    if matrix.shape[1] == 1 and gap:
        raise InvalidInput(f"line {gap} is blank: a drop-out of a line scan must be nan")
    return matrix.reshape(-1) if 1 in matrix.shape else matrix


def _split(text: str, separator: str | None) -> list[str]:
    if separator != "," and "," in text:
        text = re.sub(r",(?=\d)", ".", text)  # decimal commas
    return text.split(separator)


def _separator(line: str) -> str | None:
    """What parts the cells of a line; None of blanks, between which a comma is a decimal one."""
    if re.search(r"\d +[-+.]?\d", line):
        return next((mark for mark in ";\t" if mark in line), None)
    return next((mark for mark in ";\t," if mark in line), None)


def cell(text: str) -> float:
    """The number in a cell of a table; NaN in an empty one."""
    text = text.strip()
    if not text:
        return np.nan
    try:
        if "_" in text:  # float() takes 1_000 for a number
            raise ValueError
        return float(text)
    except ValueError:
        raise ValueError(f"{brief(text)!r} is not a number") from None
