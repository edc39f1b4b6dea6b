"""`export_fmu` and the command `fmu`: what they refuse, and what they tell."""

import shutil
import zipfile
from pathlib import Path

import fmpy
import pytest
from fmpy.validation import validate_fmu

from asperity import InvalidInput, export_fmu
from asperity.cli import main
from asperity.fmu import export
from helpers.shell import status_of

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


def test_an_fmu_says_what_is_inside(road, tmp_path, monkeypatch, capsys):
    """A package that was built without mingw has the Linux binary alone, one elsewhere none."""
    package = tmp_path / "package"
    shutil.copytree(export._FILES, package)
    monkeypatch.setattr(export, "_FILES", package)
    road.save(tmp_path / "road.fmap")
    listed = {"x86_64-linux": "linux64", "x86_64-windows": "win64"}
    for platform in listed:
        (package / "binaries" / platform).mkdir(parents=True, exist_ok=True)
        name = f"friction{export.PLATFORMS[platform][1]}"
        (package / "binaries" / platform / name).write_bytes(b"a library")
    for gone in (None, *reversed(listed)):
        if gone is not None:
            shutil.rmtree(package / "binaries" / gone)
        inside = export.platforms()
        output = tmp_path / f"{len(inside)}.fmu"
        assert main(["fmu", str(tmp_path / "road.fmap"), "--output", str(output)]) == 0
        told = f"binaries = {', '.join(inside) or 'none'}\n"
        if missing := [one for one in listed if one not in inside]:
            told += f"from source alone = {', '.join(missing)}\n"
        assert capsys.readouterr().out == told
        with zipfile.ZipFile(output) as archive:
            names = archive.namelist()
        folders = {name.split("/")[1] for name in names if name.startswith("binaries/")}
        assert folders == {listed[one] for one in inside}
        assert "sources/fmu.cpp" in names
        described = fmpy.read_model_description(str(output)).description
        words = f"binaries for {' and '.join(inside)}, " if inside else ""
        assert described.endswith(f"certified map; {words}source for any platform")
    assert len(inside) == 0


def test_command(road, tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    road.save("road.fmap")
    assert main(["fmu", "road.fmap", "--output", "road.fmu", "--fmi", "3.0"]) == 0
    assert "binaries = " in capsys.readouterr().out
    assert validate_fmu("road.fmu") == []


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (["no.fmap", "--output", "no.fmu"], "no.fmap: is no friction map"),
        (["road.fmap", "--output", "no.fmu", "--name", "1"], "--name = '1'"),
        (["road.fmap", "--output", "road.fmap"], "road.fmap: is an input"),
        (["other.fmap", "--output", "no.fmu"], "other.fmap: has layout version 3"),
        (["road.fmap", "--output", "no.fmu", "--fmi", "1"], "invalid choice: '1'"),
    ],
)
def test_what_the_command_refuses(road, tmp_path, monkeypatch, capsys, arguments, message):
    monkeypatch.chdir(tmp_path)
    road.save("road.fmap")
    other = bytearray(road.to_bytes())
    other[12] = 3  # its version
    Path("other.fmap").write_bytes(other)
    Path("no.fmap").write_bytes(b"no map")
    assert status_of(["fmu", *arguments]) == 2
    assert message in capsys.readouterr().err
    assert not Path("no.fmu").exists()
