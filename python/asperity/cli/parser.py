"""The verbs of the shell command and their options."""

import argparse
from collections.abc import Callable
from importlib import import_module

from asperity.cli import design_command, fit_command, map_command, spectrum_command
from asperity.cli import friction_commands as commands
from asperity.cli.app_command import app
from asperity.cli.fmu_command import fmu
from asperity.cli.options import (
    Parser,
    Version,
    keys,
    number,
    numbers,
    pairs,
    pixel_size,
    points,
    prior,
    share,
    sides,
    tile,
    whole,
)
from asperity.cli.report_command import report
from asperity.cli.rubber_parser import add_rubber
from asperity.cli.sweep_parser import add_sweep
from asperity.draw.style import STYLES
from asperity.measured_spectrum import WINDOWS


def script(name: str) -> Callable[[argparse.Namespace], None]:
    """What runs a verb that is a script beside the library."""

    def run(args: argparse.Namespace) -> None:
        command = import_module(f"asperity_scripts.{name}.command")
        getattr(command, name)(args)

    return run


def parser() -> argparse.ArgumentParser:
    """The parser of the whole command line."""
    result = Parser(
        prog="asperity",
        description="Rubber contact area and friction on rough surfaces. Numbers that are absurd "
        "in the unit of their key, column or option are refused, unusual ones are noted on stderr.",
    )
    result.add_argument("--version", action=Version, nargs=0, help="show the version and exit")
    verbs = result.add_subparsers(required=True, metavar="VERB")

    def verb(
        name: str, run: Callable[[argparse.Namespace], None], summary: str, example: str
    ) -> argparse.ArgumentParser:
        added = verbs.add_parser(
            name,
            help=summary,
            description=summary[0].upper() + summary[1:] + ".",
            epilog=f"example:\n  asperity {name} {example}",
            formatter_class=argparse.RawDescriptionHelpFormatter,
        )
        added.set_defaults(run=run)
        return added

    def style(to: argparse.ArgumentParser) -> None:
        to.add_argument(
            "--style",
            choices=STYLES,
            help="of pictures: print (default), single for one of two columns, dark for screens",
        )

    def pictures(to: argparse.ArgumentParser) -> None:
        to.add_argument("--plot", metavar="PICTURE", help="draw it, .png, .svg or .pdf")
        style(to)

    def notes(to: argparse.ArgumentParser) -> None:
        to.add_argument(
            "--notes",
            choices=("few", "all"),
            default="few",
            help="on the terminal: the gravest, alike ones joined (default), or all of them",
        )

    def outputs(to: argparse.ArgumentParser) -> None:
        to.add_argument("--output", metavar="FILE", help="where to write (default: the terminal)")
        pictures(to)
        notes(to)
        to.add_argument("--json", action="store_true", help="write JSON instead of CSV")

    def of_scan(
        to: argparse.ArgumentParser, channel: int | None = None, detrend: str | None = None
    ) -> None:
        to.add_argument(
            "--pixel-size", type=pixel_size, metavar="DY,DX", help="[m], where the file states none"
        )
        to.add_argument(
            "--unit",
            metavar="UNIT",
            help="of the heights (m, mm, um, nm, pm), where the file states none",
        )
        to.add_argument(
            "--channel",
            type=whole,
            default=channel,
            help="of a file with several maps (default: 0)",
        )
        to.add_argument(
            "--detrend",
            choices=("plane", "quadratic", "offset", "none"),
            default=detrend,
            help="what is taken off the heights first (default: plane)",
        )

    def directory(to: argparse.ArgumentParser, default: str) -> None:
        to.add_argument(
            "--output", metavar="DIR", default=default, help="directory (default: %(default)s)"
        )
        to.add_argument(
            "--force", action="store_true", help="replace the files of an earlier run there"
        )
        style(to)

    demo = verb(
        "demo", commands.demo, "friction of rubber on a shipped asphalt scan", "--output tryout"
    )
    directory(demo, "asperity-demo")
    notes(demo)

    friction = verb(
        "friction",
        commands.friction,
        "friction coefficient over velocity and pressure; several scenes in one picture",
        "dry.toml wet.toml --output mu.csv --plot mu.pdf",
    )
    friction.add_argument("scene", metavar="SCENE.toml", nargs="+")
    outputs(friction)

    area = verb(
        "area",
        commands.area,
        "relative contact area over wavenumber",
        "scene.toml --points 400 --output area.csv --plot area.png",
    )
    area.add_argument("scene", metavar="SCENE.toml")
    area.add_argument(
        "--points",
        type=points,
        default=200,
        help="wavenumbers, logarithmic (default: %(default)s)",
    )
    outputs(area)

    design = verb(
        "design",
        design_command.design,
        "what a tenth more of each decade of modulus and roughness, and of each number, is worth",
        "scene.toml --output design.csv --plot design.png",
    )
    design.add_argument("scene", metavar="SCENE.toml")
    outputs(design)

    spectrum = verb(
        "spectrum",
        spectrum_command.spectrum,
        "roughness spectrum of a scan, with rms height, rms slope and a self-affine fit",
        "scan.npy --pixel-size 2e-6,1e-6 --unit um --detrend quadratic --plot spectrum.png",
    )
    spectrum.add_argument("file", metavar="FILE")
    of_scan(spectrum, channel=0, detrend="plane")
    spectrum.add_argument(
        "--window",
        choices=WINDOWS,
        default=WINDOWS[0],
        help="default: %(default)s",
    )
    spectrum.add_argument(
        "--max-dropouts",
        type=number,
        default=0.10,
        metavar="SHARE",
        help="refuse a scan with more of its points missing (default: %(default)s)",
    )
    spectrum.add_argument(
        "--q-min", type=number, metavar="Q", help="fit above [1/m] (default: what is reliable)"
    )
    spectrum.add_argument(
        "--q-max", type=number, metavar="Q", help="fit below [1/m] (default: what is reliable)"
    )
    spectrum.add_argument(
        "--method",
        choices=("least-squares", "slope"),
        default="least-squares",
        help="of the fit: weighted, with a roll-off where there is one, or Eq. 28 alone "
        "(default: %(default)s)",
    )
    spectrum.add_argument(
        "--tiles",
        type=tile,
        metavar="NY,NX",
        help="points of a tile, one number or two: a .npy file or a Zarr array that need not fit "
        "in memory",
    )
    spectrum.add_argument(
        "--overlap", type=share, metavar="SHARE", help="of neighbouring tiles (default: 0.5)"
    )
    spectrum.add_argument(
        "--threads", type=whole, metavar="N", help="that share the tiles (default: 1)"
    )
    outputs(spectrum)

    outputs(add_rubber(verb))
    fit = verb(
        "fit",
        fit_command.fit,
        "adhesion from measured friction, or any numbers of a scene; or the scene beside it",
        "scene.toml measured.csv --hold width=0.1 --output fit.csv --plot fit.png\n"
        "  asperity fit scene.toml measured.csv --free surface.q1_per_m,adhesion.shear_stress_pa",
    )
    fit.add_argument("scene", metavar="SCENE.toml")
    fit.add_argument(
        "measured",
        metavar="MEASURED.csv",
        help="columns mu, velocity_m_s (or velocity_mm_s, velocity_km_h) and, where pressures "
        "differ, pressure_pa (pressure_kpa, pressure_mpa), where temperatures do, temperature_k or "
        "temperature_c",
    )
    fit.add_argument(
        "--hold",
        type=pairs,
        metavar="NAME=VALUE,...",
        help="keep shear_stress_pa, reference_velocity_m_s or width",
    )
    fit.add_argument(
        "--free",
        type=keys,
        action="extend",
        metavar="KEY,...",
        help="fit these numbers of the scene instead, as surface.q1_per_m, rubber.moduli_pa[2]",
    )
    fit.add_argument(
        "--prior",
        type=prior,
        action="append",
        metavar="KEY=VALUE,DEVIATION[,ln]",
        help="what is known of one of them, with a standard deviation of it or of its logarithm",
    )
    fit.add_argument(
        "--compare", action="store_true", help="fit nothing: hold the scene against the points"
    )
    fit.add_argument(
        "--scatter",
        type=number,
        metavar="SHARE",
        help="relative standard deviation of the points, with --free or --compare",
    )
    outputs(fit)

    add_sweep(verb, pictures, notes)

    mapped = verb(
        "map",
        map_command.friction_map_of,
        "friction map for simulators, certified; or what a map's file says",
        "scene.toml --output road.fmap --plot map.png\n  asperity map --info road.fmap",
    )
    mapped.add_argument("scene", metavar="SCENE.toml", nargs="?")
    mapped.add_argument("--info", metavar="FILE", help="tell what is in a map's file")
    for name, unit in (("pressure", "Pa"), ("velocity", "m/s")):
        mapped.add_argument(
            f"--{name}",
            type=sides,
            metavar="LO,HI",
            help=f"of the map [{unit}] (default: the scene's)",
        )
    mapped.add_argument(
        "--rtol", type=number, help="relative (default: the scene's [solver] rtol, or 1e-4)"
    )
    mapped.add_argument(
        "--checked",
        type=whole,
        metavar="N",
        help="random points that the map is checked on (default: 1000000)",
    )
    mapped.add_argument("--output", metavar="FILE", help="where to write the map")
    mapped.add_argument(
        "--export",
        metavar="GRID",
        help="write mu on a grid for simulators that interpolate, .mat (MATLAB) or .csv",
    )
    pictures(mapped)
    notes(mapped)
    mapped.add_argument("--json", action="store_true", help="tell it as JSON")

    mock_up = verb(
        "fmu",
        fmu,
        "a friction map as a Functional Mock-up Unit for tire and vehicle simulators",
        "road.fmap --output road.fmu --fmi 3.0",
    )
    mock_up.add_argument("map", metavar="ROAD.fmap")
    mock_up.add_argument("--output", metavar="FILE", required=True, help="the FMU that is written")
    mock_up.add_argument(
        "--fmi",
        choices=("2.0", "3.0"),
        default="2.0",
        help="version of the standard (default: %(default)s)",
    )
    mock_up.add_argument(
        "--name",
        default="friction",
        help="of the model, an identifier of C (default: %(default)s)",
    )
    mock_up.add_argument(
        "--points",
        type=whole,
        metavar="N",
        help="contact points looked up at once: arrays in 3.0, pressure[1] ... in 2.0",
    )

    reported = verb(
        "report",
        report,
        "scenes as one HTML file with pictures, tables, errors and inputs, to read and to print",
        "dry.toml wet.toml --output report.html",
    )
    reported.add_argument("scene", metavar="SCENE.toml", nargs="+")
    reported.add_argument("--output", metavar="FILE", required=True, help="the file to write")
    reported.add_argument("--title", help="the heading (default: the names of the scenes)")

    in_browser = verb(
        "app",
        app,
        "the app in the browser, on this machine alone: its address with a token is printed",
        "--port 8080 --no-browser",
    )
    in_browser.add_argument(
        "--port", type=whole, default=0, metavar="N", help="to listen at (default: any free one)"
    )
    in_browser.add_argument(
        "--host",
        default="127.0.0.1",
        metavar="ADDRESS",
        help="to listen at (default: %(default)s, which other machines cannot reach)",
    )
    in_browser.add_argument(
        "--no-browser", action="store_true", help="print the address, open no browser"
    )

    validate = verb(
        "validate",
        script("validate"),
        "the measured error of every correction, against boundary-element contacts",
        "--output worth",
    )
    directory(validate, "asperity-validate")
    notes(validate)
    validate.add_argument(
        "--rows", metavar="FILE", help="contacts to compare with (default: the 177 shipped ones)"
    )
    validate.add_argument(
        "--surface",
        metavar="FILE",
        help="a map of your own, pressed by boundary elements",
    )
    of_scan(validate)
    validate.add_argument(
        "--q0",
        type=number,
        metavar="Q",
        help="wavenumber of its macro-asperities [1/m]; without it peaks and IGW are left out",
    )
    validate.add_argument(
        "--loads", type=numbers, metavar="P,P,...", help="p / (E* h') (default: those of the rows)"
    )
    validate.add_argument(
        "--periodic", action="store_true", help="the map continues at its opposite sides"
    )
    validate.add_argument(
        "--sliding",
        action="store_true",
        help="friction and area against exact sliding contact, of --surface or a shipped map",
    )
    validate.add_argument(
        "--rubber",
        metavar="SCENE",
        help="rubber, pressures and velocities of --sliding (default: the shipped scene's)",
    )
    validate.add_argument(
        "--velocities",
        type=numbers,
        metavar="V,V,...",
        help="of --sliding [m/s] (default: SCENE's)",
    )
    remade = verb(
        "article",
        script("article"),
        "the article remade: its figures and table, and its statements checked",
        "--output remade",
    )
    directory(remade, "asperity-article")
    return result
