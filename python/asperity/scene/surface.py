"""Surface of a scene: a self-affine spectrum, or what a scan gives."""

import math
from collections.abc import Callable, Iterator, Sequence
from contextlib import suppress
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import Any

from asperity import _core
from asperity.base import quantities
from asperity.base.diagnostics import Argument, Error, InvalidInput, Note, OutOfRange, valued
from asperity.io import plausible
from asperity.io.fields import (
    Field,
    arguments,
    defaults_of,
    fields_of,
    file_or_files,
    number,
    pixel_size,
    rename_in_errors,
    text,
    truth,
)
from asperity.io.instrument import scans_of_container
from asperity.io.read_surface import read_surface
from asperity.measured_spectrum import merge_spectra, power_spectrum
from asperity.scene.scan import (
    LAY,
    Lay,
    Scan,
    lay_of,
    line_notes,
    noise_floor,
    noise_notes,
    read_filled,
    scan_notes,
    surface_spectrum,
)
from asperity.scene.section import Section, Values
from asperity.self_affine_fit import SelfAffineFit, fit_self_affine
from asperity.spectrum import SelfAffineSpectrum, Spectrum, TabulatedSpectrum
from asperity.surface import HeightMap
from asperity.uncertainty.draws import Drawn, Generator, draw_fit, drawn_spectrum

Read = Callable[[Section, bool], tuple[list[Scan], Values]]

_SELF_AFFINE = fields_of(SelfAffineSpectrum, "rms_height", "hurst", "rolloff", "axis_ratio", "lay")
_BAND = fields_of(SelfAffineSpectrum, "q0", "q1")
_CUTOFFS = {
    "contamination_size_m": Field(
        number,
        "size",
        quantities.PARTICLE,
        meaning="ends it at 2 pi / size; the smaller of the two cut-offs holds",
    ),
    "slope_cutoff": Field(
        number, "slope", meaning="ends it where the rms slope reaches this, 1.3 by the rule"
    ),
}
_READ = {
    **fields_of(read_surface, "channel"),
    "pixel_size_m": Field(pixel_size, "pixel_size", quantities.SPACING),
    **fields_of(read_surface, "unit"),
    "max_dropouts": fields_of(HeightMap.fill_dropouts, "max_fraction")["max_fraction"],
}
READ = ("file", *_READ)  # the keys that say which heights
_TRANSFORM = fields_of(power_spectrum, "window", "detrend")
_MERGED = 10.0  # bins a decade of the spectrum of several scans
_FINEST = 1e11  # [1/m], beyond the distance of atoms
_NARROWEST = 1.05  # q1 / q0 that a cut-off may leave
_FIT = {
    "fit": Field(
        text,
        meaning='"self-affine": the fitted law instead of the measured rows, on `q0_per_m` to '
        "`q1_per_m`, which may go on beyond what the scan resolves",
    )
}
_DIRECTIONAL = {
    "directional": Field(
        truth,
        "directional",
        meaning="true: the directions of its roughness are kept, for `direction_deg` and the force "
        "across ([direction](../explanation/direction.md)); not of a line scan, nor with `fit`",
    )
}
_FILE = {
    "file": Field(
        file_or_files,
        meaning="the scan, or a list of scans whose spectra are merged in ten bins a decade",
    )
}
SCAN = {**_FILE, **_READ, **_TRANSFORM, **_FIT, **_DIRECTIONAL}
ENDS = {**_BAND, **_CUTOFFS}
SURFACE = {**SCAN, **_SELF_AFFINE, **ENDS}


@dataclass(frozen=True, eq=False)
class Surface:
    """What a scene's surface turned out to be."""

    spectrum: Spectrum
    scan: Scan | None  # it was measured on, where that is one
    values: Values  # the table with its defaults
    derived: Values
    notes: Sequence[Note]
    drawn: Drawn[Spectrum]  # as its standard errors would have it, where they are known
    fit: SelfAffineFit | None = None  # to the scan's spectrum, where the scene asks for one
    lay: Lay | None = None  # of the scan
    fitted_heights: Sequence[Note] = ()  # on the scan's heights, which a fit does not carry


def build_surface(path: Path, table: object, read: Read | None = None) -> Surface:
    """The surface of a scene's table. `read` takes the place of `read_scans` for who keeps what it
    read."""
    section = Section.read(path, "surface", table, SURFACE)
    derived: Values = {}
    scan = fit = floor = lay = None
    of_heights: Sequence[Note] = ()
    if "file" in section.values:
        section.leave_out(_SELF_AFFINE, "file is given")
        every = "channel" not in section.values
        defaults = {**defaults_of(_READ), **defaults_of(_TRANSFORM)}
        section = section.replace_values({**defaults, **section.values})
        scans, facts = (read or read_scans)(section, every)
        derived |= facts
        measured, fit, floor = _measure(section, scans)
        scan = scans[0] if len(scans) == 1 else None
        spectrum: Spectrum = measured
        if fit is not None:  # which may go on beyond what the scan resolves
            spectrum = section.call(fit.spectrum.extended, _BAND)
    else:
        section.leave_out((*_READ, *_TRANSFORM, *_FIT, *_DIRECTIONAL), "no file is given")
        needed = ("rms_height_m", "hurst", "q0_per_m", "q1_per_m")
        section.require(*needed, hint="give file, or " + ", ".join(needed))
        spectrum = section.call(SelfAffineSpectrum, {**_SELF_AFFINE, **_BAND})
    values = section.values
    law = spectrum if isinstance(spectrum, SelfAffineSpectrum) else None
    if isinstance(spectrum, TabulatedSpectrum) and "slope_cutoff" in values:
        with suppress(Error):
            law = fit_self_affine(spectrum).spectrum
    spectrum = _cut(section, spectrum)
    plausible.check("[surface] rms slope", spectrum.rms_slope, quantities.SLOPE, path=path)
    if scan is not None:  # what a law is given by has been checked
        plausible.check(
            "[surface] rms height", spectrum.rms_height, quantities.RMS_HEIGHT, path=path
        )
        plausible.check("[surface] q0", spectrum.q0, quantities.FIRST_WAVENUMBER, path=path)
    derived |= {
        "q0_per_m": spectrum.q0,
        "q1_per_m": spectrum.q1,
        "rms_height_m": spectrum.rms_height,
        "rms_slope": spectrum.rms_slope,
    }
    notes = _slope_notes(spectrum, values, table, law)
    if scan is not None:
        directional = spectrum.is_directional
        lay = lay_of(scan, spectrum, **_transform(values))
        notes += scan_notes(scan, lay, directional=directional)
        if lay is not None and lay.ratio > LAY:
            derived |= {"slope_anisotropy": lay.ratio, "lay_deg": lay.degrees}
        if isinstance(scan, HeightMap):
            notes += line_notes(measured, spectrum.q1 if "slope_cutoff" in values else None)
        notes += noise_notes(floor, spectrum)
    drawn = drawn_spectrum(spectrum)
    if fit is not None:
        derived |= {"hurst": fit.hurst, "hurst_standard_error": fit.standard_errors["hurst"]}
        notes += _fit_notes(fit, spectrum)
        of_heights = _core.notes_on_heights(measured._core)
        draw = partial(_draw_fit, fit, spectrum.q0, spectrum.q1)
        drawn = Drawn[Spectrum](spectrum, draw, source=fit)
    return Surface(spectrum, scan, values, derived, notes, drawn, fit, lay, of_heights)


def read_scans(section: Section, every: bool) -> tuple[list[Scan], Values]:
    """The scans without drop-outs; trends are still in them. Of an archive all or one."""
    values, folder = section.values, section.path.parent
    named = values["file"] if isinstance(values["file"], list) else [values["file"]]
    facts: dict[str, list[Any]] = {"shape": [], "pixel_size_m": [], "dropout_fraction": []}
    scans = []
    for file, channel in _channels(folder, named, values["channel"], every):
        one = section.replace_values({**values, "channel": channel})
        raw, filled = one.call(read_filled, _READ, file)
        scans.append(filled)
        facts["shape"].append(list(raw.heights.shape))
        pixel = list(raw.pixel_size) if isinstance(raw, HeightMap) else raw.spacing
        facts["pixel_size_m"].append(pixel)
        facts["dropout_fraction"].append(raw.dropout_fraction)
    return scans, {key: of[0] if len(of) == 1 else of for key, of in facts.items()}


def _channels(
    folder: Path, named: Sequence[str], channel: int, every: bool
) -> Iterator[tuple[Path, int]]:
    for file in (folder / name for name in named):
        if every and file.suffix.lower() == ".zip" and file.is_file():
            with rename_in_errors(file, {}):
                yield from ((file, at) for at in range(len(scans_of_container(file))))
        else:
            yield file, channel


def _transform(values: Values) -> dict[str, Any]:
    settings = arguments(values, _TRANSFORM)
    if settings["detrend"] == "none":
        settings["detrend"] = None
    return settings


def _measure(
    section: Section, scans: Sequence[Scan]
) -> tuple[TabulatedSpectrum, SelfAffineFit | None, float | None]:
    """The scans' spectrum, the self-affine fit to it where the scene asks for one, and where the
    noise of the instrument begins in it, if it shows in that of one map."""
    values = section.values
    wanted = values.get("fit")
    if wanted not in (None, "self-affine"):
        section.refuse("fit", 'must be "self-affine", or left out', valued(wanted))
    directional = values.get("directional", False)
    if directional and (wanted is not None or len(scans) > 1):
        section.leave_out(("directional",), "fit or several scans are given: they are means")
    with section.naming({**_TRANSFORM, **_BAND, **_DIRECTIONAL}):
        how = {**_transform(values), "directional": directional}
        spectra = [surface_spectrum(scan, **how) for scan in scans]
        spectrum = spectra[0]
        if len(scans) > 1:
            whole = [one.truncated(q1=one.q1) for one in spectra]
            spectrum = merge_spectra(whole, per_decade=_MERGED)
        if wanted is not None:
            return spectrum, _fitted(spectrum), None
        try:
            of_map = len(scans) == 1 and isinstance(scans[0], HeightMap)
            floor = noise_floor(spectrum) if of_map else None
            return spectrum.truncated(**arguments(values, _BAND)), None, floor
        except OutOfRange as error:
            raise error.followed_by('; fit = "self-affine" goes on beyond it') from error


def _fitted(spectrum: TabulatedSpectrum) -> SelfAffineFit:
    try:
        return fit_self_affine(spectrum)
    except InvalidInput as error:
        raise error.followed_by("; without fit the measured rows are taken as they are") from error


def _draw_fit(fit: SelfAffineFit, q0: float, q1: float, rng: Generator) -> Spectrum:
    return draw_fit(fit, rng, q1).extended(q0=q0, q1=q1)


def _fit_notes(fit: SelfAffineFit, spectrum: Spectrum) -> list[Note]:
    beyond = [
        f"{side} {q:.4g} 1/m"
        for side, q, outside in (
            ("below", fit.q0, spectrum.q0 < fit.q0 * (1 - 1e-9)),
            ("above", fit.q1, spectrum.q1 > fit.q1 * (1 + 1e-9)),
        )
        if outside
    ]
    if not beyond:
        return []
    where = " and ".join(beyond)
    text = f"the spectrum {where} is the fitted law gone on with, beyond the reliable rows"
    return [Note(text, code="law-beyond-rows")]


def _slope_notes(
    spectrum: Spectrum, values: Values, typed: Any, law: SelfAffineSpectrum | None
) -> list[Note]:
    """A note where the spectrum ends before the slope that was to end it, with what serves; `law`
    is the one that it may go on by."""
    wanted = values.get("slope_cutoff")
    if wanted is None or "contamination_size_m" in values:
        return []
    if spectrum.rms_slope >= wanted * (1 - 1e-9):
        return []
    problem = (
        f" is not reached: the rms slope up to {spectrum.q1:.4g} 1/m is {spectrum.rms_slope:.3g}"
    )
    value = valued(wanted, f"{typed['slope_cutoff']}")
    step = "leave slope_cutoff out and take mu as that of the waves that are measured, the least"
    with suppress(Error):
        whole = None if law is None else law.extended(q1=_FINEST)
        end = None if whole is None else whole.cutoff_for_slope(wanted)
        if end is not None and end < _FINEST * (1 - 1e-9):
            by_law = f"q1_per_m = {end:.3g}"
            if "file" in values and "fit" not in values:
                by_law = f'fit = "self-affine" with {by_law}, beyond what was measured'
            step += f"; or {by_law}; or measure with pixels of {math.pi / end:.2g} m"
    about = Argument("slope_cutoff"), " = ", value, problem
    return [Note(*about, code="slope-not-reached", next_step=step)]


def _cut(section: Section, spectrum: Spectrum) -> Spectrum:
    """The spectrum up to the smaller of the cut-offs that are named."""
    values = section.values
    rules: dict[str, Callable[[float], float]] = {
        "contamination_size_m": spectrum.cutoff_for_contamination,
        "slope_cutoff": spectrum.cutoff_for_slope,
    }
    with section.naming(_CUTOFFS):
        cutoffs = {key: rule(values[key]) for key, rule in rules.items() if key in values}
    if not cutoffs:
        return spectrum
    key = min(cutoffs, key=cutoffs.__getitem__)
    if cutoffs[key] < _NARROWEST * spectrum.q0:
        place = f"{cutoffs[key]:.4g} 1/m, where the spectrum begins at {spectrum.q0:.4g}"
        problem = f"must leave a band, cuts at {place}: are the heights in another unit?"
        section.refuse(key, problem, valued(values[key]))
    with rename_in_errors(section.path, {"q1": f"[surface] {key} = {values[key]}: q1"}):
        return spectrum.truncated(q1=cutoffs[key])
