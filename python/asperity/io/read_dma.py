"""DMA sweeps from files: columns and units as declared, nothing guessed."""

import os
from collections.abc import Mapping, Sequence
from typing import Any, Literal

import numpy as np

from asperity._core import InvalidInput
from asperity.base.arguments import Array, reading
from asperity.io.columns import Columns, Names
from asperity.io.declared import Paths, file_of, files_of, read_declared, young
from asperity.io.ramps import STEP, is_ramp, isotherms_of_ramp, without_other_tests
from asperity.sweeps import Isotherm, StrainSweep


def read_isotherms(
    paths: Paths,
    *,
    columns: Names,
    units: Mapping[str, str],
    modulus: Literal["E", "G"],
    poisson_ratio: float = 0.5,
    temperatures: Sequence[float] | None = None,
) -> list[Isotherm]:
    """Frequency sweeps from tables, one temperature or several in each.

    A line with the names of the columns precedes the numbers, in each block of them where there are
    several; lines before it and lines beginning with ``#`` are passed over. Units that a file
    states below the names or in them must be the declared ones. Cells are parted by tabs,
    semicolons, commas or blanks; where they are not parted by commas, a comma is a decimal one.
    Text is in UTF-8, UTF-16 or Latin-1; workbooks (.xlsx, .xls) are read sheet by sheet.

    Parameters
    ----------
    paths : path-like, DataFrame or xarray.Dataset, or iterable of them
    columns : mapping
        Names in the files of "frequency", "storage", "loss" and "temperature"; not the last where
        `temperatures` are given. Whole numbers are places, counted from 1.
    units : mapping
        "frequency": "Hz" or "rad/s"; "modulus": "Pa", "kPa", "MPa" or "GPa"; "temperature": "K" or
        "C". All are required.
    modulus : {"E", "G"}
        Whether the moduli are Young's or those of shear, E = 2 (1 + nu) G.
    poisson_ratio : float
        nu [-], for "G".
    temperatures : sequence of float, optional
        One for each file, in the unit of "temperature", where the files have no column of it.

    Returns
    -------
    list of Isotherm
        In rising temperature [K]; rows within 1 K are one isotherm at their mean. Of a temperature
        ramp at two frequencies or more they are at temperatures 1 K apart, or as far as measured:
        ln E' and ln E'' are interpolated over T at each frequency, and between fewer than four
        frequencies over ln w.

    Raises
    ------
    InvalidInput
        Naming file and line.

    Examples
    --------
    >>> columns = {"frequency": "f", "temperature": "T", "storage": "G'", "loss": 'G"'}
    >>> units = {"frequency": "Hz", "temperature": "C", "modulus": "MPa"}
    >>> read_isotherms("dma.csv", columns=columns, units=units, modulus="G")  # doctest: +SKIP
    """
    factor = young(modulus, poisson_ratio)
    wanted = ("frequency", "storage", "loss", "temperature")
    result = []
    for table in read_declared(files_of(paths), columns, units, wanted, factor, temperatures):
        table = without_other_tests(table)
        if is_ramp(table):
            result += isotherms_of_ramp(table)
            continue
        temperature = table.values["temperature"]
        order = np.argsort(temperature, kind="stable")
        steps = np.flatnonzero(np.diff(temperature[order]) > STEP) + 1
        result += [_isotherm(table.taken(np.sort(rows))) for rows in np.split(order, steps)]
    return sorted(result, key=lambda isotherm: isotherm.temperature)


def _isotherm(table: Columns) -> Isotherm:
    values = table.values
    try:
        return Isotherm(
            temperature=_mean(values["temperature"]),
            angular_frequency=values["frequency"],
            storage_modulus=values["storage"],
            loss_modulus=values["loss"],
        )
    except InvalidInput as error:
        raise error.within(f"isotherm in {table.span()}: ").within(table.path) from error


def _mean(values: Array) -> float:
    """Of numbers that are all the same, that number to its last digit: who types it is inside."""
    return float(values[0] + np.mean(values - values[0]))


def read_strain_sweep(
    path: str | os.PathLike[str] | Any,
    *,
    columns: Names,
    units: Mapping[str, str],
    modulus: Literal["E", "G"],
    poisson_ratio: float = 0.5,
) -> StrainSweep:
    """One sweep of strain from a text file, at the mean of its temperatures and frequencies.

    Arguments and errors are those of `read_isotherms`, with one `path` and a column and a unit ("1"
    or "%") of "strain" [-] besides.
    """
    file = file_of(path, "path")
    factor = young(modulus, poisson_ratio)
    wanted = ("strain", "frequency", "storage", "loss", "temperature")
    (table,) = read_declared([file], columns, units, wanted, factor)
    values = table.taken(np.argsort(table.values["strain"], kind="stable")).values
    with reading(file):
        return StrainSweep(
            temperature=_mean(values["temperature"]),
            angular_frequency=_mean(values["frequency"]),
            strain=values["strain"],
            storage_modulus=values["storage"],
            loss_modulus=values["loss"],
        )
