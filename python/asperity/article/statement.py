"""A statement of the article, what was found, and the verdict that follows from it."""

from collections.abc import Iterable
from dataclasses import dataclass

HOLDS = "holds"
IN_PART = "holds in part"
FAILS = "does not hold"
TUNED = "tuned"
UNCHECKED = "cannot be checked"
VERDICTS = (HOLDS, IN_PART, FAILS, TUNED, UNCHECKED)


@dataclass(frozen=True)
class Statement:
    """One row of the summary."""

    name: str
    place: str  # in the article
    claim: str
    criterion: str
    found: str
    verdict: str
    reason: str


def judged(held: bool | Iterable[bool]) -> str:
    """The verdict on one test, or on several that the claim stands for together."""
    tests = [bool(held)] if not isinstance(held, Iterable) else [bool(test) for test in held]
    return HOLDS if all(tests) else IN_PART if any(tests) else FAILS


def rests_on_tuning(held: bool | Iterable[bool]) -> str:
    """The verdict where the tuned compound decides: met is only "tuned", for it was put in."""
    verdict = judged(held)
    return TUNED if verdict == HOLDS else verdict


def unchecked(name: str, place: str, claim: str, reason: str, found: str = "-") -> Statement:
    """A statement that nothing at hand can decide."""
    return Statement(name, place, claim, "-", found, UNCHECKED, reason)


def listed(values: Iterable[float], form: str = ".3g") -> str:
    """Numbers beside one another, as in "2.46, 2.02, 1.83"."""
    return ", ".join(f"{value:{form}}" for value in values)


def percent(value: float) -> str:
    """A relative difference with its sign."""
    return f"{100 * value:+.2g} %" if abs(value) >= 5e-4 else "0.0 %"
