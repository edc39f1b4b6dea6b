"""Shift factors of a scene's rubber: from a file, or by the constants of a law."""

from pathlib import Path
from typing import Any

from asperity.base.diagnostics import unfit
from asperity.dma import MasterCurveBuild
from asperity.io.fields import (
    Field,
    arguments,
    fields_of,
    file_name,
    kelvin_or_celsius,
    names_of,
    number,
    one_temperature,
    refuse,
    rename_in_errors,
    require,
    text,
)
from asperity.io.read_shift_factors import read_shift_factors
from asperity.shift_factors import WLF, ShiftFactors

Values = dict[str, Any]
BUILD = {
    **kelvin_or_celsius(
        number,
        "reference_temperature",
        "at which the master curve is built, with isotherms that at which the rubber is wanted "
        "unless given; with `shift` and `wlf_c1` required: that of the modulus given",
    ),
    "vertical_shift": Field(text, "vertical_shift"),
}
TEMPERATURE = {
    **kelvin_or_celsius(
        one_temperature,
        "temperature",
        "at which the rubber is wanted: better given in `[conditions]`. Isotherms, `shift` and "
        "`wlf_c1` need it in one of the two tables; in both it is refused",
    ),
    "shift": Field(
        file_name,
        meaning="file of shift factors, [as these](csv.md), with any source; needs "
        "`reference_temperature_c` and a temperature in `[conditions]`",
    ),
}
WLF_KEYS = fields_of(WLF, "c1", "c2")


def shift_of(path: Path, values: Values) -> ShiftFactors | WLF | None:
    """a_T(T), from a file or from the constants of a law."""
    constants = [key for key in WLF_KEYS if key in values]
    if not constants:
        return shift_table(path, values)
    if "shift" in values:
        refuse(path, f"[rubber] {constants[0]}", "must be left out where shift is given")
    require(path, "rubber", values, tuple(WLF_KEYS), "the law of a_T has two constants")
    hint = "or reference_temperature_c, at which a_T is 1"
    require(path, "rubber", values, ("reference_temperature_k",), hint)
    with rename_in_errors(path, names_of("rubber", {**WLF_KEYS, **BUILD})):
        reference = values["reference_temperature_k"]
        return WLF(reference_temperature=reference, **arguments(values, WLF_KEYS))


def shift_table(path: Path, values: Values) -> ShiftFactors | None:
    if "shift" not in values:
        return None
    require(
        path,
        "rubber",
        values,
        ("reference_temperature_k",),
        "or reference_temperature_c, at which a_T is 1",
    )
    reference = values["reference_temperature_k"]
    with rename_in_errors(path, names_of("rubber", BUILD)):
        file = path.parent / values["shift"]
        return read_shift_factors(file, reference_temperature=reference)


def shift_factor(
    path: Path, shifts: ShiftFactors | MasterCurveBuild | WLF, values: Values
) -> float:
    """a_T at the scene's temperature."""
    if values["temperature_k"] == values.get("reference_temperature_k"):
        return 1.0
    with rename_in_errors(path, names_of("rubber", TEMPERATURE)):
        at = values["temperature_k"]
        if isinstance(shifts, WLF):
            a_t = float(10 ** shifts.log10_a_T(at))
        else:
            a_t = float(shifts.shift_factor(at))
        if not 0 < a_t < float("inf"):
            raise unfit(
                "temperature", values["temperature_k"], f"a_T = {a_t}", f"{values['temperature_k']}"
            )
        return a_t
