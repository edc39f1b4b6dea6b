"""A wheel says what the libraries inside it ask for, the source says its own licence."""

import email
import importlib.metadata
import importlib.util
import re
import subprocess
import sys
import tarfile
import tomllib
from email.message import Message
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[3]
PROJECT = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))
NOTICE = (ROOT / "NOTICE").read_text(encoding="utf-8")
SOURCE, BINARY = "BSD-3-Clause", "GPL-3.0-or-later"
GPL, POCKETFFT = "LICENSES/GPL-3.0-or-later.txt", "LICENSES/BSD-3-Clause-pocketfft.txt"
SHIPPED = {
    "LICENSE",
    "NOTICE",
    "LICENSES/0BSD.txt",
    "LICENSES/BSD-3-Clause-pybind11.txt",
    "LICENSES/MPL-2.0.txt",
    GPL,
    POCKETFFT,
}


def provider_and_settings():
    """The provider as pyproject.toml names it, and its settings there."""
    pytest.importorskip("scikit_build_core")
    entries = PROJECT["tool"]["dynamic-metadata"]
    (entry,) = [entry for entry in entries if isinstance(entry["provider"], dict)]
    settings = {key: value for key, value in entry.items() if key != "provider"}
    module, _, name = entry["provider"]["module"].partition(":")
    path = ROOT / entry["provider"]["path"] / f"{module}.py"
    spec = importlib.util.spec_from_file_location(module, path)
    loaded = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(loaded)
    return loaded, getattr(loaded, name)(), settings


@pytest.mark.parametrize(
    ("state", "permissive", "licence", "lacking"),
    [
        ("sdist", None, SOURCE, set()),
        ("sdist", "ON", SOURCE, set()),
        ("wheel", None, BINARY, {POCKETFFT}),
        ("editable", "OFF", BINARY, {POCKETFFT}),
        ("metadata_wheel", None, BINARY, {POCKETFFT}),
        ("metadata_editable", None, BINARY, {POCKETFFT}),
        ("wheel", "ON", SOURCE, {GPL}),
        ("metadata_wheel", "on", SOURCE, {GPL}),
        ("editable", "1", SOURCE, {GPL}),
    ],
)
def test_the_licence_is_that_of_what_is_built(state, permissive, licence, lacking, monkeypatch):
    module, provider, settings = provider_and_settings()
    define = {} if permissive is None else {"cmake.define.ASPERITY_PERMISSIVE": permissive}
    monkeypatch.setattr(module, "_settings", define)
    monkeypatch.setenv("ASPERITY_LICENCE_OF_BUILD", "")  # it is set
    provider.build_state(state)
    said = provider.dynamic_metadata(settings, PROJECT["project"])
    assert said["license"] == licence
    assert set(said["license-files"]) == SHIPPED - lacking
    assert provider.dynamic_wheel(settings).keys() == said.keys()


def test_the_installed_distribution_says_it_and_has_the_notices():
    installed = importlib.metadata.distribution("asperity")
    said = installed.metadata
    lacking = POCKETFFT if said["License-Expression"] == BINARY else GPL
    assert said["License-Expression"] == (SOURCE if lacking == GPL else BINARY)
    assert set(said.get_all("License-File")) == SHIPPED - {lacking}
    files = {str(path): path for path in installed.files}
    for name in SHIPPED - {lacking}:
        (result,) = [path for path in files if path.endswith(f".dist-info/licenses/{name}")]
        assert files[result].read_text("utf-8") == (ROOT / name).read_text("utf-8"), name


def sdist_metadata(folder: Path) -> tuple[Message, set[str]]:
    """PKG-INFO of an sdist built now, and the names of its files."""
    code = "import sys; from scikit_build_core.build import build_sdist; build_sdist(sys.argv[1])"
    run = [sys.executable, "-c", code, str(folder)]
    subprocess.run(run, cwd=ROOT, check=True, capture_output=True, text=True)
    (archive,) = folder.glob("*.tar.gz")
    with tarfile.open(archive) as tar:
        names = {name.partition("/")[2]: name for name in tar.getnames()}
        text = tar.extractfile(names["PKG-INFO"]).read().decode()
    return email.message_from_string(text), set(names)


def test_a_source_distribution_says_its_own_and_has_the_notices_too(tmp_path):
    pytest.importorskip("scikit_build_core")
    said, names = sdist_metadata(tmp_path)
    assert said["License-Expression"] == SOURCE
    assert "License-Expression" in said.get_all("Dynamic")
    assert set(said.get_all("License-File")) == SHIPPED
    assert names >= {*SHIPPED, "docs/licence.md", "python/licence_of_build.py"}


def words(text: str) -> str:
    return " ".join(text.split())


def test_the_map_header_opens_with_its_own_licence():
    header = ROOT / "cpp/include/asperity/friction_map.hpp"
    lines = header.read_text(encoding="utf-8").splitlines()
    assert lines[1] == "// SPDX-License-Identifier: 0BSD"
    opening = words(" ".join(line.removeprefix("//") for line in lines[:9]))
    licence = (ROOT / "LICENSES/0BSD.txt").read_text(encoding="utf-8")
    for paragraph in licence.split("\n\n")[1:]:  # the copyright, the grant, the disclaimer
        said = words(paragraph).replace("distribute this software", "distribute this file")
        assert said in opening


def linked() -> set[str]:
    """All libraries that the build looks for, by the names that CMake has for them."""
    folders = [ROOT / name for name in ("cpp/src", "cpp/include", "python")]
    files = [ROOT / "CMakeLists.txt", ROOT / "cpp/CMakeLists.txt"]
    files += [path for folder in folders for path in folder.rglob("CMakeLists.txt")]
    text = "\n".join(path.read_text(encoding="utf-8") for path in files)
    archives = re.findall(r"^\s*asperity_find_archive\((\w+)", text, re.MULTILINE)
    packages = re.findall(r"^\s*find_package\((\w+)", text, re.MULTILINE)
    fetched = re.findall(r"^\s*FetchContent_Declare\((\w+)", text, re.MULTILINE)
    # Nothing is linked by another way that this test would not see.
    assert re.findall(r"find_library\((\S+)", text) == ["ASPERITY_${library}_ARCHIVE"]
    assert not re.search(r"ExternalProject|pkg_check_modules", text)
    return {f"lib{name}.a" for name in archives} | set(packages) - {"Python"} | set(fetched)


def test_the_notice_names_everything_that_is_linked():
    names = linked()
    assert len(names) >= 7, "GSL's and FFTW's archives, pocketfft, Eigen and pybind11"
    missing = {name for name in names if not re.search(rf"(?<!\w){re.escape(name)}(?!\w)", NOTICE)}
    assert missing == set()


def test_every_licence_that_the_notice_points_at_is_there():
    pointed = set(re.findall(r"LICENSES/[\w.-]+\.txt", NOTICE))
    assert pointed == {name for name in SHIPPED if name.startswith("LICENSES/")}
    assert pointed == {f"LICENSES/{path.name}" for path in (ROOT / "LICENSES").iterdir()}
