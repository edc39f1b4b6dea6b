"""Tables of the keys of scenes, by the declarations and docstrings of what they set."""

import inspect
import re
from collections.abc import Callable, Iterator, Mapping
from typing import Any

from asperity.adhesion import Adhesion
from asperity.base.parameters import KEY_UNITS
from asperity.friction import friction
from asperity.heating import Heating
from asperity.io.fields import Field, fields_of
from asperity.scene.keys import SOLVER, UNCERTAINTY
from asperity.scene.parts import ADHESION, CORRECTIONS, HEATING, KINDS
from asperity.spectrum import SelfAffineSpectrum
from asperity.uncertainty.band import friction_band

Rows = Iterator[list[str]]
_UNITS = re.compile(rf",? \[(?:-|{'|'.join(map(re.escape, KEY_UNITS.values()))})\]")
_PARAMETERS = re.compile(r"^Parameters\n-+\n(.*?)(?=^\w[\w ]*\n---|\Z)", re.M | re.S)
_ENTRY = re.compile(r"^(\w.*)\n((?:(?:    .*)?\n)+)", re.M)
_HEAD = ["key", "unit", "default", "meaning"]
_OF: dict[str, tuple[Mapping[str, Field], Callable[..., Any]]] = {
    "law": (fields_of(SelfAffineSpectrum), SelfAffineSpectrum),
    "adhesion": (ADHESION, Adhesion),
    "heating": (HEATING, Heating),
    "solver": (SOLVER, friction),
    "uncertainty": (UNCERTAINTY, friction_band),
}
TABLES = ("correction", *_OF)


def table(name: str) -> list[str]:
    """The lines of a table in Markdown."""
    rows = _corrections() if name == "correction" else _rows_of(*_OF[name])
    shown = [_HEAD, ["---"] * len(_HEAD), *([f"`{key}`", *rest] for key, *rest in rows)]
    return [f"| {' | '.join(row)} |" for row in shown]


def _corrections() -> Rows:
    """A row for each key, or more where kinds have other defaults, with the kinds it goes with."""
    rows: dict[tuple[str, Any], list[str]] = {}
    kinds: dict[tuple[str, Any], list[str]] = {}
    for kind, fields in CORRECTIONS.items():
        named = {key: one for key, one in fields.items() if key != "kind"}
        for row in _rows_of(named, KINDS[kind]):
            if "z_max_m" in fields:
                row[2] = row[2].replace("required", "from the scan")
            at = row[0], fields[row[0]].default
            rows.setdefault(at, row)
            kinds.setdefault(at, []).append(kind)
    for at, (*cells, meaning) in rows.items():
        yield [*cells, f"{', '.join(kinds[at])}: {meaning}"]


def _rows_of(fields: Mapping[str, Field], of: Callable[..., Any]) -> Rows:
    meanings = _meanings(of)
    for key, field in fields.items():
        assert field.declared is not None
        default = "" if field.default is None else _shown(field.default)
        default = "required" if field.required else default
        meaning = _UNITS.sub("", meanings.get(field.argument, ""))
        choices = ", ".join(map(_shown, field.declared.choices))
        text = f"{choices}. {meaning}" if choices else meaning
        yield [
            key,
            field.declared.si_unit,
            "required" if field.required else default,
            text.replace("|", r"\|"),
        ]


def _shown(value: Any) -> str:
    if value is True:
        return "true"
    return f'"{value}"' if isinstance(value, str) else f"{value:g}"


def _meanings(of: Callable[..., Any]) -> dict[str, str]:
    """What the docstring says of each parameter."""
    text = inspect.getdoc(of)
    if text is None or "Parameters\n" not in text:
        return {}
    section: Any = _PARAMETERS.search(text + "\n")
    found = {}
    for names, body in _ENTRY.findall(section[1]):
        for name in re.findall(r"\w+", names.split(" : ")[0]):
            found[name] = " ".join(body.split())
    return found
