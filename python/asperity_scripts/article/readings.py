"""The E*, z_max and z_min that the three printed p_T ask for, in either reading of Eqs 19-20."""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from asperity.asperities import separation

Reading = Literal["implicit", "added"]
READINGS: tuple[Reading, ...] = ("implicit", "added")
PRINTED = {0.1e6: 2.46, 0.3e6: 2.02, 0.5e6: 1.83}  # p_T by sigma0 [Pa], Section 6.1.2
_ROUNDING = 0.005  # of the printed p_T
Array = NDArray[np.float64]


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
    shift_factor: Array  # p_T that come out at the three pressures


def implied(reading: Reading, rms_height: float, q0: float) -> Implied:
    """Search E* from 1 MPa to 10 GPa; sandpaper's `rms_height` [m] and `q0` [1/m].

    Raises
    ------
    ValueError
        If no E* gives the printed numbers within their rounding.
    """
    printed = np.array(list(PRINTED.values()))
    inverse, low, high = (1 / p for p in (printed, printed + _ROUNDING, printed - _ROUNDING))

    def effective(modulus: Array) -> Array:
        result = separation(
            pressure=list(PRINTED),
            effective_modulus=modulus[:, None],
            rms_height=rms_height,
            q0=q0,
            reading=reading,
        )
        return np.asarray(result.effective)

    def fitting(modulus: Array) -> NDArray[np.bool_]:
        """Whether a falling line passes through all three 1 / p_T, each within its rounding."""
        d = effective(modulus)
        falls = low[d.argmin(axis=1)] > high[d.argmax(axis=1)]
        return np.asarray(falls & (_excess(d, low, high) >= 0) & (_excess(d, high, low) <= 0))

    def edge(inside: float, outside: float) -> float:
        """Where the fit ends, between a modulus that fits and one that does not."""
        while abs(np.log(outside / inside)) > 1e-4:
            middle = float(np.sqrt(inside * outside))
            fits = fitting(np.array([middle]))[0]
            inside, outside = (middle, outside) if fits else (inside, middle)
        return inside

    grid = np.geomspace(1e6, 1e10, 401)
    step, fits = grid[1] / grid[0], grid[fitting(grid)]
    if fits.size == 0:
        raise ValueError(f"{reading}: no E* gives the printed p_T")

    def misfit(modulus: Array) -> Array:
        return np.abs(_excess(effective(modulus), inverse, inverse))

    start = int(misfit(grid).argmin())
    best = _minimum(misfit, float(grid[start - 1]), float(grid[start + 1]))
    d = effective(np.array([best]))[0]
    slope, intercept = np.polyfit(d, inverse, 1)
    z_max, height = -intercept / slope, -1 / slope
    return Implied(
        reading=reading,
        effective_modulus=best,
        lowest=edge(float(fits[0]), float(fits[0] / step)),
        highest=edge(float(fits[-1]), float(fits[-1] * step)),
        z_max=float(z_max),
        z_min=float(z_max - height),
        shift_factor=np.asarray(height / (z_max - d)),
    )


def _excess(d: Array, outer: Array, middle: Array) -> Array:
    """How far `middle` at the middle separation is above the line through `outer` at the others."""
    order = np.argsort(d, axis=1)
    d, outer, middle = np.take_along_axis(d, order, axis=1), outer[order], middle[order]
    share = (d[:, 1] - d[:, 0]) / (d[:, 2] - d[:, 0])
    return np.asarray(middle[:, 1] - (1 - share) * outer[:, 0] - share * outer[:, 2])


def _minimum(f: Callable[[Array], Array], low: float, high: float) -> float:
    """Where f is least, by golden section in ln x; f falls, then rises."""
    golden = (np.sqrt(5) - 1) / 2
    a, b = np.log(low), np.log(high)
    while b - a > 1e-9:
        left, right = b - golden * (b - a), a + golden * (b - a)
        at = f(np.exp(np.array([left, right])))
        a, b = (a, right) if at[0] < at[1] else (left, b)
    return float(np.exp((a + b) / 2))
