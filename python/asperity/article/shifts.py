"""Separation and p_T of the improved Greenwood-Williamson model: Figs 13 and 14 (data alone)."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from asperity.article.inputs import Q0, Inputs, Model, effective_modulus
from asperity.asperities import separation

_Array = NDArray[np.float64]
FIG13_VELOCITIES = (0.001, 0.01, 0.1, 1.0)  # m/s, the article's
FIG14_PRESSURES = (0.02e6, 0.1e6, 0.3e6, 0.5e6, 0.9e6)  # Pa, ours: its legend is not legible


@dataclass(frozen=True, eq=False)
class Shifts:
    """d~ [m] and p_T over pressure and velocity; p_T is 1 in full and infinite without contact."""

    pressure: _Array  # [Pa], rows
    velocity: _Array  # [m/s], columns
    effective: _Array
    shift_factor: _Array


@dataclass(frozen=True, eq=False)
class Readings:
    """Fig. 13 and Fig. 14, by the names of `Inputs.models`."""

    over_pressure: dict[str, Shifts]
    over_velocity: dict[str, Shifts]


def compute(inputs: Inputs) -> Readings:
    """Both figures' curves of every model, each with its own compound and heights."""
    pressure = 1e6 * np.linspace(0.01, 0.9, 90)
    velocity = np.geomspace(1e-4, 10, 51)
    models = inputs.models.items()
    return Readings(
        {n: shifts(inputs, m, pressure, np.array(FIG13_VELOCITIES)) for n, m in models},
        {n: shifts(inputs, m, np.array(FIG14_PRESSURES), velocity) for n, m in models},
    )


def shifts(inputs: Inputs, model: Model, pressure: _Array, velocity: _Array) -> Shifts:
    """d~ and p_T2 on the sandpaper, pressures in rows, velocities in columns."""
    igw = model.correction
    z_max, z_min = igw.z_max, igw.z_min
    found = separation(
        pressure=pressure[:, None],
        effective_modulus=[effective_modulus(model.rubber, v) for v in velocity],
        rms_height=inputs.sandpaper.rms_height,
        q0=Q0,
        reading=igw.reading,
        z_max=z_max,
        z_min=z_min,
    )
    d, state = np.asarray(found.effective), np.asarray(found.state)
    gap = np.where(state == "partial", z_max - d, 1.0)
    factor = np.select(
        [state == "full", state == "no contact"], [1.0, np.inf], (z_max - z_min) / gap
    )
    return Shifts(pressure, velocity, d, factor)
