"""Contacts that were solved by boundary elements, and the file of those that are shipped."""

import csv
import math
from collections.abc import Mapping
from dataclasses import dataclass
from importlib.resources import as_file, files
from pathlib import Path

from asperity.base.arguments import brief, reading
from asperity.base.diagnostics import Argument, InvalidInput, must_be, must_have, refusal
from asperity.io.files import check_file
from asperity.io.read_surface import cell
from asperity.spectrum import SelfAffineSpectrum, Spectrum

_NUMBERS = (
    *("H", "q0", "q1", "h_rms", "rms_slope", "z_max", "z_min"),
    *("peak_mean_lambda0", "peak_mean_half_lambda0", "E_star", "p"),
    *("A_over_A0_corrected", "elastic_energy_per_A0"),
)


@dataclass(frozen=True)
class Contact:
    """One load on one map: an elastic solid without friction or adhesion, exact but for the grid.

    Area is free of the perimeter's excess. Peaks are the mean heights of greedy maxima no closer
    than lambda0 = 2 pi / q0 and lambda0 / 2.
    """

    case: str
    spectrum: Spectrum  # of the map's own rms slope
    hurst: float | None  # None of a measured surface
    q0: float | None  # [1/m] of the macro-asperities; None where nobody said
    rms_height: float  # [m]
    z_max: float  # [m]
    z_min: float  # [m]
    peaks: Mapping[str, float]  # mean heights [m], by "lambda0" and "lambda0/2"
    effective_modulus: float  # E* [Pa]
    pressure: float  # [Pa]
    area: float  # A/A0
    energy: float  # elastic, per A0 [J/m^2]

    @property
    def load(self) -> float:
        """p / (E* h')."""
        return self.pressure / (self.effective_modulus * self.spectrum.rms_slope)

    @property
    def band(self) -> float:
        """q1 / q0, rounded to what it was meant to be."""
        return round(self.spectrum.q1 / self.spectrum.q0, 1)


def shipped() -> list[Contact]:
    """The 177 contacts that corrections are measured on: see bem_area.csv."""
    with as_file(files("asperity_scripts.validate") / "bem_area.csv") as path:
        return read_contacts(path)


def read_contacts(path: Path) -> list[Contact]:
    """Contacts of random-phase self-affine maps from a CSV file with a header.

    Raises
    ------
    InvalidInput
        In one line: file, line, column, the value found and what is allowed.
    """
    try:
        with reading(path):
            check_file(path)
            reader = csv.DictReader(path.read_text(encoding="utf-8").splitlines(keepends=True))
            names = reader.fieldnames or ()
            missing = [name for name in ("case", *_NUMBERS) if name not in names]
            if missing:
                there = brief(",".join(names))
                raise InvalidInput(f"header {there} has no column {', '.join(missing)}")
            contacts = [_contact(reader.line_num, row) for row in reader]
    except (UnicodeDecodeError, csv.Error) as error:
        kind = "is not text: " if isinstance(error, UnicodeDecodeError) else ""
        raise InvalidInput(f"{kind}{error}", where=path) from error
    if not contacts:
        raise must_have("", "1 or more", "has 0 rows", where=path)
    return contacts


def _contact(line: int, row: Mapping[str, str | None]) -> Contact:
    try:
        values = {name: _value(name, row[name]) for name in _NUMBERS}
        if values["A_over_A0_corrected"] > 1:
            raise must_be("", "at most 1", f"A_over_A0_corrected = {row['A_over_A0_corrected']}")
        for name in ("peak_mean_lambda0", "peak_mean_half_lambda0"):
            if values[name] >= values["z_max"]:
                raise refusal(name, row[name], f"below z_max = {row['z_max']}", text=f"{row[name]}")
        spectrum = SelfAffineSpectrum(
            rms_height=values["h_rms"], hurst=values["H"], q0=values["q0"], q1=values["q1"]
        )
    except InvalidInput as error:
        raise error.within(f"line {line}: ") from error
    return Contact(
        case=str(row["case"]),
        # a map has a few per cent less slope than the continuous spectrum
        spectrum=spectrum.scaled((values["rms_slope"] / spectrum.rms_slope) ** 2),
        hurst=values["H"],
        q0=values["q0"],
        rms_height=values["h_rms"],
        z_max=values["z_max"],
        z_min=values["z_min"],
        peaks={
            "lambda0": values["peak_mean_lambda0"],
            "lambda0/2": values["peak_mean_half_lambda0"],
        },
        effective_modulus=values["E_star"],
        pressure=values["p"],
        area=values["A_over_A0_corrected"],
        energy=values["elastic_energy_per_A0"],
    )


def _value(name: str, text: str | None) -> float:
    try:
        value = cell(text or "")
    except ValueError as error:
        raise InvalidInput(Argument(name), f": {error}") from error
    sign, allowed = (-1, "negative") if name == "z_min" else (1, "positive")
    if not math.isfinite(value) or sign * value <= 0:
        raise refusal(name, text or "nothing", f"{allowed} and finite", text=f"{text or 'nothing'}")
    return value
