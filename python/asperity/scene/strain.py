"""The strain of each magnification in a scene: factors of the modulus, or strain sweeps."""

from dataclasses import replace

from asperity.base.diagnostics import valued
from asperity.io.fields import Field, fields_of, file_names, text
from asperity.io.read_dma import read_strain_sweep
from asperity.scene.section import Section
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


def build_strain(section: Section) -> StrainFactors | None:
    """The factors of a [rubber] table; none where it asks for no strain."""
    values = section.values
    if "strain" not in values:
        section.refuse_each(STRAIN, f'needs strain = "{BY_MAGNIFICATION}"')
        return None
    if (model := values["strain"]) != BY_MAGNIFICATION:
        section.refuse("strain", f'must be "{BY_MAGNIFICATION}"', valued(model, model))
    if "strain_sweeps" not in values:
        of_files = (*_FILES, *_REFERENCE, "strain_kind")
        section.refuse_each(of_files, "needs strain_sweeps, the files that it is of")
        section.require(*_ROWS, hint=f"strain_sweeps, or {', '.join(_ROWS)} instead")
        return section.call(StrainFactors, {**_ROWS, **_PER_SLOPE})
    section.leave_out(_ROWS, "strain_sweeps is given")
    section.require("strain_kind", *_FILES, hint="files do not tell")
    kind = values["strain_kind"]
    if kind not in KINDS:
        names = ", ".join(f'"{name}"' for name in KINDS)
        section.refuse("strain_kind", f"must be one of {names}", valued(kind, kind))
    sweeps = [  # E or G: of ratios it does not matter
        section.call(read_strain_sweep, _FILES, section.path.parent / name, modulus="E")
        for name in values["strain_sweeps"]
    ]
    halved = [replace(one, strain=one.strain / KINDS[kind]) for one in sweeps]
    return section.call(strain_factors, {**_REFERENCE, **_PER_SLOPE}, halved)
