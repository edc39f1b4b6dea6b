"""A friction map as a grid, for simulators that read MATLAB files or CSV and interpolate."""

import io
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from asperity._core import __version__
from asperity.base.diagnostics import Argument, InvalidInput
from asperity.base.table import imported
from asperity.friction_map.look_up import NOTE_LINE, FrictionMap

_PRESSURES, _VELOCITIES, _TEMPERATURES = 41, 121, 9
_PARTS = {
    "mu": "mu",
    "mu_hysteresis": "hysteresis",
    "mu_adhesion": "adhesion",
    "contact_area": "contact_area",
}
_Axes = Mapping[str, NDArray[np.float64]]


def check_export(path: Path) -> None:
    """Refuse, before any work, a file of another kind, and one for which SciPy is missing."""
    if path.suffix not in (".mat", ".csv"):
        raise InvalidInput(Argument("--export"), f": {path}: must end in .mat or .csv")
    if path.suffix == ".mat":
        try:
            imported("scipy.io", "io")
        except ImportError as error:
            raise InvalidInput(Argument("--export"), f": {path}: {error}") from error


def grid_file(friction_map: FrictionMap, path: Path) -> tuple[bytes, float]:
    """The file, and the error that linear interpolation between its points adds to the map's own.

    The points have equal steps of ln p and ln v, and of T0 where the map covers several. The error
    is the largest relative one of mu at the middles of the grid's cells, where a simulator
    interpolates mu linearly over these.
    """
    lowest, highest = friction_map.temperature or (0.0, 0.0)
    if lowest < highest and path.suffix == ".csv":
        allowed = "a table has one; choose .mat, which has a third axis"
        raise InvalidInput(
            Argument("--export"), f": {path}: the map covers {lowest:g} to {highest:g} K, {allowed}"
        )
    axes = {
        "pressure_pa": np.geomspace(*friction_map.pressure, _PRESSURES),
        "velocity_m_s": np.geomspace(*friction_map.velocity, _VELOCITIES),
    }
    if lowest < highest:
        axes["temperature_k"] = np.linspace(lowest, highest, _TEMPERATURES)
    error = _interpolation_error(friction_map, axes)
    facts = {"max_error": friction_map.max_error, "interpolation_error": error}
    write = _mat if path.suffix == ".mat" else _csv
    return write(friction_map, axes, facts), error


def _on_grid(friction_map: FrictionMap, method: str, axes: _Axes) -> Any:
    """What a look-up gives at every point, an axis a coordinate."""
    places = np.meshgrid(*axes.values(), indexing="ij")
    heat = {"temperature": places[2]} if len(places) == 3 else {}
    return getattr(friction_map, method)(places[0], places[1], **heat)


def _interpolation_error(friction_map: FrictionMap, axes: _Axes) -> float:
    between = _on_grid(friction_map, "mu", axes)
    for axis in range(between.ndim):
        between = np.moveaxis(between, axis, 0)
        between = np.moveaxis((between[1:] + between[:-1]) / 2, 0, axis)
    middles = {
        name: (side[1:] + side[:-1]) / 2
        if name == "temperature_k"
        else np.sqrt(side[1:] * side[:-1])
        for name, side in axes.items()
    }
    exact = _on_grid(friction_map, "mu", middles)
    off = np.abs(between - exact)
    return float(np.max(np.divide(off, exact, out=np.zeros_like(off), where=exact > 0)))


def _mat(friction_map: FrictionMap, axes: _Axes, facts: Mapping[str, float]) -> bytes:
    parts = {name: _on_grid(friction_map, method, axes) for name, method in _PARTS.items()}
    content: dict[str, Any] = {**axes, **parts, **facts, "text": friction_map.text}
    out = io.BytesIO()
    imported("scipy.io", "io").savemat(out, {"friction": content}, oned_as="column")
    return out.getvalue()


def _csv(friction_map: FrictionMap, axes: _Axes, facts: Mapping[str, float]) -> bytes:
    mu = _on_grid(friction_map, "mu", axes)
    pressure, velocity = axes.values()
    lines = [f"# asperity {__version__} map --export: mu, a row a pressure, a column a velocity"]
    lines += [f"# {name} = {value:.6g}" for name, value in facts.items()]
    lines += [f"# note: {note}" for note in friction_map.notes]
    text = friction_map.text.splitlines()
    lines += [f"# {line}" for line in text if not line.startswith(NOTE_LINE)]
    lines.append(",".join(["pressure_pa / velocity_m_s", *map(repr, velocity.tolist())]))
    for p, row in zip(pressure.tolist(), mu.tolist(), strict=True):
        lines.append(",".join(map(repr, [p, *row])))
    return "".join(f"{line}\n" for line in lines).encode()
