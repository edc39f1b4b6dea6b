"""What the verbs of the shell command do."""

import importlib.util
import os
import sys
from argparse import Namespace
from collections.abc import Callable, Mapping
from contextlib import nullcontext
from dataclasses import replace
from functools import partial
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

import numpy as np

from asperity.app.serve import serve
from asperity.base.arguments import FilePath
from asperity.base.diagnostics import InvalidInput, must_be
from asperity.base.table import to_install
from asperity.cli.options import goes_with
from asperity.cli.streams import print_stderr, print_stdout, tell_notes
from asperity.demo import FILES, input_files
from asperity.draw.figure import check_plot
from asperity.draw.style import drawn_in
from asperity.io.fields import MOST_ROWS, refuse
from asperity.io.files import check_directory, check_output, refuse_overwrite, write_files
from asperity.io.table import Table, terminal_table
from asperity.plot import curves as plot
from asperity.plot import friction as plot_friction
from asperity.plot.design import design_figure
from asperity.report.make import write_report
from asperity.scene.design import design as designed
from asperity.scene.model import Progress
from asperity.scene.results import friction_table, scene_inputs
from asperity.scene.scene import load_scene


def demo(args: Namespace) -> None:
    """Write the shipped scan and scenes, compute and draw the hot one, show the curve."""
    directory = FilePath(args.output)
    check_directory(directory, FILES, force=args.force)
    files: dict[str, bytes | str] = {**input_files()}
    with TemporaryDirectory() as aside:
        write_files({FilePath(aside) / name: data for name, data in files.items()})
        scene = load_scene(FilePath(aside) / "hot.toml", for_friction=True)
    scene = replace(scene, path=directory / "hot.toml")
    table, curves = friction_table([scene], bands=True, bar=progress)
    files["friction.csv"] = table.csv()
    picture = directory / "friction.png"
    missing = importlib.util.find_spec("matplotlib") is None
    if not missing:
        with drawn_in(args.style, table.notes):
            files[picture.name] = plot_friction.friction_figure([scene], curves, picture)
    write_files({directory / name: data for name, data in files.items()})
    shown = ("velocity_m_s", "mu", "mu_cold", "hysteresis", "adhesion", "hot_temperature_k")
    print_stdout(terminal_table({name: table.columns[name] for name in shown}) + "\n")
    tell_notes(table.notes, args.notes)
    band = "{q0_per_m:.4g} to {q1_per_m:.4g} 1/m, rms slope {rms_slope:.3g}".format(**scene.derived)
    drawn = f"none, {to_install('plot')}" if missing else f"{picture}"
    print_stdout(
        f"surface: {band}, within what the scan resolves: nothing is extrapolated\n"
        f"scene:   {scene.path}\n"
        f"table:   {directory / 'friction.csv'}\n"
        f"picture: {drawn}\n"
    )


def friction(args: Namespace) -> None:
    """Friction of one scene, or of several under one another."""
    outputs = check_outputs(args)
    files = [load_scene(name, for_friction=True) for name in args.scene]
    scenes = [scene for file in files for scene in (file, *file.others)]
    refuse_overwrite(outputs, [source for scene in scenes for source in scene.sources])
    table, curves = friction_table(scenes, bands=args.plot is not None, bar=progress)
    write_outputs(args, table, partial(plot_friction.friction_figure, scenes, curves))


def shows_bars() -> bool:
    """Whether there is a terminal for bars, and tqdm to draw them."""
    on_terminal = sys.stderr is not None and sys.stderr.isatty()
    return on_terminal and importlib.util.find_spec("tqdm") is not None


def progress(title: str) -> Progress:
    """A bar on a terminal, after two seconds of work, where tqdm is installed."""
    if not shows_bars():
        return nullcontext
    bar: Callable[..., Any] = importlib.import_module("tqdm").tqdm
    shown = "{l_bar}{bar}| {elapsed}<{remaining}{postfix}"
    return lambda chunks: bar(chunks, desc=title, delay=2, leave=False, bar_format=shown)


def area(args: Namespace) -> None:
    outputs = check_outputs(args)
    scene = load_scene(args.scene)
    refuse_overwrite(outputs, scene.sources)
    rows = scene.pressure.size * scene.velocity.size * args.points
    if rows > MOST_ROWS:
        text = f"pressures, velocities and --points make {rows} rows"
        raise must_be("", f"at most {MOST_ROWS}", text, where=scene.path)
    wavenumber = np.geomspace(scene.spectrum.q0, scene.spectrum.q1, args.points)
    values = scene.contact_area(wavenumber, progress(f"{scene.path}"))
    grid = np.meshgrid(scene.pressure, scene.velocity, wavenumber, indexing="ij")
    names = ("pressure_pa", "velocity_m_s", "wavenumber_per_m", "contact_area")
    columns = {n: v.ravel() for n, v in zip(names, (*grid, values), strict=True)}
    inputs = {**scene_inputs(scene), "points": args.points}
    table = Table("area", [inputs], scene.contact_notes(), columns)
    write_outputs(args, table, partial(plot.area_figure, scene, wavenumber, values))


def check_outputs(args: Namespace, **others: str | None) -> list[Path]:
    """Files to be written, of --output, --plot and other options: refused before any work where
    they cannot be, or where two are one."""
    goes_with(args, "style", "plot")
    if args.plot is not None:
        check_plot(FilePath(args.plot))
    flags: dict[str, str] = {}  # by the files that they lead to
    outputs: list[Path] = []
    for option, name in {"output": args.output, "plot": args.plot, **others}.items():
        if name is None:
            continue
        flag = f"--{option.replace('_', '-')}"
        outputs.append(FilePath(name))
        check_output(outputs[-1])
        first = flags.setdefault(os.path.realpath(name), flag)
        if first != flag:
            raise InvalidInput(f"{first} and {flag} must be different files", where=outputs[-1])
    return outputs


def write_outputs(
    args: Namespace,
    table: Table,
    draw: Callable[[Path], bytes],
    numbers: Mapping[str, float | None] | None = None,
) -> None:
    """Write files, then print what was found, the notes, and the table where no file takes it."""
    text = table.json() if args.json else table.csv()
    files: dict[Path, bytes | str] = {}
    if args.plot is not None:
        with drawn_in(args.style, table.notes):
            files[FilePath(args.plot)] = draw(FilePath(args.plot))
    if args.output is not None:
        files[FilePath(args.output)] = text
    write_files(files)
    for name, value in (numbers or {}).items():
        print_stderr(f"{name} = {'none' if value is None else f'{value:.6g}'}\n")
    tell_notes(table.notes, args.notes)
    if args.output is None:
        print_stdout(text)


def app(args: Namespace) -> None:
    """Serve until Ctrl-C; the address is one line on standard output."""
    browser = not args.no_browser
    serve(args.host, args.port, browser=browser, tell=lambda line: print_stdout(f"{line}\n"))


def report(args: Namespace) -> None:
    paths = [FilePath(name) for name in args.scene]
    try:
        write_report(paths, FilePath(args.output), args.title, progress)
    except ImportError as error:  # of what the extra brings
        raise InvalidInput(f"report: {error}") from error


def design(args: Namespace) -> None:
    outputs = check_outputs(args)
    scene = load_scene(args.scene, for_friction=True)
    if scene.others:
        problem = "several temperatures or directions are for asperity friction alone: must be one"
        refuse(scene.path, "[conditions]", problem)
    refuse_overwrite(outputs, scene.sources)
    found = designed(scene)
    rows = found.worths
    columns: dict[str, list[Any]] = {
        "pressure_pa": [row.pressure for row in rows],
        "velocity_m_s": [row.velocity for row in rows],
        "part": [row.part for row in rows],
        "change": [row.change for row in rows],
        "from": [_cell(row.lower) for row in rows],
        "to": [_cell(row.upper) for row in rows],
        "dma_temperature_k": [_cell(row.temperature) for row in rows],
        "mu_change": [float(row.mu) for row in rows],
    }
    table = Table("design", [scene_inputs(scene)], found.result.notes, columns)
    write_outputs(args, table, partial(design_figure, found))


def _cell(found: float | None) -> float | str:
    return "" if found is None else found
