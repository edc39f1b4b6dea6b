"""The rubber of files that were dropped: sweeps of frequency, or a master curve."""

import math
from collections.abc import Mapping, Sequence
from typing import Any

from asperity._core import InvalidInput
from asperity.app.files import Folder
from asperity.app.guess import numbers_of
from asperity.io.read_dma import read_isotherms

_HERTZ = {"Hz": 2 * math.pi, "rad/s": 1.0}
_PASCAL = {"Pa": 1.0, "kPa": 1e3, "MPa": 1e6, "GPa": 1e9}
_SHEAR = 3.0  # E = 2 (1 + nu) G of a rubber that keeps its volume
_HEADER = "angular_frequency_rad_s,storage_modulus_pa,loss_modulus_pa"


def rubber_of(
    folder: Folder, names: Sequence[str], settings: Mapping[str, Any]
) -> tuple[dict[str, Any], str]:
    """The table of a scene, and what there is to say of the files.

    Without a column of temperatures the one file is a master curve. Of sweeps the master curve is
    that at the middle isotherm; files that hold one frequency are no such sweeps and are left out.
    """
    if settings["columns"].get("temperature") is None:
        return _master_curve(folder, names, settings), ""
    read = {key: settings[key] for key in ("columns", "units", "modulus")}
    column = settings["columns"]["frequency"]
    single = [name for name in names if len(set(numbers_of(folder.path / name, column))) == 1]
    swept = [name for name in names if name not in single]
    if not swept:
        problem = "holds one frequency: must be sweeps of frequency at several temperatures"
        raise InvalidInput(problem, where=folder.path / single[0])
    isotherms = read_isotherms([folder.path / name for name in swept], **read)
    prony = bool(settings.get("prony", False))
    table = {
        "isotherms": swept,
        **read,
        "reference_temperature_k": round(isotherms[len(isotherms) // 2].temperature, 2),
        "prony": prony,
        "extrapolation": "prony" if prony else "power-law",
    }
    shown = ", ".join(folder.shown[name] for name in single)
    said = f"Left out, as they hold one frequency each: {shown}." if single else ""
    return table, said


def _master_curve(
    folder: Folder, names: Sequence[str], settings: Mapping[str, Any]
) -> dict[str, Any]:
    """The file's columns in a file of ours, as scenes take master curves."""
    if len(names) != 1:
        problem = f"{len(names)} files without temperatures: must be one, a master curve"
        raise InvalidInput(problem)
    path, units = folder.path / names[0], settings["units"]
    modulus = _PASCAL[units["modulus"]] * (_SHEAR if settings["modulus"] == "G" else 1.0)
    factors = {
        "frequency": _HERTZ[units["frequency"]],
        "storage": modulus,
        "loss": modulus,
    }
    columns = [
        [factor * one for one in numbers_of(path, settings["columns"][quantity])]
        for quantity, factor in factors.items()
    ]
    if len({len(one) for one in columns}) != 1:
        raise InvalidInput("has rows without a number in each of the columns", where=path)
    rows = sorted(zip(*columns, strict=True))
    lines = [_HEADER, *(",".join(f"{one:.17g}" for one in row) for row in rows)]
    shown = f"{folder.shown[names[0]]}, in rad/s and Pa"
    kept = folder.keep("master curve.csv", "\n".join(lines).encode())
    folder.shown[kept] = shown
    return {"master_curve": kept, "extrapolation": "power-law"}
