"""Shift factors of a scene's rubber: from a file, or by the constants of a law."""

from asperity.base.diagnostics import unfit
from asperity.dma import MasterCurveBuild
from asperity.io.fields import (
    Field,
    fields_of,
    file_name,
    kelvin_or_celsius,
    number,
    one_temperature,
    text,
)
from asperity.io.read_shift_factors import read_shift_factors
from asperity.scene.section import Section
from asperity.shift_factors import WLF, ShiftFactors

REFERENCE = kelvin_or_celsius(
    number,
    "reference_temperature",
    "at which the master curve is built, with isotherms that at which the rubber is wanted "
    "unless given; with `shift` and `wlf_c1` required: that of the modulus given",
)
BUILD = {**REFERENCE, "vertical_shift": Field(text, "vertical_shift")}
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
_AT_ONE = "or reference_temperature_c, at which a_T is 1"


def shift_of(section: Section) -> ShiftFactors | WLF | None:
    constants = [key for key in WLF_KEYS if key in section.values]
    if not constants:
        return shift_table(section)
    if "shift" in section.values:
        section.leave_out(constants, "shift is given")
    section.require(*WLF_KEYS, hint="the law of a_T has two constants")
    section.require("reference_temperature_k", hint=_AT_ONE)
    return section.call(WLF, {**WLF_KEYS, **REFERENCE})


def shift_table(section: Section) -> ShiftFactors | None:
    if "shift" not in section.values:
        return None
    section.require("reference_temperature_k", hint=_AT_ONE)
    file = section.path.parent / section.values["shift"]
    return section.call(read_shift_factors, REFERENCE, file)


def shift_factor(section: Section, shifts: ShiftFactors | MasterCurveBuild | WLF) -> float:
    at = section.values["temperature_k"]
    if at == section.values.get("reference_temperature_k"):
        return 1.0
    with section.naming(TEMPERATURE):
        if isinstance(shifts, WLF):
            a_t = float(10 ** shifts.log10_a_T(at))
        else:
            a_t = float(shifts.shift_factor(at))
        if not 0 < a_t < float("inf"):
            raise unfit("temperature", at, f"a_T = {a_t}", f"{at}")
        return a_t
