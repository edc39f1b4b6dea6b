"""A surface of one's own pressed by boundary elements: the contact that the theory is held against.

The solver is `slide` at velocity 0.
"""

import math
from collections.abc import Sequence
from contextlib import nullcontext

import numpy as np

from asperity.base.diagnostics import Note, refusal
from asperity.measured_spectrum import power_spectrum
from asperity.rubber import PronySeries
from asperity.scene.model import Progress
from asperity.spectrum import TabulatedSpectrum
from asperity.surface import HeightMap
from asperity.validation.sliding import continued, slide
from asperity_scripts.validate.contacts import Contact

_SOLID = PronySeries(equilibrium_modulus=1.0, moduli=[], relaxation_times=[])
_TOLERANCE = 1e-8  # sum(p gap) / (sum(p) h_rms)
_COARSE = 1.15  # raw over corrected area: beyond it points are too few for the patches in contact


def spectrum_of_modes(solved: HeightMap) -> TabulatedSpectrum:
    """Rings of all modes of a periodic map, at the rms slope of its modes, h'^2 = sum q^2 |h_q|^2,
    which that of rings misses by what they average."""
    (ny, nx), (dy, dx) = solved.heights.shape, solved.pixel_size
    q = np.hypot(
        np.fft.fftfreq(ny, dy / (2 * np.pi))[:, None], np.fft.fftfreq(nx, dx / (2 * np.pi))
    )
    power = np.abs(np.fft.fft2(solved.heights.astype(float)) / solved.heights.size) ** 2
    spectrum = power_spectrum(solved, window="none", detrend=None)
    return spectrum.scaled(float(np.sum(q**2 * power)) / spectrum.rms_slope**2)


def own_contacts(
    surface: HeightMap,
    name: str,
    *,
    loads: Sequence[float],
    q0: float | None = None,
    periodic: bool = False,
    progress: Progress = nullcontext,
) -> tuple[list[Contact], list[Note]]:
    """A map of one's own pressed into an elastic half-space, without friction or adhesion, at loads
    p / (E* h'), and what to know of it. E* is 1.

    The theory is given the spectrum of the very map that is solved, all its modes, at its rms slope
    h'; with the wavenumber `q0` [1/m] of the macro-asperities also their peaks. `periodic` False
    takes the map with its mirror images; trends are to be taken out first: a tilt becomes a roof.
    `progress` sees the loads, one by one. Errors as of `slide`.

    Of 256^2 cut from 1024^2 points (H 0.8, q1/q0 = 8, four longest waves along a side of the cut),
    the mirrored ones have the whole map's rms slope to 0.1 % and its area at the same p / (E* h')
    to +1.2 % at 0.01, +0.4 % at 0.05, and 0.1 % from 0.2 on. As they are, with jumps at their
    sides, they have 8 to 20 % too much, and under a window, which tapers their heights, from half
    to three times of it.

    Of the perimeter's excess that `slide` takes off, six maps (H 0.8, q1/q0 = 4) in pixels halved
    four times say that 0.85 would be right, so that areas are low: at p / (E* h') = 0.01, 0.1 and
    0.7 by 1.7, 0.9 and 0.1 % where the finest waves are 10 pixels long, and by half as much at 20;
    by 1.6, 1.6 and 0.2 % at 5. At 2.5 single maps scatter by 2 % at 0.1 and more below. Energies
    and gaps are right to 0.3 % at 5 pixels, and to 1 % (0.7: 3 %) at 2.5 from 0.1 on.

    512^2 points take 0.1 to 0.2 s, 1024^2 points 0.6 to 1.2 s; mirrored they are four times as
    many.
    """
    for load in loads:
        if not 0 < load < math.inf:
            raise refusal("loads", load, "positive and finite", text=f"{load:g}")
    solved = surface if periodic else continued(surface, "mirror")
    spectrum = spectrum_of_modes(solved)
    peaks = {}
    if q0 is not None:
        for distance, length in (("lambda0", 2 * math.pi / q0), ("lambda0/2", math.pi / q0)):
            heights = solved.local_peaks(min_distance=length, periodic=True)
            peaks[distance] = float(heights.mean())
    contacts, coarse = [], []
    with progress([slice(i, i + 1) for i in range(len(loads))]) as shown:
        for chunk in shown:
            (load,) = loads[chunk]
            pressure = load * spectrum.rms_slope
            result = slide(
                solved,
                _SOLID,
                pressure=pressure,
                velocity=0.0,
                poisson_ratio=0.0,
                periodic=True,
                rtol=_TOLERANCE,
            )
            if result.contact_area_raw > _COARSE * result.contact_area:
                coarse.append(load)
            contacts.append(
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
                    pressure=pressure,
                    area=result.contact_area,
                    energy=result.elastic_energy,
                )
            )
    if not coarse:
        return contacts, []
    text = (
        f"at p* up to {max(coarse):.3g} the points touch in patches of few pixels: their area "
        "is uncertain by some per cent, and so are the errors found; a map that holds no waves "
        "below 5 to 10 pixels has none of this"
    )
    return contacts, [Note(text, code="coarse-map")]
