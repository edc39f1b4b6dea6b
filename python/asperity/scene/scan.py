"""From a scan, a map or a line, to the spectrum of the surface."""

import math
from collections.abc import Sequence
from contextlib import suppress
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from numpy.lib.stride_tricks import sliding_window_view

from asperity.base.arguments import Array, reading
from asperity.base.diagnostics import InvalidInput, Note, must_be
from asperity.io.read_surface import read_surface
from asperity.measured_spectrum import NO_DIRECTIONS, Window, line_spectrum, power_spectrum
from asperity.plane_spectrum import anisotropy
from asperity.results.directions import LAY as LAY
from asperity.spectrum import Spectrum, TabulatedSpectrum
from asperity.surface import Detrend, HeightMap, LineScan
from asperity.surface import Scan as Scan

_WORN = -0.4  # skewness below which exact contacts differ from those of the spectrum by 20 %
_BINS = (10.0, 7.0, 5.0, 3.0)  # a decade, for the spectrum of a line scan
_FEW_PERIODS, _NEAR_NYQUIST = 1, 2  # bits of TabulatedSpectrum.flag
# White noise of an instrument has a flat C(q), a surface one that falls as q^-2 or steeper. Heights
# taken at points fold finer roughness back (aliasing), by which C(q) falls less below pi / pixel.
# Exponents of a fit over the last quarter, half and whole octave below it, for a surface of
# H = 0.2 that is rough down to an 80th of a pixel, summed over its aliases: what falls less than
# these is no surface, or none that the pixels show.
_FOLDED = ((2**0.25, -0.43), (2**0.5, -0.59), (2.0, -0.89))
# C(q) of a random surface falls, so that a row is above the median of some before it by scatter
# alone: a ring of four modes by a factor of 9 in a thousand.
_LINE, _BESIDE = 20.0, 5  # times the rows beside it, of which there are so many at each side
_ROWS = 6  # fewer tell no exponent with its error
_SMOOTHED = 5  # rows of a running median, past which a single line does not reach


def read_filled(path: Path, *, max_fraction: float, **settings: Any) -> tuple[Scan, Scan]:
    """A scan as `read_surface` reads it, and the same without drop-outs."""
    scan = read_surface(path, **settings)
    with reading(path):
        return scan, scan.fill_dropouts(max_fraction=max_fraction)


def surface_spectrum(
    scan: Scan, *, window: Window, detrend: Detrend | None, directional: bool = False
) -> TabulatedSpectrum:
    """C(q) of the scanned surface; of a line scan that of the isotropic one with such profiles, in
    the finest of a few logarithmic bins that scatter little enough for it."""
    if isinstance(scan, HeightMap):
        return power_spectrum(scan, window=window, detrend=detrend, directional=directional)
    if directional:
        raise must_be("directional", "False", NO_DIRECTIONS)
    profile = line_spectrum(scan, window=window, detrend=detrend)
    *finer, coarsest = _BINS
    for per_decade in finer:
        with suppress(InvalidInput):
            return profile.isotropic(per_decade=per_decade)
    return profile.isotropic(per_decade=coarsest)


def nyquist(scan: Scan) -> float:
    """pi / spacing of the points, the coarser one of a map: the end of what a scan holds whole."""
    return math.pi / (max(scan.pixel_size) if isinstance(scan, HeightMap) else scan.spacing)


def flat(scan: Scan, detrend: Detrend | None) -> Scan:
    return scan.detrend(detrend or "offset")


@dataclass(frozen=True)
class Lay:
    """How much rougher a scan is across its lay, from all waves of a band."""

    ratio: float  # of the principal slopes
    direction: float  # of the lay, from x towards y [rad]
    band: tuple[float, float]  # [1/m]

    @property
    def degrees(self) -> float:
        """In (-45, 135], which ridges along x and along y are far from the ends of: those along y
        were at -89.7 on one band and at 89.7 on another."""
        degrees = math.degrees(self.direction)
        return degrees + 180 if degrees <= -45 else degrees


def lay_of(
    scan: Scan, spectrum: Spectrum, *, window: Window, detrend: Detrend | None
) -> Lay | None:
    """The lay of a scan on the band that is used; None of a line scan, and of a map too small to
    tell."""
    if isinstance(scan, LineScan):
        return None
    band = spectrum.q0, min(spectrum.q1, nyquist(scan))
    how: dict[str, Any] = {"window": window, "detrend": detrend}
    try:
        slopes = anisotropy(scan, **how, q_min=band[0], q_max=band[1])
    except InvalidInput:
        return None
    return Lay(slopes.ratio, slopes.direction, band) if slopes.along > 0 else None


def scan_notes(scan: Scan, result: Lay | None, *, directional: bool = False) -> list[Note]:
    notes = []
    if isinstance(scan, LineScan):
        text = "of a line scan: C(q) is that of the isotropic surface with such profiles"
        notes += [Note(text, code="line-scan"), *_worn_notes(scan)]
    if result is not None and result.ratio > LAY and not directional:
        low, high = result.band
        text = (
            f"the slope across the lay is {result.ratio:.3g} times that along it, which is at "
            f"{result.degrees:.0f} degrees from x towards y (waves from {low:.3g} to {high:.3g} "
            "1/m): the spectrum is an average over directions, and stands for none"
        )
        step = "directional = true in [surface] keeps them, and direction_deg says which is slid"
        notes.append(Note(text, code="lay", next_step=step))
    return notes


def _worn_notes(scan: LineScan) -> list[Note]:
    """What the full spectrum of a profile with worn tops may be worth, in docs/notes/sliding.md."""
    level = scan.detrend("plane")
    if not level.skewness < _WORN:
        return []
    heights = np.asarray(level.heights)
    steep = np.square(np.diff(heights))
    share = float(np.mean(steep[heights[1:] > heights.mean()]) / np.mean(steep))
    text = (
        f"the line scan has skewness {level.skewness:.2g}, and its heights above the mean have "
        f"{share:.2g} of the mean square slope: on worn maps mu of the full spectrum was 1.1 to "
        "4.7 times that of exact contacts, of the top one 0.4 to 2.7 times"
    )
    step = (
        'measure a map, whose own contact kind = "scan-contact" takes; without one compute with '
        'line_spectrum(part="top") too, and state both'
    )
    return [Note(text, code="worn-line-scan", next_step=step)]


def line_notes(spectrum: TabulatedSpectrum, cut: float | None = None) -> list[Note]:
    """What there is to say of lines of a spectrum, as grooves at equal distances have them; `cut`
    is the wavenumber [1/m] where a rule on the slope ends it."""
    whole = spectrum.wavenumber <= spectrum.q1
    q, density = spectrum.wavenumber[whole], spectrum.density[whole]
    if density.size < 2 * _BESIDE + 1:
        return []
    medians = np.median(sliding_window_view(density, _BESIDE), axis=-1)
    beside = np.maximum(medians[: -_BESIDE - 1], medians[_BESIDE + 1 :])
    inner = slice(_BESIDE, -_BESIDE)
    with np.errstate(divide="ignore", invalid="ignore"):
        times = np.where(beside > 0, density[inner] / beside, 0.0)
    if not times.max() > _LINE:
        return []
    at = int(np.argmax(times))
    wave = 2 * math.pi / q[inner][at]
    text = (
        f"C(q) has {np.count_nonzero(times > _LINE)} lines, one of {wave:.3g} m {times[at]:.3g} "
        "times its neighbours: the surface looks turned or ground, and theories of random "
        "roughness may not hold on it"
    )
    step = 'take the scan itself, kind = "scan-contact", and slide across and along'
    if cut is not None and (sides := _line_at(q, times, cut)) is not None:
        low, high = sides
        text += f"; the slope ends it at {cut:.4g} 1/m, in a line: mu hangs on which side it falls"
        step += f"; or end beside the line, q1_per_m = {low:.4g} or {high:.4g}, and state both"
    return [Note(text, code="lines-in-spectrum", next_step=step)]


def _line_at(q: Array, times: Array, cut: float) -> tuple[float, float] | None:
    """The sound rows at both sides of lines [1/m] that are cut, if they are."""
    lines = np.pad(times > _LINE, _BESIDE)
    reached = lines | np.roll(lines, 1) | np.roll(lines, -1)  # C(q) is straight between rows
    below, above = np.flatnonzero(~reached & (q <= cut)), np.flatnonzero(~reached & (q >= cut))
    at = int(np.searchsorted(q, cut))
    if not below.size or not above.size or not reached[max(at - 1, 0) : at + 1].all():
        return None
    return float(q[below[-1]]), float(q[above[0]])


def trusted(spectrum: TabulatedSpectrum) -> Sequence[float] | None:
    """The band [1/m] that is flagged neither for the window nor for Nyquist; None without flags."""
    if spectrum.flag is None:
        return None
    sound = spectrum.wavenumber[(spectrum.flag & (_FEW_PERIODS | _NEAR_NYQUIST)) == 0]
    return (float(sound[0]), float(sound[-1])) if np.size(sound) else None


def noise_floor(spectrum: TabulatedSpectrum) -> float | None:
    """The wavenumber [1/m] from which C(q) of a map is less than twice the level at which it ends
    flat below pi / pixel; None where it falls up to there."""
    band, end = trusted(spectrum), spectrum.q1
    whole = (spectrum.wavenumber <= end) & (spectrum.density > 0)
    q, density = spectrum.wavenumber[whole], spectrum.density[whole]
    if band is None or q.size < _SMOOTHED:
        return None
    for part, least in _FOLDED:
        last = q >= end / part
        if np.count_nonzero(last) < _ROWS:
            continue
        exponent, error = _exponent(q[last], density[last])
        if exponent - 2 * error > least:
            break
    else:
        return None
    level = float(np.median(density[last]))
    middle = slice(_SMOOTHED // 2, -(_SMOOTHED // 2))
    smooth = np.median(sliding_window_view(density, _SMOOTHED), axis=-1)
    drowned = (q[middle] >= band[0]) & (smooth <= 2 * level)
    return float(q[middle][drowned][0]) if drowned.any() else None


def noise_notes(floor: float | None, spectrum: Spectrum) -> list[Note]:
    """A note where a spectrum goes on beyond the wavenumber from which noise is half of it."""
    if floor is None or spectrum.q1 <= floor:
        return []
    sound = spectrum.truncated(q1=floor).rms_slope if floor > spectrum.q0 else 0.0
    text = (
        f"C(q) ends flat, as no surface does: from {floor:.3g} 1/m on noise of the instrument, "
        "or roughness finer than the pixels, is half of it or more; without what lies there the "
        f"rms slope is {sound:.3g} instead of {spectrum.rms_slope:.3g}"
    )
    step = f"end the spectrum there: q1_per_m = {floor:.3g}"
    return [Note(text, code="noise-in-spectrum", next_step=step)]


def _exponent(q: Array, density: Array) -> tuple[float, float]:
    """That of the power law through the rows, and its standard error by their scatter."""
    x, y = np.log(q) - np.log(q).mean(), np.log(density) - np.log(density).mean()
    exponent = (x @ y) / (x @ x)
    left = y - exponent * x
    return float(exponent), math.sqrt((left @ left) / (x @ x) / (x.size - 2))
