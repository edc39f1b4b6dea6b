"""Rubber of a scene: Prony series, master curve, or isotherms with their shift."""

import warnings
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, replace
from functools import partial
from pathlib import Path

from asperity.base import quantities
from asperity.base.diagnostics import InvalidInput, Note, OutOfRange, valued
from asperity.base.quantities import ZERO_CELSIUS
from asperity.dma import MasterCurveBuild, build_master_curve
from asperity.io import plausible
from asperity.io.fields import (
    Field,
    arguments,
    fields_of,
    file_name,
    file_names,
    in_keys,
    names_of,
    rename_in_errors,
    text,
    truth,
)
from asperity.io.read_dma import read_isotherms
from asperity.io.read_master_curve import read_master_curve
from asperity.prony_fit import PronyExtrapolation, PronyFit, fit_prony
from asperity.rubber import MasterCurve, PronySeries, Rubber
from asperity.scene.section import Section, Values
from asperity.scene.shift import (
    BUILD,
    REFERENCE,
    TEMPERATURE,
    WLF_KEYS,
    shift_factor,
    shift_of,
    shift_table,
)
from asperity.scene.strain import STRAIN, build_strain
from asperity.shift_factors import TemperatureShift
from asperity.sweeps import Isotherm, StrainFactors
from asperity.uncertainty.draws import Drawn, Generator, ShiftedRubber, draw_build, drawn_rubber

Measured = Callable[[Section], tuple[list[Isotherm], MasterCurveBuild]]

_ADD = "add temperature_k or temperature_c, at which the rubber is wanted"

_PRONY = fields_of(PronySeries)
_TABLE = fields_of(read_isotherms, "columns", "units", "modulus", "poisson_ratio")
_DMA = {**_TABLE, **fields_of(read_isotherms, "temperatures")}
_PRONY_FIT = {
    "prony": Field(
        truth,
        meaning="true: the Prony series through the isotherms, known on the measured frequencies",
    )
}
_EXTRAPOLATION = {
    "extrapolation": Field(
        text,
        "extrapolation",
        meaning='of a master curve "power-law" or "clamp", a decade at each end; of '
        '`prony = true` "prony"',
    )
}
RUBBER = {
    **_PRONY,
    "master_curve": Field(
        file_name,
        meaning="a table of text or a workbook (.xlsx, .xls): with [these columns](csv.md), or "
        "with those that `columns`, `units` and `modulus` say; rows at temperatures of their own "
        "(a ramp) where `columns` has one of `temperature`",
    ),
    "isotherms": Field(
        file_names, meaning="list of files; `*` and `?` stand for parts of their names"
    ),
    **_DMA,
    **BUILD,
    **TEMPERATURE,
    **WLF_KEYS,
    **_PRONY_FIT,
    **_EXTRAPOLATION,
    **STRAIN,
}
# which keys go with which source of the modulus
_WITH = {
    "isotherms": {*_DMA, *BUILD, *TEMPERATURE, *_PRONY_FIT, "extrapolation"},
    "master_curve": {*_TABLE, *TEMPERATURE, *REFERENCE, *WLF_KEYS, "extrapolation"},
    "": {*_PRONY, *TEMPERATURE, *REFERENCE, *WLF_KEYS},
}
# what results state where these keys are left out
_STATED: dict[str, Values] = {
    "isotherms": {"prony": False, "extrapolation": "none"},
    "master_curve": {"extrapolation": "none"},
    "": {},
}


@dataclass(frozen=True, eq=False)
class BuiltRubber:
    """The rubber at a scene's temperature."""

    rubber: Rubber
    values: Values  # the table as it was used
    drawn: Drawn[ShiftedRubber]  # as its standard errors would have it, where they are known
    shift: TemperatureShift | None = None  # a_T(T), and the rubber at its reference
    at_reference: Rubber | None = None
    temperature: float | None = None  # [K], at which the rubber is wanted
    drawn_at_reference: Drawn[ShiftedRubber] | None = None  # with its shift
    isotherms: Sequence[Isotherm] = ()  # as they were read, and what was made of them
    build: MasterCurveBuild | None = None
    strain_factors: StrainFactors | None = None  # of the strain of each magnification

    @property
    def notes(self) -> tuple[Note, ...]:
        of_strain = () if self.strain_factors is None else self.strain_factors.notes
        return (*self.rubber.notes, *of_strain)


def build_rubber(
    path: Path, table: object, temperature: float | None = None, measured: Measured | None = None
) -> BuiltRubber:
    """The rubber of a scene's table; `temperature` [K] is that of its conditions. `measured` takes
    the place of `build_measured` for who keeps what it built."""
    section = Section.read(path, "rubber", table, RUBBER)
    source = next((key for key in ("isotherms", "master_curve") if key in section.values), "")
    foreign = [key for key in section.values if key not in {source, *_WITH[source], *STRAIN}]
    context = f"{source} is given" if source else "neither isotherms nor master_curve is"
    section.leave_out(foreign, context)
    factors = build_strain(section)
    named = {}
    if temperature is not None:
        section.leave_out(("temperature_k", "temperature_c"), "[conditions] has a temperature")
        named = {"[rubber] temperature_k": "[conditions] temperature_k"}  # the table that has it
    with rename_in_errors(None, named):
        values = _in_kelvin(section)
        if temperature is not None:
            values["temperature_k"] = temperature
        built = _build(section.replace_values(values), source, measured or build_measured)
    used = {**_STATED[source], **built.values}
    if temperature is not None:
        del used["temperature_k"]
    temperature = values.get("temperature_k")
    return replace(built, values=used, temperature=temperature, strain_factors=factors)


def _build(section: Section, source: str, measure: Measured) -> BuiltRubber:
    if source == "isotherms":
        return _from_isotherms(section, measure)
    values = section.values
    rubber: Rubber
    shifts = shift_of(section)
    if source == "master_curve":
        ramp = "temperature" in values.get("columns", {})
        file = section.path.parent / values["master_curve"]
        rubber = section.call(
            read_master_curve, {**_TABLE, **_EXTRAPOLATION}, file, shift=shifts if ramp else None
        )
    else:
        alternatives = (
            "give isotherms, master_curve, or equilibrium_modulus_pa, moduli_pa and "
            "relaxation_times_s"
        )
        section.require(*_PRONY, hint=alternatives)
        rubber = section.call(PronySeries, _PRONY)
        where = "[rubber] equilibrium_modulus_pa and moduli_pa together"
        plausible.check(where, rubber._stiffest, quantities.MODULUS, path=section.path)
    if shifts is None:
        problem = "needs shift, a file of shift factors, or wlf_c1 and wlf_c2_k"
        section.refuse_each(("temperature_k", "reference_temperature_k"), problem)
        return BuiltRubber(rubber, values, Drawn(ShiftedRubber(rubber)))
    known = "shift holds a_T of several" if "shift" in values else "the law gives a_T at any"
    section.require("temperature_k", hint=f"{_ADD}: {known}")
    shifted = rubber.shifted(shift_factor(section, shifts))
    made = BuiltRubber(shifted, values, Drawn(ShiftedRubber(shifted)), shifts, rubber)
    return replace(made, drawn_at_reference=drawn_rubber(rubber, shifts))


def _in_kelvin(section: Section) -> Values:
    """Values with temperatures in K, whichever of the two units they were given in."""
    kelvin = dict(section.values)
    for name in ("temperature", "reference_temperature"):
        if f"{name}_c" in kelvin:
            if f"{name}_k" in kelvin:
                section.leave_out((f"{name}_c",), f"{name}_k is given")
            kelvin[f"{name}_k"] = kelvin.pop(f"{name}_c") + ZERO_CELSIUS
    return kelvin


@contextmanager
def _naming_temperature(values: Values) -> Iterator[None]:
    """Let errors on the reference name the temperature that it was taken from, and say what serves
    beyond the isotherms."""
    try:
        yield
    except (InvalidInput, OutOfRange) as error:
        named = {"[rubber] reference_temperature_k": "[rubber] temperature_k"}
        if "reference_temperature_k" not in values:
            error = error.said(partial(in_keys, names=named))
        if isinstance(error, OutOfRange) and "shift" not in values:
            error = error.followed_by(
                "; beyond them a scene needs their master curve, wlf_c1 and wlf_c2_k, which "
                "asperity rubber gives"
            )
        raise error from error.__cause__


def build_measured(section: Section) -> tuple[list[Isotherm], MasterCurveBuild]:
    """Isotherms and the master curve of them, whatever temperature the rubber is wanted at."""
    values = section.values
    files = [section.path.parent / name for name in values["isotherms"]]
    isotherms = section.call(read_isotherms, _DMA, files)
    names = {**names_of("rubber", {**BUILD, **RUBBER}), "isotherms": "isotherms"}
    with rename_in_errors(section.path, names):
        build = build_master_curve(
            isotherms,
            **arguments(values, BUILD),
            shift_factors=shift_table(section),
            extrapolation=None if values.get("prony", False) else values.get("extrapolation"),
        )
    return isotherms, build


def _from_isotherms(section: Section, measure: Measured) -> BuiltRubber:
    section.require("columns", "units", "modulus", hint="isotherms declare them")
    section.require("temperature_k", hint=f"{_ADD}: isotherms give E at several")
    wanted = section.values["temperature_k"]
    with _naming_temperature(section.values):
        known = section.replace_values({"reference_temperature_k": wanted, **section.values})
        return _at_a_temperature(known, measure)


def _at_a_temperature(section: Section, measure: Measured) -> BuiltRubber:
    values = section.values
    extrapolation, fitted = values.get("extrapolation"), values.get("prony", False)
    if extrapolation is not None and fitted != (extrapolation == "prony"):
        allowed = 'must be "prony" or left out' if fitted else '"prony" needs prony = true'
        section.refuse("extrapolation", allowed, valued(extrapolation, extrapolation))
    at_any = {key: one for key, one in values.items() if key != "temperature_k"}
    isotherms, build = measure(section.replace_values(at_any))
    rubber = _at_temperature(section, build, extrapolation)

    def draw(rng: Generator) -> ShiftedRubber:  # its shifts move the ends of what was measured
        return ShiftedRubber(_at_temperature(section, draw_build(build, rng), "prony"))

    drawn_at = Drawn(ShiftedRubber(rubber), draw)
    made = BuiltRubber(rubber, values, drawn_at, isotherms=isotherms, build=build)
    if values.get("vertical_shift") is not None:  # the model of heat has no b_T
        return made

    at_reference = section.replace_values(
        {**values, "temperature_k": values["reference_temperature_k"]}
    )

    def shifted(build: MasterCurveBuild, beyond: str | None) -> ShiftedRubber:
        return ShiftedRubber(_at_temperature(at_reference, build, beyond), build)

    plain = shifted(build, extrapolation)
    source = None if fitted else build
    drawn = Drawn(plain, lambda rng: shifted(draw_build(build, rng), "prony"), source=source)
    return replace(made, shift=build, at_reference=plain.rubber, drawn_at_reference=drawn)


def _at_temperature(section: Section, build: MasterCurveBuild, beyond: str | None) -> Rubber:
    """The master curve, or the Prony series through it, as it is at the scene's temperature."""
    values = section.values
    curve = build.master_curve.shifted(shift_factor(section, build))
    if values.get("vertical_shift") == "T/T_ref":
        b_t = values["temperature_k"] / values["reference_temperature_k"]
        moduli = {"storage_modulus": curve.storage_modulus, "loss_modulus": curve.loss_modulus}
        curve = replace(curve, **{name: b_t * modulus for name, modulus in moduli.items()})
    if not values.get("prony", False):
        return curve
    with rename_in_errors(section.path, {"residual": "[rubber] prony"}):
        return quiet_prony(curve, "prony" if beyond == "prony" else None)


def quiet_prony(
    curve: MasterCurve | MasterCurveBuild, extrapolation: PronyExtrapolation | None = None
) -> PronyFit:
    """A Prony fit whose warning is left to the reader of its notes."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", UserWarning)
        return fit_prony(curve, extrapolation=extrapolation)
