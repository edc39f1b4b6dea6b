"""Friction of compound B on asphalt with the heat of sliding, which the article leaves out."""

from collections.abc import Mapping
from typing import Any

import numpy as np

from asperity.base.quantities import ZERO_CELSIUS
from asperity.correction import Correction
from asperity.friction import Friction, friction
from asperity.heating import Heating
from asperity.shift_factors import WLF
from asperity.spectrum import SelfAffineSpectrum
from asperity_scripts.article.compounds import C1, C2, ROOM, T_G, compound
from asperity_scripts.article.inputs import ADHESION, ASPHALT_PRESSURE
from asperity_scripts.article.readings import Array

# Our choice: a filled tread compound in contacts of 1 mm, on granite by their effusivities.
TREAD = Heating(
    density=1200,
    heat_capacity=1650,
    conductivity=0.23,
    contact_diameter=1e-3,
    interface_share=0.22,
)


def heated(
    surfaces: Mapping[str, SelfAffineSpectrum],
    velocity: Array,
    correction: Correction | None = None,
) -> Mapping[str, Friction]:
    """Friction with the heat of sliding, by cut-off; `.cold` is without it. The original theory
    unless there is a correction."""
    law = WLF(c1=C1, c2=C2, reference_temperature=T_G["B"] + ZERO_CELSIUS)
    return {
        name: friction(
            surface,
            compound(T_G["B"], T_G["B"]),
            pressure=ASPHALT_PRESSURE,
            velocity=velocity,
            correction=correction,
            adhesion=ADHESION,
            temperature=ROOM + ZERO_CELSIUS,
            shift=law,
            heating=TREAD,
        )
        for name, surface in surfaces.items()
    }


def cold(hot: Friction) -> Friction:
    assert hot.cold is not None
    return hot.cold


def rise(hot: Friction) -> Array:
    return np.asarray(hot.temperature - cold(hot).temperature)


def hot_columns(hot: Friction) -> dict[str, Any]:
    """What flash heat makes of a curve."""
    return {
        "mu_hot": hot.mu,
        "hysteresis_hot": hot.hysteresis,
        "adhesion_hot": hot.adhesion,
        "hot_temperature_k": hot.temperature,
    }
