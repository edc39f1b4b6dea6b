"""Shift factors from files."""

import json
import os
import re
from contextlib import suppress
from dataclasses import replace
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from asperity.base import quantities
from asperity.base.arguments import path_of, reading
from asperity.base.diagnostics import InvalidInput, Note, OutOfRange
from asperity.base.quantities import ZERO_CELSIUS
from asperity.io import plausible
from asperity.io.columns import cells_of, read_columns, unit_in
from asperity.io.files import check_file
from asperity.io.source import inputs_in, read_source, text_lines
from asperity.shift_factors import ShiftFactors

Column = NDArray[np.float64]

_TEMPERATURE = r"t(emp(erature)?)?\.?(_k|_c)?\s*([\[(].*)?"
_SHIFT = r"(?P<log>log_?(10)?|lg|ln)?[_ (]*(a_?t|shift( factor)?)\)?\s*([\[(].*)?"
_COLDEST = 120.0  # K: no DMA cools so far, so that a lower number is in C
_NOT_ONE = 0.01  # decades of a_T at the reference: more is said


def read_shift_factors(
    path: str | os.PathLike[str], *, reference_temperature: float
) -> ShiftFactors:
    """Return the shift factors over temperature in a table, or in what `asperity rubber` wrote.

    The columns are called `temperature_k` and `log10_a_t`, or as other programs do: `T` or `Temp`
    and `log_aT`, `ln_aT`, `aT` or `Shift`. The last two hold a_T where they are all positive, else
    its decadic logarithm. Temperatures are in the unit that the name or the line below says; else
    in C where one of them is below 120.

    Parameters
    ----------
    path : path-like
    reference_temperature : float
        T_ref [K], where a_T = 1. A table that has another one is taken relative to it, which a note
        says.

    Returns
    -------
    ShiftFactors

    Raises
    ------
    InvalidInput
        Naming file and line.
    """
    file = path_of(path, "path")
    temperature, log10_a_t = _written_by_rubber(file) or _table(file)
    plausible.check("temperature_k", temperature, quantities.TEMPERATURE, path=file)
    order = np.argsort(temperature, kind="stable")
    with reading(file):
        shifts = ShiftFactors(
            reference_temperature=reference_temperature,
            temperature=temperature[order],
            log10_a_T=log10_a_t[order],
        )
    return _relative(file, shifts)


def _relative(file: Path, shifts: ShiftFactors) -> ShiftFactors:
    """The same with a_T = 1 at the reference, which the table may have elsewhere."""
    try:
        off = float(np.log10(shifts.shift_factor(shifts.reference_temperature)))
    except OutOfRange:
        return shifts
    if abs(off) <= _NOT_ONE:
        return shifts
    text = f"log10 a_T is {off:.4g} at the reference temperature, and was taken relative to that"
    plausible.tell_again([Note(text, code="shifts-relative", where=file)])
    return replace(shifts, log10_a_T=shifts.log10_a_T - off)


def _written_by_rubber(file: Path) -> tuple[Column, Column] | None:
    """The isotherms' shifts in a file of `asperity rubber`, CSV or JSON; None of any other."""
    with suppress(
        OSError, InvalidInput, ValueError, KeyError, TypeError, IndexError, StopIteration
    ):
        check_file(file)  # one might wait for a pipe
        if next(text_lines(file)).startswith("{"):
            isotherms = json.loads(file.read_bytes())["inputs"][0]["isotherms"]
            return np.array(isotherms["temperature_k"]), np.array(isotherms["log10_a_t"])
        inputs = inputs_in(file)
        temperature, shift = (inputs[f"isotherms.{key}"] for key in ("temperature_k", "log10_a_t"))
        return np.array(json.loads(temperature)), np.array(json.loads(shift))
    return None


def _table(file: Path) -> tuple[Column, Column]:
    for _, line in read_source(file).lines:
        cells = cells_of(line)
        of_t = [one for one in cells if re.fullmatch(_TEMPERATURE, one, re.IGNORECASE)]
        of_a = [one for one in cells if re.fullmatch(_SHIFT, one, re.IGNORECASE)]
        if of_t and of_a:
            break
    else:
        of_t, of_a = ["temperature_k"], ["log10_a_t"]
    names = {"temperature": of_t[0], "log10_a_T": of_a[0]}
    table = read_columns(file, names, {"temperature": "temperature"})
    temperature, shift = table.values["temperature"], table.values["log10_a_T"]
    unit = table.units.get("temperature") or unit_in("temperature", of_t[0])
    if unit is None and np.min(temperature) >= _COLDEST:
        problem = f"{of_t[0]!r} is in K or C: a line of units below it, or a name such as"
        raise InvalidInput(f"{problem} temperature_k or temperature_c, must say so", where=file)
    if unit not in ("K", "C", None):
        raise InvalidInput(f"{of_t[0]!r} is in {unit}: must be in K or C", where=file)
    if unit != "K":
        temperature = temperature + ZERO_CELSIUS
    named = re.fullmatch(_SHIFT, of_a[0], re.IGNORECASE)
    log = named["log"] if named else "log10"
    if not log and np.all(shift > 0):
        shift = np.log10(shift)
    return temperature, shift / np.log(10) if log and log.lower() == "ln" else shift
