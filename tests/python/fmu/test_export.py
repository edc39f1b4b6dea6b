"""`export_fmu` and the command `fmu`: what they refuse, and what they tell."""

import shutil
import subprocess
import zipfile
from pathlib import Path

import fmpy
import pytest
from fmpy.validation import validate_fmu

import asperity
from asperity import InvalidInput, export_fmu
from asperity.cli import main
from asperity.fmu import export

ROOT = Path(__file__).parents[3]


@pytest.mark.parametrize(
    ("options", "message"),
    [
        ({"name": "my road"}, r"name = 'my road': must be an identifier of C, such as friction"),
        ({"name": ""}, r"name = '': must be an identifier of C"),
        ({"fmi": "1.0"}, r'fmi = "1.0": must be one of "2.0", "3.0"'),
        ({"points": 0}, r"points = 0: must be a whole number, from 1 to 1000000"),
        ({"points": 2.5}, r"points = 2.5: must be a whole number"),
    ],
)
def test_bad_input_is_one_line_and_writes_nothing(road, tmp_path, options, message):
    with pytest.raises(InvalidInput, match=message):
        export_fmu(road, tmp_path / "road.fmu", **options)
    assert list(tmp_path.iterdir()) == []


def test_other_bad_input(road, tmp_path):
    with pytest.raises(InvalidInput, match=r"^map = 3: must be a FrictionMap$"):
        export_fmu(3, tmp_path / "road.fmu")
    with pytest.raises(InvalidInput, match=r"cannot be written: "):
        export_fmu(road, tmp_path / "missing" / "road.fmu")
    with pytest.raises(InvalidInput, match=r"cannot be written: |is a directory"):
        export_fmu(road, tmp_path)
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


@pytest.mark.skipif(shutil.which("cmake") is None, reason="no cmake")
@pytest.mark.parametrize("mingw", [True, False])
def test_a_build_without_mingw_tells_how_to_add_it(tmp_path, mingw):
    command = ["cmake", "-G", "Ninja", "-S", ROOT, "-B", tmp_path / f"{mingw}"]
    command += ["-DASPERITY_LIBRARY=OFF"]
    found = "/usr/bin/true" if mingw else "OFF"
    command += ["-DASPERITY_FMU=ON", f"-DASPERITY_MINGW={found}"]
    told = subprocess.run(command, capture_output=True, text=True, check=True).stdout
    line = "FMUs are without win64; for it install g++-mingw-w64-x86-64-posix (Debian)"
    assert (line in told) == (not mingw)


def test_command(road, tmp_path, capsys):
    road.save(tmp_path / "road.fmap")
    output = tmp_path / "road.fmu"
    assert main(["fmu", str(tmp_path / "road.fmap"), "--output", str(output), "--fmi", "3.0"]) == 0
    assert "binaries = " in capsys.readouterr().out
    assert validate_fmu(str(output)) == []
    assert main(["fmu", str(output), "--output", str(tmp_path / "no.fmu")]) == 2
    assert "is no friction map: it begins otherwise" in capsys.readouterr().err
    assert main(["fmu", str(tmp_path / "road.fmap"), "--output", str(output), "--name", "1"]) == 2
    assert "--name = '1': must be an identifier of C" in capsys.readouterr().err
    assert main(["fmu", str(output), "--output", str(output)]) == 2
    assert "is an input" in capsys.readouterr().err
    other = bytearray(road.to_bytes())
    other[12] = 3  # its version
    (tmp_path / "other.fmap").write_bytes(other)
    assert main(["fmu", str(tmp_path / "other.fmap"), "--output", str(tmp_path / "no.fmu")]) == 2
    assert (
        "other.fmap: has layout version 3: must be 4, so the map has to be made again"
        in capsys.readouterr().err
    )
    with pytest.raises(SystemExit) as ended:
        main(
            ["fmu", str(tmp_path / "road.fmap"), "--output", str(tmp_path / "no.fmu"), "--fmi", "1"]
        )
    assert ended.value.code == 2
    assert "invalid choice: '1' (choose from '2.0', '3.0')" in capsys.readouterr().err
    assert not (tmp_path / "no.fmu").exists()
    assert asperity.export_fmu is export_fmu
