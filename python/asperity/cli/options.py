"""Values of the shell command's options, and how a wrong one is refused."""

import argparse
import math
import sys
from argparse import ArgumentTypeError
from collections.abc import Callable, Iterable
from contextlib import suppress
from typing import Any, NoReturn, TypeVar

from asperity._core import __version__
from asperity.base.arguments import brief
from asperity.base.diagnostics import Argument, InvalidInput, must_be
from asperity.cli.streams import print_stderr, print_stdout, printable
from asperity.draw.style import STYLES
from asperity.io.fields import MOST_POINTS
from asperity.io.typed import Typed, TypedWhole

Value = TypeVar("Value")


class Parser(argparse.ArgumentParser):
    """A parser that knows which stream is the result's and which may fail, and the options that
    verbs share."""

    def error(self, message: str) -> NoReturn:
        self.exit(2, f"{self.prog}: {printable(message)} (see {self.prog} --help)\n")

    def exit(self, status: int = 0, message: str | None = None) -> NoReturn:
        print_stderr(message or "")
        sys.exit(status)

    def print_help(self, file: object = None) -> None:
        print_stdout(self.format_help())

    def option(self, name: str, text: str, kind: Any = None, **how: Any) -> None:
        """Add an option: "--name VALUE", what the help says, and the choices of a value or what
        reads one. With none of these it is a switch. The help tells a default that it lacks."""
        flag, _, value = name.partition(" ")
        if value:
            how["metavar"] = value
        if kind is not None:
            how["choices" if isinstance(kind, tuple) else "type"] = kind
        if how.get("default") and "default" not in text:
            text += " (default: %(default)s)"
        self.add_argument(flag, help=text, **(how or {"action": "store_true"}))

    def style(self) -> None:
        text = "of pictures: print (default), single for one of two columns, dark for screens"
        self.option("--style", text, STYLES)

    def pictures(self) -> None:
        self.option("--plot PICTURE", "draw it, .png, .svg or .pdf")
        self.style()

    def notes(self) -> None:
        text = "on the terminal: the gravest, alike ones joined (default), or all of them"
        self.option("--notes", text, ("few", "all"), default="few")

    def outputs(self) -> None:
        self.option("--output FILE", "where to write (default: the terminal)")
        self.pictures()
        self.notes()
        self.option("--json", "write JSON instead of CSV")

    def directory(self, default: str) -> None:
        self.option("--output DIR", "directory", default=default)
        self.option("--force", "replace the files of an earlier run there")
        self.style()

    def scan(self, channel: int | None = None, detrend: str | None = None) -> None:
        self.option("--pixel-size DY,DX", "[m], where the file states none", pixel_size)
        self.option("--unit UNIT", "of the heights (m, mm, um, nm, pm), where the file states none")
        self.option("--channel", "of a file with several maps (default: 0)", whole, default=channel)
        text = "what is taken off the heights first (default: plane)"
        self.option("--detrend", text, ("plane", "quadratic", "offset", "none"), default=detrend)


class Version(argparse.Action):
    def __call__(self, parser: argparse.ArgumentParser, *_: object) -> NoReturn:
        print_stdout(f"{__version__}\n")
        parser.exit()


def _must_be(allowed: str) -> Callable[[Callable[[str], Value]], Callable[[str], Value]]:
    """Let what reads the text of an option refuse it where it raises ValueError."""

    def refusing(read: Callable[[str], Value]) -> Callable[[str], Value]:
        def value(text: str) -> Value:
            try:
                return read(text)
            except (ArgumentTypeError, ValueError):
                raise ArgumentTypeError(f"{brief(text)}: must be {allowed}") from None

        return value

    return refusing


@_must_be("numbers, parted by commas")
def numbers(text: str) -> list[float]:
    return [Typed(entry) for entry in text.split(",")]


def keys(text: str) -> list[str]:
    return [entry.strip() for entry in text.split(",")]


@_must_be("NAME=VALUE,NAME=VALUE, with each NAME once")
def pairs(text: str) -> dict[str, str]:
    parts = [entry.partition("=") for entry in text.split(",")]
    result = {name.strip(): value.strip() for name, _, value in parts}
    if not all(map(all, parts)) or len(result) < len(parts):
        raise ValueError
    return result


@_must_be("KEY=VALUE,DEVIATION or KEY=VALUE,DEVIATION,ln")
def prior(text: str) -> tuple[str, tuple[float | str, ...]]:
    key, _, given = text.partition("=")
    value, deviation, *scale = given.split(",")
    if scale not in ([], ["ln"]):
        raise ValueError
    return key.strip(), (Typed(value), Typed(deviation), *scale)


@_must_be("a positive number")
def number(text: str) -> float:
    number = Typed(text)
    if not 0 < number < math.inf:
        raise ValueError
    return number


@_must_be("two positive numbers, LO,HI")
def sides(text: str) -> tuple[float, float]:
    lo, hi = map(number, text.split(","))
    return lo, hi


@_must_be("a whole number")
def whole(text: str) -> int:
    return TypedWhole(text)


@_must_be(f"a whole number in 2..{MOST_POINTS}")
def points(text: str) -> int:
    if not 2 <= (points := whole(text)) <= MOST_POINTS:
        raise ValueError
    return points


@_must_be("a number, 0 or more")
def share(text: str) -> float:
    """A number from 0 on; more is refused by whoever takes it."""
    return Typed(text) if float(text) == 0 else number(text)


@_must_be("a positive number [m], or two: DY,DX")
def pixel_size(text: str) -> Any:
    return _one_or_two(map(number, text.split(",")))


@_must_be("a whole number, or two: NY,NX")
def tile(text: str) -> Any:
    return _one_or_two(map(whole, text.split(",")))


def _one_or_two(numbers: Iterable[Any]) -> Any:
    first, *second = numbers
    if len(second) > 1:
        raise ValueError
    return (first, *second) if second else first


def typed_options(args: argparse.Namespace) -> dict[str, Any]:
    """The numbers of options by their names, for `as_typed`."""
    values = {f"--{name.replace('_', '-')}": value for name, value in vars(args).items()}
    for option, value in list(values.items()):
        if isinstance(value, dict):  # of NAME=VALUE
            values |= {f"{option} {name}": _number_or_none(text) for name, text in value.items()}
    return values


def _number_or_none(text: str) -> float | None:
    with suppress(ValueError):
        return Typed(text)
    return None


def flags(*arguments: str) -> dict[str, str]:
    """The options of these arguments, by their names in Python."""
    return {name: f"--{name.replace('_', '-')}" for name in arguments}


def list_used(args: argparse.Namespace, options: str) -> list[str]:
    """Those of some options that a command has, as they are typed."""
    values = typed_options(args)
    flags = [f"--{name}" for name in options.split()]
    return [flag for flag in flags if values[flag] not in (None, {}) and values[flag] is not False]


def goes_with(args: argparse.Namespace, options: str, others: str) -> None:
    """Refuse each of some options where none of the others, with which they go, is used."""
    used = list_used(args, options)
    if used and not list_used(args, others):
        beside = " or ".join(f"--{name}" for name in others.split())
        raise InvalidInput(Argument(used[0]), f": goes with {beside}")


def exclusive(args: argparse.Namespace, options: str) -> None:
    used = list_used(args, options)
    if len(used) > 1:
        raise must_be("", "one of them", ", ".join(used))
