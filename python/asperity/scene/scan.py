"""From a scan, a map or a line, to the spectrum of the surface."""

import math
from collections.abc import Sequence
from contextlib import suppress
from pathlib import Path
from typing import Any, Literal

import numpy as np

from asperity._core import (
    HeightMap,
    InvalidInput,
    LineScan,
    TabulatedSpectrum,
    anisotropy,
    line_spectrum,
    power_spectrum,
)
from asperity.io.read_surface import read_surface

Scan = HeightMap | LineScan
Window = Literal["split-cosine-bell", "hann", "none"]
Detrend = Literal["plane", "quadratic", "offset"] | None

_LAY = 1.5  # ratio of the principal slopes above which directions matter: |C| differs by its square
_BINS = (10.0, 7.0, 5.0, 3.0)  # a decade, for the spectrum of a line scan
_FEW_PERIODS, _NEAR_NYQUIST = 1, 2  # bits of TabulatedSpectrum.flag


def read_filled(path: Path, *, max_fraction: float, **settings: Any) -> tuple[Scan, Scan]:
    """A scan as `read_surface` reads it, and the same without drop-outs."""
    scan = read_surface(path, **settings)
    try:
        return scan, scan.fill_dropouts(max_fraction=max_fraction)
    except InvalidInput as error:
        raise InvalidInput(f"{path}: {error}") from error


def surface_spectrum(scan: Scan, *, window: Window, detrend: Detrend) -> TabulatedSpectrum:
    """C(q) of the scanned surface; of a line scan that of the isotropic one with such profiles, in
    the finest of a few logarithmic bins that scatter little enough for it."""
    if isinstance(scan, HeightMap):
        return power_spectrum(scan, window=window, detrend=detrend)
    profile = line_spectrum(scan, window=window, detrend=detrend)
    *finer, coarsest = _BINS
    for per_decade in finer:
        with suppress(InvalidInput):
            return profile.isotropic(per_decade=per_decade)
    return profile.isotropic(per_decade=coarsest)


def nyquist(scan: Scan) -> float:
    """pi / spacing of the points, the coarser one of a map: the end of what a scan holds whole."""
    return math.pi / (max(scan.pixel_size) if isinstance(scan, HeightMap) else scan.spacing)


def flat(scan: Scan, detrend: Detrend) -> Scan:
    """The scan without its trend and without its mean."""
    return scan.detrend(detrend or "offset")


def lay(scan: Scan, *, window: Window, detrend: Detrend) -> float | None:
    """Ratio of the principal slopes; None of a line scan, and of a map too small to tell."""
    if isinstance(scan, LineScan):
        return None
    try:
        found = anisotropy(scan, window=window, detrend=detrend)
    except InvalidInput:
        return None
    return found.ratio if found.along > 0 else None


def scan_notes(scan: Scan, ratio: float | None) -> list[str]:
    """What a reader of the spectrum must know of the scan."""
    notes = []
    if isinstance(scan, LineScan):
        notes.append("of a line scan: C(q) is that of the isotropic surface with such profiles")
    if ratio is not None and ratio > _LAY:
        notes.append(
            f"the slope across the lay is {ratio:.3g} times that along it: the spectrum is an "
            "average over directions, and stands for none"
        )
    return notes


def trusted(spectrum: TabulatedSpectrum) -> Sequence[float] | None:
    """The band [1/m] that is flagged neither for the window nor for Nyquist; None without flags."""
    if spectrum.flag is None:
        return None
    sound = spectrum.wavenumber[(spectrum.flag & (_FEW_PERIODS | _NEAR_NYQUIST)) == 0]
    return (float(sound[0]), float(sound[-1])) if np.size(sound) else None
