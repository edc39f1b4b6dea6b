"""`export_fmu` and the command `fmu`: what they refuse, and what they tell."""

from pathlib import Path

import pytest
from fmpy.validation import validate_fmu

from asperity import InvalidInput, export_fmu
from asperity.cli import main

ROOT = Path(__file__).parents[3]


@pytest.mark.parametrize(
    ("argument", "value"),
    [
        ("map", 3),
        ("name", "my road"),
        ("name", ""),
        ("fmi", "1.0"),
        ("points", 0),
        ("points", 2.5),
        ("path", "missing/road.fmu"),
        ("path", "."),
    ],
)
def test_bad_input_is_refused_and_writes_nothing(road, tmp_path, monkeypatch, argument, value):
    monkeypatch.chdir(tmp_path)
    with pytest.raises(InvalidInput) as refused:
        export_fmu(**{"map": road, "path": "road.fmu", argument: value})
    assert refused.value.argument == ("" if argument == "path" else argument)
    assert list(tmp_path.iterdir()) == []


def test_command(road, tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    road.save("road.fmap")
    assert main(["fmu", "road.fmap", "--output", "road.fmu", "--fmi", "3.0"]) == 0
    assert "binaries = " in capsys.readouterr().out
    assert validate_fmu("road.fmu") == []
