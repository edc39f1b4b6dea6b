"""Notes of several temperatures and files, as the shell, reports and tables tell them."""

from pathlib import Path
from types import SimpleNamespace

from asperity.base.diagnostics import Note
from asperity.scene.results import notes_of_all


def note(text):
    """One whose code is its first words."""
    return Note(text, code="-".join(text.split()[:2]))


def told(*said):
    """What is told of scenes, each a file, a temperature, notes of its inputs and of its curve."""
    scenes = [
        SimpleNamespace(path=Path(file), notes=[*map(note, inputs)], place_text=at)
        for file, at, inputs, _ in said
    ]
    curves = [SimpleNamespace(notes=[*map(note, [*one, *more])]) for _, _, one, more in said]
    return notes_of_all(scenes, curves)


def test_notes_of_inputs_are_told_once_whatever_their_numbers():
    assert told(
        ("a.toml", "5 °C", ["off by 0.3 at 300 K"], []),
        ("a.toml", "20 °C", ["off by -1.4e-2 at 310 K"], []),
        ("a.toml", "40 °C", ["off by 0.2 at 300 K"], []),
    ) == ["5 °C (alike at 2 others): off by 0.3 at 300 K"]
    assert told(("a.toml", "5 °C", ["off by 1"], []), ("a.toml", "20 °C", ["off by 2"], [])) == [
        "5 °C (alike at 1 other): off by 1"
    ]


def test_notes_of_curves_are_told_with_all_their_numbers():
    assert told(
        ("a.toml", "5 °C", ["rough"], ["guessed from 1 m/s"]),
        ("a.toml", "20 °C", ["rough"], ["guessed from 2 m/s", "no contact"]),
    ) == [
        "fatal: 20 °C: no contact",
        "rough",
        "5 °C: guessed from 1 m/s",
        "20 °C: guessed from 2 m/s",
    ]


def test_notes_of_several_files_name_them():
    assert told(
        ("a.toml", "5 °C", ["off by 1", "smooth"], []),
        ("a.toml", "20 °C", ["off by 2"], []),
        ("b.toml", "5 °C", ["off by 3", "smooth"], []),
    ) == [
        "a.toml, 5 °C (alike at 1 other): off by 1",
        "a.toml, 5 °C, b.toml: smooth",
        "b.toml: off by 3",
    ]
