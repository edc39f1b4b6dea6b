"""Parameters of values and functions, each declared once.

Its name, type and default, its entry in the docstring and, in the field of a value, `parameter` say
all that there is to say. How Python checks it, how scenes read it, what the app offers and what the
pages list follow from here.
"""

import dataclasses
import inspect
from collections.abc import Callable
from dataclasses import MISSING, dataclass
from functools import cache
from typing import Any, Literal, get_args, get_origin, get_type_hints

from asperity.base.arguments import (
    Covariance,
    OptionalVector,
    Vector,
    choice,
    covariance_matrix,
    flag,
    notes_of,
    number,
    number_or_none,
    vector,
    vector_or_none,
    whole,
)
from asperity.base.diagnostics import Note
from asperity.base.quantities import Quantity

KEY_UNITS = {  # by how keys of scenes and columns of tables end, the longest first
    "kg_m3": "kg/m^3",
    "j_kg_k": "J/(kg K)",
    "w_m_k": "W/(m K)",
    "per_pa": "1/Pa",
    "per_m": "1/m",
    "rad_s": "rad/s",
    "deg": "deg",
    "m_s": "m/s",
    "m4": "m^4",
    "pa": "Pa",
    "k": "K",
    "c": "degC",
    "m": "m",
    "s": "s",
}
_ENDS = {unit: end for end, unit in KEY_UNITS.items()}
CHECKS: dict[Any, Callable[[Any, str], Any]] = {  # by type; `value` adds its classes
    float: number,
    float | None: number_or_none,
    Vector: vector,
    OptionalVector: vector_or_none,
    Covariance: covariance_matrix,
    bool: flag,
    int: whole,
    tuple[Note, ...]: notes_of,
}


def key_of(name: str, unit: str) -> str:
    """Return a name as files have it, which ends in the unit."""
    return "_".join(filter(None, (name.lower(), _ENDS.get(unit, ""))))


@dataclass(frozen=True)
class Parameter:
    """What is declared of one parameter."""

    name: str
    type: Any
    default: Any = MISSING  # MISSING where it must be given
    quantity: Quantity | None = None  # its unit, and the ranges that this leaves plausible
    unit: str = ""  # the SI unit of a number without a quantity
    key_name: str = ""  # in scenes, without the unit; its name, if empty
    usual: tuple[Any, ...] = ()  # what the app offers: the ends of a slider [SI], or the choices
    shown_unit: str = ""  # of the slider
    label: str = ""  # what the app calls it; its name, if empty
    start: float | None = None  # of the slider, where there is no default

    @property
    def si_unit(self) -> str:
        return self.unit if self.quantity is None else next(iter(self.quantity.units))

    @property
    def key(self) -> str:
        """Its key in scenes, which ends in its unit."""
        return key_of(self.key_name or self.name, self.si_unit)

    @property
    def choices(self) -> tuple[Any, ...]:
        """The values that it is limited to, in the order of the core's enumeration."""
        types = (self.type, *get_args(self.type))
        named = next((get_args(one) for one in types if get_origin(one) is Literal), ())
        return (*named, None) if named and type(None) in types else named

    @property
    def is_checked(self) -> bool:
        """Whether its type says all that there is to check, but for the range."""
        return bool(self.choices) or self.type in CHECKS

    def take(self, value: Any) -> tuple[Any, Any]:
        """Return what an object keeps of an argument, and what the object of the core gets."""
        if self.choices:
            return value, choice(value, self.name, self.choices)
        kept = CHECKS[self.type](value, self.name)
        return kept, kept


def parameter(
    quantity: Quantity | None = None,
    *,
    default: Any = MISSING,
    kw_only: bool = True,
    **declared: Any,
) -> Any:
    """Return a field of a value that declares more than its type and default: see `Parameter`."""
    metadata = {"declared": {"quantity": quantity, **declared}}
    return dataclasses.field(default=default, kw_only=kw_only, metadata=metadata)


def column(
    unit: str, meaning: str = "", *along: str, default: Any = MISSING, **declared: Any
) -> Any:
    """Return a field of a value that is a column of its table: a number a point, unless it goes
    along dimensions of its own."""
    metadata = {"column": (unit, meaning, along), "declared": declared}
    return dataclasses.field(default=default, metadata=metadata)


def without_unit(key: str) -> tuple[str, str]:
    """What a key is of, and the unit at its end: "pressure_pa" has "pressure" and "Pa"."""
    for end, unit in KEY_UNITS.items():
        if key.endswith(f"_{end}"):
            return key.removesuffix(f"_{end}"), unit
    return key, ""


@cache
def parameters(of: Callable[..., Any], *names: str) -> tuple[Parameter, ...]:
    """Return the parameters of a value or a function, or those of these names."""
    types = get_type_hints(of)
    if dataclasses.is_dataclass(of):
        fields = [one for one in dataclasses.fields(of) if one.init]
        declared = [
            Parameter(one.name, types[one.name], one.default, **one.metadata.get("declared", {}))
            for one in fields
        ]
    else:
        declared = [
            Parameter(name, types.get(name), MISSING if one.default is one.empty else one.default)
            for name, one in inspect.signature(of).parameters.items()
        ]
    by_name = {one.name: one for one in declared}
    return tuple(by_name[name] for name in names or by_name)
