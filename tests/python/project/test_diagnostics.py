"""Errors and notes are data: nothing in the package learns from their text what they mean."""

import ast
import copy
import pickle
import re
from pathlib import Path

import pytest

import asperity
from asperity.base.codes import ERRORS, KINDS, NOTE, NOTES, WARNING
from asperity.base.diagnostics import (
    MUST_BE,
    Advice,
    Argument,
    InvalidInput,
    Note,
    Value,
    fatal_first,
    few_lines,
    first_step,
    refusal,
)
from helpers.cases import case
from helpers.extensions import extension

ROOT = Path(__file__).parents[3]
CORE = sorted((ROOT / "cpp/src").rglob("*.?pp"))
PYTHON = sorted((ROOT / "python").rglob("*.py"))
TEXTS = {"error", "note", "problem", "message", "warning"}  # names of what has a text
LOOKS = {"startswith", "endswith", "find", "replace", "removeprefix", "removesuffix", "split"}
OF_RE = {"search", "match", "fullmatch", "sub", "findall", "finditer"}


def is_text(node: ast.AST) -> bool:
    """Whether an expression is the text of an error or a note, by the names that these have."""
    match node:
        case ast.Name(id=name):
            return name in TEXTS
        case ast.Call(func=ast.Name(id="str"), args=[inner]):
            return is_text(inner)
        case ast.Attribute(attr="args", value=inner) | ast.Subscript(value=inner):
            return is_text(inner)
    return False


def readings(tree: ast.AST) -> list[str]:
    """Where code looks into the text of an error or a note."""
    found = []
    for node in ast.walk(tree):
        match node:
            case ast.Call(func=ast.Attribute(attr=verb, value=owner)) if verb in LOOKS:
                guilty = is_text(owner)
            case ast.Call(func=ast.Attribute(attr=verb), args=args) if verb in OF_RE:
                guilty = any(map(is_text, args))
            case ast.Compare(ops=[ast.In() | ast.NotIn()], comparators=[right]):
                guilty = is_text(right)
            case ast.Subscript(value=ast.Attribute(attr="args")):
                guilty = is_text(node)
            case ast.Constant(value=str(text)):
                guilty = text.startswith("fatal: ")
            case _:
                guilty = False
        if guilty:
            found.append(ast.unparse(node))
    return found


@pytest.mark.parametrize(
    "code",
    [
        "str(error).startswith('a')",
        "'a' in str(error)",
        "error.args[0]",
        "re.sub('a', 'b', str(error))",
        "note.removeprefix('fatal: ')",
        "message.replace('a', 'b')",
    ],
)
def test_a_reading_is_found(code: str) -> None:
    assert readings(ast.parse(code))


def test_no_module_reads_meaning_out_of_a_text() -> None:
    # one-line texts for people are made of an error's text by splitting it at its white space
    allowed = {"str(error).split()", "str(problem).split()"}
    for path in PYTHON:
        with case(file=path.name):
            assert set(readings(ast.parse(path.read_text(encoding="utf-8")))) <= allowed


def codes_of_core() -> dict[str, str]:
    """The codes of the core's notes with their severity."""
    found = {}
    for path in CORE:
        text = path.read_text(encoding="utf-8")
        found |= {b: a for a, b in re.findall(r'\b(note|warning|fatal)\(\s*"([a-z0-9-]+)"', text)}
        found |= dict.fromkeys(re.findall(r'"(regime-\w+)"', text), "note")
    return found


def test_every_code_is_in_the_table_and_every_row_is_used() -> None:
    core = codes_of_core()
    assert {code: NOTES[code][0] for code in core} == core
    texts = [path.read_text(encoding="utf-8") for path in (*PYTHON, *CORE)]
    written = {code for text in texts for code in re.findall(r'"([a-z]+[a-z0-9-]*)"', text)}
    assert {*NOTES, *ERRORS} <= written
    python = {code for text in texts for code in re.findall(r'code="([a-z0-9-]+)"', text)}
    assert python <= {*NOTES, *ERRORS}
    thrown = {
        c for t in texts for c in re.findall(r'Sentence sentence, std::string code = "(.+?)"', t)
    }
    assert thrown <= {*ERRORS}


def test_every_note_to_act_on_says_how_at_one_place() -> None:
    steps_of_core = extension("note_steps").steps_of_core()
    to_act_on = {code for code, kind in KINDS.items() if kind.severity != NOTE}
    of_package = {code for code, kind in KINDS.items() if kind.next_step}
    assert of_package | steps_of_core.keys() >= to_act_on
    assert of_package & steps_of_core.keys() == set()
    assert of_package <= to_act_on
    assert all(Note("a", code=code).next_step == KINDS[code].next_step for code in of_package)
    assert steps_of_core["few-periods"] == "measure a longer scan, or merge several"
    assert steps_of_core["area-further-off"] == "NayakSFactor"


def test_a_few_lines_tell_what_matters_most() -> None:
    small = Note("small", code="few-periods", effect=0.01, next_step="merge scans")
    large = Note("large", code="few-long-waves", effect=0.3, next_step="scan a metre")
    worst = Note("worst", code="small-friction")
    others = [Note(f"row {i}", code="point-off-curve") for i in range(9)]
    notes = [small, *others, large]
    assert first_step(notes) == "scan a metre (few-long-waves)"
    assert first_step([*notes, worst]).endswith("(small-friction)")
    assert first_step(others) == ""
    assert few_lines(notes, 5) == [
        "note: large -> scan a metre",
        "note: small -> merge scans",
        "note: row 0 (and 8 alike)",
        "next: scan a metre (few-long-waves)",
    ]
    kinds = [Note(code, code=code) for code, kind in KINDS.items() if kind.severity == WARNING]
    lines = few_lines([*kinds, worst, *others], 5)
    assert len(lines) == 5
    assert lines[0].startswith("note: fatal: worst")
    assert f"{len(kinds) + 7} more ({len(kinds) - 2} warning, 9 note)" in lines[3]


def test_errors_have_fields_and_keep_them() -> None:
    road = asperity.SelfAffineSpectrum(rms_height=1e-4, hurst=0.8, q0=2e3, q1=1e6)
    curve = asperity.MasterCurve(
        angular_frequency=[1, 1e3], storage_modulus=[1e6, 2e6], loss_modulus=[1e5, 2e5]
    )
    calls = [
        (lambda: asperity.friction(road, curve, pressure=-1.0, velocity=1.0), "invalid-value"),
        (lambda: asperity.friction(road, curve, pressure=1e5, velocity=1.0), "unknown-modulus"),
        (lambda: asperity.friction(road, curve, pressure="a", velocity=1.0), "invalid-value"),
    ]
    found = [("pressure", -1.0, "positive and finite"), ("velocity", 1.0, "")]
    found.append(("pressure", "'a'", "a number or an array of real numbers"))
    for (call, code), (argument, value, allowed) in zip(calls, found, strict=True):
        with pytest.raises(asperity.Error) as caught:
            call()
        for error in (
            caught.value,
            pickle.loads(pickle.dumps(caught.value)),
            copy.copy(caught.value),
        ):
            assert (error.code, error.argument) == (code, argument)
            assert (error.value, error.allowed) == (value, allowed)
            assert str(error) == str(caught.value)
            assert error.sentence == caught.value.sentence
            assert error.identity == (code, argument)


def test_notes_are_texts_with_fields_and_keep_them() -> None:
    road = asperity.SelfAffineSpectrum(rms_height=5e-4, hurst=0.8, q0=2e3, q1=1e7)
    rubber = asperity.PronySeries(equilibrium_modulus=3e6, moduli=[1e8], relaxation_times=[1e-4])
    result = asperity.friction(road, rubber, pressure=1e5, velocity=[1e-4, 1e-2, 1.0])
    assert [note.code for note in result.notes] == [
        "large-friction",
        "steep-spectrum",
        "no-correction",
        "heat-left-out",
    ]
    assert [note.severity for note in result.notes] == ["fatal", *["warning"] * 3]
    assert all(note.next_step for note in result.notes)
    large, steep, *_ = result.notes
    assert str(large).startswith("fatal: mu reaches ")
    assert large.value == result.mu.max()
    assert (steep.argument, steep.value) == ("q1", road.rms_slope)
    for notes in (pickle.loads(pickle.dumps(result)).notes, copy.deepcopy(result).notes):
        assert notes == result.notes
        assert [vars(note) for note in notes] == [vars(note) for note in result.notes]
    assert large.within("one.toml: ") == large.replace("fatal: ", "fatal: one.toml: ")
    assert Note.of_line(steep.line).identity == steep.identity
    assert Note.of_line(large.line) == large
    assert fatal_first([steep, large, steep]) == [large, steep]


def test_a_sentence_is_said_in_other_words() -> None:
    error = refusal("pressure", -1.0, "positive").within("here: ").followed_by("; there")
    assert str(error) == "here: pressure = -1.0: must be positive; there"
    again = error.said(lambda s: tuple(p.saying("p") if isinstance(p, Argument) else p for p in s))
    assert str(again) == "here: p = -1.0: must be positive; there"
    assert (again.argument, again.value, again.allowed) == ("p", -1.0, "positive")
    advised = InvalidInput(Argument("q"), " = ", Value("1", (1.0,)), MUST_BE, "2", Advice("; x"))
    assert (advised.value, advised.allowed) == (1.0, "2")
