"""The verb `validate`: every correction against contacts that boundary elements have solved."""

from argparse import Namespace
from collections.abc import Sequence
from pathlib import Path

from asperity import plot
from asperity.commands import spare, tell
from asperity.table import Table, check_output, check_writable, write_directory
from asperity.validation.contacts import Contact, read_contacts, shipped
from asperity.validation.figures import error_figure, shift_figure
from asperity.validation.predictions import Prediction, models_for, predict
from asperity.validation.summary import error_rows, summary

_AREA, _ENERGY, _SHIFT = "area_error.png", "energy_error.png", "shift.png"
_FILES = ("summary.md", "errors.csv", _AREA, _ENERGY, _SHIFT)


def validate(args: Namespace) -> None:
    """Errors of area and elastic energy: tables, pictures, and the summary on the terminal."""
    directory = Path(args.output)
    plot.check_plot(directory / _AREA)
    if check_writable(directory) == directory:
        for name in _FILES:
            check_output(directory / name)
    if args.rows is not None:
        spare([directory / name for name in _FILES], [Path(args.rows)])
    contacts = shipped() if args.rows is None else read_contacts(Path(args.rows))
    predictions = [[predict(c, model) for c in contacts] for model in models_for(contacts)]
    text = summary(predictions)
    inputs = {"rows": args.rows or "bem_area.csv, shipped"}
    table = Table("validate", [inputs], [], error_rows(predictions))
    pictures = _pictures(contacts, predictions)
    write_directory(
        directory, {"summary.md": text.encode(), "errors.csv": table.csv().encode(), **pictures}
    )
    tell(f"{text}\nfiles: {directory}: {', '.join(_FILES)}\n")


def _pictures(
    contacts: Sequence[Contact], predictions: Sequence[Sequence[Prediction]]
) -> dict[str, bytes]:
    return {
        _AREA: error_figure(predictions, "area", Path(_AREA)),
        _ENERGY: error_figure(predictions, "energy", Path(_ENERGY)),
        _SHIFT: shift_figure(contacts, predictions, Path(_SHIFT)),
    }
