"""Tables of the keys of scenes, by the declarations and docstrings of what they set.

`python docs/_extensions/scene_tables.py` writes them into the page on scenes anew; a test holds the
page to them.
"""

import inspect
import re
from collections.abc import Callable, Iterator, Mapping
from pathlib import Path
from typing import Any

import asperity
from asperity.base.parameters import KEY_UNITS, without_unit
from asperity.io.fields import Field, fields_of
from asperity.scene.keys import CONDITIONS, SOLVER, UNCERTAINTY
from asperity.scene.parts import ADHESION, CORRECTIONS, HEATING, KINDS
from asperity.scene.rubber import RUBBER
from asperity.scene.surface import ENDS, SCAN

Rows = Iterator[list[str]]
_UNITS = re.compile(rf",? \[(?:-|{'|'.join(map(re.escape, KEY_UNITS.values()))})\]")
_PARAMETERS = re.compile(r"^Parameters\n-+\n(.*?)(?=^\w[\w ]*\n---|\Z)", re.M | re.S)
_ENTRY = re.compile(r"^(\w.*)\n((?:(?:    .*)?\n)+)", re.M)
_HEAD = ["key", "unit", "default", "meaning"]
_LAW = asperity.SelfAffineSpectrum
_MAP = asperity.HeightMap.fill_dropouts
_RUBBERS = asperity.PronySeries, asperity.read_isotherms, asperity.build_master_curve, asperity.WLF
_STRAIN = asperity.StrainFactors, asperity.strain_factors
# keys, and what their arguments are of
_OF: dict[str, tuple[Mapping[str, Field], tuple[Callable[..., Any], ...]]] = {
    "scan": (SCAN, (asperity.read_surface, _MAP, asperity.power_spectrum)),
    "law": (fields_of(_LAW), (_LAW,)),
    "ends": (ENDS, (_LAW,)),
    "rubber": (RUBBER, (*_RUBBERS, *_STRAIN)),
    "conditions": (CONDITIONS, (asperity.friction,)),
    "adhesion": (ADHESION, (asperity.Adhesion,)),
    "heating": (HEATING, (asperity.Heating,)),
    "solver": (SOLVER, (asperity.friction,)),
    "uncertainty": (UNCERTAINTY, (asperity.friction_band,)),
}
PAGE = Path(__file__).parents[1] / "reference/scene.md"
_SEVERAL = ("ends", "rubber")  # tables of several sources, of which each has keys that it needs


def page(text: str) -> str:
    """The page on scenes with its tables as the declarations have them."""
    mark = re.compile(r"^(<!-- keys: (\w+) -->\n)(?:\|.*\n)*", re.M)
    return mark.sub(
        lambda result: result[1] + "".join(f"{row}\n" for row in table(result[2])), text
    )


def table(name: str) -> list[str]:
    """The lines of a table in Markdown."""
    rows = _corrections() if name == "correction" else _rows_of(*_OF[name])
    if name in _SEVERAL:
        rows = (
            [key, unit, default.replace("required", ""), text] for key, unit, default, text in rows
        )
    shown = [_HEAD, ["---"] * len(_HEAD), *([f"`{key}`", *rest] for key, *rest in rows)]
    return [f"| {' | '.join(row)} |" for row in shown]


def _corrections() -> Rows:
    """A row for each key, or more where kinds have other defaults, with the kinds it goes with."""
    rows: dict[tuple[str, Any], list[str]] = {}
    kinds: dict[tuple[str, Any], list[str]] = {}
    for kind, fields in CORRECTIONS.items():
        named = {key: one for key, one in fields.items() if key != "kind"}
        for row in _rows_of(named, (KINDS[kind],)):
            if "z_max_m" in fields:
                row[2] = row[2].replace("required", "from the scan")
            at = row[0], fields[row[0]].default
            rows.setdefault(at, row)
            kinds.setdefault(at, []).append(kind)
    for at, (*cells, meaning) in rows.items():
        yield [*cells, f"{', '.join(kinds[at])}: {meaning}"]


def _rows_of(fields: Mapping[str, Field], of: tuple[Callable[..., Any], ...]) -> Rows:
    meanings: dict[str, str] = {}
    for one in reversed(of):  # the first that knows an argument holds
        meanings |= _meanings(one)
    for key, field in fields.items():
        default = "" if field.default is None else _shown(field.default)
        meaning = field.meaning or _UNITS.sub("", meanings.get(field.argument, ""))
        declared = () if field.declared is None else field.declared.choices
        choices = ", ".join(_shown(one) for one in declared if one is not None)
        text = f"{choices}. {meaning}" if choices and not field.meaning else meaning
        required = "required" if field.required else default
        yield [key, without_unit(key)[1], required, text.replace("|", r"\|")]


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
    result = {}
    for names, body in _ENTRY.findall(section[1]):
        for name in re.findall(r"\w+", names.split(" : ")[0]):
            result[name] = " ".join(body.split())
    return result


if __name__ == "__main__":
    PAGE.write_text(page(PAGE.read_text(encoding="utf-8")), encoding="utf-8")
