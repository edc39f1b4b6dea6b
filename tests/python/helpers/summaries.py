"""Statements of an article's summary.md by their ids, and what makes two of them the same."""

import re
from pathlib import Path

ROOT = Path(__file__).parents[3]
PUBLISHED = (ROOT / "docs/article/summary.md").read_text(encoding="utf-8")
TESTED = ("id", "place", "statement", "criterion", "found", "verdict", "reason")
UNTESTED = ("id", "place", "statement", "verdict", "reason")
NUMBER = re.compile(r"(?<![\w.])[-+]?\d+(?:\.\d+)?(?:e[-+]?\d+)?")
# What lies far below the tolerance of the solver is rounding, which is another on another machine.
NOISE = 1e-10


def statements(summary: str) -> dict[str, dict[str, str]]:
    """Rows of a summary by their ids."""
    result = {}
    for line in summary.splitlines():
        cells = [cell.strip() for cell in re.split(r"(?<!\\)\|", line)[1:-1]]
        if cells and re.fullmatch(r"[A-Z]\d+", cells[0]):
            names = TESTED if len(cells) == len(TESTED) else UNTESTED
            result[cells[0]] = dict(zip(names, cells, strict=True))
    return result


def same(one: str, other: str) -> bool:
    """The same words, and the same numbers but for one unit of the last digit that is printed."""
    pairs = zip(NUMBER.findall(one), NUMBER.findall(other), strict=False)
    return NUMBER.sub("#", one) == NUMBER.sub("#", other) and all(near(a, b) for a, b in pairs)


def near(one: str, other: str) -> bool:
    # 1.001: the difference of two decimal numbers is not exactly a unit
    slack = 1.001 * max(unit(one), unit(other), NOISE)
    return abs(float(one) - float(other)) <= slack


def unit(number: str) -> float:
    """One in the last digit: 0.01 of 2.46, 1e-8 of 9.4e-07."""
    mantissa, _, exponent = number.partition("e")
    return float(10.0 ** (int(exponent or 0) - len(mantissa.partition(".")[2])))
