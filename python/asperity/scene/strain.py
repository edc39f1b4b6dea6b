"""The strain of each magnification in a scene: factors of the modulus, or strain sweeps."""

from dataclasses import replace
from pathlib import Path
from typing import Any

from asperity.base.diagnostics import valued
from asperity.io.fields import (
    Field,
    arguments,
    fields_of,
    file_names,
    names_of,
    refuse,
    rename_in_errors,
    require,
    text,
)
from asperity.io.read_dma import read_strain_sweep
from asperity.sweeps import StrainFactors, strain_factors

BY_MAGNIFICATION = "by-magnification"
# what the strain of a file is, and how often the amplitude it holds
KINDS = {"shear": 1, "tension": 1, "peak-to-peak-shear": 2, "peak-to-peak-tension": 2}

_ROWS = fields_of(StrainFactors, "strain", "storage", "loss")
_FILES = {
    f"strain_{key}": one for key, one in fields_of(read_strain_sweep, "columns", "units").items()
}
_PER_SLOPE = fields_of(strain_factors, "strain_per_slope")
_REFERENCE = fields_of(strain_factors, "reference_strain")
STRAIN = {
    "strain": Field(
        text,
        meaning='`"by-magnification"`: the modulus softens with the strain that the roughness of '
        "each magnification brings, by the factors of the keys below "
        "([when](../howto/strain.md))",
    ),
    "strain_kind": Field(
        text,
        meaning='with `strain_sweeps`, what their strain is: `"shear"` or `"tension"` for '
        'amplitudes, `"peak-to-peak-shear"` or `"peak-to-peak-tension"`, which are halved',
    ),
    "strain_sweeps": Field(
        file_names, meaning="files of strain sweeps, instead of rows of factors"
    ),
    **_FILES,
    **_ROWS,
    **_REFERENCE,
    **_PER_SLOPE,
}


def build_strain(path: Path, values: dict[str, Any]) -> StrainFactors | None:
    """The factors of a [rubber] table; none where it asks for no strain."""
    if "strain" not in values:
        for key in STRAIN:
            if key in values:
                refuse(path, f"[rubber] {key}", f'needs strain = "{BY_MAGNIFICATION}"')
        return None
    if (model := values["strain"]) != BY_MAGNIFICATION:
        refuse(path, "[rubber] strain", f'must be "{BY_MAGNIFICATION}"', valued(model, model))
    alternative = f"strain_sweeps, or {', '.join(_ROWS)} instead"
    if "strain_sweeps" not in values:
        for key in (*_FILES, *_REFERENCE, "strain_kind"):
            if key in values:
                refuse(path, f"[rubber] {key}", "needs strain_sweeps, the files that it is of")
        require(path, "rubber", values, tuple(_ROWS), alternative)
        keys = {**_ROWS, **_PER_SLOPE}
        with rename_in_errors(path, names_of("rubber", keys)):
            return StrainFactors(**arguments(values, keys))
    for key in filter(values.__contains__, _ROWS):
        refuse(path, f"[rubber] {key}", "must be left out where strain_sweeps is given")
    require(path, "rubber", values, ("strain_kind", *_FILES), "files do not tell")
    kind = values["strain_kind"]
    if kind not in KINDS:
        names = ", ".join(f'"{name}"' for name in KINDS)
        refuse(path, "[rubber] strain_kind", f"must be one of {names}", valued(kind, kind))
    with rename_in_errors(path, names_of("rubber", {**_FILES, **_REFERENCE, **_PER_SLOPE})):
        sweeps = [
            # E or G: of ratios it does not matter
            read_strain_sweep(path.parent / name, modulus="E", **arguments(values, _FILES))
            for name in values["strain_sweeps"]
        ]
        return strain_factors(
            [replace(sweep, strain=sweep.strain / KINDS[kind]) for sweep in sweeps],
            **arguments(values, {**_REFERENCE, **_PER_SLOPE}),
        )
