"""The shell command `asperity`: its arguments and its exit status."""

import argparse
import os
import sys
from collections.abc import Callable, Sequence
from typing import NoReturn

from asperity import commands
from asperity._core import Error, InvalidInput, OutOfRange, __version__


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the shell command; the exit status is 0, 2 for bad input, 1 for any other failure."""
    args = _parser().parse_args(arguments)
    try:
        args.run(args)
    except (InvalidInput, OutOfRange) as error:
        return _fail(error, 2)
    except BrokenPipeError:  # the reader of our output has gone; nor may Python's exit write to it
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        return 1
    except (Error, OSError) as error:
        return _fail(error, 1)
    return 0


def _fail(error: Exception, status: int) -> int:
    print("asperity:", " ".join(str(error).split()), file=sys.stderr)
    return status


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
