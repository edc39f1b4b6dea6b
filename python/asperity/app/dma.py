"""The rubber of files that were dropped: sweeps of frequency, or a master curve."""

from collections.abc import Mapping, Sequence
from typing import Any

from asperity._core import InvalidInput
from asperity.app.files import Folder
from asperity.app.guess import numbers_of
from asperity.io.read_dma import read_isotherms


def rubber_of(
    folder: Folder, names: Sequence[str], settings: Mapping[str, Any]
) -> tuple[dict[str, Any], str]:
    """The table of a scene, and what there is to say of the files.

    Without a column of temperatures the one file is a master curve. Of sweeps the master curve is
    that at the middle isotherm; files that hold one frequency are no such sweeps and are left out.
    """
    read = {key: settings[key] for key in ("columns", "units", "modulus")}
    if settings["columns"].get("temperature") is None:
        if len(names) != 1:
            problem = f"{len(names)} files without temperatures: must be one, a master curve"
            raise InvalidInput(problem)
        for key in ("columns", "units"):
            read[key] = {one: said for one, said in read[key].items() if one != "temperature"}
        return {"master_curve": names[0], **read, "extrapolation": "power-law"}, ""
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
