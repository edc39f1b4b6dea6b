"""Where on a curve the notes on an extrapolated modulus hold."""

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from asperity._core import FATAL_EXTRAPOLATION, NOTED_EXTRAPOLATION

_LIMITS = {
    "of the hysteresis comes from frequencies outside of the measured ones": NOTED_EXTRAPOLATION,
    "most of the hysteresis is that of an extrapolated modulus": FATAL_EXTRAPOLATION,
}
_SOMEWHERE = " at some points"  # in the core's notes


def with_velocities(
    notes: Sequence[str], velocity: NDArray[np.float64], share: NDArray[np.float64]
) -> list[str]:
    """Return notes of which those on an extrapolated modulus name velocities.

    `velocity` [m/s] and `share`, the part of the hysteresis from beyond the measured frequencies,
    belong to all points of a scene.
    """
    return [_located(note, velocity, share) for note in notes]


def _located(note: str, velocity: NDArray[np.float64], share: NDArray[np.float64]) -> str:
    for words, limit in _LIMITS.items():
        if words in note:
            beyond = np.unique(velocity[share > limit])
            every = np.unique(velocity).size
            span = f"from {beyond[0]:.3g} to {beyond[-1]:.3g} m/s"
            if beyond.size == 1:
                span = f"{beyond[0]:.3g} m/s"
            where = f" at {beyond.size} of {every} velocities, {span}"
            return note.replace(_SOMEWHERE, " at all velocities" if beyond.size == every else where)
    return note
