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
    rows = [_HEAD, ["---"] * len(_HEAD), *_rows(name)]
    if name == "correction":
        kinds = {key: [k for k in KINDS if key in CORRECTIONS[k]] for key, *_ in rows}
        for row in rows[2:]:
            of_scan = "z_max_m" in CORRECTIONS[kinds[row[0]][0]]
            row[2] = row[2].replace("required", "from the scan") if of_scan else row[2]
            row[3] = f"{', '.join(kinds[row[0]])}: {row[3]}"
    shown = [[f"`{key}`", *rest] for key, *rest in rows[2:]]
    return [f"| {' | '.join(row)} |" for row in (*rows[:2], *shown)]


def _rows(name: str) -> Rows:
    if name in _OF:
        yield from _rows_of(*_OF[name])
        return
    told = {"kind"}
    for kind, fields in CORRECTIONS.items():
        new = {key: one for key, one in fields.items() if key not in told}
        yield from _rows_of(new, KINDS[kind])
        told |= new.keys()


def _rows_of(fields: Mapping[str, Field], of: Callable[..., Any]) -> Rows:
    meanings = _meanings(of)
    for key, field in fields.items():
        assert field.declared is not None
        default = "" if field.default is None else _shown(field.default)
        default = "required" if field.required else default
        meaning = _UNITS.sub("", meanings[field.argument])
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
