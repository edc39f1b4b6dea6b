"""The shell command `asperity`: demo, friction, area, spectrum."""

import argparse
import importlib.util
import sys
from collections.abc import Callable, Iterable, Sequence
from pathlib import Path
from typing import Any, NoReturn

import numpy as np

from asperity import plot
from asperity._core import (
    Error,
    InvalidInput,
    OutOfRange,
    __version__,
    fit_self_affine,
    power_spectrum,
)
from asperity.demo import write_inputs
from asperity.fields import named
from asperity.read import read_filled
from asperity.scene import COLUMNS, Curves, Scene, load_scene
from asperity.table import Table, check_output, terminal_table, write_files


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the shell command; the exit status is 0, 2 for bad input, 1 for any other failure."""
    args = _parser().parse_args(arguments)
    try:
        args.run(args)
    except (InvalidInput, OutOfRange) as error:
        return _fail(error, 2)
    except BrokenPipeError:  # the reader of our output has closed it
        sys.stderr.close()
        return 1
    except (Error, OSError) as error:
        return _fail(error, 1)
    return 0


def _fail(error: Exception, status: int) -> int:
    print("asperity:", " ".join(str(error).split()), file=sys.stderr)
    return status


def _demo(args: argparse.Namespace) -> None:
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


def _friction(args: argparse.Namespace) -> None:
    paths = [Path(name) for name in args.scene]
    _check_outputs(args, paths)
    table, curves = _friction_table(scenes := [load_scene(path) for path in paths])
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


def _area(args: argparse.Namespace) -> None:
    path = Path(args.scene)
    _check_outputs(args, [path])
    scene = load_scene(path)
    wavenumber = np.geomspace(scene.spectrum.q0, scene.spectrum.q1, args.points)
    area = scene.contact_area(wavenumber)
    grid = np.meshgrid(scene.pressure, scene.velocity, wavenumber, indexing="ij")
    names = ("pressure_pa", "velocity_m_s", "wavenumber_per_m", "contact_area")
    columns = {n: values.ravel().tolist() for n, values in zip(names, (*grid, area), strict=True)}
    table = Table("area", [{**_inputs(scene), "points": args.points}], [], columns)
    _deliver(args, table, lambda picture: plot.area_figure(scene, wavenumber, area, picture))


def _spectrum(args: argparse.Namespace) -> None:
    path = Path(args.file)
    _check_outputs(args, [path])
    with named(None, {"pixel_size": "--pixel-size", "unit": "--unit", "channel": "--channel"}):
        raw, surface = read_filled(
            path, channel=args.channel, pixel_size=args.pixel_size, unit=args.unit
        )
    detrend = None if args.detrend == "none" else args.detrend
    with named(path, {"q_min": "--q-min", "q_max": "--q-max"}):
        spectrum = power_spectrum(surface, window=args.window, detrend=detrend)
        fit = fit_self_affine(spectrum, q_min=args.q_min, q_max=args.q_max)
    cutoff = spectrum.cutoff_for_slope(1.3)
    inputs = {
        "file": str(path),
        "channel": args.channel,
        "shape": list(raw.heights.shape),
        "pixel_size_m": list(raw.pixel_size),
        "dropout_fraction": raw.dropout_fraction,
        "window": args.window,
        "detrend": args.detrend,
    }
    found = {
        "rms_height_m": spectrum.rms_height,
        "rms_slope": spectrum.rms_slope,
        "slope_cutoff_1.3_per_m": cutoff,
        "fit_q0_per_m": fit.q0,
        "fit_q1_per_m": fit.q1,
        "fit_hurst": fit.hurst,
        "fit_hurst_standard_error": fit.standard_errors["hurst"],
        "fit_rms_height_m": fit.rms_height,
        "fit_rms_height_standard_error_m": fit.standard_errors["rms_height"],
    }
    count = np.zeros(0) if spectrum.count is None else spectrum.count
    columns = {
        "wavenumber_per_m": spectrum.wavenumber.tolist(),
        "density_m4": spectrum.density.tolist(),
        "count": [round(modes) for modes in count.tolist()],
    }
    for name, value in found.items():
        print(f"{name} = {value:.6g}", file=sys.stderr)
    if cutoff >= spectrum.q1:
        print("note: the rms slope stays below 1.3 on the whole spectrum", file=sys.stderr)
    table = Table("spectrum", [{**inputs, "found": found}], [], columns)
    _deliver(args, table, lambda picture: plot.spectrum_figure(spectrum, fit, cutoff, picture))


def _inputs(scene: Scene) -> dict[str, Any]:
    return {"scene": str(scene.path), **scene.inputs, "derived": scene.derived}


def _check_outputs(args: argparse.Namespace, inputs: Sequence[Path]) -> None:
    outputs = [Path(name) for name in (args.output, args.plot) if name is not None]
    if args.plot is not None:
        plot.check_plot(Path(args.plot))
    for path in outputs:
        check_output(path, inputs)
    if len({path.resolve() for path in outputs}) < len(outputs):
        raise InvalidInput(f"{outputs[0]}: --output and --plot must be two files")


def _deliver(args: argparse.Namespace, table: Table, draw: Callable[[Path], bytes]) -> None:
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


class _Parser(argparse.ArgumentParser):
    def error(self, message: str) -> NoReturn:
        self.exit(2, f"{self.prog}: {message} (see {self.prog} --help)\n")


def _pixel_size(text: str) -> float | tuple[float, float]:
    sizes = [float(size) for size in text.split(",")]
    if len(sizes) == 1:
        return sizes[0]
    dy, dx = sizes
    return dy, dx


def _points(text: str) -> int:
    if (points := int(text)) < 2:
        raise ValueError
    return points


def _parser() -> argparse.ArgumentParser:
    parser = _Parser(
        prog="asperity", description="Rubber contact area and friction on rough surfaces."
    )
    parser.add_argument("--version", action="version", version=__version__)
    verbs = parser.add_subparsers(required=True, metavar="demo | friction | area | spectrum")

    def verb(
        name: str, run: Callable[[argparse.Namespace], None], summary: str, example: str
    ) -> argparse.ArgumentParser:
        result = verbs.add_parser(
            name,
            help=summary,
            description=summary[0].upper() + summary[1:] + ".",
            epilog=f"example:\n  asperity {name} {example}",
            formatter_class=argparse.RawDescriptionHelpFormatter,
        )
        result.set_defaults(run=run)
        return result

    def outputs(result: argparse.ArgumentParser) -> None:
        result.add_argument(
            "--output", metavar="FILE", help="where to write (default: the terminal)"
        )
        result.add_argument("--plot", metavar="PICTURE", help="draw it, .png, .svg or .pdf")
        result.add_argument("--json", action="store_true", help="write JSON instead of CSV")

    demo = verb("demo", _demo, "friction of rubber on a shipped asphalt scan", "--output tryout")
    demo.add_argument(
        "--output", metavar="DIR", default="asperity-demo", help="directory (default: %(default)s)"
    )

    friction = verb(
        "friction",
        _friction,
        "friction coefficient over velocity and pressure; several scenes in one picture",
        "dry.toml wet.toml --output mu.csv --plot mu.pdf",
    )
    friction.add_argument("scene", metavar="SCENE.toml", nargs="+")
    outputs(friction)

    area = verb(
        "area",
        _area,
        "relative contact area over wavenumber",
        "scene.toml --points 400 --output area.csv --plot area.png",
    )
    area.add_argument("scene", metavar="SCENE.toml")
    area.add_argument(
        "--points",
        type=_points,
        default=200,
        help="wavenumbers, logarithmic (default: %(default)s)",
    )
    outputs(area)

    spectrum = verb(
        "spectrum",
        _spectrum,
        "roughness spectrum of a scan, with rms height, rms slope and a self-affine fit",
        "scan.npy --pixel-size 2e-6,1e-6 --unit um --detrend quadratic --plot spectrum.png",
    )
    spectrum.add_argument("file", metavar="FILE")
    spectrum.add_argument(
        "--pixel-size", type=_pixel_size, metavar="DY,DX", help="[m], where the file states none"
    )
    spectrum.add_argument(
        "--unit", choices=("m", "mm", "um", "nm"), help="of the heights, where the file states none"
    )
    spectrum.add_argument(
        "--channel", type=int, default=0, help="of a file with several maps (default: %(default)s)"
    )
    spectrum.add_argument(
        "--window",
        choices=("split-cosine-bell", "hann", "none"),
        default="split-cosine-bell",
        help="default: %(default)s",
    )
    spectrum.add_argument(
        "--detrend",
        choices=("plane", "quadratic", "offset", "none"),
        default="plane",
        help="default: %(default)s",
    )
    spectrum.add_argument("--q-min", type=float, metavar="Q", help="fit above [1/m] (default: all)")
    spectrum.add_argument("--q-max", type=float, metavar="Q", help="fit below [1/m] (default: all)")
    outputs(spectrum)
    return parser
