"""A statement of the article, what was found, and the verdict that follows from it."""

from collections.abc import Iterable, Mapping
from dataclasses import dataclass

from asperity.article.inputs import UNTUNED

HOLDS = "holds"
IN_PART = "holds in part"
FAILS = "does not hold"
TUNED = "tuned"
UNCHECKED = "cannot be checked"
BY_CONSTRUCTION = "by construction"
VERDICTS = (HOLDS, IN_PART, FAILS, TUNED, UNCHECKED, BY_CONSTRUCTION)
Held = bool | Iterable[bool]


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


def judged(held: Held) -> str:
    """The verdict on one test, or on several that the claim stands for together."""
    tests = _tests(held)
    return HOLDS if all(tests) else IN_PART if any(tests) else FAILS


def by_construction(held: Held) -> str:
    """The verdict where the equations in use, or how inputs were made, leave no other outcome: what
    is met is a check of the code."""
    verdict = judged(held)
    return BY_CONSTRUCTION if verdict == HOLDS else verdict


def rests_on_tuning(held: Held) -> str:
    """The verdict where tuned inputs decide: what is met is only "tuned", for it was put in."""
    verdict = judged(held)
    return TUNED if verdict == HOLDS else verdict


def despite_tuning(held: Mapping[str, Held]) -> str:
    """The verdict that tuned and untuned inputs agree on; where they do not, tuning decides.

    Tests by the names of `Inputs.compounds` or `Inputs.models`; readings are parts of a claim.
    """
    tuned, untuned = (
        judged(
            [t for name, tests in held.items() if _untuned(name) is which for t in _tests(tests)]
        )
        for which in (False, True)
    )
    return tuned if tuned == untuned else TUNED


def unchecked(name: str, place: str, claim: str, reason: str, found: str = "-") -> Statement:
    """A statement that nothing at hand can decide."""
    return Statement(name, place, claim, "-", found, UNCHECKED, reason)


def listed(values: Iterable[float], form: str = ".3g") -> str:
    """Numbers beside one another, as in "2.46, 2.02, 1.83"."""
    return ", ".join(f"{value:{form}}" for value in values)


def by_name(values: Mapping[str, Iterable[float]], form: str = ".3g") -> str:
    """The same of several, as in "implicit: 2.46, 2.02; added: 2.46, 2.02"."""
    return "; ".join(f"{name}: {listed(numbers, form)}" for name, numbers in values.items())


def percent(value: float) -> str:
    """A relative difference with its sign."""
    return f"{100 * value:+.2g} %" if abs(value) >= 5e-4 else "0.0 %"


def _untuned(name: str) -> bool:
    return name.startswith(UNTUNED)


def _tests(held: Held) -> list[bool]:
    return [bool(test) for test in held] if isinstance(held, Iterable) else [bool(held)]
