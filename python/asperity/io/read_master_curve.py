"""Master curves from files."""

import os
from collections.abc import Mapping
from typing import Any, Literal

import numpy as np

from asperity.base.arguments import Array, reading
from asperity.base.diagnostics import Argument, InvalidInput, Note
from asperity.base.parameters import key_of
from asperity.base.table import declared_columns
from asperity.io import plausible
from asperity.io.columns import Columns, Names
from asperity.io.declared import file_of, read_declared, young
from asperity.io.source import Frame, notes_in
from asperity.rubber import Extrapolation, MasterCurve
from asperity.shift_factors import HasShiftFactors, TemperatureShift, temperature_shift_core

_DECLARED = declared_columns(MasterCurve).items()
_ROWS = ("frequency", "storage", "loss")
_OF_FRAME = {ours: name for ours, (name, _) in zip(_ROWS, _DECLARED, strict=True)}
_OWN = {ours: key_of(name, one[0]) for ours, (name, one) in zip(_ROWS, _DECLARED, strict=True)}
_TOGETHER = 1.01  # of two frequencies that are one, as in an isotherm
_OF_RAMP = 10**0.05  # the same of rows that are reduced by a_T


def read_master_curve(
    path: str | os.PathLike[str] | Any,
    *,
    columns: Names | None = None,
    units: Mapping[str, str] | None = None,
    modulus: Literal["E", "G"] | None = None,
    poisson_ratio: float = 0.5,
    extrapolation: Extrapolation | None = None,
    shift: TemperatureShift | None = None,
) -> MasterCurve:
    """Return the master curve in a table of text or of a workbook (.xlsx, .xls).

    Rows may stand in any order. Those within 1 % of each other in frequency are averaged in the
    logarithm, which a note says. Frequencies are the reduced ones, of any size.

    Parameters
    ----------
    path : path-like, DataFrame or xarray.Dataset
    columns, units, modulus, poisson_ratio : optional
        As those of `read_isotherms`, without "temperature". They are all left out for a file that
        `asperity rubber` wrote, whose columns are angular_frequency_rad_s, storage_modulus_pa and
        loss_modulus_pa, and for what `MasterCurve.to_dataframe` and `to_xarray` gave.
    extrapolation : {None, "power-law", "clamp"}
        As in `MasterCurve`.
    shift : WLF, WlfFit, ArrheniusFit, ShiftFactors or MasterCurveBuild, optional
        For rows measured at temperatures of their own, as a temperature ramp at one frequency or a
        few has them: `columns` and `units` then have "temperature" too, frequencies are reduced by
        a_T, and rows are averaged twenty a decade.

    Returns
    -------
    MasterCurve

    Raises
    ------
    InvalidInput
        Naming file and line.

    Examples
    --------
    >>> columns = {"frequency": "f", "storage": "E_stor", "loss": "E_loss"}
    >>> units = {"frequency": "Hz", "modulus": "MPa"}
    >>> read_master_curve("master.csv", columns=columns, units=units, modulus="E")  # doctest: +SKIP
    """
    file = file_of(path, "path")
    own = _OF_FRAME if isinstance(file, Frame) else _OWN
    declared = {"columns": columns, "units": units, "modulus": modulus}
    missing = [name for name, argument in declared.items() if argument is None]
    if len(missing) not in (0, 3):
        argument = next(name for name in declared if name not in missing)
        raise InvalidInput(Argument(missing[0]), f": is missing, which goes with {argument}")
    if shift is not None and not isinstance(shift, HasShiftFactors):
        temperature_shift_core(shift)  # refuses what is none
    factor = young(modulus or "E", poisson_ratio)
    known = units or {"frequency": "rad/s", "modulus": "Pa"}
    try:
        wanted = _ROWS if shift is None else (*_ROWS, "temperature")
        reduced = shift is None
        (table,) = read_declared([file], columns or own, known, wanted, factor, reduced=reduced)
    except InvalidInput as error:
        if columns is not None or error.code != "unknown-columns":
            raise
        hint = "; columns, units and modulus say what other tables have"
        raise error.followed_by(hint) from error
    if columns is not None and shift is not None:
        table.values["frequency"] *= 10 ** _log10_a_t(shift, table.values["temperature"])
    with reading(file):
        return _curve(table, _TOGETHER if shift is None else _OF_RAMP, extrapolation)


def _log10_a_t(shift: TemperatureShift, temperature: Array) -> Any:
    if isinstance(shift, HasShiftFactors):
        return np.log10(shift.shift_factor(temperature))
    return shift.log10_a_T(temperature)


def _curve(table: Columns, together: float, extrapolation: Extrapolation | None) -> MasterCurve:
    rows = np.array([table.values[name] for name in _ROWS])
    rows = rows[:, np.argsort(rows[0], kind="stable")]
    starts, last = [], 0.0
    for at, frequency in enumerate(rows[0]):
        if frequency > last * together:
            starts.append(at)
            last = frequency
    sizes = np.diff([*starts, rows.shape[1]])
    means = np.exp(np.add.reduceat(np.log(rows), starts, axis=1) / sizes)
    frequency, storage, loss = np.where(sizes > 1, means, rows[:, starts])
    if np.any(sizes > 1):
        merged = int(np.sum(sizes[sizes > 1]))
        near = f"{100 * (together - 1):.2g} %"
        text = f"{merged} rows within {near} of the frequency of others were averaged"
        plausible.tell_again([Note(text, code="rows-averaged", where=table.path)])
    return MasterCurve(
        angular_frequency=frequency,
        storage_modulus=storage,
        loss_modulus=loss,
        extrapolation=extrapolation,
        notes=() if isinstance(table.path, Frame) else notes_in(table.path),
    )
