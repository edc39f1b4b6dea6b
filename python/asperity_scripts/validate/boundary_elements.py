"""A surface of one's own pressed by boundary elements: the contact that the theory is held against.

The solver is `slide` at velocity 0.
"""

import math
from collections.abc import Sequence
from contextlib import nullcontext
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from asperity.base.diagnostics import Note, must_have, refusal
from asperity.measured_spectrum import power_spectrum
from asperity.rubber import PronySeries
from asperity.scene.model import Progress
from asperity.surface import HeightMap
from asperity.validation.sliding import slide
from asperity_scripts.validate.contacts import Contact

_Array = NDArray[np.float64]

_FEWEST = 16  # points along a side
_TOLERANCE = 1e-8  # sum(p gap) / (sum(p) h_rms)


@dataclass(frozen=True, eq=False)
class Contacts:
    """Contacts of one map, arrays over the loads. Gap and energy are per nominal area A0.

    p_over_Eh     p / (E* h')
    area_raw      A/A0, the share of the points that carry pressure
    area          A/A0 without the perimeter's excess, see `contact`
    mean_gap      [m] between the surfaces; the solids have approached by what it lost
    elastic_energy
                  U / (A0 E*) [m], (1/2) <p u> of the displacement u without its mean, so that
                  p = -dU/d(mean gap); (1/4) sum q |h_q|^2 in full contact
    rms_slope     h', of the map that was solved: h'^2 = sum q^2 |h_q|^2 over its Fourier modes
    """

    p_over_Eh: _Array
    area_raw: _Array
    area: _Array
    mean_gap: _Array
    elastic_energy: _Array
    rms_slope: float


def mirrored(surface: HeightMap) -> HeightMap:
    """The periodic map that a scan and its mirror images make, of twice the points along each side.

    The solver is periodic, a scan is not. Of 256^2 cut from 1024^2 points (H 0.8, q1/q0 = 8, four
    longest waves along a side of the cut), the mirrored ones have the whole map's rms slope to
    0.1 % and its area at the same p / (E* h') to +1.2 % at 0.01, +0.4 % at 0.05, and 0.1 % from 0.2
    on. As they are, with jumps at their sides, they have 8 to 20 % too much, and under a window,
    which tapers their heights, from half to three times of it.

    Take the trend out first: a tilt becomes a roof.
    """
    ny, nx = surface.heights.shape
    heights = np.pad(surface.heights, ((0, ny), (0, nx)), mode="symmetric")
    return HeightMap(heights, pixel_size=surface.pixel_size)


def contact(
    surface: HeightMap,
    *,
    p_over_Eh: Sequence[float],
    periodic: bool = False,
    progress: Progress = nullcontext,
) -> Contacts:
    """Press a rigid map into an elastic half-space, without friction or adhesion.

    Parameters
    ----------
    surface
        Heights [m], shape (ny, nx), without drop-outs and trend; pixels need not be square.
    p_over_Eh
        Loads p / (E* h'), in any order: h' is the slope of the map that is solved.
    periodic
        True: the map continues at its opposite sides, as those of `synthesize` do, and is solved as
        it is. Otherwise it is `mirrored`.
    progress
        Sees the loads, one by one.

    Notes
    -----
    Fourier modes of the points' own grid, solved by `slide`. From the load on where the sum of the
    modes leaves no tension anywhere the contact is full and has a closed form, which is taken.

    Points touch in whole pixels, more of them than the true area has. What stands out over the
    perimeter S is taken off (Yastrebov, Anciaux and Molinari, Tribology International 114 (2017)
    161): A = A_raw - ((pi - 1 + ln 2) / 24) S dx. Six maps (H 0.8, q1/q0 = 4) in pixels halved four
    times say that 0.85 of it would be right, so that areas are low: at p / (E* h') = 0.01, 0.1 and
    0.7 by 1.7, 0.9 and 0.1 % where the finest waves are 10 pixels long, and by half as much at 20;
    by 1.6, 1.6 and 0.2 % at 5. At 2.5 single maps scatter by 2 % at 0.1 and more below. Energies
    and gaps are right to 0.3 % at 5 pixels, and to 1 % (0.7: 3 %) at 2.5 from 0.1 on.

    512^2 points take 0.1 to 0.2 s, 1024^2 points 0.6 to 1.2 s. A `mirrored` map has four times the
    points of its scan.

    Raises
    ------
    InvalidInput
        For a map with drop-outs, below 16 points along a side, or flat; for loads that are not
        positive numbers.
    NotConverged
        Names the load and the error that was reached.
    """
    loads = _loads(p_over_Eh)
    _check(surface)
    solved = surface if periodic else mirrored(surface)
    dy, dx = solved.pixel_size
    heights = np.array(solved.heights, dtype=np.float64, order="C")
    heights -= heights[0, 0]  # a constant has no slope then, not even one of rounding
    heights -= heights.mean()
    slope, lowest, energy = _full_contact(heights, (dy, dx))
    if not 0 < slope < math.inf:
        raise must_have("surface", "roughness", f" has an rms slope of {slope:.3g}")

    level = HeightMap(heights, pixel_size=(dy, dx))
    rows = []
    with progress([slice(i, i + 1) for i in range(loads.size)]) as shown:
        for chunk in shown:
            (load,) = loads[chunk]
            full = load + lowest / slope >= 0
            rows.append((1.0, 1.0, 0.0, energy) if full else _pressed(level, float(load) * slope))
    raw, area, gap, work = np.array(rows).T
    return Contacts(loads, raw, area, gap, work, slope)


def _pressed(surface: HeightMap, pressure: float) -> tuple[float, float, float, float]:
    """Raw area, area, mean gap and energy at a pressure [E*]: a velocity of 0 is elastic."""
    solid = PronySeries(equilibrium_modulus=1.0, moduli=[], relaxation_times=[])
    contact = slide(
        surface,
        solid,
        pressure=pressure,
        velocity=0.0,
        poisson_ratio=0.0,
        periodic=True,
        rtol=_TOLERANCE,
    )
    gap = float(contact.gap.mean())
    return contact.contact_area_raw, contact.contact_area, gap, contact.elastic_energy


def _loads(p_over_Eh: Sequence[float]) -> _Array:
    try:
        loads = np.array(p_over_Eh, dtype=np.float64)
    except (TypeError, ValueError) as error:
        raise refusal("p_over_Eh", p_over_Eh, "a list of numbers", text=f"{p_over_Eh!r}") from error
    if loads.ndim != 1 or loads.size == 0:
        raise must_have("p_over_Eh", "one axis, and a load", f" has shape {loads.shape}")
    for load in loads:
        if not 0 < load < math.inf:
            raise refusal("p_over_Eh", load, "positive and finite", text=f"{load:g}")
    return loads


def _check(surface: HeightMap) -> None:
    ny, nx = surface.heights.shape
    if min(ny, nx) < _FEWEST:
        raise must_have(
            "surface",
            f"{_FEWEST} or more along both sides, fewer resolve no contact",
            f" has {ny} x {nx} points",
        )
    if surface.dropout_fraction > 0:
        raise must_have(
            "surface",
            "none, see fill_dropouts",
            f" has {surface.dropout_fraction:.3g} of its points dropped out",
        )


def _full_contact(heights: _Array, pixel_size: tuple[float, float]) -> tuple[float, float, float]:
    """Rms slope, the lowest pressure about its mean [E*], and elastic energy [E* A0] of a surface
    that was pressed flat: p_q = E* q h_q / 2 of each mode."""
    ny, nx = heights.shape
    dy, dx = pixel_size
    qy, qx = np.fft.fftfreq(ny, dy / (2 * np.pi)), np.fft.rfftfreq(nx, dx / (2 * np.pi))
    q = np.hypot(qy[:, None], qx)
    modes = np.fft.rfft2(heights)
    pressure = np.fft.irfft2(modes * q / 2, s=heights.shape)
    slope = math.sqrt(np.mean(heights * np.fft.irfft2(modes * q**2, s=heights.shape)))
    return slope, float(pressure.min()), float(np.mean(pressure * heights)) / 2


_COARSE = 1.15  # raw over corrected area: beyond it points are too few for the patches in contact


def own_contacts(
    surface: HeightMap,
    name: str,
    *,
    loads: Sequence[float],
    q0: float | None = None,
    periodic: bool = False,
    progress: Progress = nullcontext,
) -> tuple[list[Contact], list[Note]]:
    """A map of one's own pressed by boundary elements at loads p / (E* h'), and what to know of it.

    The theory is given the spectrum of the very map that is solved, all its modes, at its rms
    slope; with the wavenumber `q0` [1/m] of the macro-asperities also their peaks. Arguments and
    errors as of `boundary_elements.contact`.
    """
    result = contact(surface, p_over_Eh=loads, periodic=periodic, progress=progress)
    solved = surface if periodic else mirrored(surface)
    spectrum = power_spectrum(solved, window="none", detrend=None)
    spectrum = spectrum.scaled((result.rms_slope / spectrum.rms_slope) ** 2)
    peaks = {}
    if q0 is not None:
        for distance, length in (("lambda0", 2 * math.pi / q0), ("lambda0/2", math.pi / q0)):
            heights = solved.local_peaks(min_distance=length, periodic=True)
            peaks[distance] = float(heights.mean())
    contacts = [
        Contact(
            case=name,
            spectrum=spectrum,
            hurst=None,
            q0=q0,
            rms_height=solved.rms_height,
            z_max=solved.z_max,
            z_min=solved.z_min,
            peaks=peaks,
            effective_modulus=1.0,
            pressure=float(load) * spectrum.rms_slope,
            area=float(area),
            energy=float(energy),
        )
        for load, area, energy in zip(
            result.p_over_Eh, result.area, result.elastic_energy, strict=True
        )
    ]
    notes = []
    coarse = result.p_over_Eh[result.area_raw > _COARSE * result.area]
    if coarse.size:
        text = (
            f"at p* up to {coarse.max():.3g} the points touch in patches of few pixels: their area "
            "is uncertain by some per cent, and so are the errors found; a map that holds no waves "
            "below 5 to 10 pixels has none of this"
        )
        notes.append(Note(text, code="coarse-map"))
    return contacts, notes
