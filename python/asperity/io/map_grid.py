"""A friction map as a grid, for simulators that read MATLAB files or CSV and interpolate."""

import io
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from asperity._core import InvalidInput, __version__
from asperity.base.table import imported
from asperity.friction_map import FrictionMap

_PRESSURES, _VELOCITIES = 41, 121
_PARTS = {
    "mu": "mu",
    "mu_hysteresis": "hysteresis",
    "mu_adhesion": "adhesion",
    "contact_area": "contact_area",
}


def check_export(path: Path) -> None:
    """Refuse, before any work, a file of another kind, and one for which SciPy is missing."""
    if path.suffix not in (".mat", ".csv"):
        raise InvalidInput(f"--export: {path}: must end in .mat or .csv")
    if path.suffix == ".mat":
        try:
            imported("scipy.io", "io")
        except ImportError as error:
            raise InvalidInput(f"--export: {path}: {error}") from error


def grid_file(friction_map: FrictionMap, path: Path) -> tuple[bytes, float]:
    """The file, and the error that linear interpolation between its points adds to the map's own.

    The points have equal steps of ln p and ln v. The error is the largest relative one of mu at the
    middles of the grid's cells, where a simulator interpolates mu linearly over ln p and ln v.
    """
    pressure, velocity = (
        np.geomspace(*sides, count)
        for sides, count in (
            (friction_map.pressure, _PRESSURES),
            (friction_map.velocity, _VELOCITIES),
        )
    )
    for side, box in ((pressure, friction_map.pressure), (velocity, friction_map.velocity)):
        side[0], side[-1] = box  # to the last digit
    error = _interpolation_error(friction_map, pressure, velocity)
    facts = {"max_error": friction_map.max_error, "interpolation_error": error}
    write = _mat if path.suffix == ".mat" else _csv
    return write(friction_map, pressure, velocity, facts), error


def _interpolation_error(
    friction_map: FrictionMap, pressure: NDArray[np.float64], velocity: NDArray[np.float64]
) -> float:
    mu = friction_map.mu(pressure[:, None], velocity)
    between = (mu[1:, 1:] + mu[1:, :-1] + mu[:-1, 1:] + mu[:-1, :-1]) / 4
    middle = [np.sqrt(side[1:] * side[:-1]) for side in (pressure, velocity)]
    exact = friction_map.mu(middle[0][:, None], middle[1])
    off = np.abs(between - exact)
    return float(np.max(np.divide(off, exact, out=np.zeros_like(off), where=exact > 0)))


def _mat(
    friction_map: FrictionMap,
    pressure: NDArray[np.float64],
    velocity: NDArray[np.float64],
    facts: Mapping[str, float],
) -> bytes:
    parts = {
        name: getattr(friction_map, method)(pressure[:, None], velocity)
        for name, method in _PARTS.items()
    }
    content: dict[str, Any] = {
        "pressure_pa": pressure,
        "velocity_m_s": velocity,
        **parts,
        **facts,
        "text": friction_map.text,
    }
    out = io.BytesIO()
    imported("scipy.io", "io").savemat(out, {"friction": content}, oned_as="column")
    return out.getvalue()


def _csv(
    friction_map: FrictionMap,
    pressure: NDArray[np.float64],
    velocity: NDArray[np.float64],
    facts: Mapping[str, float],
) -> bytes:
    mu = friction_map.mu(pressure[:, None], velocity)
    lines = [f"# asperity {__version__} map --export: mu, a row a pressure, a column a velocity"]
    lines += [f"# {name} = {value:.6g}" for name, value in facts.items()]
    lines += [f"# {line}" for line in friction_map.text.splitlines()]
    lines.append(",".join(["pressure_pa / velocity_m_s", *map(repr, velocity.tolist())]))
    for p, row in zip(pressure.tolist(), mu.tolist(), strict=True):
        lines.append(",".join(map(repr, [p, *row])))
    return "".join(f"{line}\n" for line in lines).encode()
