"""Values: frozen, compared by content, pickled by what they were made from, shown in one line."""

from collections.abc import Mapping
from dataclasses import dataclass, field, fields
from html import escape
from typing import Any, ClassVar, Self, TypeVar, dataclass_transform

import numpy as np

from asperity import _core
from asperity.base.arguments import of_kind
from asperity.base.diagnostics import html_items
from asperity.base.parameters import CHECKS, column, parameter, parameters

Kind = TypeVar("Kind", bound="Value")


@dataclass_transform(
    frozen_default=True, kw_only_default=True, field_specifiers=(field, parameter, column)
)
def value(cls: Any) -> Any:
    """Make a frozen dataclass whose fields are keyword-only arguments and pattern attributes."""
    decorate = dataclass(frozen=True, eq=False, repr=False, kw_only=True, match_args=False)
    made: Any = decorate(cls)
    made.__match_args__ = tuple(f.name for f in fields(made) if f.init)  # type: ignore[misc]
    CHECKS[made] = lambda one, name: of_kind(one, name, made)
    return made


class Value:
    """What every public object can do. `_core` is the object of the compiled core behind it."""

    _core: Any
    _title = ""  # in menus; the name of the class, if empty
    _beside: ClassVar[Mapping[str, Any]] = {}  # fields that the core does not know, with defaults
    __match_args__: tuple[str, ...]
    __hash__ = None  # type: ignore[assignment]  # equal arrays have no equal hash

    def __post_init__(self) -> None:
        """Check fields by their types, and make arrays read-only."""
        self._take()
        for name, entry in self._arguments().items():
            if isinstance(entry, np.ndarray):
                shown = entry.view()
                shown.setflags(write=False)
                self._set(**{name: shown})

    def _take(self) -> dict[str, Any]:
        """Check and keep the fields whose types say how; return what the core takes of them."""
        cls: Any = type(self)
        declarations = [one for one in parameters(cls) if one.is_checked]
        taken = {one.name: one.take(getattr(self, one.name)) for one in declarations}
        self._set(**{name: kept for name, (kept, _) in taken.items()})
        return {name: of_core for name, (_, of_core) in taken.items()}

    def _set(self, **values: Any) -> None:
        """Set attributes of a frozen object while it is made."""
        self.__dict__.update(values)

    @classmethod
    def _made(cls, values: Mapping[str, Any] | tuple[()] = (), **named: Any) -> Self:
        """Make an object from values that the core has checked already."""
        made = object.__new__(cls)
        made.__dict__.update(values, **named)
        return made

    @classmethod
    def _of_core(cls) -> tuple[str, ...]:
        return tuple(name for name in cls.__match_args__ if name not in cls._beside)

    def _arguments(self) -> dict[str, Any]:
        return {name: getattr(self, name) for name in self.__match_args__}

    def _summary(self) -> dict[str, Any]:
        """Return what the one-line repr shows: by default the constructor's arguments."""
        return self._arguments()

    def __repr__(self) -> str:
        shown = ", ".join(f"{name}={short(value)}" for name, value in self._summary().items())
        return f"{type(self).__name__}({shown})"

    def _repr_html_(self) -> str:
        """Return the same as a table, for notebooks."""
        cells = {escape(name): escape(short(shown)) for name, shown in self._summary().items()}
        if "notes" in cells:
            cells["notes"] = f"<ul>{html_items(self._summary()['notes'])}</ul>"
        rows = "".join(f"<tr><th>{name}</th><td>{cell}</td></tr>" for name, cell in cells.items())
        return f"<table><caption>{type(self).__name__}</caption>{rows}</table>"

    def __eq__(self, other: object) -> bool:
        if type(other) is not type(self):
            return NotImplemented
        mine, others = self._arguments(), other._arguments()
        return all(same(mine[name], others[name]) for name in mine)

    def __reduce__(self) -> tuple[Any, ...]:
        return _made_anew, (type(self), self._arguments())


class CoreValue(Value):
    """A value of which the core has a class of the same name, made of the fields in their order."""

    def __post_init__(self) -> None:
        self._set(_core=getattr(_core, type(self).__name__)(*self._take().values()))


def around(kind: type[Kind], core: Any, **beside: Any) -> Kind:
    """Return an object of the package around one that the core made; its arrays are read-only.

    `beside` are fields that the core does not know, by default those of the class.
    """
    of_core = {name: getattr(core, name) for name in kind._of_core()}
    fields = {**of_core, **kind._beside, **beside}
    for entry in fields.values():
        if isinstance(entry, np.ndarray):
            entry.setflags(write=False)
    return kind._made(_core=core, **fields)


def like(one: Kind, core: Any, **beside: Any) -> Kind:
    """Return what the core made of an object, with the fields that it does not know, or others."""
    kept = {name: getattr(one, name) for name in one._beside}
    return around(type(one), core, **{**kept, **beside})


def _made_anew(kind: type[Value], arguments: dict[str, Any]) -> Value:
    """Make an object as its constructor does: from a pickle, or from copies of the arguments."""
    return kind(**arguments)


def same(one: Any, other: Any) -> bool:
    """Whether two attributes are equal; arrays entry by entry, NaN equal to NaN."""
    if isinstance(one, float) and isinstance(other, float):
        return one == other or (one != one and other != other)
    if isinstance(one, np.ndarray) != isinstance(other, np.ndarray):
        return False
    if isinstance(one, np.ndarray):
        return np.array_equal(one, other, equal_nan=one.dtype.kind == "f" == other.dtype.kind)
    return bool(one == other)


def short(shown: Any) -> str:
    """Return a few characters for a value: an array by its ends, a number by four digits."""
    if isinstance(shown, np.ndarray) and shown.dtype.kind == "f" and shown.size:
        if shown.ndim == 1 and shown.size <= 3:
            return "[" + ", ".join(f"{x:.4g}" for x in shown) + "]"
        known = shown[~np.isnan(shown)]
        lowest, highest = (known.min(), known.max()) if known.size else (np.nan, np.nan)
        return f"<{' x '.join(map(str, shown.shape))} from {lowest:.4g} to {highest:.4g}>"
    if isinstance(shown, np.ndarray):
        return f"<{' x '.join(map(str, shown.shape))} {shown.dtype}>"
    if isinstance(shown, float):
        return f"{shown:.6g}"
    if isinstance(shown, tuple) and shown and isinstance(shown[0], str):
        return f"<{len(shown)} notes>" if len(shown) > 1 else "<1 note>"
    if isinstance(shown, dict):
        return "{" + ", ".join(f"{name}: {short(one)}" for name, one in shown.items()) + "}"
    if isinstance(shown, tuple):
        return "(" + ", ".join(map(short, shown)) + (",)" if len(shown) == 1 else ")")
    return repr(shown)
