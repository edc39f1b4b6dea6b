"""DMA sweeps from files: columns and units as declared, nothing guessed."""

import os
from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path
from typing import Any, Literal

import numpy as np
from numpy.typing import NDArray

from asperity._core import InvalidInput
from asperity.base import quantities
from asperity.base.arguments import brief as shown
from asperity.base.arguments import choice, path_of, vector
from asperity.base.arguments import number as real
from asperity.base.celsius import ZERO_CELSIUS
from asperity.base.diagnostics import MUST_BE, Argument, Must, refusal
from asperity.io import plausible
from asperity.io.column_names import Lines, cells_of, find_header, numbered_lines, separator_of
from asperity.io.instrument import brief
from asperity.shift_factors import ShiftFactors
from asperity.sweeps import Isotherm, StrainSweep

Paths = str | os.PathLike[str] | Iterable[str | os.PathLike[str]]
Column = NDArray[np.float64]

_UNITS = {
    "frequency": {"Hz": 2 * np.pi, "rad/s": 1.0},
    "modulus": {"Pa": 1.0, "kPa": 1e3, "MPa": 1e6, "GPa": 1e9},
    "temperature": {"K": 1.0, "C": 1.0},
    "strain": {"1": 1.0, "%": 0.01},
}
_KINDS = {"storage": "modulus", "loss": "modulus"}  # columns whose unit has another name
_STEP = 1.0  # K: sweeps nearer to each other in temperature are one isotherm
_MOST_UNIT_LINES = 2  # between the names of the columns and the first numbers


def read_isotherms(
    paths: Paths,
    *,
    columns: Mapping[str, str],
    units: Mapping[str, str],
    modulus: Literal["E", "G"],
    poisson_ratio: float = 0.5,
    temperatures: Sequence[float] | None = None,
) -> list[Isotherm]:
    """Frequency sweeps from text files, one temperature or several in each.

    A line with the names of the columns precedes the numbers; lines before it, lines of units after
    it and lines beginning with ``#`` are passed over. Cells are parted by semicolons, tabs, commas
    or blanks; where they are not parted by commas, a comma is a decimal one. UTF-8 with or without
    byte-order mark, or Latin-1.

    Parameters
    ----------
    paths : path-like or iterable of path-like
    columns : mapping
        Names in the files of "frequency", "storage", "loss" and "temperature"; not the last where
        `temperatures` are given.
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
        In rising temperature [K]; rows within 1 K are one isotherm at their mean.

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
    factor = _young(modulus, poisson_ratio)
    wanted = ("frequency", "storage", "loss", "temperature")
    result = []
    for path, table in _tables(paths, columns, units, wanted, factor, temperatures):
        order = np.argsort(table["temperature"], kind="stable")
        steps = np.flatnonzero(np.diff(table["temperature"][order]) > _STEP) + 1
        for rows in np.split(order, steps):
            rows = np.sort(rows)
            try:
                isotherm = Isotherm(
                    temperature=_mean(table["temperature"][rows]),
                    angular_frequency=table["frequency"][rows],
                    storage_modulus=factor * table["storage"][rows],
                    loss_modulus=factor * table["loss"][rows],
                )
            except InvalidInput as error:
                first, last = int(table["line"][rows[0]]), int(table["line"][rows[-1]])
                lines = f"isotherm in lines {first} to {last}: "
                raise error.within(lines).within(path) from error
            result.append(isotherm)
    return sorted(result, key=lambda isotherm: isotherm.temperature)


def _mean(values: NDArray[np.float64]) -> float:
    """Of numbers that are all the same, that number to its last digit: who types it is inside."""
    return float(values[0] + np.mean(values - values[0]))


def read_strain_sweep(
    path: str | os.PathLike[str],
    *,
    columns: Mapping[str, str],
    units: Mapping[str, str],
    modulus: Literal["E", "G"],
    poisson_ratio: float = 0.5,
) -> StrainSweep:
    """One sweep of strain from a text file, at the mean of its temperatures and frequencies.

    Arguments and errors are those of `read_isotherms`, with one `path` and a column and a unit ("1"
    or "%") of "strain" [-] besides.
    """
    path = path_of(path, "path")
    factor = _young(modulus, poisson_ratio)
    wanted = ("strain", "frequency", "storage", "loss", "temperature")
    ((file, table),) = _tables(path, columns, units, wanted, factor)
    order = np.argsort(table["strain"], kind="stable")
    try:
        return StrainSweep(
            temperature=_mean(table["temperature"]),
            angular_frequency=_mean(table["frequency"]),
            strain=table["strain"][order],
            storage_modulus=factor * table["storage"][order],
            loss_modulus=factor * table["loss"][order],
        )
    except InvalidInput as error:
        raise error.within(file) from error


def read_shift_factors(
    path: str | os.PathLike[str], *, reference_temperature: float
) -> ShiftFactors:
    """Shift factors over temperature [K] from a CSV file with columns temperature_k, log10_a_t.

    Parameters
    ----------
    path : path-like
    reference_temperature : float
        T_ref [K], where a_T = 1.

    Returns
    -------
    ShiftFactors

    Raises
    ------
    InvalidInput
        Naming file and line.
    """
    columns = {"temperature": "temperature_k", "log10_a_T": "log10_a_t"}
    file = path_of(path, "path")
    table = _table(file, columns)
    plausible.check("temperature_k", table["temperature"], quantities.TEMPERATURE, path=file)
    order = np.argsort(table["temperature"], kind="stable")
    try:
        return ShiftFactors(
            reference_temperature=reference_temperature,
            temperature=table["temperature"][order],
            log10_a_T=table["log10_a_T"][order],
        )
    except InvalidInput as error:
        raise error.within(file) from error


def _young(modulus: str, poisson_ratio: float) -> float:
    shear = choice(modulus, "modulus", ("E", "G")) == 1
    ratio = real(poisson_ratio, "poisson_ratio")
    if not 0 <= ratio <= 0.5:
        raise refusal("poisson_ratio", ratio, "in [0, 0.5]", text=f"{ratio!r}")
    return 2 * (1 + ratio) if shear else 1.0


def _tables(
    paths: Paths,
    columns: Mapping[str, str],
    units: Mapping[str, str],
    wanted: Iterable[str],
    factor: float,
    temperatures: Sequence[float] | None = None,
) -> list[tuple[Path, dict[str, Column]]]:
    """The wanted columns of each file in SI units, and the numbers of their lines.

    `factor` makes Young's moduli of the file's.
    """
    wanted = tuple(wanted)
    for name, given in (("columns", columns), ("units", units)):
        if not isinstance(given, Mapping) or not all(isinstance(x, str) for x in given.values()):
            raise refusal(name, given, "a dict of str")
        known = set(wanted) if name == "columns" else {_KINDS.get(w, w) for w in wanted}
        if name == "columns" and temperatures is not None:
            known.discard("temperature")
        for key in given:
            if key not in known:
                allowed = ", ".join(sorted(known))
                raise InvalidInput(
                    Argument(name),
                    f": {shown(key)} is unknown",
                    Must(", must be "),
                    f"of {allowed}",
                )
        for key in sorted(known):
            if key not in given:
                raise InvalidInput(Argument(name), f": {key!r} is missing")
    for key, unit in units.items():
        if unit not in _UNITS[key]:
            allowed = ", ".join(_UNITS[key])
            raise InvalidInput(
                Argument("units"), f": {key} = {shown(unit)}", MUST_BE, f"one of {allowed}"
            )
    one: Any = paths
    try:
        several = None if isinstance(one, str | os.PathLike) else list(one)
    except TypeError:
        several = None
    if several is None:
        files = [path_of(one, "paths")]
    else:
        files = [path_of(path, f"paths[{i}]") for i, path in enumerate(several)]
    if not files:
        raise InvalidInput(Argument("paths"), ": is empty", Must(", must have "), "1 file or more")
    by_file = None if temperatures is None else vector(temperatures, "temperatures")
    if by_file is not None and by_file.size != len(files):
        raise InvalidInput(
            Argument("temperatures"),
            f" ({by_file.size}) and ",
            Argument("paths"),
            f" ({len(files)}) must have equal length",
        )
    result = []
    for at, file in enumerate(files):
        table = _table(file, columns)
        if by_file is not None:
            table["temperature"] = np.full(table["line"].size, by_file[at])
        for name in wanted:
            if name != "temperature" and not np.all(table[name] > 0):
                row = int(np.argmin(table[name] > 0))
                problem = f"{name} = {table[name][row]:g}: must be positive"
                raise InvalidInput(f"line {table['line'][row]:.0f}: {problem}", where=file)
            kind = _KINDS.get(name, name)
            table[name] = table[name] * _UNITS[kind][units[kind]]
        _check_units(file, table, units, factor)
        if units["temperature"] == "C":
            table["temperature"] = table["temperature"] + ZERO_CELSIUS
        result.append((file, table))
    return result


def _check_units(
    file: Path, table: Mapping[str, Column], units: Mapping[str, str], factor: float
) -> None:
    """Refuse what the declared units make absurd; temperatures are still in theirs."""
    unit = units["temperature"]
    plausible.check("temperature", table["temperature"], quantities.TEMPERATURE, unit, path=file)
    _check(file, "frequency", table["frequency"], quantities.FREQUENCY, units)
    if "strain" in table:
        _check(file, "strain", table["strain"], quantities.STRAIN, units)
    largest = factor * np.max(np.hypot(table["storage"], table["loss"]))
    _check(file, "modulus", largest, quantities.MODULUS, units)


def _check(
    file: Path, kind: str, si: Any, quantity: quantities.Quantity, units: Mapping[str, str]
) -> None:
    named = "largest |E|" if kind == "modulus" else kind
    declared = si / _UNITS[kind][units[kind]]
    plausible.check(named, declared, quantity, units[kind], path=file)


def _table(path: Path, columns: Mapping[str, str]) -> dict[str, Column]:
    """Columns by our names, as numbers; "line" has the numbers of their lines."""
    numbered = numbered_lines(path)
    for at, (_, line) in enumerate(numbered):
        separator, names = separator_of(line), cells_of(line)
        if all(column in names for column in columns.values()):
            places = {ours: names.index(theirs) for ours, theirs in columns.items()}
            most = len(names) if separator == "," else None
            return _numbers(path, numbered[at + 1 :], places, separator, most)
    missing = [c for c in columns.values() if not any(c in line for _, line in numbered)]
    named = ", ".join(map(repr, missing or columns.values()))
    raise InvalidInput(f"no line names the columns {named}{_names_there(numbered)}", where=path)


def _names_there(numbered: Lines) -> str:
    """The columns that a file has, for a message."""
    header = find_header(numbered)
    if header is None:
        return ""
    words = [name for name in header.names if any(one.isalpha() for one in name)]
    return f"; line {header.number} has {brief(', '.join(map(repr, words)))}"


def _numbers(
    path: Path,
    rows: list[tuple[int, str]],
    places: Mapping[str, int],
    separator: str | None,
    most: int | None,
) -> dict[str, Column]:
    """The columns at `places` of rows with at most so many cells.

    Decimal commas between commas make more: their numbers would be others.
    """
    table: dict[str, list[float]] = {name: [] for name in (*places, "line")}
    skipped = 0
    for number, line in rows:
        # names parted by tabs may stand over numbers parted by blanks
        cells = line.split(separator if separator != "\t" or separator in line else None)
        if most is not None and any(cell.strip() for cell in cells[most:]):
            problem = f"has {len(cells)} cells, the names {most}: numbers have a decimal point"
            raise InvalidInput(f"line {number} {problem}", where=path)
        values: dict[str, Any] = {"line": number}
        for name, place in places.items():
            if place >= len(cells):
                problem = f"has {len(cells)} cells, must have {place + 1} or more ({name})"
                raise InvalidInput(f"line {number} {problem}", where=path)
            cell = cells[place].strip()
            if separator != ",":
                cell = cell.replace(",", ".")
            try:
                values[name] = float(cell.replace("_", "?"))
            except ValueError:
                values[name] = brief(cell)
        wrong = {name: value for name, value in values.items() if isinstance(value, str)}
        if len(wrong) == len(places) and not table["line"] and skipped < _MOST_UNIT_LINES:
            skipped += 1  # units
            continue
        for name, value in wrong.items():
            raise InvalidInput(f"line {number}: {name} = {value!r} is not a number", where=path)
        for name, value in values.items():
            if not np.isfinite(value):
                raise InvalidInput(
                    f"line {number}: {name} = {value}", MUST_BE, "finite", where=path
                )
            table[name].append(value)
    if not table["line"]:
        raise InvalidInput("no numbers below the names of the columns", where=path)
    return {name: np.array(values) for name, values in table.items()}
