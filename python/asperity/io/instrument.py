"""Files of instruments through SurfaceTopography, and what all scans from files share."""

import re
import warnings
from collections.abc import Iterator
from contextlib import contextmanager
from functools import partial
from importlib import import_module
from io import BytesIO
from pathlib import Path
from typing import Any
from zipfile import ZipFile, is_zipfile

import numpy as np
from numpy.typing import NDArray

from asperity.base.diagnostics import Argument, InvalidInput, must_be, must_have, refusal
from asperity.base.quantities import LENGTH_UNITS, SPACING
from asperity.base.table import to_install
from asperity.io.archive import Archive
from asperity.io.fields import rename_in_errors
from asperity.surface import HeightMap, LineScan, Scan

METRES = {unit: factor for unit, (factor, _) in LENGTH_UNITS.items()}

PixelSize = float | tuple[float, float]

_UNEVEN = 1e-3  # of the spacing: how far positions may be from equal distances in any case
_ROUNDED = 0.7  # of the last printed digit: rounding shifts them by 0.5, and the line through them


class UnrecognisedError(InvalidInput):
    """A file is not of the format that it was taken for."""


@contextmanager
def understood(
    problem: str, kind: type[InvalidInput] = InvalidInput, package: str = ""
) -> Iterator[None]:
    """One error for all the ways in which another library cannot read a file, or is missing."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        try:
            yield
        except (InvalidInput, OSError):
            raise
        except ModuleNotFoundError as error:
            raise kind(f"needs {package}: {to_install('io')}") from error
        except Exception as error:
            raise kind(f"{problem}: {brief(error)}") from error


def checked_unit(unit: str) -> str:
    """The unit, micro signs (there are two) written as u."""
    plain = _plain(unit) if isinstance(unit, str) else ""
    if plain not in METRES:
        raise refusal("unit", unit, f"one of {', '.join(METRES)}")
    return plain


def _plain(unit: str) -> str:
    return re.sub("^[\u00b5\u03bc]m$", "um", unit)


def surface_of(heights: NDArray[Any], metres: float, pixel_size: PixelSize) -> Scan:
    """The map or line scan of heights in units of `metres`; float32 stays float32."""
    if heights.ndim not in (1, 2):
        dimensions = f" has {heights.ndim} dimensions"
        raise must_have("heights", "2 (a map) or 1 (a line scan)", dimensions)
    if metres != 1:
        kept = heights.dtype.kind == "f" and heights.dtype.itemsize == 4
        real = np.dtype(np.float32 if kept else np.float64)
        own = heights if heights.dtype == real and heights.flags.writeable else None
        with np.errstate(invalid="ignore"):  # a signalling NaN is a drop-out like others
            heights = np.multiply(heights, metres, out=own, dtype=real, casting="same_kind")
    if heights.ndim == 2:
        return HeightMap(heights, pixel_size=pixel_size)
    if isinstance(pixel_size, tuple) or np.ndim(pixel_size) > 0:
        raise refusal("pixel_size", pixel_size, "one number, the file holds a line scan")
    with rename_in_errors(None, {"spacing": "pixel_size"}):
        return LineScan(heights, spacing=pixel_size)


def left_out(name: str, given: Any, source: str = "file") -> None:
    """Refuse an argument that what is read states itself."""
    if given is not None:
        raise refusal(name, given, f"left out, the {source} states its own", text=f"{given!r}")


def check_stated_once(name: str, given: Any, stated: Any, source: str = "file") -> None:
    """Refuse an argument that what is read states itself, and one that nobody states."""
    if stated is not None:
        left_out(name, given, source)
    elif given is None:
        raise InvalidInput(Argument(name), f" is missing: the {source} does not state it")


def check_channel(channel: int, available: int) -> None:
    if not (isinstance(channel, int | np.integer) and 0 <= channel < available):
        allowed = "0, the only one" if available == 1 else f"in 0..{available - 1}"
        raise refusal("channel", channel, allowed)


def read_instrument(
    path: Path,
    channel: int,
    pixel_size: PixelSize | None,
    unit: str | None,
    *,
    must_state_unit: bool = False,
) -> Scan:
    """One channel of a file; UnrecognisedError where SurfaceTopography makes nothing of it."""
    import logging  # here: `import asperity` is to be quick

    for parser in ("SurfaceTopography", "igor2"):  # errors are raised, not printed besides
        if not (log := logging.getLogger(parser)).handlers:
            log.addHandler(logging.NullHandler())
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        try:
            open_topography = import_module("SurfaceTopography.IO").open_topography
        except ModuleNotFoundError as error:
            if (error.name or "").partition(".")[0] != "SurfaceTopography":
                raise
            problem = f"needs SurfaceTopography: {to_install('io')}"
            raise UnrecognisedError(problem) from error
        try:
            with open_topography(_as_iso_5436(path) or str(path)) as reader:
                by_size = reader.format() == "hgt"  # which any file of 2 n^2 bytes seems to be
                if not reader.channels or (by_size and path.suffix.lower() != ".hgt"):
                    raise UnrecognisedError("of no known format, or damaged")
                if must_state_unit and all(c.unit is None for c in reader.channels):
                    raise UnrecognisedError("states no unit")
                return _read_channel(reader, channel, pixel_size, unit)
        except InvalidInput:
            raise
        except Exception as error:  # some forty parsers, each with its own ways to fail
            if type(error).__name__ in ("CannotDetectFileFormat", "UnknownFileFormat"):
                raise UnrecognisedError("of no known format, or damaged") from error
            raise UnrecognisedError(f"damaged or not supported: {brief(error)}") from error


def _as_iso_5436(path: Path) -> BytesIO | None:
    """An .x3p archive with its main.xml outside of any folder and no empty offsets, where this one
    differs; None of all other files. SurfaceTopography reads no other."""
    if not is_zipfile(path):
        return None
    with path.open("rb") as file:
        archive = Archive(file)
        named = {one.filename: one for one in archive.members}
        mains = [name for name in named if name.split("/")[-1] == "main.xml"]
        main = min(mains, key=len, default="")
        if not main:
            return None
        folder, copy = main.removesuffix("main.xml"), BytesIO()
        text = archive.open(named[main]).read_all()
        mended = re.sub(rb"<Offset\s*/>|<Offset>\s*</Offset>", b"<Offset>0</Offset>", text)
        if not folder and mended == text:
            return None
        with ZipFile(copy, "w") as flat:
            for name, one in named.items():
                if name.startswith(folder):
                    content = mended if name == main else archive.open(one).read_all()
                    flat.writestr(name.removeprefix(folder), content)
    copy.seek(0)
    return copy


def scans_of_container(path: Path) -> list[Any]:
    """What reads the scans of a ZIP archive of contact.engineering, one after the other."""
    problem = "no archive of contact.engineering, or damaged"
    with understood(problem, UnrecognisedError, "SurfaceTopography"):
        with path.open("rb") as file:
            Archive(file).check()
        reader = import_module("SurfaceTopography.Container.IO").CEReader(str(path))
        return [
            partial(container.__getitem__, at)
            for container in map(reader.container, range(reader.nb_containers))
            for at in range(len(container))
        ]


def read_container(path: Path, channel: int, unit: str | None) -> Scan:
    """One scan of such an archive; `channel` counts them."""
    import gc  # here, as logging

    scans = scans_of_container(path)
    check_channel(channel, len(scans))
    with understood(f"scan {channel}", UnrecognisedError):
        try:
            topography = scans[channel]()
        finally:
            gc.collect()  # the library leaves files open, in circles of references
    check_stated_once("unit", unit, topography.unit)
    return of_topography(topography, None if unit is None else METRES[unit], None)


def _read_channel(
    reader: Any, channel: int, pixel_size: PixelSize | None, unit: str | None
) -> Scan:
    check_channel(channel, len(reader.channels))
    info = reader.channels[channel]
    if not info.is_height_channel:
        kinds = ", ".join(f"{c.index}: {c.data_kind.value}" for c in reader.channels)
        raise refusal("channel", channel, f"one of heights ({kinds})", text=f"{channel}")
    check_stated_once("unit", unit, info.unit)
    is_coarse = pixel_size is not None and _coarse(info)
    check_stated_once("pixel_size", pixel_size, None if is_coarse else info.physical_sizes)
    unsized = info.physical_sizes is None  # SurfaceTopography wants some size
    sizes = {"physical_sizes": info.nb_grid_pts} if unsized else {}
    topography = reader.topography(channel_index=channel, **sizes)
    return of_topography(topography, None if unit is None else METRES[unit], pixel_size)


def _coarse(info: Any) -> bool:
    """Whether a file states its points further apart than those of any scan are."""
    metres = METRES.get(_plain(info.unit or ""), 1.0)
    steps = metres * np.divide(info.physical_sizes or (0.0,), info.nb_grid_pts)
    return SPACING.high is not None and float(np.max(steps)) > SPACING.high.value


def of_topography(topography: Any, metres: float | None, pixel_size: PixelSize | None) -> Scan:
    """An object of SurfaceTopography; `metres` and `pixel_size` where it knows none itself."""
    if not topography.is_uniform:
        check_equal_distances(np.asarray(topography.positions()))
    if metres is None:
        metres, topography = 1.0, topography.to_unit("m")
    masked: np.ma.MaskedArray[Any, Any] = np.ma.asarray(topography.heights(), dtype=np.float64)
    heights = masked.filled(np.nan).T
    if pixel_size is None:  # SurfaceTopography counts (x, y), we count (y, x)
        gaps = np.array(heights.shape) - (0 if topography.is_uniform else 1)
        steps = np.ravel(topography.physical_sizes)[::-1] * metres / gaps
        pixel_size = float(steps[0]) if len(steps) == 1 else (float(steps[0]), float(steps[1]))
    return surface_of(heights, metres, pixel_size)


def check_equal_distances(positions: NDArray[Any]) -> None:
    """Refuse positions that are not equal steps even within their last printed digit."""
    if positions.size < 2 or not np.all(np.diff(positions) > 0):
        raise InvalidInput("holds a line scan whose positions do not increase: must do so")
    step = (positions[-1] - positions[0]) / (positions.size - 1)
    count = np.arange(positions.size) - (positions.size - 1) / 2
    fitted = np.mean(positions) + count * (count @ positions) / (count @ count)
    strayed = float(np.max(np.abs(positions - fitted)))
    if not strayed <= max(_UNEVEN * step, _ROUNDED * _last_digit(positions, step)):
        by = f"up to {strayed / step:.3g} of their mean distance"
        raise must_be("", "equally spaced", f"holds a line scan whose points stray by {by}")


def _last_digit(positions: NDArray[Any], step: float) -> float:
    """The power of ten below `step` that all positions are multiples of, 0 if it matters not."""
    first = int(np.ceil(-np.log10(step)))
    for digits in range(first, first + 4):
        place = 10.0**-digits
        if np.allclose(positions, np.round(positions, digits), rtol=0, atol=1e-6 * place):
            return place
    return 0.0


def brief(message: object) -> str:
    """First line of a foreign message, without what a terminal cannot show."""
    lines = str(message).strip().splitlines() or [type(message).__name__]
    text = "".join(c for c in lines[0] if c.isprintable())
    return text if len(text) <= 120 else text[:117] + "..."
