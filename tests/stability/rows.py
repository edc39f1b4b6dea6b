"""A row of the catalogue, and what the naive and our method come to in it."""

import math
import warnings
from collections.abc import Callable, Iterable
from dataclasses import dataclass
from typing import Any

Method = Callable[[], Any]
Case = tuple[Method, Method, Any]  # naive, ours, truth: a number, or the error that must be raised


@dataclass(frozen=True)
class Row:
    regime: str
    reason: str
    naive: str
    truth: str
    allowed: float  # relative error of ours
    fails: float  # least relative error of the naive method
    cases: Callable[[], Iterable[Case]]


@dataclass(frozen=True)
class Outcome:
    """The worst relative errors over the cases of a row; a word where there is no number."""

    naive: float | str
    ours: float | str
    refused: str | None  # the error that had to be raised

    def holds(self, row: Row) -> bool:
        if self.refused is not None:
            return self.ours == self.refused
        return isinstance(self.ours, float) and self.ours <= row.allowed

    def naive_fails(self, row: Row) -> bool:
        return isinstance(self.naive, str) or self.naive >= row.fails


ROWS: list[Row] = []


def row(
    regime: str, reason: str, *, naive: str, truth: str, allowed: float = 1e-12, fails: float = 1e-3
) -> Callable[[Callable[[], Iterable[Case]]], None]:
    """Enters what follows as a row."""

    def enter(cases: Callable[[], Iterable[Case]]) -> None:
        ROWS.append(Row(regime, reason, naive, truth, allowed, fails, cases))

    return enter


def error(method: Method, truth: Any) -> float | str:
    """Relative error (absolute of a 0), or what came instead of a number."""
    try:
        value = method()
    except Exception as exception:  # whatever a naive method ends in is its figure
        return type(exception).__name__
    if truth is None or isinstance(truth, type):
        return f"{float(value):.3g}"
    distance = abs(value - truth)
    if not math.isfinite(distance):
        return "nan" if math.isnan(distance) else "inf"
    return float(distance / abs(truth)) if truth else float(distance)


def worst(errors: list[float | str]) -> float | str:
    words = [e for e in errors if isinstance(e, str)]
    return words[0] if words else max(e for e in errors if isinstance(e, float))


def outcome(entry: Row) -> Outcome:
    naive, ours, refused = [], [], None
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # NumPy's and SciPy's of the naive methods
        for first, second, truth in entry.cases():
            naive.append(error(first, truth))
            ours.append(error(second, truth))
            if isinstance(truth, type):
                refused = truth.__name__
    return Outcome(worst(naive), worst(ours), refused)
