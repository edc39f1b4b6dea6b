"""Numbers of a scene that are unknown: their keys, their priors and where they start."""

import math
import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Literal, NamedTuple

from asperity.base.arguments import Array, choice, number, shortened
from asperity.base.diagnostics import MUST_BE, Argument, InvalidInput, must_be, refusal
from asperity.io.fields import Field, count, nearest
from asperity.results.gradients import Gradients
from asperity.scene.keys import KEYS

_KEY = re.compile(r"(\w+)\.(\w+)(?:\[(\d+)\])?")
_MEASURED = ("conditions.pressure_pa", "conditions.velocity_m_s")
_NOT_PHYSICAL = ("solver", "uncertainty")
_ADDED = ("surface.q1_per_m", "adhesion.shear_stress_pa")  # to a scene that does not name them
_CUTOFFS = {"file", "contamination_size_m", "slope_cutoff"}  # with which q1 follows from others
_OF_LAW = ("rms_height", "hurst", "q0", "q1", "rolloff", "axis_ratio")
_OF_CORRECTION = {"gamma", "friction_gamma", "p", "z_max", "z_min"}
_OF_CORRECTION |= {"correction_rms_height", "correction_q0"}
_OF_SERIES = ("equilibrium_modulus", "moduli", "relaxation_times")

Scale = Literal["plain", "ln"]


class Prior(NamedTuple):
    """What is known of a number before: its value, with a standard deviation of it or of its ln."""

    value: float
    standard_deviation: float
    scale: Scale = "plain"


@dataclass(frozen=True)
class Unknown:
    """A number of a scene that is to be found; in ln, unless it is a temperature or an angle."""

    key: str
    table: str
    field: str
    place: int | None  # in a list
    start: float
    is_plain: bool
    prior: Prior | None

    def inside(self, value: float) -> float:
        return value if self.is_plain else math.log(value)

    def value(self, inside: float) -> float:
        return inside if self.is_plain else math.exp(min(inside, 700.0))

    @property
    def step(self) -> float:
        """Return a unit of the coordinate for differences: a factor e, 100 K, 60 degrees."""
        if not self.is_plain:
            return 1.0
        return 60.0 if self.field.endswith("_deg") else 100.0

    def off_prior(self, inside: float) -> tuple[float, float]:
        """Return how many standard deviations the prior is off, and its slope; without one 0."""
        if self.prior is None:
            return 0.0, 0.0
        value, deviation, scale = self.prior
        result = self.value(inside)
        if scale == "ln":
            return (inside - math.log(value)) / deviation, 1 / deviation
        return (result - value) / deviation, (1.0 if self.is_plain else result) / deviation

    def slope(self, gradients: Gradients | None, tables: Mapping[str, Any]) -> Any:
        """Return d mu over the coordinate from the slopes of mu; None where they do not hold it."""
        argument, table = KEYS[self.table][self.field].argument, tables.get(self.table, {})
        if self.field.startswith("temperature_"):
            argument, known = "temperature", True
        elif self.table == "surface":
            known = argument in _OF_LAW and not _CUTOFFS & table.keys()
        elif self.table == "rubber":
            known = argument in _OF_SERIES and "equilibrium_modulus_pa" in table
        elif self.table == "correction":
            argument = f"correction_{argument}" if argument in _OF_LAW else argument
            known = argument in _OF_CORRECTION
        else:
            known = self.table == "adhesion" or argument == "poisson_ratio"
        slope = getattr(gradients, argument) if known else None
        return slope if slope is None or self.place is None else slope[..., self.place]


def unknowns_of(
    path: Path,
    tables: Mapping[str, Any],
    free: Sequence[str],
    priors: Mapping[str, Any],
    *,
    hot: bool,
) -> list[Unknown]:
    """Return what is to be found; `hot` where the points have temperatures of their own."""
    if isinstance(free, str) or not isinstance(free, Sequence):
        raise refusal("free", free, "a list of keys")
    if len({*free}) < len(free):
        raise refusal("free", free, "a list without repeats")
    for key in priors:
        if key not in free:
            raise must_be(f"priors: {shortened(str(key))}", f"one of free, {', '.join(free)}")
    return [_unknown(path, tables, key, priors.get(key), hot=hot) for key in free]


def _unknown(path: Path, tables: Mapping[str, Any], key: str, given: Any, *, hot: bool) -> Unknown:
    about = Argument(f"free: {shortened(str(key))}")
    result = _KEY.fullmatch(key) if isinstance(key, str) else None
    table, name, place = result.groups() if result else ("", "", None)
    if result is None or name not in KEYS.get(table, ()) or table in _NOT_PHYSICAL:
        physical = [one for one in KEYS if one not in _NOT_PHYSICAL]
        every = {f"{one}.{each}": None for one in physical for each in KEYS[one]}
        hint = nearest(str(key), every)
        hint = hint if hint.startswith("did") else "as in adhesion.shear_stress_pa"
        raise InvalidInput(about, ": is no number of a scene, ", hint)
    temperature = name.startswith("temperature_")
    if f"{table}.{name}" in _MEASURED or (temperature and hot):
        raise InvalidInput(about, MUST_BE, "left out: the points have their own")
    field = KEYS[table][name]
    prior = None if given is None else _prior(key, given)
    start = _start(path, tables, table, name, place, field, prior)
    plain = temperature or name.endswith("_deg")
    if not plain and not start > 0:
        raise InvalidInput(about, f" = {start:g}", MUST_BE, "above 0, as it is fitted in its ln")
    if prior is not None and prior.scale == "ln" and plain:
        raise must_be(f"priors: {key}", "plain for a temperature or an angle")
    at = None if place is None else int(place)
    return Unknown(key, table, name, at, start, plain, prior)


def _start(
    path: Path,
    tables: Mapping[str, Any],
    table: str,
    name: str,
    place: str | None,
    field: Field,
    prior: Prior | None,
) -> float:
    given = tables.get(table, {}).get(name)
    about = Argument(f"free: {table}.{name}" + (f"[{place}]" if place else ""))
    if isinstance(given, list):
        if place is None:
            problem = f": has {len(given)} entries"
            raise InvalidInput(about, problem, MUST_BE, f"one of them, {table}.{name}[0]")
        if int(place) >= len(given):
            raise InvalidInput(about, MUST_BE, f"one of the {len(given)} that {path} has")
        given = given[int(place)]
    elif place is not None:
        raise InvalidInput(about, ": is no list in ", f"{path}")
    if given is None:
        given = field.default if prior is None else prior.value
    if isinstance(given, list) or not _is_number(given) or field.read is count:
        raise InvalidInput(
            about, MUST_BE, f"a number that {path} has, from which to start; ", _free(tables)
        )
    return float(given)


def _free(tables: Mapping[str, Any]) -> str:
    """What can be freed in a scene, as it is and with a line more."""
    numbers = [
        f"{table}.{name}" + ("[0]" if isinstance(value, list) else "")
        for table, field_of in tables.items()
        if table not in _NOT_PHYSICAL
        for name, value in field_of.items()
        if f"{table}.{name}" not in _MEASURED and _is_number(value)
    ]
    more = [key for key in _ADDED if key not in numbers]
    has = f"it has {', '.join(numbers)}" if numbers else "it has none"
    return f"{has}; {' and '.join(more)} can be added to it" if more else has


def _is_number(value: Any) -> bool:
    first = value[0] if isinstance(value, list) and value else value
    return isinstance(first, int | float) and not isinstance(first, bool)


def _prior(key: str, given: Any) -> Prior:
    about = f"priors: {key}"
    if not isinstance(given, tuple | list) or len(given) not in (2, 3):
        raise refusal(about, given, '(value, standard deviation), or with "ln" as the third')
    value, deviation = number(given[0], about), number(given[1], about)
    scale: Any = given[2] if len(given) == 3 else "plain"
    choice(scale, about, ("plain", "ln"))
    if not 0 < deviation < math.inf or (scale == "ln" and not value > 0):
        raise refusal(about, given, "positive in its standard deviation, and in its value for ln")
    return Prior(value, deviation, scale)


def with_numbers(
    tables: Mapping[str, Any], unknowns: Sequence[Unknown], inside: Array
) -> dict[str, Any]:
    changed = {name: dict(table) for name, table in tables.items()}
    for one, at in zip(unknowns, inside.tolist(), strict=True):
        table, value = changed.setdefault(one.table, {}), one.value(at)
        if one.place is None:
            table[one.field] = value
        else:
            entries = [*table[one.field]]
            entries[one.place] = value
            table[one.field] = entries
    return changed
