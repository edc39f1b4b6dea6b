"""The verbs of the shell command and their options."""

import argparse
from collections.abc import Callable
from importlib import import_module

from asperity.cli import fit_command, map_command, spectrum_command
from asperity.cli import friction_commands as commands
from asperity.cli.options import (
    Parser,
    Version,
    keys,
    number,
    numbers,
    option,
    pairs,
    pixel_size,
    points,
    prior,
    share,
    sides,
    tile,
    whole,
)
from asperity.cli.rubber_command import add_rubber
from asperity.cli.sweep_command import add_sweep
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
        option(
            to,
            "--style",
            "of pictures: print (default), single for one of two columns, dark for screens",
            choices=STYLES,
        )

    def pictures(to: argparse.ArgumentParser) -> None:
        option(to, "--plot PICTURE", "draw it, .png, .svg or .pdf")
        style(to)

    def notes(to: argparse.ArgumentParser) -> None:
        option(
            to,
            "--notes",
            "on the terminal: the gravest, alike ones joined (default), or all of them",
            choices=("few", "all"),
            default="few",
        )

    def outputs(to: argparse.ArgumentParser) -> None:
        option(to, "--output FILE", "where to write (default: the terminal)")
        pictures(to)
        notes(to)
        option(to, "--json", "write JSON instead of CSV")

    def of_scan(
        to: argparse.ArgumentParser, channel: int | None = None, detrend: str | None = None
    ) -> None:
        option(to, "--pixel-size DY,DX", "[m], where the file states none", pixel_size)
        option(to, "--unit UNIT", "of the heights (m, mm, um, nm, pm), where the file states none")
        option(to, "--channel", "of a file with several maps (default: 0)", whole, default=channel)
        option(
            to,
            "--detrend",
            "what is taken off the heights first (default: plane)",
            choices=("plane", "quadratic", "offset", "none"),
            default=detrend,
        )

    def directory(to: argparse.ArgumentParser, default: str) -> None:
        option(to, "--output DIR", "directory (default: %(default)s)", default=default)
        option(to, "--force", "replace the files of an earlier run there")
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
    option(area, "--points", "wavenumbers, logarithmic (default: %(default)s)", points, default=200)
    outputs(area)

    design = verb(
        "design",
        commands.design,
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
    option(spectrum, "--window", "default: %(default)s", choices=WINDOWS, default=WINDOWS[0])
    option(
        spectrum,
        "--max-dropouts SHARE",
        "refuse a scan with more of its points missing (default: %(default)s)",
        number,
        default=0.10,
    )
    option(spectrum, "--q-min Q", "fit above [1/m] (default: what is reliable)", number)
    option(spectrum, "--q-max Q", "fit below [1/m] (default: what is reliable)", number)
    option(
        spectrum,
        "--method",
        "of the fit: weighted, with a roll-off where there is one, or Eq. 28 alone "
        "(default: %(default)s)",
        choices=("least-squares", "slope"),
        default="least-squares",
    )
    option(
        spectrum,
        "--tiles NY,NX",
        "points of a tile, one number or two: a .npy file or a Zarr array that need not fit "
        "in memory",
        tile,
    )
    option(spectrum, "--overlap SHARE", "of neighbouring tiles (default: 0.5)", share)
    option(spectrum, "--threads N", "that share the tiles (default: 1)", whole)
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
    option(
        fit, "--hold NAME=VALUE,...", "keep shear_stress_pa, reference_velocity_m_s or width", pairs
    )
    option(
        fit,
        "--free KEY,...",
        "fit these numbers of the scene instead, as surface.q1_per_m, rubber.moduli_pa[2]",
        keys,
        action="extend",
    )
    option(
        fit,
        "--prior KEY=VALUE,DEVIATION[,ln]",
        "what is known of one of them, with a standard deviation of it or of its logarithm",
        prior,
        action="append",
    )
    option(fit, "--compare", "fit nothing: hold the scene against the points")
    option(
        fit,
        "--scatter SHARE",
        "relative standard deviation of the points, with --free or --compare",
        number,
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
    option(mapped, "--info FILE", "tell what is in a map's file")
    for name, unit in (("pressure", "Pa"), ("velocity", "m/s")):
        option(mapped, f"--{name} LO,HI", f"of the map [{unit}] (default: the scene's)", sides)
    option(mapped, "--rtol", "relative (default: the scene's [solver] rtol, or 1e-4)", number)
    option(
        mapped, "--checked N", "random points that the map is checked on (default: 1000000)", whole
    )
    option(mapped, "--output FILE", "where to write the map")
    option(
        mapped,
        "--export GRID",
        "write mu on a grid for simulators that interpolate, .mat (MATLAB) or .csv",
    )
    pictures(mapped)
    notes(mapped)
    option(mapped, "--json", "tell it as JSON")

    mock_up = verb(
        "fmu",
        map_command.fmu,
        "a friction map as a Functional Mock-up Unit for tire and vehicle simulators",
        "road.fmap --output road.fmu --fmi 3.0",
    )
    mock_up.add_argument("map", metavar="ROAD.fmap")
    option(mock_up, "--output FILE", "the FMU that is written", required=True)
    option(
        mock_up,
        "--fmi",
        "version of the standard (default: %(default)s)",
        choices=("2.0", "3.0"),
        default="2.0",
    )
    option(
        mock_up,
        "--name",
        "of the model, an identifier of C (default: %(default)s)",
        default="friction",
    )
    option(
        mock_up,
        "--points N",
        "contact points looked up at once: arrays in 3.0, pressure[1] ... in 2.0",
        whole,
    )

    reported = verb(
        "report",
        commands.report,
        "scenes as one HTML file with pictures, tables, errors and inputs, to read and to print",
        "dry.toml wet.toml --output report.html",
    )
    reported.add_argument("scene", metavar="SCENE.toml", nargs="+")
    option(reported, "--output FILE", "the file to write", required=True)
    option(reported, "--title TITLE", "the heading (default: the names of the scenes)")

    in_browser = verb(
        "app",
        commands.app,
        "the app in the browser, on this machine alone: its address with a token is printed",
        "--port 8080 --no-browser",
    )
    option(in_browser, "--port N", "to listen at (default: any free one)", whole, default=0)
    option(
        in_browser,
        "--host ADDRESS",
        "to listen at (default: %(default)s, which other machines cannot reach)",
        default="127.0.0.1",
    )
    option(in_browser, "--no-browser", "print the address, open no browser")

    validate = verb(
        "validate",
        script("validate"),
        "the measured error of every correction, against boundary-element contacts",
        "--output worth",
    )
    directory(validate, "asperity-validate")
    notes(validate)
    option(validate, "--rows FILE", "contacts to compare with (default: the 177 shipped ones)")
    option(validate, "--surface FILE", "a map of your own, pressed by boundary elements")
    of_scan(validate)
    option(
        validate,
        "--q0 Q",
        "wavenumber of its macro-asperities [1/m]; without it peaks and IGW are left out",
        number,
    )
    option(validate, "--loads P,P,...", "p / (E* h') (default: those of the rows)", numbers)
    option(validate, "--periodic", "the map continues at its opposite sides")
    option(
        validate,
        "--sliding",
        "friction and area against exact sliding contact, of --surface or a shipped map",
    )
    option(
        validate,
        "--rubber SCENE",
        "rubber, pressures and velocities of --sliding (default: the shipped scene's)",
    )
    option(validate, "--velocities V,V,...", "of --sliding [m/s] (default: SCENE's)", numbers)
    remade = verb(
        "article",
        script("article"),
        "the article remade: its figures and table, and its statements checked",
        "--output remade",
    )
    directory(remade, "asperity-article")
    return result
