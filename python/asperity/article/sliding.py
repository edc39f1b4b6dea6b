"""Section 6.2: friction of compound B on asphalt, Fig. 15 and Table 1 (data alone)."""

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from asperity.article.inputs import ADHESION, ASPHALT_PRESSURE, MAGNIFICATION, Inputs, heights_of
from asperity.article.readings import READINGS, Reading
from asperity.correction import Correction, GreenwoodWilliamson, SFactor
from asperity.friction import Friction, friction

_Array = NDArray[np.float64]
# The article's q1, and that of the rule it cites.
CUTOFFS = (f"{MAGNIFICATION:g} q0", "rms slope 1.3")


@dataclass(frozen=True, eq=False)
class Sliding:
    """Friction over velocity, by cut-off and by correction."""

    velocity: _Array  # [m/s]
    cutoff: Mapping[str, float]  # q1 [1/m]
    curves: Mapping[str, Mapping[str, Friction]]


def compute(inputs: Inputs) -> Sliding:
    """Plain Persson ("original"), IGW in both readings, and the S factor with gamma 0.4 and 0.5."""
    velocity = np.geomspace(1e-6, 10, 57)
    corrections: dict[str, Correction | None] = {"original": None}
    corrections |= {reading: of_asphalt(inputs, reading) for reading in READINGS}
    corrections |= {f"gamma {gamma}": SFactor(gamma=gamma) for gamma in (0.4, 0.5)}
    road = inputs.asphalt
    surfaces = dict(zip(CUTOFFS, (road, road.truncated(q1=road.cutoff_for_slope())), strict=True))
    return Sliding(
        velocity=velocity,
        cutoff={name: surface.q1 for name, surface in surfaces.items()},
        curves={
            name: {
                which: friction(
                    surface,
                    inputs.compound_b,
                    pressure=ASPHALT_PRESSURE,
                    velocity=velocity,
                    correction=correction,
                    adhesion=ADHESION,
                )
                for which, correction in corrections.items()
            }
            for name, surface in surfaces.items()
        },
    )


def of_asphalt(inputs: Inputs, reading: Reading) -> GreenwoodWilliamson:
    """IGW with the mean extremes of the synthetic scans and all of the published rms height."""
    return heights_of(inputs.asphalt_scans, reading, inputs.asphalt.rms_height)
