"""Keys of a scene's own tables, and the names that errors on their arguments take."""

from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any

from asperity.base import quantities
from asperity.base.quantities import ZERO_CELSIUS
from asperity.friction import friction
from asperity.io.fields import (
    Field,
    angles,
    fields_of,
    file_name,
    file_names,
    file_or_files,
    kelvin_or_celsius,
    names_of,
    refuse,
    sweep,
)
from asperity.scene.parts import ADHESION, CORRECTIONS, HEATING, HEATING_NAMES
from asperity.scene.rubber import RUBBER, BuiltRubber
from asperity.scene.surface import SURFACE
from asperity.uncertainty.band import friction_band

MOST_LISTED = 1000  # temperatures, or directions
TEMPERATURE = kelvin_or_celsius(
    sweep,
    "temperature",
    "of the rubber, the place where a temperature goes; for `asperity friction` it may be a list. "
    "A single number may stand in `[rubber]` instead; both are refused. A column at the end of the "
    "table. [How to change the temperature](../howto/temperature.md) has examples",
)


LISTED = (*TEMPERATURE, "direction_deg")  # of [conditions]: each entry is a scene of its own


def temperatures_of(path: Path, conditions: dict[str, Any]) -> list[float | None]:
    """Temperatures [K] of [conditions], taken out of it; None where it has none."""
    entries = {key: conditions.pop(key) for key in TEMPERATURE if key in conditions}
    if len(entries) > 1:
        refuse(path, "[conditions] temperature_c", "must be left out where temperature_k is given")
    if not entries:
        return [None]
    [(key, values)] = entries.items()
    return _listed(path, key, values + (ZERO_CELSIUS if key == "temperature_c" else 0))


def directions_of(path: Path, conditions: dict[str, Any]) -> list[float | None]:
    """Directions of sliding [degrees] of [conditions], taken out of it; None where it has none."""
    values = conditions.pop("direction_deg", None)
    return [None] if values is None else _listed(path, "direction_deg", values)


def _listed(path: Path, key: str, values: Any) -> list[float | None]:
    if len(values) > MOST_LISTED:
        problem = f"has {len(values)} entries: must be at most {MOST_LISTED}"
        refuse(path, f"[conditions] {key}", problem)
    return [*map(float, values)]


def check_heated(path: Path, temperature: float | None, rubber: BuiltRubber) -> None:
    if temperature is None:
        problem = "needs [conditions] temperature_k or temperature_c, from which the rubber warms"
        refuse(path, "[heating]", problem)
    if rubber.shift is None:
        if "vertical_shift" in rubber.values:
            problem = "must be left out where [heating] is given: its model has no b_T"
            refuse(path, "[rubber] vertical_shift", problem)
        refuse(path, "[heating]", "needs [rubber] shift, or wlf_c1 and wlf_c2_k")


POINTS = {
    "pressure_pa": Field(
        sweep,
        "pressure",
        quantities.PRESSURE,
        meaning="required: a number, a list, or `{ from = 1e4, to = 1e6, points = 5 }`, which is "
        "logarithmic",
    ),
    "velocity_m_s": Field(sweep, "velocity", quantities.VELOCITY, meaning="the same"),
}
CONDITIONS = {
    **POINTS,
    **TEMPERATURE,
    **fields_of(friction, "poisson_ratio"),
    "direction_deg": Field(
        angles,
        "direction",
        meaning="of sliding, from x (a scan's second axis) towards y, on a surface that knows "
        "directions and with `scan-contact`: a number, a list or "
        "`{from = 0, to = 360, points = 73}`, in equal steps. A column `lateral` at the end of the "
        "table has the force across over the load, one before it `direction_deg` where there are "
        "several; the picture of several is polar. With `scan-contact` each is a contact to solve: "
        "13 or 25 serve",
    ),
}
SOLVER = fields_of(friction, "rtol", "form", "method")
NAMES = {**names_of("conditions", CONDITIONS), **names_of("solver", SOLVER)}
UNCERTAINTY = fields_of(friction_band, "method", "samples", "seed", "level")
# arguments that results name; rows of a spectrum have a density too
NOTED = {name: key for name, key in HEATING_NAMES.items() if name != "density"}
NOTED |= {"heating": "[heating]", "strain_factors": "[rubber] strain"}
KEYS: dict[str, dict[str, Field]] = {  # of every table that a scene may have
    "surface": SURFACE,
    "rubber": RUBBER,
    "conditions": CONDITIONS,
    "correction": {key: one for kind in CORRECTIONS.values() for key, one in kind.items()},
    "adhesion": ADHESION,
    "heating": HEATING,
    "solver": SOLVER,
    "uncertainty": UNCERTAINTY,
}
_NAMED = (file_name, file_names, file_or_files)
FILES = tuple(f"{t}.{key}" for t, of in KEYS.items() for key, f in of.items() if f.read in _NAMED)


def files_of(tables: Mapping[str, Any]) -> list[str]:
    files: list[str] = []
    for key in FILES:
        table, _, field = key.partition(".")
        entries = tables.get(table)
        names = entries.get(field) if isinstance(entries, Mapping) else None
        files += [names] if isinstance(names, str) else list(names or [])
    return files


def with_files(key: str, value: Any, here: Callable[[str], str]) -> Any:
    """The value of a key with what `here` makes of the names of files in it, where it has some."""
    if key in FILES and isinstance(value, str):
        return here(value)
    if key in FILES and isinstance(value, list) and all(isinstance(one, str) for one in value):
        return [here(one) for one in value]
    return value
