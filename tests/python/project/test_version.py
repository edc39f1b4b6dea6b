"""The version stands in CMakeLists.txt, and everything else has it from there."""

import email
import importlib.metadata
import re
import subprocess
import sys
from pathlib import Path

import asperity
from asperity import _core

ROOT = Path(__file__).parents[3]
CMAKE = (ROOT / "CMakeLists.txt").read_text(encoding="utf-8")
VERSION = re.search(r"project\(asperity VERSION ([0-9]+\.[0-9]+\.[0-9]+)\b", CMAKE)[1]
SERIES = VERSION.rpartition(".")[0]  # before 1.0 a minor version may break the interface


def test_the_package_the_core_the_wheel_and_the_command_have_it():
    assert asperity.__version__ == _core.__version__ == VERSION
    assert importlib.metadata.version("asperity") == VERSION
    wheel = email.message_from_string(
        importlib.metadata.distribution("asperity").read_text("METADATA")
    )
    assert (wheel["Name"], wheel["Version"]) == ("asperity", VERSION)
    run = [sys.executable, "-m", "asperity", "--version"]
    done = subprocess.run(run, check=True, capture_output=True, text=True)
    assert done.stdout.split()[-1] == VERSION


def test_no_other_source_says_it():
    """The CMake package, the SONAME and version.hpp have it by configuration (tests/cpp)."""
    folders = [ROOT / name for name in ("cpp", "python", "tests")]
    files = [path for folder in folders for path in folder.rglob("*") if path.is_file()]
    files += [ROOT / name for name in ("pyproject.toml", "CMakePresets.json", "bootstrap.sh")]
    # a map is a file that some version wrote, which it says
    files = [path for path in files if path.suffix != ".fmap"]
    text = {path: path.read_bytes() for path in files if "__pycache__" not in path.parts}
    said = re.compile(rf"(?<![\d.]){re.escape(VERSION)}(?![\d.])".encode())
    assert [str(path) for path, result in text.items() if said.search(result)] == []


def test_what_strangers_ask_for_is_the_series_of_this_version():
    strangers = ["README.md", "docs/embedding/embedding.md", "docs/reference/cpp/index.md"]
    strangers += [f"cpp/examples/{name}/CMakeLists.txt" for name in ("brush_map", "brush_full")]
    strangers += [f"tests/{name}/CMakeLists.txt" for name in ("consumer", "c_host")]
    for name in strangers:
        asked = re.findall(r"find_package\(asperity ([0-9.]+)", (ROOT / name).read_text())
        assert set(asked) == {SERIES}, name


def test_the_pages_that_tell_the_version_tell_this_one():
    citation = (ROOT / "CITATION.cff").read_text(encoding="utf-8")
    assert re.search(r"^version: (\S+)$", citation, re.M)[1] == VERSION
    changes = (ROOT / "CHANGELOG.md").read_text(encoding="utf-8")
    assert re.search(r"^## (\S+)", changes, re.M)[1] == VERSION
