"""The verb `spectrum`: of a scan in memory, or of a map by tiles."""

import math
from argparse import Namespace
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np

from asperity.base import quantities
from asperity.base.arguments import FilePath
from asperity.base.diagnostics import MUST_BE, Argument, InvalidInput, NotConverged, Note, valued
from asperity.base.iso_25178 import height_parameters
from asperity.cli.friction_commands import check_outputs, write_outputs
from asperity.cli.options import flags, goes_with, typed_options
from asperity.io import plausible
from asperity.io.fields import rename_in_errors
from asperity.io.files import refuse_overwrite
from asperity.io.open_map import open_map
from asperity.io.table import Table, columns_of
from asperity.measured_spectrum import power_spectrum
from asperity.plot import surface as plot_surface
from asperity.scene import scan
from asperity.scene.scan import Scan, read_filled, surface_spectrum
from asperity.self_affine_fit import SelfAffineFit, fit_self_affine
from asperity.spectrum import TabulatedSpectrum
from asperity.surface import HeightMap, LineScan
from asperity.tiles.coarse import middle_tile, thinned
from asperity.tiles.statistics import HeightStatistics, height_statistics

_FLAGS = flags("pixel_size", "unit", "channel")
_TILED = flags("tiles", "overlap", "threads", "max_dropouts", "window")


@dataclass(frozen=True)
class Measured:
    """What a file gave: its spectrum, statistics of its heights without their trend, pictures."""

    spectrum: TabulatedSpectrum
    statistics: Scan | HeightStatistics
    inputs: dict[str, Any]
    lay: scan.Lay | None
    notes: list[Note]
    raw: Scan  # of a map by tiles, both thinned out
    flat: Scan


def spectrum(args: Namespace) -> None:
    """Spectrum of a scan; its moments and fit go to the terminal and into the header."""
    path = FilePath(args.file)
    refuse_overwrite(check_outputs(args), [path])
    with plausible.collected(typed_options(args)) as unusual:
        for flag, q in (("--q-min", args.q_min), ("--q-max", args.q_max)):
            if q is not None:
                plausible.check(flag, q, quantities.WAVENUMBER)
        result = _in_memory(path, args) if args.tiles is None else _by_tiles(path, args)
        measured = result.spectrum
        plausible.check("rms slope", measured.rms_slope, quantities.SLOPE, path=path)
    fit, fit_notes = _fit(measured, args)
    cutoff: float | None = measured.cutoff_for_slope(1.3)
    if cutoff is not None and cutoff >= measured.q1:
        cutoff = None
    inputs = {"file": str(path), "channel": args.channel, **result.inputs}
    options = {name: getattr(args, name) for name in ("unit", "q_min", "q_max")}
    inputs |= {name: one for name, one in options.items() if one is not None}
    of, of_map = result.statistics, isinstance(result.flat, HeightMap)
    numbers: dict[str, float | None] = {
        "rms_height_m": measured.rms_height,
        "rms_slope": measured.rms_slope,
        "rms_slope_by_differences": of.rms_slope,
        "skewness": of.skewness,
        "kurtosis": of.kurtosis,
        "z_max_m": of.z_max,
        "z_min_m": of.z_min,
        "slope_cutoff_1.3_per_m": cutoff,
    }
    if of_map:
        numbers |= _iso_25178(of)
    if result.lay is not None:
        numbers["slope_anisotropy"] = result.lay.ratio
        if result.lay.ratio > scan.LAY:
            numbers["lay_deg"] = result.lay.degrees
    if (band := scan.trusted(measured)) is not None:
        numbers |= {"reliable_from_per_m": band[0], "reliable_to_per_m": band[1]}
    if fit is not None:
        numbers |= _fitted(fit)
    floor = scan.noise_floor(measured) if of_map else None
    if floor is not None:
        numbers["noise_from_per_m"] = floor
    notes = [*unusual, *fit_notes, *result.notes]
    if of_map:
        notes += scan.line_notes(measured, cutoff)
    if cutoff is None:
        text = (
            "slope_cutoff = 1.3 ends nothing here: the rms slope up to pi / pixel, "
            f"{measured.q1:.4g} 1/m, is {measured.rms_slope:.3g}"
        )
        notes.append(Note(text, code="no-cutoff"))
    notes += scan.noise_notes(floor, measured)
    notes.append(Note(_serves(measured, band, floor), code="reliable-band"))
    table = Table("spectrum", [{**inputs, "found": numbers}], notes, _rows(measured))
    whole = measured.truncated(q1=measured.q1)
    drawn = result.raw, result.flat, whole, fit, cutoff, floor, result.lay
    write_outputs(args, table, partial(plot_surface.spectrum_figure, *drawn), numbers)


def _iso_25178(of: Any) -> dict[str, float]:
    """By their names and units; of a map by tiles those that its statistics have."""
    if isinstance(of, HeightMap):
        known = of.iso_25178
    else:
        heights = of.rms_height, of.skewness, of.kurtosis, of.z_max, of.z_min
        known = height_parameters(*heights, of.rms_slope)
    units = dict.fromkeys(("Sq", "Sa", "Sp", "Sv", "Sz"), "_m") | {"Spd": "_per_m2"}
    return {f"{name}{units.get(name, '')}": value for name, value in known.items()}


def _serves(measured: TabulatedSpectrum, band: Sequence[float] | None, floor: float | None) -> str:
    """Whether the scan serves, and from where to where."""
    if band is None:
        return "this scan does not serve: no row of its spectrum is reliable, take a larger one"
    first, last = band[0], min(band[1], floor or math.inf)
    if last <= first:
        return "this scan does not serve: where its spectrum is reliable noise is all that it shows"
    whole = measured.rms_slope or 1.0
    share = (measured.truncated(q0=first, q1=last).rms_slope / whole) ** 2
    above = 1 - (measured.truncated(q1=last).rms_slope / whole) ** 2
    text = (
        f"this scan serves from {first:.3g} to {last:.3g} 1/m, {math.log10(last / first):.2g} "
        f"decades with {100 * share:.0f} % of the mean square slope"
    )
    if share >= 0.5:
        return text
    finer = "finer pixels" if last == band[1] else "an instrument of less noise"
    better = "a larger scan" if 1 - share > 2 * above else finer
    return f"{text} only: mu hangs on the rest, for which take {better}"


def _in_memory(path: Path, args: Namespace) -> Measured:
    goes_with(args, "overlap threads", "tiles")
    if path.is_dir():
        raise InvalidInput("is a folder; a Zarr array is read with --tiles 4096", where=path)
    with rename_in_errors(None, {**_FLAGS, "max_fraction": "--max-dropouts"}):
        raw, filled = read_filled(path, max_fraction=args.max_dropouts, **_values(args, _FLAGS))
    how = _transform(args)
    with rename_in_errors(path, {}):
        measured = surface_spectrum(filled, **how)
    lay = scan.lay_of(filled, measured, **how)
    flat = scan.flat(filled, how["detrend"])
    facts = {
        "shape": list(raw.heights.shape),
        "pixel_size_m": raw.spacing if isinstance(raw, LineScan) else list(raw.pixel_size),
        "dropout_fraction": raw.dropout_fraction,
        **_values(args, ("window", "detrend")),
    }
    return Measured(measured, flat, facts, lay, scan.scan_notes(filled, lay), raw, flat)


def _by_tiles(path: Path, args: Namespace) -> Measured:
    """The same of a map that need not fit in memory."""
    how, most = _transform(args), float(args.max_dropouts)
    threads = 1 if args.threads is None else args.threads
    with rename_in_errors(None, _FLAGS):
        source = open_map(path, **_values(args, _FLAGS))
    with rename_in_errors(path, _TILED):
        in_tiles = _values(args, ("tiles", "overlap"))
        measured = power_spectrum(source, **how, **in_tiles, max_dropouts=most, threads=threads)
        statistics = height_statistics(source, detrend=how["detrend"] or "offset", threads=threads)
        raw = thinned(source, threads=threads)
        filled = raw.fill_dropouts(max_fraction=0.999)
        tile = middle_tile(source, args.tiles, most)
    lay = None if tile is None else scan.lay_of(tile, measured, **how)
    notes = [] if tile is None else scan.scan_notes(tile, lay)
    facts = {
        "shape": list(source.shape),
        "pixel_size_m": list(source.pixel_size),
        "dropout_fraction": statistics.dropout_fraction,
        **_values(args, ("window", "detrend")),
        "tiles": args.tiles if isinstance(args.tiles, int) else list(args.tiles),
        "overlap": 0.5 if args.overlap is None else args.overlap,
        "max_dropouts": most,
    }
    notes = [note.followed_by(" (a tile in the middle)") for note in notes]
    flat = scan.flat(filled, how["detrend"])
    return Measured(measured, statistics, facts, lay, notes, raw, flat)


def _values(args: Namespace, names: Iterable[str]) -> dict[str, Any]:
    return {name: getattr(args, name) for name in names}


def _transform(args: Namespace) -> dict[str, Any]:
    return {"window": args.window, "detrend": None if args.detrend == "none" else args.detrend}


def _rows(measured: TabulatedSpectrum) -> dict[str, Any]:
    columns = columns_of(measured)
    if "count" in columns:
        columns["count"] = np.rint(columns["count"]).astype(int)
    order = ("wavenumber_per_m", "density_m4", "standard_error_m4", "count", "flag")
    return {name: columns[name] for name in order if name in columns}


def _fitted(fit: SelfAffineFit) -> dict[str, float]:
    facts = {
        "fit_q0_per_m": fit.q0,
        "fit_q1_per_m": fit.q1,
        "fit_hurst": fit.hurst,
        "fit_hurst_standard_error": fit.standard_errors["hurst"],
        "fit_rms_height_m": fit.rms_height,
        "fit_rms_height_standard_error_m": fit.standard_errors["rms_height"],
        "fit_residual": fit.residual,
    }
    if fit.rolloff is not None:
        facts["fit_rolloff_per_m"] = fit.rolloff
        facts["fit_rolloff_standard_error_per_m"] = fit.standard_errors["rolloff"]
    return facts


def _fit(measured: TabulatedSpectrum, args: Namespace) -> tuple[SelfAffineFit | None, list[Note]]:
    """The self-affine fit, or a note that says why there is none."""
    q_min, q_max = args.q_min, args.q_max
    if q_min is not None and q_max is not None and q_min >= q_max:
        phrase = valued(q_max, f"{q_max}")
        raise InvalidInput(Argument("--q-max"), " ", phrase, MUST_BE, f"above --q-min {q_min}")
    try:
        with rename_in_errors(None, {"q_min": "--q-min", "q_max": "--q-max"}):
            return fit_self_affine(measured, q_min=q_min, q_max=q_max, method=args.method), []
    except (InvalidInput, NotConverged) as error:
        return None, [Note(f"no self-affine fit: {error}", code="no-self-affine-fit")]
