"""The shell command `asperity`: its arguments and its exit status."""

import argparse
import codecs
import io
import json
import math
import os
import sys
from argparse import ArgumentTypeError
from collections.abc import Callable, Sequence
from contextlib import suppress
from typing import NoReturn

from asperity import commands, rubber_command
from asperity._core import Error, InvalidInput, OutOfRange, __version__
from asperity.fields import MOST_POINTS
from asperity.validation import command as validation


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the shell command; the exit status is 0, 2 for bad input, 1 for any other failure."""
    if isinstance(sys.stdout, io.TextIOWrapper):
        sys.stdout.reconfigure(errors=_ESCAPE)
    args = _parser().parse_args(arguments)
    try:
        args.run(args)
    except (InvalidInput, OutOfRange) as error:
        return _fail(error, 2)
    except BrokenPipeError:  # the reader of our output has gone
        _drop_stdout()
        return 1
    except OSError as error:
        _drop_stdout()
        named = "" if error.filename is None else f"{error.filename}: "
        return _fail(f"{named}{error.strerror or error}", 1)
    except MemoryError as error:
        return _fail(f"out of memory: {error}" if str(error) else "out of memory", 1)
    except Error as error:
        return _fail(error, 1)
    except KeyboardInterrupt:
        return _fail("interrupted", 130)
    return 0


def _fail(problem: object, status: int) -> int:
    print("asperity:", " ".join(str(problem).split()), file=sys.stderr)
    return status


def _drop_stdout() -> None:
    """Let what stdout still holds go nowhere, or Python's exit would try to write it again."""
    with suppress(OSError):
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())


def _escaped(error: UnicodeError) -> tuple[str, int]:
    """What an output cannot encode, in file names say, as JSON writes it in ASCII."""
    if not isinstance(error, UnicodeEncodeError):
        raise error
    return json.dumps(error.object[error.start : error.end])[1:-1], error.end


_ESCAPE = "asperity.escape"
codecs.register_error(_ESCAPE, _escaped)


class _Parser(argparse.ArgumentParser):
    def error(self, message: str) -> NoReturn:
        self.exit(2, f"{self.prog}: {message} (see {self.prog} --help)\n")


def _numbers(text: str) -> list[float]:
    try:
        return [float(entry) for entry in text.split(",")]
    except ValueError:
        raise ArgumentTypeError(f"{text!r}: must be numbers, parted by commas") from None


def _pairs(text: str) -> dict[str, str]:
    pairs = [entry.partition("=") for entry in text.split(",")]
    if not all(name and mark and value for name, mark, value in pairs):
        raise ArgumentTypeError(f"{text!r}: must be NAME=VALUE,NAME=VALUE")
    return {name.strip(): value.strip() for name, _, value in pairs}


def _number(text: str) -> float:
    """A positive number: all that the options ask for are."""
    try:
        number = float(text)
    except ValueError:
        number = math.nan
    if not 0 < number < math.inf:
        raise ArgumentTypeError(f"{text!r}: must be a positive number")
    return number


def _pixel_size(text: str) -> float | tuple[float, float]:
    try:
        sizes = [_number(size) for size in text.split(",")]
        if len(sizes) == 1:
            return sizes[0]
        dy, dx = sizes
    except (ArgumentTypeError, ValueError):
        raise ArgumentTypeError(f"{text!r}: must be a positive number [m], or two: DY,DX") from None
    return dy, dx


def _whole(text: str) -> int:
    try:
        return int(text)
    except ValueError:
        raise ArgumentTypeError(f"{text!r}: must be a whole number") from None


def _points(text: str) -> int:
    if not 2 <= (points := _whole(text)) <= MOST_POINTS:
        raise ArgumentTypeError(f"{text}: must be in 2..{MOST_POINTS}")
    return points


def _parser() -> argparse.ArgumentParser:
    parser = _Parser(
        prog="asperity", description="Rubber contact area and friction on rough surfaces."
    )
    parser.add_argument("--version", action="version", version=__version__)
    verbs = parser.add_subparsers(required=True, metavar="VERB")

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

    demo = verb(
        "demo", commands.demo, "friction of rubber on a shipped asphalt scan", "--output tryout"
    )
    demo.add_argument(
        "--output", metavar="DIR", default="asperity-demo", help="directory (default: %(default)s)"
    )

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
        type=_points,
        default=200,
        help="wavenumbers, logarithmic (default: %(default)s)",
    )
    outputs(area)

    spectrum = verb(
        "spectrum",
        commands.spectrum,
        "roughness spectrum of a scan, with rms height, rms slope and a self-affine fit",
        "scan.npy --pixel-size 2e-6,1e-6 --unit um --detrend quadratic --plot spectrum.png",
    )
    spectrum.add_argument("file", metavar="FILE")
    spectrum.add_argument(
        "--pixel-size", type=_pixel_size, metavar="DY,DX", help="[m], where the file states none"
    )
    spectrum.add_argument(
        "--unit",
        metavar="UNIT",
        help="of the heights (m, mm, um, nm, pm), where the file states none",
    )
    spectrum.add_argument(
        "--channel",
        type=_whole,
        default=0,
        help="of a file with several maps (default: %(default)s)",
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
    spectrum.add_argument(
        "--max-dropouts",
        type=_number,
        default=0.10,
        metavar="SHARE",
        help="refuse a scan with more of its points missing (default: %(default)s)",
    )
    spectrum.add_argument(
        "--q-min", type=_number, metavar="Q", help="fit above [1/m] (default: what is reliable)"
    )
    spectrum.add_argument(
        "--q-max", type=_number, metavar="Q", help="fit below [1/m] (default: what is reliable)"
    )
    spectrum.add_argument(
        "--method",
        choices=("least-squares", "slope"),
        default="least-squares",
        help="of the fit: weighted, with a roll-off where there is one, or Eq. 28 alone "
        "(default: %(default)s)",
    )
    outputs(spectrum)

    rubber = verb(
        "rubber",
        rubber_command.rubber,
        "master curve, shift factors and Prony series of DMA isotherms",
        "dma.csv --columns frequency=f,temperature=T,storage=G1,loss=G2 "
        "--units frequency=Hz,temperature=C,modulus=MPa --modulus G --plot rubber.png",
    )
    rubber.add_argument("file", metavar="FILE", nargs="+")
    rubber.add_argument(
        "--columns",
        type=_pairs,
        required=True,
        metavar="NAME=COLUMN,...",
        help="names in the files of frequency, temperature, storage, loss",
    )
    rubber.add_argument(
        "--units",
        type=_pairs,
        required=True,
        metavar="NAME=UNIT,...",
        help="frequency=Hz or rad/s, temperature=K or C, modulus=Pa, kPa, MPa or GPa",
    )
    rubber.add_argument(
        "--modulus", choices=("E", "G"), required=True, help="Young's or shear moduli"
    )
    rubber.add_argument(
        "--poisson-ratio",
        type=_number,
        default=0.5,
        metavar="NU",
        help="for E = 2 (1 + nu) G (default: %(default)s)",
    )
    rubber.add_argument(
        "--temperatures",
        type=_numbers,
        metavar="T,T,...",
        help="one for each file, where the files have no column of them",
    )
    rubber.add_argument(
        "--reference-temperature",
        type=_number,
        metavar="T",
        help="[K] (default: that of the middle isotherm)",
    )
    rubber.add_argument(
        "--vertical-shift", choices=("T/T_ref",), help="divide moduli by b_T (default: none)"
    )
    rubber.add_argument(
        "--shift", metavar="FILE", help="take a_T from a table, temperature_k,log10_a_t"
    )
    outputs(rubber)
    validate = verb(
        "validate",
        validation.validate,
        "the measured error of every correction, against boundary-element contacts",
        "--output worth",
    )
    validate.add_argument(
        "--output",
        metavar="DIR",
        default="asperity-validate",
        help="directory (default: %(default)s)",
    )
    validate.add_argument(
        "--rows", metavar="FILE", help="contacts to compare with (default: the 177 shipped ones)"
    )
    return parser
