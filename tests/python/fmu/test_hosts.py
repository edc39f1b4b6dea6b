"""Strangers' hosts, built against the standards' headers, on Linux and on Windows under Wine."""

import os
import shutil
import subprocess
from pathlib import Path

import fmpy
import numpy as np
import pytest

from asperity import export_fmu
from asperity.fmu.export import platforms
from helpers.fmus import HEADERS, hot_map, on_linux, points

ROOT = Path(__file__).parents[3]
EXAMPLES, INCLUDE = ROOT / "cpp" / "examples", ROOT / "cpp" / "include"


def token(folder):
    """What a host must name of an unpacked FMU, as its description has it."""
    return fmpy.read_model_description(str(folder)).guid


STRICT = ("-Wall", "-Wextra", "-Werror")


WINE = next(
    (p for p in ("/usr/lib/wine/wine64", shutil.which("wine64")) if p and Path(p).exists()), None
)


def compiled(command, source, *options, target):
    if shutil.which(command) is None:
        pytest.skip(f"no {command}")
    subprocess.run([command, *options, source, "-o", target, "-ldl"], check=True)
    return target


@pytest.fixture(scope="module")
def c_host(tmp_path_factory):
    """The host in C, built against the standards' headers."""
    target = tmp_path_factory.mktemp("host") / "host"
    options = ("-std=c11", "-D_GNU_SOURCE", *STRICT, f"-I{HEADERS}")
    return compiled("gcc", EXAMPLES / "fmu_host" / "host.c", *options, target=target)


@pytest.fixture(scope="module")
def asked():
    """The bits of 10,000 points, three of them outside, a line each."""
    pressure, velocity = points(10000, seed=5)
    pressure[:3] = [1e9, -1.0, 1.0]
    bits = np.stack([pressure, velocity], axis=1).view(np.uint64).tolist()
    return "".join(
        f"{p >> 32:x} {p & (2**32 - 1):x} {v >> 32:x} {v & (2**32 - 1):x}\n" for p, v in bits
    )


@pytest.fixture(scope="module")
def answers(road, asked, tmp_path_factory):
    """What the map's own header gives, to the last digit."""
    folder = tmp_path_factory.mktemp("look_up")
    road.save(folder / "road.fmap")
    options = ("-std=c++17", "-O2", "-ffp-contract=off", *STRICT, f"-I{INCLUDE}")
    program = compiled(
        "g++", ROOT / "tests" / "fmu" / "look_up.cpp", *options, target=folder / "look_up"
    )
    command = [program, folder / "road.fmap"]
    return subprocess.run(command, input=asked, capture_output=True, text=True, check=True).stdout


@on_linux
@pytest.mark.parametrize("fmi", ["2.0", "3.0"])
def test_a_host_in_c_gets_the_digits_of_the_map(files, c_host, asked, answers, tmp_path, fmi):
    fmpy.extract(str(files[fmi, None]), str(tmp_path))
    folder = "linux64" if fmi == "2.0" else "x86_64-linux"
    resources = tmp_path / "resources"
    address = resources.as_uri() if fmi == "2.0" else f"{resources}/"
    library = tmp_path / "binaries" / folder / "friction.so"
    command = [c_host, library, address, fmi[0], token(tmp_path)]
    result = subprocess.run(command, input=asked, capture_output=True, text=True, check=True)
    assert result.stdout == answers
    assert result.stderr.count("outside of the map") == 1  # said once
    other = subprocess.run([*command[:-1], "{another}"], capture_output=True, text=True)
    assert other.returncode == 1
    assert '"{another}" is that of another FMU' in other.stderr


@pytest.mark.skipif(
    WINE is None or "x86_64-windows" not in platforms(), reason="no wine, or no FMU for Windows"
)
@pytest.mark.parametrize("fmi", ["2.0", "3.0"])
def test_windows_gets_the_digits_of_the_map(files, asked, answers, tmp_path, fmi):
    compiler, options = "x86_64-w64-mingw32-gcc-posix", ("-std=c11", f"-I{HEADERS}")
    if shutil.which(compiler) is None:
        pytest.skip(f"no {compiler}")
    host = tmp_path / "host.exe"
    subprocess.run([compiler, *options, EXAMPLES / "fmu_host" / "host.c", "-o", host], check=True)
    fmpy.extract(str(files[fmi, None]), str(tmp_path))
    folder = "win64" if fmi == "2.0" else "x86_64-windows"
    resources = f"file:///Z:{tmp_path}/resources" if fmi == "2.0" else f"Z:{tmp_path}\\resources\\"
    command = [WINE, "host.exe", f"binaries\\{folder}\\friction.dll", resources, fmi[0]]
    environment = {**os.environ, "WINEDEBUG": "-all", "WINEPREFIX": str(tmp_path / "wine")}
    wine = {"capture_output": True, "text": True, "cwd": tmp_path, "env": environment}
    result = subprocess.run([*command, token(tmp_path)], input=asked, check=True, **wine)
    assert result.stdout == answers
    other = subprocess.run([*command, "{another}"], **wine)
    assert other.returncode == 1
    assert '"{another}" is that of another FMU' in other.stderr


@pytest.fixture(scope="module")
def tires(tmp_path_factory):
    """The examples of a tire: by a map, and by an FMU of it."""
    folder, options = tmp_path_factory.mktemp("tires"), ("-std=c++17", "-O1", *STRICT)
    return [
        compiled(
            "g++",
            EXAMPLES / name / "main.cpp",
            *options,
            f"-isystem{include}",
            target=folder / name,
        )
        for name, include in (("brush_map", INCLUDE), ("brush_fmu", HEADERS))
    ]


@on_linux
@pytest.mark.parametrize("heat", [False, True])
def test_a_tire_by_an_fmu_is_that_by_its_map(road, tires, tmp_path, heat):
    fmap = hot_map(293.15) if heat else road
    fmap.save(tmp_path / "road.fmap")
    export_fmu(fmap, tmp_path / "road.fmu", points=200)
    fmpy.extract(str(tmp_path / "road.fmu"), str(tmp_path / "road"))
    forces = []
    for tire, at in zip(tires, ("road.fmap", "road"), strict=True):
        ran = subprocess.run([tire, tmp_path / at], capture_output=True, text=True, check=True)
        rows = [line.split(",")[:3] for line in ran.stdout.splitlines()]
        assert rows[0] == ["slip", "force_over_load", "sliding_share"]
        forces.append(np.array(rows[1:], float))
    np.testing.assert_array_equal(*forces)


@pytest.mark.skipif(shutil.which("g++") is None, reason="no C++ compiler")
def test_sources_build_anywhere(files, tmp_path):
    """The sources in the FMU are whole, and their types are those of the standards' headers."""
    fmpy.extract(str(files["3.0", None]), str(tmp_path))
    command = ["g++", "-std=c++17", "-Wall", "-Wextra", "-Werror", "-fPIC", "-shared", "-I."]
    headers = ["-DASPERITY_FMI_HEADERS", f"-I{HEADERS}"]
    for more in ([], headers):
        subprocess.run(
            [*command, *more, "fmu.cpp", "-o", "friction.so"], cwd=tmp_path / "sources", check=True
        )
