"""The verb `validate`: every correction against contacts that boundary elements have solved."""

from argparse import Namespace
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from asperity.base import quantities
from asperity.base.arguments import FilePath
from asperity.base.diagnostics import InvalidInput, Note
from asperity.cli.friction_commands import progress
from asperity.cli.options import exclusive, goes_with, typed_options
from asperity.cli.streams import print_stdout, tell_notes
from asperity.draw.figure import check_plot
from asperity.draw.style import drawn_in
from asperity.io import plausible
from asperity.io.fields import rename_in_errors
from asperity.io.files import check_directory, refuse_overwrite, write_files
from asperity.io.table import Table
from asperity.scene.scan import read_filled
from asperity.surface import HeightMap
from asperity_scripts.validate.boundary_elements import own_contacts
from asperity_scripts.validate.contacts import Contact, read_contacts, shipped
from asperity_scripts.validate.figures import error_figure, shift_figure
from asperity_scripts.validate.predictions import Prediction, models_for, predict
from asperity_scripts.validate.sliding import validate_sliding
from asperity_scripts.validate.summary import error_rows, summary

LOADS = (0.005, 0.01, 0.02, 0.05, 0.1, 0.2, 0.3, 0.5, 0.7, 1.0)  # those of the shipped rows
_AREA, _ENERGY, _SHIFT = "area_error.png", "energy_error.png", "shift.png"
_OF_MAP = ("pixel_size", "unit", "channel", "detrend", "q0", "loads", "periodic")
_FILES = ("summary.md", "errors.csv", _AREA, _ENERGY, _SHIFT)


def validate(args: Namespace) -> None:
    _check_options(args)
    if args.sliding:
        surface, facts, unusual = _own_map(args) if args.surface else (None, {}, [])
        validate_sliding(args, surface, facts)
        return tell_notes(unusual, args.notes)
    directory = FilePath(args.output)
    check_plot(directory / _AREA)
    check_directory(directory, _FILES, force=args.force)
    inputs = [FilePath(name) for name in (args.rows, args.surface) if name is not None]
    refuse_overwrite([directory / name for name in _FILES], inputs)
    contacts, facts, notes = _contacts(args)
    predictions = [[predict(c, model) for c in contacts] for model in models_for(contacts)]
    text = summary(predictions)
    table = Table("validate", [facts], notes, error_rows(predictions))
    with drawn_in(args.style):
        pictures = _pictures(contacts, predictions)
    files = {"summary.md": text.encode(), "errors.csv": table.csv().encode(), **pictures}
    write_files({directory / name: data for name, data in files.items()})
    tell_notes(notes, args.notes)
    print_stdout(f"{text}\nfiles: {directory}: {', '.join(_FILES)}\n")


def _contacts(args: Namespace) -> tuple[list[Contact], dict[str, Any], list[Note]]:
    """Contacts from rows or from a run of one's own surface, their origin, and what to know."""
    if args.surface is None:
        if args.rows is None:
            return shipped(), {"rows": "bem_area.csv, shipped"}, []
        return read_contacts(FilePath(args.rows)), {"rows": args.rows}, []
    flat, facts, unusual = _own_map(args)
    path = FilePath(args.surface)
    with rename_in_errors(path, {"loads": "--loads", "min_distance": "--q0"}):
        contacts, notes = own_contacts(
            flat,
            path.name,
            loads=args.loads or LOADS,
            q0=args.q0,
            periodic=args.periodic,
            progress=progress(f"{path}"),
        )
    return contacts, facts, [*unusual, *notes]


def _check_options(args: Namespace) -> None:
    """Refuse options that do nothing beside others, or without them."""
    for name in ("rows", "q0", "loads"):
        exclusive(args, f"sliding {name}")
    exclusive(args, "surface rows")
    goes_with(args, "rubber velocities", "sliding")
    goes_with(args, " ".join(_OF_MAP).replace("_", "-"), "surface")


def _own_map(args: Namespace) -> tuple[HeightMap, dict[str, Any], list[Note]]:
    """A map read from --surface without its trend, what was given, and what to know of it."""
    values = {name: getattr(args, name) for name in _OF_MAP}
    options = {name: v for name, v in values.items() if v is not None and v is not False}
    path = FilePath(args.surface)
    flags = {"pixel_size": "--pixel-size", "unit": "--unit", "channel": "--channel"}
    with plausible.collected(typed_options(args)) as unusual, rename_in_errors(None, flags):
        if args.q0 is not None:
            plausible.check("--q0", args.q0, quantities.FIRST_WAVENUMBER)
        read = {name: options[name] for name in flags if name in options}
        _, filled = read_filled(path, max_fraction=0.10, **read)
    if not isinstance(filled, HeightMap):
        raise InvalidInput("is a line scan: contacts need a map", where=path)
    detrend: Any = args.detrend or "plane"
    flat = filled if detrend == "none" else filled.detrend(detrend)
    return flat, {"surface": args.surface, **options, "detrend": detrend}, list(unusual)


def _pictures(
    contacts: Sequence[Contact], predictions: Sequence[Sequence[Prediction]]
) -> dict[str, bytes]:
    return {
        _AREA: error_figure(predictions, "area", Path(_AREA)),
        _ENERGY: error_figure(predictions, "energy", Path(_ENERGY)),
        _SHIFT: shift_figure(contacts, predictions, Path(_SHIFT)),
    }
