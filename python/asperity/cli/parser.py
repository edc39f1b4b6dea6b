"""The verbs of the shell command and their options."""

import argparse
from collections.abc import Callable
from importlib import import_module

from asperity.cli import fit_command, map_command, rubber_command, spectrum_command, sweep_command
from asperity.cli import friction_commands as commands
from asperity.cli import options as kinds
from asperity.measured_spectrum import WINDOWS

Run = Callable[[argparse.Namespace], None]
_SCENE = "SCENE.toml"


def script(name: str) -> Run:
    """What runs a verb that is a script beside the library."""

    def run(args: argparse.Namespace) -> None:
        command = import_module(f"asperity_scripts.{name}.command")
        getattr(command, name)(args)

    return run


def parser() -> kinds.Parser:
    result = kinds.Parser(
        prog="asperity",
        description="Rubber contact area and friction on rough surfaces. Numbers that are absurd "
        "in the unit of their key, column or option are refused, unusual ones are noted on stderr.",
    )
    show = "show the version and exit"
    result.add_argument("--version", action=kinds.Version, nargs=0, help=show)
    verbs = result.add_subparsers(required=True, metavar="VERB")

    def verb(name: str, run: Run, summary: str, example: str) -> kinds.Parser:
        added = verbs.add_parser(
            name,
            help=summary,
            description=summary[0].upper() + summary[1:] + ".",
            epilog=f"example:\n  asperity {name} {example}",
            formatter_class=argparse.RawDescriptionHelpFormatter,
        )
        added.set_defaults(run=run)
        return added

    text = "friction of rubber on a shipped asphalt scan"
    demo = verb("demo", commands.demo, text, "--output tryout")
    demo.directory("asperity-demo")
    demo.notes()

    text = "friction coefficient over velocity and pressure; several scenes in one picture"
    example = "dry.toml wet.toml --output mu.csv --plot mu.pdf"
    friction = verb("friction", commands.friction, text, example)
    friction.add_argument("scene", metavar=_SCENE, nargs="+")
    friction.outputs()

    example = "scene.toml --points 400 --output area.csv --plot area.png"
    area = verb("area", commands.area, "relative contact area over wavenumber", example)
    area.add_argument("scene", metavar=_SCENE)
    area.option("--points", "wavenumbers, logarithmic", kinds.points, default=200)
    area.outputs()

    text = "what a tenth more of each decade of modulus and roughness, and of each number, is worth"
    example = "scene.toml --output design.csv --plot design.png"
    design = verb("design", commands.design, text, example)
    design.add_argument("scene", metavar=_SCENE)
    design.outputs()

    text = "roughness spectrum of a scan, with rms height, rms slope and a self-affine fit"
    example = "scan.npy --pixel-size 2e-6,1e-6 --unit um --detrend quadratic --plot spectrum.png"
    spectrum = verb("spectrum", spectrum_command.spectrum, text, example)
    spectrum.add_argument("file", metavar="FILE")
    spectrum.scan(channel=0, detrend="plane")
    spectrum.option("--window", "default: %(default)s", WINDOWS, default=WINDOWS[0])
    text = "refuse a scan with more of its points missing"
    spectrum.option("--max-dropouts SHARE", text, kinds.number, default=0.10)
    for name, side in (("--q-min Q", "above"), ("--q-max Q", "below")):
        spectrum.option(name, f"fit {side} [1/m] (default: what is reliable)", kinds.number)
    text = "of the fit: weighted, with a roll-off where there is one, or Eq. 28 alone"
    spectrum.option("--method", text, ("least-squares", "slope"), default="least-squares")
    text = "points of a tile, one number or two: a .npy file or a Zarr array that need not fit in "
    spectrum.option("--tiles NY,NX", text + "memory", kinds.tile)
    spectrum.option("--overlap SHARE", "of neighbouring tiles (default: 0.5)", kinds.share)
    spectrum.option("--threads N", "that share the tiles (default: 1)", kinds.whole)
    spectrum.outputs()

    text = "master curve, shift factors and Prony series of DMA isotherms"
    example = (
        "dma.csv --columns frequency=f,temperature=T,storage=G1,loss=G2 "
        "--units frequency=Hz,temperature=C,modulus=MPa --modulus G --plot rubber.png"
    )
    rubber = verb("rubber", rubber_command.rubber, text, example)
    rubber.add_argument("file", metavar="FILE", nargs="+")
    text = "names in the files of frequency, temperature, storage, loss"
    rubber.option("--columns NAME=COLUMN,...", text, kinds.pairs, required=True)
    text = "frequency=Hz or rad/s, temperature=K or C, modulus=Pa, kPa, MPa or GPa"
    rubber.option("--units NAME=UNIT,...", text, kinds.pairs, required=True)
    rubber.option("--modulus", "Young's or shear moduli", ("E", "G"), required=True)
    rubber.option("--poisson-ratio NU", "for E = 2 (1 + nu) G", kinds.number, default=0.5)
    text = "one for each file, where the files have no column of them"
    rubber.option("--temperatures T,T,...", text, kinds.numbers)
    text = "[K] (default: that of the middle isotherm)"
    rubber.option("--reference-temperature T", text, kinds.number)
    rubber.option("--vertical-shift", "divide moduli by b_T (default: none)", ("T/T_ref",))
    text = "take a_T from a table (temperature_k,log10_a_t or T,log_aT) or a file of this verb"
    rubber.option("--shift FILE", text)
    rubber.option("--write-shift FILE", "write the shift factors, a row an isotherm (.csv)")
    text = "write the Prony terms: .csv, .inp for Abaqus, .mac for Ansys"
    rubber.option("--write-prony FILE", text)
    rubber.outputs()

    text = "adhesion from measured friction, or any numbers of a scene; or the scene beside it"
    example = (
        "scene.toml measured.csv --hold width=0.1 --output fit.csv --plot fit.png\n"
        "  asperity fit scene.toml measured.csv --free surface.q1_per_m,adhesion.shear_stress_pa"
    )
    fit = verb("fit", fit_command.fit, text, example)
    fit.add_argument("scene", metavar=_SCENE)
    text = (
        "columns mu, velocity_m_s (or velocity_mm_s, velocity_km_h) and, where pressures differ, "
        "pressure_pa (pressure_kpa, pressure_mpa), where temperatures do, temperature_k or "
        "temperature_c"
    )
    fit.add_argument("measured", metavar="MEASURED.csv", help=text)
    text = "keep shear_stress_pa, reference_velocity_m_s or width"
    fit.option("--hold NAME=VALUE,...", text, kinds.pairs)
    text = "fit these numbers of the scene instead, as surface.q1_per_m, rubber.moduli_pa[2]"
    fit.option("--free KEY,...", text, kinds.keys, action="extend")
    text = "what is known of one of them, with a standard deviation of it or of its logarithm"
    fit.option("--prior KEY=VALUE,DEVIATION[,ln]", text, kinds.prior, action="append")
    fit.option("--compare", "fit nothing: hold the scene against the points")
    text = "relative standard deviation of the points, with --free or --compare"
    fit.option("--scatter SHARE", text, kinds.number)
    fit.outputs()

    text = "friction of many scenes at once, on one machine or on many; pictures and ranks of them"
    example = (
        "sweep.toml --output results.zarr --workers 4\n"
        "  asperity sweep results.zarr --plot results.png --at surface.hurst=0.8\n"
        "  asperity sweep results.zarr --rank correction.kind"
    )
    sweep = verb("sweep", sweep_command.sweep, text, example)
    text = 'scene = "scene.toml", and a table [over] of keys with lists; or a store of such a sweep'
    sweep.add_argument("sweep", metavar="SWEEP.toml", help=f"{text}, to look at")
    sweep.option("--output STORE", "results.zarr or results.nc")
    sweep.option("--workers N", "processes of this machine (default: this one)", kinds.whole)
    sweep.option("--scheduler ADDRESS", "of Dask workers that run, tcp://host:8786")
    sweep.option("--mpi", "other ranks compute: start it by mpiexec -n 8")
    sweep.option("--resume", "go on with the store of an earlier run")
    sweep.option("--force", "replace a sweep's store that is there")
    text = "keep these alone (default: all of them); draw the first"
    sweep.option("--variables NAME,...", text)
    sweep.option("--dry-run", "tell points, tasks, bytes and seconds")
    text = "look at these values of some axes"
    sweep.option("--at AXIS=VALUE,...", text, kinds.pairs, default={})
    text = "tell which value of an axis has most friction, where, and how certainly, as CSV"
    sweep.option("--rank AXIS", text)
    sweep.pictures()
    sweep.notes()

    text = "friction map for simulators, certified; or what a map's file says"
    example = "scene.toml --output road.fmap --plot map.png\n  asperity map --info road.fmap"
    mapped = verb("map", map_command.friction_map_of, text, example)
    mapped.add_argument("scene", metavar=_SCENE, nargs="?")
    mapped.option("--info FILE", "tell what is in a map's file")
    for name, unit in (("pressure", "Pa"), ("velocity", "m/s")):
        text = f"of the map [{unit}] (default: the scene's)"
        mapped.option(f"--{name} LO,HI", text, kinds.sides)
    text = "relative (default: the scene's [solver] rtol, or 1e-4)"
    mapped.option("--rtol", text, kinds.number)
    text = "random points that the map is checked on (default: 1000000)"
    mapped.option("--checked N", text, kinds.whole)
    mapped.option("--output FILE", "where to write the map")
    text = "write mu on a grid for simulators that interpolate, .mat (MATLAB) or .csv"
    mapped.option("--export GRID", text)
    mapped.pictures()
    mapped.notes()
    mapped.option("--json", "tell it as JSON")

    text = "a friction map as a Functional Mock-up Unit for tire and vehicle simulators"
    mock_up = verb("fmu", map_command.fmu, text, "road.fmap --output road.fmu --fmi 3.0")
    mock_up.add_argument("map", metavar="ROAD.fmap")
    mock_up.option("--output FILE", "the FMU that is written", required=True)
    mock_up.option("--fmi", "version of the standard", ("2.0", "3.0"), default="2.0")
    mock_up.option("--name", "of the model, an identifier of C", default="friction")
    text = "contact points looked up at once: arrays in 3.0, pressure[1] ... in 2.0"
    mock_up.option("--points N", text, kinds.whole)

    text = "scenes as one HTML file with pictures, tables, errors and inputs, to read and to print"
    reported = verb("report", commands.report, text, "dry.toml wet.toml --output report.html")
    reported.add_argument("scene", metavar=_SCENE, nargs="+")
    reported.option("--output FILE", "the file to write", required=True)
    reported.option("--title TITLE", "the heading (default: the names of the scenes)")

    text = "the app in the browser, on this machine alone: its address with a token is printed"
    in_browser = verb("app", commands.app, text, "--port 8080 --no-browser")
    in_browser.option("--port N", "to listen at (default: any free one)", kinds.whole, default=0)
    text = "to listen at (default: %(default)s, which other machines cannot reach)"
    in_browser.option("--host ADDRESS", text, default="127.0.0.1")
    in_browser.option("--no-browser", "print the address, open no browser")

    text = "the measured error of every correction, against boundary-element contacts"
    validate = verb("validate", script("validate"), text, "--output worth")
    validate.directory("asperity-validate")
    validate.notes()
    validate.option("--rows FILE", "contacts to compare with (default: the 177 shipped ones)")
    validate.option("--surface FILE", "a map of your own, pressed by boundary elements")
    validate.scan()
    text = "wavenumber of its macro-asperities [1/m]; without it peaks and IGW are left out"
    validate.option("--q0 Q", text, kinds.number)
    validate.option("--loads P,P,...", "p / (E* h') (default: those of the rows)", kinds.numbers)
    validate.option("--periodic", "the map continues at its opposite sides")
    text = "friction and area against exact sliding contact, of --surface or a shipped map"
    validate.option("--sliding", text)
    text = "rubber, pressures and velocities of --sliding (default: the shipped scene's)"
    validate.option("--rubber SCENE", text)
    text = "of --sliding [m/s] (default: SCENE's)"
    validate.option("--velocities V,V,...", text, kinds.numbers)

    text = "the article remade: its figures and table, and its statements checked"
    verb("article", script("article"), text, "--output remade").directory("asperity-article")
    return result
