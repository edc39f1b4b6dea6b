"""Rubber of a scene: Prony series, master curve, or isotherms with their shift."""

import warnings
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from asperity._core import InvalidInput
from asperity.dma import (
    MasterCurveBuild,
    PronyExtrapolation,
    PronyFit,
    build_master_curve,
    fit_prony,
)
from asperity.io.fields import (
    Field,
    arguments,
    file_name,
    file_names,
    named,
    names_of,
    number,
    numbers,
    read_table,
    refuse,
    require,
    text,
    texts,
    truth,
)
from asperity.io.read_dma import read_isotherms, read_shift_factors
from asperity.io.read_master_curve import read_master_curve
from asperity.rubber import MasterCurve, PronySeries, Rubber
from asperity.shift_factors import ShiftFactors
from asperity.uncertainty.draws import Drawn, Generator, draw_build

Values = dict[str, Any]

_PRONY = {
    "equilibrium_modulus_pa": Field(number, "equilibrium_modulus"),
    "moduli_pa": Field(numbers, "moduli"),
    "relaxation_times_s": Field(numbers, "relaxation_times"),
}
_DMA = {
    "columns": Field(texts, "columns"),
    "units": Field(texts, "units"),
    "modulus": Field(text, "modulus"),
    "poisson_ratio": Field(number, "poisson_ratio"),
    "temperatures": Field(numbers, "temperatures"),
}
_BUILD = {
    "reference_temperature_k": Field(number, "reference_temperature"),
    "vertical_shift": Field(text, "vertical_shift"),
}
_PRONY_FIT = {"prony": Field(truth)}
_TEMPERATURE = {"temperature_k": Field(number, "temperature"), "shift": Field(file_name)}
_RUBBER = {
    **_PRONY,
    "master_curve": Field(file_name),
    "isotherms": Field(file_names),
    **_DMA,
    **_BUILD,
    **_TEMPERATURE,
    **_PRONY_FIT,
    "extrapolation": Field(text, "extrapolation"),
}
# which keys go with which source of the modulus
_WITH = {
    "isotherms": {*_DMA, *_BUILD, *_TEMPERATURE, *_PRONY_FIT, "extrapolation"},
    "master_curve": {*_TEMPERATURE, "reference_temperature_k", "extrapolation"},
    "": {*_PRONY, *_TEMPERATURE, "reference_temperature_k"},
}


@dataclass(frozen=True, eq=False)
class BuiltRubber:
    """The rubber at a scene's temperature."""

    rubber: Rubber
    values: Values  # the table as it was used
    notes: Sequence[str]
    drawn: Drawn[Rubber]  # as its standard errors would have it, where they are known


def build_rubber(path: Path, table: object) -> BuiltRubber:
    """The rubber of a scene's table."""
    values = read_table(path, "rubber", table, _RUBBER)
    source = next((key for key in ("isotherms", "master_curve") if key in values), "")
    for key in values:
        if key != source and key not in _WITH[source]:
            given = f"{source} is given" if source else "neither isotherms nor master_curve is"
            refuse(path, f"[rubber] {key}", f"must be left out where {given}")
    if source == "isotherms":
        return _from_isotherms(path, values)
    rubber: Rubber
    if source == "master_curve":
        with named(path, {"extrapolation": "[rubber] extrapolation"}):
            file = path.parent / values["master_curve"]
            rubber = read_master_curve(file, values.get("extrapolation"))
    else:
        alternatives = (
            "give isotherms, master_curve, or equilibrium_modulus_pa, moduli_pa and "
            "relaxation_times_s"
        )
        require(path, "rubber", values, tuple(_PRONY), alternatives)
        with named(path, names_of("rubber", _PRONY)):
            rubber = PronySeries(**arguments(values, _PRONY))
    shifts = _shift_table(path, values)
    if shifts is None:
        for key in ("temperature_k", "reference_temperature_k"):
            if key in values:
                refuse(path, f"[rubber] {key}", "needs shift, a file of shift factors")
        return _without_errors(rubber, values)
    require(path, "rubber", values, ("temperature_k",), "at which the rubber is wanted")
    return _without_errors(rubber.shifted(_shift_factor(path, shifts, values)), values)


def _without_errors(rubber: Rubber, values: Values) -> BuiltRubber:
    return BuiltRubber(rubber, values, (), Drawn[Rubber](rubber))


def _from_isotherms(path: Path, values: Values) -> BuiltRubber:
    require(path, "rubber", values, ("columns", "units", "modulus"), "isotherms declare them")
    require(path, "rubber", values, ("temperature_k",), "at which the rubber is wanted")
    values = {"reference_temperature_k": values["temperature_k"], **values}
    extrapolation, fitted = values.get("extrapolation"), values.get("prony", False)
    if extrapolation is not None and fitted != (extrapolation == "prony"):
        allowed = 'must be "prony" or left out' if fitted else '"prony" needs prony = true'
        refuse(path, f"[rubber] extrapolation = {extrapolation}", allowed)
    files = [path.parent / name for name in values["isotherms"]]
    with named(path, names_of("rubber", _DMA)):
        isotherms = read_isotherms(files, **arguments(values, _DMA))
    with named(path, {**names_of("rubber", {**_BUILD, **_RUBBER}), "isotherms": "isotherms"}):
        build = build_master_curve(
            isotherms,
            **arguments(values, _BUILD),
            shift_factors=_shift_table(path, values),
            smooth=True,
            extrapolation=None if fitted else extrapolation,
        )
    rubber, notes = _at_temperature(path, values, build, extrapolation)

    def draw(rng: Generator) -> Rubber:  # its shifts move the ends of what was measured
        return _at_temperature(path, values, draw_build(build, rng), "prony")[0]

    return BuiltRubber(rubber, values, [*build.notes, *notes], Drawn[Rubber](rubber, draw))


def _at_temperature(
    path: Path, values: Values, build: MasterCurveBuild, beyond: str | None
) -> tuple[Rubber, Sequence[str]]:
    """The master curve, or the Prony series through it, as it is at the scene's temperature."""
    curve = build.master_curve.shifted(_shift_factor(path, build, values))
    if values.get("vertical_shift") == "T/T_ref":
        curve = _stiffer(curve, values["temperature_k"] / values["reference_temperature_k"])
    if not values.get("prony", False):
        return curve, ()
    with named(path, {"residual": "[rubber] prony"}):
        series = quiet_prony(curve, "prony" if beyond == "prony" else None)
    return series, series.notes


def _stiffer(curve: MasterCurve, b_t: float) -> MasterCurve:
    """E(w; T) = b_T E(a_T w; T_ref) beyond its horizontal shift."""
    return MasterCurve(
        angular_frequency=curve.angular_frequency,
        storage_modulus=b_t * curve.storage_modulus,
        loss_modulus=b_t * curve.loss_modulus,
        extrapolation=curve.extrapolation,
    )


def _shift_table(path: Path, values: Values) -> ShiftFactors | None:
    if "shift" not in values:
        return None
    require(path, "rubber", values, ("reference_temperature_k",), "at which a_T is 1")
    reference = values["reference_temperature_k"]
    with named(path, names_of("rubber", _BUILD)):
        file = path.parent / values["shift"]
        return read_shift_factors(file, reference_temperature=reference)


def _shift_factor(path: Path, shifts: ShiftFactors | MasterCurveBuild, values: Values) -> float:
    """a_T at the scene's temperature."""
    if values["temperature_k"] == values.get("reference_temperature_k"):
        return 1.0
    with named(path, names_of("rubber", _TEMPERATURE)):
        a_t = float(shifts.shift_factor(values["temperature_k"]))
        if not 0 < a_t < float("inf"):
            raise InvalidInput(f"temperature = {values['temperature_k']}: a_T = {a_t}")
        return a_t


def quiet_prony(
    curve: MasterCurve | MasterCurveBuild, extrapolation: PronyExtrapolation | None = None
) -> PronyFit:
    """A Prony fit whose warning is left to the reader of its notes."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", UserWarning)
        return fit_prony(curve, extrapolation=extrapolation)
