"""The rubber of files that were dropped: sweeps of frequency, or a master curve."""

from collections.abc import Mapping, Sequence
from typing import Any

from asperity._core import InvalidInput
from asperity.app.files import Folder
from asperity.app.guess import numbers_of
from asperity.io.read_dma import read_isotherms


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
    single = [name for name in names if len(set(numbers_of(folder.path / name, column))) == 1]
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
