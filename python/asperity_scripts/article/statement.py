"""The article's statements, from `statements.csv`, and the verdicts that follow from what is found.

A row has a statement and how it is judged: by a rule from tests, a `Finding` for each compound,
surface or cut-off, or by a verdict that no computation can change. Its column "found" is a text for
the numbers; what stands in brackets is written for each name.
"""

import csv
import re
import string
from collections.abc import Iterable, Mapping
from importlib.resources import files
from typing import Any

import numpy as np

HOLDS = "holds"
IN_PART = "holds in part"
FAILS = "does not hold"
TUNED = "tuned"
VERDICTS = (HOLDS, IN_PART, FAILS, TUNED, "cannot be checked", "by construction")
UNTUNED = "untuned"  # begins the name of what no printed p_T has decided


class Finding:
    """Tests that a claim stands for together, and numbers."""

    def __init__(self, *held: Any, **numbers: Any) -> None:
        self.held = [bool(test) for tests in held for test in _several(tests)]
        self.numbers = numbers


Findings = Mapping[str, Mapping[str, Finding]]  # by id and by name; "" is of all names, or the only


def judge(findings: Findings) -> list[dict[str, str]]:
    """The rows of the table, each with its verdict and, where it is tested, what is found."""
    text = (files("asperity_scripts.article") / "statements.csv").read_text(encoding="utf-8")
    rows = list(csv.DictReader(text.splitlines()))
    tested = {row["id"] for row in rows if row["criterion"]}
    if tested != set(findings):
        raise ValueError(f"statements.csv and findings differ in {tested ^ set(findings)}")
    for row in rows:
        of_row = findings.get(row["id"], {})
        row |= {"verdict": verdict(row["judged"], of_row), "found": worded(row["found"], of_row)}
    return rows


def verdict(rule: str, findings: Mapping[str, Finding]) -> str:
    """By a rule, which may be a verdict itself.

    "by tests": on all of them. "despite tuning": on which tuned and untuned inputs agree; where
    they do not, tuning decides. "by tuning": on tuned inputs; what is met was put in.
    """
    parts: dict[bool, list[bool]] = {True: [], False: []}
    for name, finding in findings.items():
        parts[name.startswith(UNTUNED)] += finding.held
    untuned, tuned = _judged(parts[True]), _judged(parts[False])
    if rule == "by tests":
        return _judged(parts[True] + parts[False])
    if rule == "despite tuning":
        return tuned if tuned == untuned else TUNED
    if rule == "by tuning":
        return TUNED if tuned == HOLDS else tuned
    return VERDICTS[VERDICTS.index(rule)]


def worded(text: str, findings: Mapping[str, Finding]) -> str:
    """The text with its numbers: "p_T: [{p:.2f}]" is "p_T: implicit: 2.46, 2.02; added: 2.46"."""
    each = re.search(r"\[(.*)\]", text)
    if each is not None:
        parts = (f"{name}: {fill(each[1], **f.numbers)}" for name, f in findings.items() if name)
        text = text.replace(each[0], "; ".join(parts))
    return fill(text, **findings[""].numbers if "" in findings else {})


def fill(text: str, **numbers: Any) -> str:
    """`str.format`, where a format beside its own is "%", a relative difference with its sign; of
    several numbers all are listed, or with "~" the smallest and the largest."""
    return _Numbers().vformat(text, (), numbers)


class _Numbers(string.Formatter):
    def format_field(self, value: Any, spec: str) -> Any:
        if spec.startswith("~"):
            ends = (min(value), max(value)) if len(value) else ()
            return " to ".join(self.format_field(end, spec[1:]) for end in ends) or "none"
        if not isinstance(value, str) and isinstance(value, Iterable):
            return ", ".join(self.format_field(each, spec) for each in value)
        if spec == "%":
            return f"{100 * value:+.2g} %" if np.abs(value) >= 5e-4 else "0.0 %"
        return format(value, spec)


def _judged(held: list[bool]) -> str:
    return HOLDS if all(held) else IN_PART if any(held) else FAILS


def _several(tests: Any) -> Iterable[Any]:
    return tests if isinstance(tests, Iterable) else [tests]
