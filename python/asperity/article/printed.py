"""Section 6.1.2's three printed p_T: what they imply, and what A has to be tuned to."""

import numpy as np
from numpy.typing import NDArray

from asperity.article.compounds import ROOM, T_G
from asperity.article.inputs import (
    LOADS,
    PRESSURES,
    SKEWNESS,
    VELOCITY,
    Inputs,
    Model,
    effective_modulus,
    heights_of,
)
from asperity.article.readings import PRINTED, READINGS
from asperity.article.shifts import shifts
from asperity.article.statement import TUNED, Statement, by_name, listed, unchecked
from asperity.correction import GreenwoodWilliamson

_Array = NDArray[np.float64]


def statements(inputs: Inputs) -> list[Statement]:
    """What Section 6.1.2 prints as numbers, tuned; and what comes out where nothing is."""
    implied = [tuned.implied for tuned in inputs.tuned.values()]
    bare = effective_modulus(inputs.compound_a)
    untuned = {
        f"skewness {skewness:g}, {reading}": _of_scans(inputs, heights_of(scans, reading))
        for skewness, scans in ((0, inputs.gaussian_scans), (SKEWNESS, inputs.scans))
        for reading in READINGS
    }
    return [
        Statement(
            "G1",
            "Sec. 6.1.2",
            f"p_T is {listed(PRINTED.values())} at {LOADS} and 0.1 m/s",
            "none: E*, z_max and z_min are solved for",
            "; ".join(
                f"{x.reading}: {listed(x.shift_factor, '.4g')} with E* "
                f"{x.effective_modulus / 1e6:.3g} MPa, z_max {x.z_max * 1e6:.0f} um, z_min "
                f"{x.z_min * 1e6:.0f} um"
                for x in implied
            ),
            TUNED,
            "three numbers for three unknowns cannot tell which reading is meant; within their "
            "rounding E* is "
            + ", ".join(
                f"{x.lowest / 1e6:.0f} to {x.highest / 1e6:.0f} MPa ({x.reading})" for x in implied
            ),
        ),
        Statement(
            "G2",
            "Sec. 5.1, 6.1.2",
            "compound A has the modulus that these p_T ask for",
            "none: its relaxation times are moved by one factor",
            f"the surrogate (T_g {T_G['A']:g} C, {ROOM:g} C) has E* {bare / 1e6:.3g} MPa at q0 v; "
            + "; ".join(
                f"{name}: {t.implied.effective_modulus / bare:.2g} times it, {t.decades:+.2f} "
                f"decades, as at {t.temperature:.0f} C"
                for name, t in inputs.tuned.items()
            ),
            TUNED,
            "moduli are not published; one reading asks for colder rubber, the other for warmer",
        ),
        unchecked(
            "G3",
            "Sec. 6.1.2",
            f"the same p_T with nothing tuned: surrogate at {ROOM:g} C, heights of synthetic scans",
            "modulus, z_max and z_min are not published, the skewness was chosen knowing the "
            "printed p_T; with surrogates of our choice a near hit proves as little as a miss",
            by_name(untuned),
        ),
    ]


def _of_scans(inputs: Inputs, correction: GreenwoodWilliamson) -> _Array:
    """p_T at the three pressures with the surrogate untuned."""
    velocity, pressure = np.array([VELOCITY]), np.array(PRESSURES)
    return shifts(inputs, Model(inputs.compound_a, correction), pressure, velocity).shift_factor[
        :, 0
    ]
