"""Correction and adhesion of a scene, each built from its table."""

from collections.abc import Mapping
from pathlib import Path
from typing import Any

from asperity.adhesion import Adhesion
from asperity.correction import (
    AffineShift,
    Correction,
    GreenwoodWilliamson,
    LocalPeaks,
    NayakSFactor,
    PartialContact,
    PeaksThenGreenwoodWilliamson,
    ScanContact,
    SFactor,
)
from asperity.heating import Heating
from asperity.io import plausible
from asperity.io.fields import (
    Field,
    arguments,
    names_of,
    nearest,
    number,
    numbers,
    read_table,
    refuse,
    rename_in_errors,
    require,
    text,
    text_or_true,
)
from asperity.scene.scan import Scan
from asperity.spectrum import SelfAffineSpectrum, Spectrum
from asperity.surface import HeightMap, LineScan

Values = dict[str, Any]
_KIND = {"kind": Field(text)}
_PEAKS = {
    **_KIND,
    "heights_m": Field(numbers, "heights_or_map", plausible.HEIGHT),
    "min_distance_m": Field(number, "min_distance", plausible.SPACING),
    "z_max_m": Field(number, "z_max", plausible.HEIGHT),
}
_ASPERITIES = {
    **_PEAKS,
    "z_min_m": Field(number, "z_min", plausible.HEIGHT),
    "reading": Field(text, "reading"),
    "rms_height_m": Field(number, "rms_height", plausible.RMS_HEIGHT),
    "q0_per_m": Field(number, "q0", plausible.FIRST_WAVENUMBER),
}
CORRECTIONS = {
    "s-factor": {**_KIND, "gamma": Field(number, "gamma"), "applies_to": Field(text, "applies_to")},
    "nayak-s-factor": {**_KIND, "friction_gamma": Field(number, "friction_gamma")},
    "partial-contact": _KIND,
    "affine-shift": {**_KIND, "p": Field(number, "p")},
    "local-peaks": _PEAKS,
    "greenwood-williamson": _ASPERITIES,
    "peaks-then-greenwood-williamson": _ASPERITIES,
    "scan-contact": {
        **_KIND,
        "tolerance": Field(number, "tolerance"),
        "periodic": Field(text_or_true, "periodic"),
    },
}
ADHESION = {
    "shear_stress_pa": Field(number, "shear_stress", plausible.SHEAR_STRESS),
    "reference_velocity_m_s": Field(number, "reference_velocity", plausible.VELOCITY),
    "width": Field(number, "width"),
}


HEATING = {
    "density_kg_m3": Field(number, "density"),
    "heat_capacity_j_kg_k": Field(number, "heat_capacity"),
    "conductivity_w_m_k": Field(number, "conductivity"),
    "contact_diameter_m": Field(number, "contact_diameter", plausible.SPACING),
    "macro_wavenumber_per_m": Field(number, "macro_wavenumber", plausible.WAVENUMBER),
    "macro_area": Field(number, "macro_area"),
    "residence": Field(text, "residence"),
    "interface_share": Field(number, "interface_share"),
    "model": Field(text, "model"),
}
HEATING_NAMES = names_of("heating", HEATING)


def build_heating(path: Path, table: object) -> tuple[Heating, Values]:
    values = read_table(path, "heating", table, HEATING)
    needed = tuple(HEATING)[:4]
    require(path, "heating", values, needed, "[heating] needs " + ", ".join(needed))
    with rename_in_errors(path, HEATING_NAMES):
        heating = Heating(**arguments(values, HEATING))
    return heating, _with_defaults(values, HEATING, heating)


def build_adhesion(path: Path, table: object) -> tuple[Adhesion, Values]:
    values = read_table(path, "adhesion", table, ADHESION)
    require(path, "adhesion", values, ("shear_stress_pa",))
    with rename_in_errors(path, names_of("adhesion", ADHESION)):
        adhesion = Adhesion(**arguments(values, ADHESION))
    return adhesion, _with_defaults(values, ADHESION, adhesion)


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
        refuse(path, f"[correction] kind = {kind!r}", known)
    fields = CORRECTIONS[kind]
    values = read_table(path, "correction", table, fields)
    if "z_max_m" in fields:
        values = _with_map(path, kind, values, surface, surface_values)
    if kind == "affine-shift":
        require(path, "correction", values, ("p",))
    settings = arguments(values, fields)
    settings.pop("min_distance", None)
    correction: Correction
    with rename_in_errors(
        path, {**names_of("correction", fields), "peaks": "[correction] heights_m"}
    ):
        if kind == "s-factor":
            correction = SFactor(**settings)
        elif kind == "nayak-s-factor":
            correction = NayakSFactor(**settings)
        elif kind == "partial-contact":
            correction = PartialContact()
        elif kind == "scan-contact":
            correction = ScanContact(_map_of(path, surface, surface_values), **settings)
        elif kind == "affine-shift":
            correction = AffineShift(settings["p"])
        elif kind == "greenwood-williamson":
            correction = GreenwoodWilliamson(peaks=settings.pop("heights_or_map", None), **settings)
        else:
            part = LocalPeaks if kind == "local-peaks" else PeaksThenGreenwoodWilliamson
            correction = part(settings.pop("heights_or_map"), **settings)
    if "min_distance_m" in values:
        values["peaks"] = len(values.pop("heights_m"))
    if fields is _ASPERITIES:  # what the core takes from the spectrum
        rolloff = spectrum.rolloff if isinstance(spectrum, SelfAffineSpectrum) else None
        q0 = spectrum.q0 if rolloff is None else rolloff
        values = {"rms_height_m": spectrum.rms_height, "q0_per_m": q0, **values}
    return correction, _with_defaults(values, fields, correction)


def _map_of(path: Path, surface: Scan | None, surface_values: Mapping[str, Any]) -> HeightMap:
    """Return the scan of the scene, without the trend that the scene takes off."""
    if not isinstance(surface, HeightMap):
        refuse(path, "[correction] kind", "scan-contact needs a [surface] file with a map")
    detrended = surface_values["detrend"] == "quadratic"
    return surface.detrend("quadratic") if detrended else surface


def _with_map(
    path: Path,
    kind: str,
    values: Values,
    surface: Scan | None,
    surface_values: Mapping[str, Any],
) -> Values:
    """`values` with what the map can tell of peaks and extremes."""
    values = dict(values)
    gaussian = kind == "greenwood-williamson" and "heights_m" not in values
    if "min_distance_m" in values:
        if "heights_m" in values:
            refuse(path, "[correction] min_distance_m", "must be left out where heights_m is given")
        if surface is None:
            refuse(path, "[correction] min_distance_m", "needs a surface file; give heights_m")
        if isinstance(surface, LineScan):
            problem = "needs a map, whose peaks a line scan misses; give heights_m"
            refuse(path, "[correction] min_distance_m", problem)
    extremes = ("z_max_m",) if kind == "local-peaks" else ("z_max_m", "z_min_m")
    if surface is None:
        needed = extremes if gaussian else ("heights_m", *extremes)
        require(path, "correction", values, needed, "or [surface] needs a file to take it from")
        return values
    if not gaussian and "heights_m" not in values:
        require(path, "correction", values, ("min_distance_m",), "the least distance of two peaks")
    if kind != "local-peaks":
        if "q0_per_m" in surface_values:
            values.setdefault("q0_per_m", surface_values["q0_per_m"])
        require(
            path,
            "correction",
            values,
            ("q0_per_m",),
            "the wavenumber of the macro-asperities, which a scan does not tell",
        )
    if surface_values["detrend"] != "none":
        surface = surface.detrend(surface_values["detrend"])
    if "min_distance_m" in values:
        with rename_in_errors(path, names_of("correction", _PEAKS)):
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
