"""Contacts of a surface of one's own, and what the theory is told of it."""

import math
from collections.abc import Sequence
from contextlib import nullcontext

from asperity.base.diagnostics import Note
from asperity.measured_spectrum import power_spectrum
from asperity.scene.model import Progress
from asperity.surface import HeightMap
from asperity.validation.boundary_elements import contact, mirrored
from asperity.validation.contacts import Contact

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
