"""A guess of what the columns of a DMA file are: a start for menus, never used unseen."""

import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from asperity.app.files import Folder
from asperity.base.diagnostics import InvalidInput, must_have
from asperity.io.columns import cells_of, find_header, read_columns, unit_in
from asperity.io.read_dma import read_isotherms
from asperity.io.source import read_source

QUANTITIES = ("frequency", "storage", "loss", "temperature")
UNITS = {
    "frequency": ("Hz", "rad/s"),
    "modulus": ("Pa", "kPa", "MPa", "GPa"),
    "temperature": ("C", "K"),
}
# What names say, by the words that instruments use; the first that fits holds.
_NAMED = {
    "temperature": r"temp|θ|^(?-i:T)($|[ _\[(/\d])",
    "frequency": r"freq|^(f|w|ω|omega|ang\w*)($|[ _\[(/.])|\bhz\b|rad/s",
    "loss": r"''|\"|″|′′|loss|verlust|[eg]_?(2|pp|dd|dprime)(?![a-z])|imag",
    "storage": r"'|′|stor|speicher|[eg]_?(1|p|d|prime)(?![a-z])|real",
}
_ROWS = 200  # from which sizes are seen
_MOST_KELVIN_BELOW = 150.0  # temperatures of DMA below it are in C
_MOST_MPA = 1e5  # moduli above it are in Pa


@dataclass(frozen=True)
class Guess:
    """The columns that a file has, which is which, and in which units."""

    names: Sequence[str]
    columns: dict[str, str]  # by QUANTITIES; without those that no name fits
    units: dict[str, str]
    modulus: str  # "E" or "G"


def guess_columns(path: Path) -> Guess:
    """Look at the line that names the columns, the units below it and the sizes of the numbers."""
    lines = read_source(path).lines
    header = find_header(lines)
    if header is None:
        raise must_have("", "one above the numbers", "no line names columns", where=path)
    names = [name for name in header.names if name]
    columns: dict[str, str] = {}
    for quantity, pattern in _NAMED.items():
        left = [name for name in names if name not in columns.values()]
        result = next((n for n in left if re.search(pattern, n, re.IGNORECASE)), None)
        if result is not None:
            columns[quantity] = result
    below = dict(zip(header.names, header.units, strict=False))
    units = dict.fromkeys(UNITS, "")
    for quantity, name in columns.items():
        kind = quantity if quantity in UNITS else "modulus"
        said = (unit_in(kind, text) for text in (below.get(name, ""), name))
        units[kind] = units[kind] or next((one for one in said if one in UNITS[kind]), "")
    rows = [cells_of(line) for number, line in lines if number > header.number][:_ROWS]
    for kind, quantity in (("modulus", "storage"), ("temperature", "temperature")):
        if not units[kind] and quantity in columns:
            place = header.names.index(columns[quantity])
            units[kind] = _by_size(kind, _numbers(rows, place))
    shear = re.match(r"\W*g|.*shear", columns.get("storage", ""), re.IGNORECASE)
    known = {kind: unit or UNITS[kind][0] for kind, unit in units.items()}
    return Guess(names, columns, known, "G" if shear else "E")


def _by_size(kind: str, numbers: Sequence[float]) -> str:
    if not numbers:
        return ""
    if kind == "temperature":
        return "C" if min(numbers) < _MOST_KELVIN_BELOW else "K"
    return "Pa" if max(numbers) > _MOST_MPA else "MPa"


def _numbers(rows: Sequence[Sequence[str]], place: int) -> list[float]:
    result = []
    for row in rows:
        try:
            result.append(float(row[place].replace(",", ".")))
        except (ValueError, IndexError):
            continue
    return result


def rubber_of(
    folder: Folder, names: Sequence[str], settings: Mapping[str, Any]
) -> tuple[dict[str, Any], float | None, str]:
    """The table of a scene, the temperature of the middle isotherm [K], and what there is to say of
    the files.

    Without a column of temperatures the one file is a master curve. Files that hold one frequency
    are no sweeps and are left out. The defaults are the shell's; `prony` is a Prony series instead
    of the points, and with `beyond` the modulus goes on beyond them.
    """
    prony, beyond = bool(settings.get("prony")), bool(settings.get("beyond"))
    read = {key: settings[key] for key in ("columns", "units", "modulus")}
    if settings["columns"].get("temperature") is None:
        if len(names) != 1:
            problem = f"{len(names)} files without temperatures: must be one, a master curve"
            raise InvalidInput(problem)
        for key in ("columns", "units"):
            read[key] = {one: said for one, said in read[key].items() if one != "temperature"}
        further = {"extrapolation": "power-law"} if beyond else {}
        return {"master_curve": names[0], **read, **further}, None, ""
    column = settings["columns"]["frequency"]
    frequencies = {
        name: read_columns(folder.path / name, {column: column}, {}).values[column]
        for name in names
    }
    single = [name for name, hertz in frequencies.items() if len(set(hertz)) == 1]
    swept = [name for name in names if name not in single]
    if not swept:
        problem = "holds one frequency: must be sweeps of frequency at several temperatures"
        raise InvalidInput(problem, where=folder.path / single[0])
    isotherms = read_isotherms([folder.path / name for name in swept], **read)
    table = {"isotherms": swept, **read} | ({"prony": True} if prony else {})
    if beyond:
        table["extrapolation"] = "prony" if prony else "power-law"
    middle = isotherms[len(isotherms) // 2].temperature
    shown = ", ".join(folder.shown[name] for name in single)
    said = f"Left out, as they hold one frequency each: {shown}." if single else ""
    return table, middle, said
