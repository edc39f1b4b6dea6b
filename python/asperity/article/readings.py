"""What the three printed p_T ask for: E*, z_max and z_min, in either reading of Eqs 19-20."""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from asperity.asperities import separation

Reading = Literal["implicit", "added"]
READINGS: tuple[Reading, ...] = ("implicit", "added")
PRINTED = {0.1e6: 2.46, 0.3e6: 2.02, 0.5e6: 1.83}  # p_T by sigma0 [Pa], Section 6.1.2
ROUNDING = 0.005  # of the printed p_T
_Array = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class Implied:
    """The inputs with which a reading gives the printed p_T, and how well three numbers fix them.

    Eq. 21's text, p_T = (z_max - z_min) / (z_max - d~), is linear: 1 / p_T = a - b d~ with
    a = z_max / (z_max - z_min) and b = 1 / (z_max - z_min). So the three points must lie on a line,
    which E* decides.
    """

    reading: Reading
    effective_modulus: float  # E* [Pa] with which the three lie closest to a line
    lowest: float  # E* [Pa] between which they do, within the rounding of the printed numbers
    highest: float
    z_max: float  # [m]
    z_min: float
    shift_factor: _Array  # p_T that come out at the three pressures


def implied(reading: Reading, rms_height: float, q0: float) -> Implied:
    """Search E* from 1 MPa to 10 GPa; sandpaper's `rms_height` [m] and `q0` [1/m].

    Raises
    ------
    ValueError
        If no E* gives the printed numbers within their rounding.
    """

    def effective(modulus: _Array) -> _Array:
        found = separation(
            pressure=list(PRINTED),
            effective_modulus=modulus[:, None],
            rms_height=rms_height,
            q0=q0,
            reading=reading,
        )
        return np.asarray(found.effective)

    def misfit(modulus: _Array) -> _Array:
        return np.abs(_excess(effective(modulus)))

    def fitting(modulus: float) -> bool:
        return bool(_on_a_line(effective(np.array([modulus])))[0])

    grid = np.geomspace(1e6, 1e10, 401)
    step, separations = grid[1] / grid[0], effective(grid)
    fits = grid[_on_a_line(separations)]
    if fits.size == 0:
        raise ValueError(f"{reading}: no E* gives the printed p_T")
    start = int(np.abs(_excess(separations)).argmin())
    best = _minimum(misfit, float(grid[start - 1]), float(grid[start + 1]))
    d = effective(np.array([best]))[0]
    slope, intercept = np.polyfit(d, 1 / np.array(list(PRINTED.values())), 1)
    z_max, span = -intercept / slope, -1 / slope
    return Implied(
        reading=reading,
        effective_modulus=best,
        lowest=_edge(fitting, float(fits[0]), float(fits[0] / step)),
        highest=_edge(fitting, float(fits[-1]), float(fits[-1] * step)),
        z_max=float(z_max),
        z_min=float(z_max - span),
        shift_factor=np.asarray(span / (z_max - d)),
    )


def _excess(d: _Array) -> _Array:
    """How far 1 / p_T of the middle separation lies off the line through the outer two."""
    d, y = _sorted(d, 1 / np.array(list(PRINTED.values())))
    share = (d[:, 1] - d[:, 0]) / (d[:, 2] - d[:, 0])
    return np.asarray(y[:, 1] - (1 - share) * y[:, 0] - share * y[:, 2])


def _on_a_line(d: _Array) -> NDArray[np.bool_]:
    """Whether a falling line passes through all three 1 / p_T, each within its rounding."""
    printed = np.array(list(PRINTED.values()))
    _, low = _sorted(d, 1 / (printed + ROUNDING))
    d, high = _sorted(d, 1 / (printed - ROUNDING))
    share = (d[:, 1] - d[:, 0]) / (d[:, 2] - d[:, 0])
    between_low = (1 - share) * low[:, 0] + share * low[:, 2]
    between_high = (1 - share) * high[:, 0] + share * high[:, 2]
    falls = low[:, 0] > high[:, 2]
    return np.asarray(falls & (between_low <= high[:, 1]) & (low[:, 1] <= between_high))


def _sorted(d: _Array, y: _Array) -> tuple[_Array, _Array]:
    order = np.argsort(d, axis=1)
    return np.take_along_axis(d, order, axis=1), y[order]


def _minimum(f: Callable[[_Array], _Array], low: float, high: float) -> float:
    """Where f is least, by golden section in ln x; f falls, then rises."""
    golden = (np.sqrt(5) - 1) / 2
    a, b = np.log(low), np.log(high)
    while b - a > 1e-9:
        left, right = b - golden * (b - a), a + golden * (b - a)
        at = f(np.exp(np.array([left, right])))
        a, b = (a, right) if at[0] < at[1] else (left, b)
    return float(np.exp((a + b) / 2))


def _edge(fits: Callable[[float], bool], inside: float, outside: float) -> float:
    """Where the fit ends, between a modulus that fits and one that does not."""
    while abs(np.log(outside / inside)) > 1e-4:
        middle = float(np.sqrt(inside * outside))
        inside, outside = (middle, outside) if fits(middle) else (inside, middle)
    return inside
