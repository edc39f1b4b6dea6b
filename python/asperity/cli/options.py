"""Values of the shell command's options, and how a wrong one is refused."""

import argparse
import math
import sys
from argparse import ArgumentTypeError
from collections.abc import Callable
from typing import Any, NoReturn

from asperity._core import __version__
from asperity.base.arguments import brief
from asperity.cli.streams import print_stderr, print_stdout, printable
from asperity.io.fields import MOST_POINTS
from asperity.io.typed import Typed, TypedWhole


class Parser(argparse.ArgumentParser):
    """A parser that knows which stream is the result's and which may fail."""

    def error(self, message: str) -> NoReturn:
        self.exit(2, f"{self.prog}: {printable(message)} (see {self.prog} --help)\n")

    def exit(self, status: int = 0, message: str | None = None) -> NoReturn:
        print_stderr(message or "")
        sys.exit(status)

    def print_help(self, file: object = None) -> None:
        print_stdout(self.format_help())


class Version(argparse.Action):
    """Tells the version."""

    def __call__(self, parser: argparse.ArgumentParser, *_: object) -> NoReturn:
        print_stdout(f"{__version__}\n")
        parser.exit()


def numbers(text: str) -> list[float]:
    """Numbers, parted by commas."""
    try:
        return [Typed(entry) for entry in text.split(",")]
    except ValueError:
        raise ArgumentTypeError(f"{brief(text)}: must be numbers, parted by commas") from None


def keys(text: str) -> list[str]:
    """Keys, parted by commas."""
    return [entry.strip() for entry in text.split(",")]


def pairs(text: str) -> dict[str, str]:
    """Names with their values."""
    pairs = [entry.partition("=") for entry in text.split(",")]
    if not all(name and mark and value for name, mark, value in pairs):
        raise ArgumentTypeError(f"{brief(text)}: must be NAME=VALUE,NAME=VALUE")
    result = {name.strip(): value.strip() for name, _, value in pairs}
    if len(result) < len(pairs):
        raise ArgumentTypeError(f"{brief(text)}: must have each NAME once")
    return result


def prior(text: str) -> tuple[str, tuple[float | str, ...]]:
    """A key with what is known of it before."""
    key, _, given = text.partition("=")
    value, *more = given.split(",")
    try:
        if len(more) not in (1, 2) or more[1:] not in ([], ["ln"]):
            raise ValueError
        return key.strip(), (Typed(value), Typed(more[0]), *more[1:])
    except ValueError:
        form = "KEY=VALUE,DEVIATION or KEY=VALUE,DEVIATION,ln"
        raise ArgumentTypeError(f"{brief(text)}: must be {form}") from None


def number(text: str) -> float:
    """A positive number: all that the options ask for are."""
    try:
        number = Typed(text)
    except ValueError:
        number = Typed("nan")
    if not 0 < number < math.inf:
        raise ArgumentTypeError(f"{brief(text)}: must be a positive number")
    return number


def pixel_size(text: str) -> Any:
    """One number [m], or DY,DX."""
    return _one_or_two(text, number, "a positive number [m], or two: DY,DX")


def sides(text: str) -> tuple[float, float]:
    """LO,HI."""
    try:
        lo, hi = (number(side) for side in text.split(","))
    except (ArgumentTypeError, ValueError):
        raise ArgumentTypeError(f"{brief(text)}: must be two positive numbers, LO,HI") from None
    return lo, hi


def whole(text: str) -> int:
    """A whole number."""
    try:
        return TypedWhole(text)
    except ValueError:
        raise ArgumentTypeError(f"{brief(text)}: must be a whole number") from None


def points(text: str) -> int:
    """How many points a sweep has."""
    if not 2 <= (points := whole(text)) <= MOST_POINTS:
        raise ArgumentTypeError(f"{text}: must be in 2..{MOST_POINTS}")
    return points


def share(text: str) -> float:
    """A number from 0 on; more is refused by whoever takes it."""
    try:
        return Typed(text) if float(text) == 0 else number(text)
    except ValueError:
        raise ArgumentTypeError(f"{brief(text)}: must be a number, 0 or more") from None


def tile(text: str) -> Any:
    """N, or NY,NX."""
    return _one_or_two(text, whole, "a whole number, or two: NY,NX")


def _one_or_two(text: str, read: Callable[[str], Any], allowed: str) -> Any:
    try:
        sizes = tuple(read(size) for size in text.split(","))
    except ArgumentTypeError:
        sizes = ()
    if len(sizes) not in (1, 2):
        raise ArgumentTypeError(f"{brief(text)}: must be {allowed}")
    return sizes[0] if len(sizes) == 1 else sizes


def typed_options(args: argparse.Namespace) -> dict[str, Any]:
    """The numbers of options by their names, for `as_typed`."""
    values = {f"--{name.replace('_', '-')}": value for name, value in vars(args).items()}
    for option, value in list(values.items()):
        if isinstance(value, dict):  # of NAME=VALUE
            values |= {f"{option} {name}": _number_or_none(text) for name, text in value.items()}
    return values


def _number_or_none(text: str) -> float | None:
    try:
        return Typed(text)
    except ValueError:
        return None


def flags(*arguments: str) -> dict[str, str]:
    """The options of these arguments, by their names in Python."""
    return {name: f"--{name.replace('_', '-')}" for name in arguments}


def option(to: argparse.ArgumentParser, name: str, text: str, read: Any = None, **how: Any) -> None:
    """Add an option to a verb: "--name VALUE", what the help says, and what reads a value. Without
    a word for the value, and with nothing that says of which kind it is, it is a switch."""
    flag, _, value = name.partition(" ")
    if value:
        how["metavar"] = value
    if read is not None:
        how["type"] = read
    to.add_argument(flag, help=text, **(how or {"action": "store_true"}))
