"""Temperatures and directions of a scene, and what heat needs to start from."""

from pathlib import Path
from typing import Any

from asperity.base.celsius import ZERO_CELSIUS
from asperity.io.fields import kelvin_or_celsius, refuse, sweep
from asperity.scene.rubber import BuiltRubber

MOST_TEMPERATURES = MOST_DIRECTIONS = 1000  # of a list
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
    kelvin = values + (ZERO_CELSIUS if key == "temperature_c" else 0)
    if len(kelvin) > MOST_TEMPERATURES:
        problem = f"has {len(kelvin)} entries: must be at most {MOST_TEMPERATURES}"
        refuse(path, f"[conditions] {key}", problem)
    return [float(one) for one in kelvin]


def directions_of(path: Path, conditions: dict[str, Any]) -> list[float | None]:
    """Directions of sliding [degrees] of [conditions], taken out of it; None where it has none."""
    values = conditions.pop("direction_deg", None)
    if values is None:
        return [None]
    if len(values) > MOST_DIRECTIONS:
        problem = f"has {len(values)} entries: must be at most {MOST_DIRECTIONS}"
        refuse(path, "[conditions] direction_deg", problem)
    return [float(one) for one in values]


def check_heated(path: Path, temperature: float | None, rubber: BuiltRubber) -> None:
    """Refuse heat where it has nothing to start from, or where nothing follows it."""
    if temperature is None:
        problem = "needs [conditions] temperature_k or temperature_c, from which the rubber warms"
        refuse(path, "[heating]", problem)
    if rubber.shift is None:
        if "vertical_shift" in rubber.values:
            problem = "must be left out where [heating] is given: its model has no b_T"
            refuse(path, "[rubber] vertical_shift", problem)
        refuse(path, "[heating]", "needs [rubber] shift, or wlf_c1 and wlf_c2_k")
