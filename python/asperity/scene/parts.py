"""Correction and adhesion of a scene, each built from its table."""

import re
from collections.abc import Mapping
from pathlib import Path
from typing import Any, TypeVar

from asperity.adhesion import Adhesion
from asperity.base.diagnostics import valued
from asperity.correction import CORRECTIONS as CLASSES
from asperity.correction import Correction
from asperity.heating import Heating
from asperity.io.fields import (
    Field,
    arguments,
    fields_of,
    names_of,
    nearest,
    refuse,
    rename_in_errors,
    required,
    text,
)
from asperity.scene.scan import Scan
from asperity.scene.section import Section, Values
from asperity.spectrum import SelfAffineSpectrum, Spectrum
from asperity.surface import HeightMap, LineScan

_Part = TypeVar("_Part", Adhesion, Heating)


def _kind(correction: type) -> str:
    """The name of a correction in scenes: that of NayakSFactor is "nayak-s-factor"."""
    return re.sub(r"(?<!^)(?=[A-Z])", "-", correction.__name__).lower()


KINDS: dict[str, Any] = {_kind(one): one for one in CLASSES}
CORRECTIONS = {kind: {"kind": Field(text), **fields_of(one)} for kind, one in KINDS.items()}
_PEAKS = CORRECTIONS["local-peaks"]
CORRECTIONS["greenwood-williamson"]["min_distance_m"] = _PEAKS["min_distance_m"]
ADHESION = fields_of(Adhesion)
HEATING = fields_of(Heating)
HEATING_NAMES = names_of("heating", HEATING)


def build_part(path: Path, name: str, table: object, part: type[_Part]) -> tuple[_Part, Values]:
    fields = fields_of(part)
    section = Section.read(path, name, table, fields)
    needed = required(fields)
    section.require(*needed, hint=f"[{name}] needs {', '.join(needed)}" * (len(needed) > 1))
    made = section.call(part, fields)
    return made, _with_defaults(section.values, fields, made)


def build_correction(
    path: Path,
    table: object,
    spectrum: Spectrum,
    surface: Scan | None,
    surface_values: Mapping[str, Any],
) -> tuple[Correction, Values]:
    """Correction of a scene; peaks and extremes not given come from the measured map."""
    if not isinstance(table, dict):
        refuse(path, "[correction]", "must be a table")
    kind = table.get("kind")
    if kind is None:
        refuse(path, "[correction] kind", "missing, " + nearest("", CORRECTIONS))
    if not isinstance(kind, str) or kind not in CORRECTIONS:
        known = f"{nearest(str(kind), CORRECTIONS)}; a scene without [correction] has none"
        refuse(path, "[correction] kind", known, valued(kind))
    fields = CORRECTIONS[kind]
    section = Section.read(path, "correction", table, fields)
    if "z_max_m" in fields:
        section = section.replace_values(_with_map(section, kind, surface, surface_values))
    section.require(*required(fields))
    values = section.values
    settings = arguments(values, fields)
    settings.pop("min_distance", None)  # the peaks are found
    if kind == "scan-contact":
        settings["height_map"] = _map_of(section, surface, surface_values)
    names = {**names_of("correction", fields), "peaks": "[correction] heights_m"}
    with rename_in_errors(path, names):
        correction: Correction = KINDS[kind](**settings)
    if "min_distance_m" in values:
        values["peaks"] = len(values.pop("heights_m"))
    if "rms_height_m" in fields:  # what the core takes from the spectrum
        rolloff = spectrum.rolloff if isinstance(spectrum, SelfAffineSpectrum) else None
        q0 = spectrum.q0 if rolloff is None else rolloff
        values = {"rms_height_m": spectrum.rms_height, "q0_per_m": q0, **values}
    return correction, _with_defaults(values, fields, correction)


def _map_of(section: Section, surface: Scan | None, surface_values: Mapping[str, Any]) -> HeightMap:
    """Return the scan of the scene, without the trend that the scene takes off."""
    if not isinstance(surface, HeightMap):
        section.refuse("kind", "scan-contact needs one [surface] file with a map")
    detrended = surface_values["detrend"] == "quadratic"
    return surface.detrend("quadratic") if detrended else surface


def _with_map(
    section: Section, kind: str, surface: Scan | None, surface_values: Mapping[str, Any]
) -> Values:
    """Values with what the map can tell of peaks and extremes."""
    values = dict(section.values)
    given = "heights_m" in values
    gaussian = kind == "greenwood-williamson" and not given
    if "min_distance_m" in values:
        if given:
            section.leave_out(("min_distance_m",), "heights_m is given")
        if surface is None:
            section.refuse("min_distance_m", "needs a surface file; give heights_m")
        if isinstance(surface, LineScan):
            problem = "needs a map, whose peaks a line scan misses; give heights_m"
            section.refuse("min_distance_m", problem)
    extremes = ("z_max_m",) if kind == "local-peaks" else ("z_max_m", "z_min_m")
    if surface is None:
        needed = extremes if gaussian else ("heights_m", *extremes)
        section.require(*needed, hint="or [surface] needs a file to take it from")
        return values
    if not gaussian and not given:
        section.require("min_distance_m", hint="the least distance of two peaks")
    if kind != "local-peaks":
        if "q0_per_m" in surface_values:
            values.setdefault("q0_per_m", surface_values["q0_per_m"])
        hint = "the wavenumber of the macro-asperities, which a scan does not tell"
        section.replace_values(values).require("q0_per_m", hint=hint)
    if surface_values["detrend"] != "none":
        surface = surface.detrend(surface_values["detrend"])
    if "min_distance_m" in values:
        with section.naming(_PEAKS):
            peaks = surface.local_peaks(min_distance=values["min_distance_m"])
        values["heights_m"] = peaks.tolist()
    for key in extremes:
        values.setdefault(key, surface.z_max if key == "z_max_m" else surface.z_min)
    return values


def _with_defaults(values: Values, fields: Mapping[str, Field], part: object) -> Values:
    """`values` and the arguments that `part` took by default."""
    missing = {key: field.argument for key, field in fields.items() if key not in values}
    defaults = {key: getattr(part, name, None) for key, name in missing.items() if name}
    plain = {k: v for k, v in defaults.items() if isinstance(v, int | float | str)}
    return {**values, **plain}
