"""What the verbs of the shell command do."""

import importlib.util
import sys
from argparse import Namespace
from collections.abc import Callable, Iterable, Sequence
from pathlib import Path
from typing import Any

import numpy as np

from asperity import plot
from asperity._core import InvalidInput, fit_self_affine, power_spectrum
from asperity.demo import write_inputs
from asperity.fields import named
from asperity.read import read_filled
from asperity.scene import COLUMNS, Curves, Scene, load_scene
from asperity.table import Table, check_output, terminal_table, write_files


def demo(args: Namespace) -> None:
    """Write the shipped scan and scene, compute and draw them, show the curve."""
    directory = Path(args.output)
    scene = load_scene(write_inputs(directory))
    table, curves = _friction_table([scene])
    files = {directory / "friction.csv": table.csv().encode()}
    picture = directory / "friction.png"
    missing = importlib.util.find_spec("matplotlib") is None
    if not missing:
        files[picture] = plot.friction_figure([scene], curves, picture)
    write_files(files)
    shown = ("velocity_m_s", "mu", "hysteresis", "adhesion", "contact_area")
    print(terminal_table({name: table.columns[name] for name in shown}))
    _print_notes(table.notes)
    band = "{q0_per_m:.4g} to {q1_per_m:.4g} 1/m, rms slope {rms_slope:.3g}".format(**scene.derived)
    print(f"surface: {band}, as measured: nothing is extrapolated")
    print(f"scene:   {scene.path}")
    print(f"table:   {directory / 'friction.csv'}")
    print("picture: " + ("none, pip install asperity[plot]" if missing else str(picture)))


def friction(args: Namespace) -> None:
    """Friction of one scene, or of several under one another."""
    outputs = _check_outputs(args)
    scenes = [load_scene(name) for name in args.scene]
    _spare(outputs, [source for scene in scenes for source in scene.sources])
    table, curves = _friction_table(scenes)
    _deliver(args, table, lambda path: plot.friction_figure(scenes, curves, path))


def _friction_table(scenes: Sequence[Scene]) -> tuple[Table, list[Curves]]:
    curves = [scene.friction(_progress(str(scene.path))) for scene in scenes]
    columns: dict[str, list[Any]] = {}
    for scene, result in zip(scenes, curves, strict=True):
        pressure, velocity = np.meshgrid(scene.pressure, scene.velocity, indexing="ij")
        names = {"scene": [str(scene.path)] * pressure.size} if len(scenes) > 1 else {}
        points = {"pressure_pa": pressure.ravel(), "velocity_m_s": velocity.ravel()}
        values = {name: getattr(result, name).ravel() for name in COLUMNS}
        for name, column in {**names, **points, **values}.items():
            columns.setdefault(name, []).extend(column)
    several = len(scenes) > 1
    notes = [
        f"{scene.path}: {note}" if several else note
        for scene, result in zip(scenes, curves, strict=True)
        for note in result.notes
    ]
    return Table("friction", [_inputs(scene) for scene in scenes], notes, columns), curves


def _progress(title: str) -> Callable[[list[Any]], Iterable[Any]]:
    """A bar on a terminal, after two seconds of work, where tqdm is installed."""
    if not sys.stderr.isatty() or importlib.util.find_spec("tqdm") is None:
        return iter
    tqdm = importlib.import_module("tqdm").tqdm
    return lambda chunks: tqdm(chunks, desc=title, delay=2, leave=False)


def area(args: Namespace) -> None:
    """A/A0 of a scene at every pressure, velocity and wavenumber."""
    outputs = _check_outputs(args)
    scene = load_scene(args.scene)
    _spare(outputs, scene.sources)
    wavenumber = np.geomspace(scene.spectrum.q0, scene.spectrum.q1, args.points)
    values = scene.contact_area(wavenumber)
    grid = np.meshgrid(scene.pressure, scene.velocity, wavenumber, indexing="ij")
    names = ("pressure_pa", "velocity_m_s", "wavenumber_per_m", "contact_area")
    columns = {n: v.ravel().tolist() for n, v in zip(names, (*grid, values), strict=True)}
    table = Table("area", [{**_inputs(scene), "points": args.points}], [], columns)
    _deliver(args, table, lambda picture: plot.area_figure(scene, wavenumber, values, picture))


def spectrum(args: Namespace) -> None:
    """Spectrum of a scan; its moments and fit go to the terminal and into the header."""
    path = Path(args.file)
    _spare(_check_outputs(args), [path])
    with named(None, {"pixel_size": "--pixel-size", "unit": "--unit", "channel": "--channel"}):
        raw, surface = read_filled(
            path, channel=args.channel, pixel_size=args.pixel_size, unit=args.unit
        )
    detrend = None if args.detrend == "none" else args.detrend
    with named(path, {"q_min": "--q-min", "q_max": "--q-max"}):
        measured = power_spectrum(surface, window=args.window, detrend=detrend)
        fit = fit_self_affine(measured, q_min=args.q_min, q_max=args.q_max)
    cutoff = measured.cutoff_for_slope(1.3)
    inputs: dict[str, Any] = {
        "file": str(path),
        "channel": args.channel,
        "shape": list(raw.heights.shape),
        "pixel_size_m": list(raw.pixel_size),
        "dropout_fraction": raw.dropout_fraction,
        "window": args.window,
        "detrend": args.detrend,
    }
    for key, given in (("unit", args.unit), ("q_min", args.q_min), ("q_max", args.q_max)):
        if given is not None:
            inputs[key] = given
    found = {
        "rms_height_m": measured.rms_height,
        "rms_slope": measured.rms_slope,
        "slope_cutoff_1.3_per_m": cutoff,
        "fit_q0_per_m": fit.q0,
        "fit_q1_per_m": fit.q1,
        "fit_hurst": fit.hurst,
        "fit_hurst_standard_error": fit.standard_errors["hurst"],
        "fit_rms_height_m": fit.rms_height,
        "fit_rms_height_standard_error_m": fit.standard_errors["rms_height"],
    }
    count = np.zeros(0) if measured.count is None else measured.count
    columns = {
        "wavenumber_per_m": measured.wavenumber.tolist(),
        "density_m4": measured.density.tolist(),
        "count": [round(modes) for modes in count.tolist()],
    }
    for name, value in found.items():
        print(f"{name} = {value:.6g}", file=sys.stderr)
    if cutoff >= measured.q1:
        print("note: the rms slope stays below 1.3 on the whole spectrum", file=sys.stderr)
    table = Table("spectrum", [{**inputs, "found": found}], [], columns)
    _deliver(args, table, lambda picture: plot.spectrum_figure(measured, fit, cutoff, picture))


def _inputs(scene: Scene) -> dict[str, Any]:
    return {"scene": str(scene.path), **scene.inputs, "derived": scene.derived}


def _check_outputs(args: Namespace) -> list[Path]:
    if args.plot is not None:
        plot.check_plot(Path(args.plot))
    outputs = [Path(name) for name in (args.output, args.plot) if name is not None]
    for path in outputs:
        check_output(path)
    if len({path.resolve() for path in outputs}) < len(outputs):
        raise InvalidInput(f"{outputs[0]}: --output and --plot must be two files")
    return outputs


def _spare(outputs: Sequence[Path], inputs: Sequence[Path]) -> None:
    taken = {path.resolve() for path in inputs}
    for path in outputs:
        if path.resolve() in taken:
            raise InvalidInput(f"{path}: is an input: choose another name for the output")


def _deliver(args: Namespace, table: Table, draw: Callable[[Path], bytes]) -> None:
    text = table.json() if args.json else table.csv()
    files = {} if args.plot is None else {Path(args.plot): draw(Path(args.plot))}
    if args.output is not None:
        files[Path(args.output)] = text.encode()
    write_files(files)
    _print_notes(table.notes)
    if args.output is None:
        sys.stdout.write(text)
        sys.stdout.flush()


def _print_notes(notes: Sequence[str]) -> None:
    for note in notes:
        print("note:", note, file=sys.stderr)
