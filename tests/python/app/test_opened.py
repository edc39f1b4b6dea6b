"""Scenes that are dropped: the shell's digits, and no file but those that came with them."""

import io
import re
import zipfile
from pathlib import Path

import numpy as np
import pytest

import asperity
from asperity.app import files, opened
from asperity.app.downloads import scene_archive
from asperity.app.state import State
from asperity.io.archive import archived
from asperity.scene.scene import load_scene
from helpers.dropped import dma_bytes, scan_bytes

CONDITIONS = """
[conditions]
pressure_pa = 2e5
velocity_m_s = [1e-3, 1e-2, 0.1]
"""
WITH_FILES = f"""
[surface]
file = "../scans/my scan.npy"
pixel_size_m = 5e-6
unit = "um"
[rubber]
isotherms = ["C:\\\\dma\\\\dma.csv"]
columns = {{ frequency = "Freq", storage = "G'", loss = 'G"', temperature = "Temperature" }}
units = {{ frequency = "Hz", modulus = "MPa", temperature = "C" }}
modulus = "G"
temperature_k = 303.15
prony = true
extrapolation = "prony"
{CONDITIONS}
poisson_ratio = 0.49
[adhesion]
shear_stress_pa = 5e6
[uncertainty]
samples = 20
[solver]
rtol = 1e-5
"""
BY_NUMBERS = f"""
[surface]
rms_height_m = 1e-5
hurst = 0.8
q0_per_m = 2e3
q1_per_m = 1e6
[rubber]
equilibrium_modulus_pa = 2e6
moduli_pa = [1e7, 1e8]
relaxation_times_s = [1e-3, 1e-5]
{CONDITIONS}
"""


def test_a_scene_with_its_files_gives_the_digits_of_the_shell(state: State, tmp_path: Path) -> None:
    dropped = [("my scan.npy", scan_bytes()), ("dma.csv", dma_bytes())]
    name = state.open_scene([*dropped, ("mine.toml", WITH_FILES.encode())])()
    assert name == "mine.toml"
    (tmp_path / "scans").mkdir()
    (tmp_path / "of").mkdir()
    (tmp_path / "scans" / "my scan.npy").write_bytes(dropped[0][1])
    (tmp_path / "of" / "dma.csv").write_bytes(dropped[1][1])
    text = WITH_FILES.replace("C:\\\\dma\\\\dma.csv", "dma.csv")
    (tmp_path / "of" / "mine.toml").write_text(text)
    shell = load_scene(tmp_path / "of" / "mine.toml", for_friction=True)
    scene = state.load()
    assert np.array_equal(scene.friction().mu, shell.friction().mu)
    assert scene.options == shell.options
    assert scene.sampling == shell.sampling
    assert scene.inputs["adhesion"] == shell.inputs["adhesion"]
    assert state.used == {"adhesion", "uncertainty", "solver"}
    assert "was dropped as dma.csv" in state.text


def test_what_the_app_gives_away_it_takes_back(state: State) -> None:
    mu = state.load().friction().mu
    archive = scene_archive(state)()
    other = State()
    try:
        other.surface = "law"
        assert other.open_scene([("scene.zip", archive)])() == "scene.toml"
        assert np.array_equal(other.load().friction().mu, mu)
    finally:
        other.close()


def test_a_scene_without_files_or_temperature(state: State) -> None:
    state.open_scene([("law.toml", BY_NUMBERS.encode())])()
    scene = state.load()
    assert scene.temperature is None
    assert scene.velocity.tolist() == [1e-3, 1e-2, 0.1]
    assert scene.correction is scene.adhesion is scene.heating is None


RMS = "rms_height_m = 1e-5\n"


def scene_with(old: str, new: str) -> bytes:
    assert old in BY_NUMBERS
    return BY_NUMBERS.replace(old, new).encode()


REFUSED = {
    "none": ("0 scenes", ("a.npy", b"1")),
    "two": ("2 scenes", ("a.toml", b""), ("b.toml", b"")),
    "no TOML": ("a.toml: not a TOML file", ("a.toml", b"[surface")),
    "no text": ("a.toml: not a TOML file", ("a.toml", b"\xff\xfe")),
    "deep": ("a.toml: not a TOML file", ("a.toml", b"a = " + b"[" * 100_000)),
    "long": ("a.toml: has 1048577 bytes", ("a.toml", b"#" * (2**20 + 1))),
    "no tables": ("[surface]: missing", ("a.toml", b"")),
    "numbers": ("be a table", ("a.toml", b"surface = 1\nrubber = 1\nconditions = 1")),
    "unknown": ("[rubbish]", ("a.toml", scene_with("[rubber]", "[rubbish]"))),
    "absent": ("names my scan.npy", ("a.toml", WITH_FILES.encode()), ("dma.csv", dma_bytes())),
    "absolute": ("names passwd", ("a.toml", scene_with(RMS, 'file = "/etc/passwd"\n'))),
    "itself": ("a.toml", ("a.toml", scene_with(RMS + "hurst = 0.8", 'file = "a.toml"'))),
    "pressures": ("[conditions] pressure_pa", ("a.toml", scene_with("2e5", "[1e5, 2e5]"))),
    "a bad value": ("hurst", ("a.toml", scene_with("hurst = 0.8", "hurst = 8"))),
    "no archive": ("a.zip: cannot be unpacked", ("a.zip", b"PK\x03\x04")),
    "empty archive": ("0 scenes", ("a.zip", archived([]))),
    "a path": ("a.toml names", ("a.zip", archived([("../../a.toml", WITH_FILES.encode())]))),
}


@pytest.mark.parametrize("case", REFUSED)
def test_what_cannot_be_opened_is_refused_and_changes_nothing(case: str, state: State) -> None:
    problem, *dropped = REFUSED[case]
    before = state.text, sorted(one.name for one in state.folder.path.glob("file-*"))
    with pytest.raises(asperity.Error) as caught:
        state.open_scene(dropped)()
    assert problem in str(caught.value)
    assert str(state.folder.path) not in str(caught.value)
    assert (state.text, sorted(one.name for one in state.folder.path.glob("file-*"))) == before
    assert state.load().friction().mu.max() > 0


def test_an_archive_has_few_files(state: State) -> None:
    many = archived((f"{i}.npy", b"1") for i in range(files.MOST_FILES + 1))
    with pytest.raises(asperity.InvalidInput, match=r"a\.zip: holds 41 files: must be at most 40"):
        state.open_scene([("a.zip", many)])()


@pytest.mark.parametrize("method", [zipfile.ZIP_DEFLATED, zipfile.ZIP_LZMA, zipfile.ZIP_BZIP2])
def test_a_damaged_archive_is_refused_in_one_line(method: int, state: State) -> None:
    """One byte after another is flipped, in the contents as in what describes them."""
    out = io.BytesIO()
    with zipfile.ZipFile(out, "w", method) as archive:
        archive.writestr("a.toml", BY_NUMBERS)
    whole, problems = out.getvalue(), []
    for place in range(len(whole)):
        damaged = bytearray(whole)
        damaged[place] ^= 0xFF
        try:
            opened.opened([("a.zip", bytes(damaged))], state.folder)
        except asperity.InvalidInput as error:
            problems.append(str(error))
    said = r"a\.zip: (cannot be unpacked:|is compressed) .+|.+: must be one \.toml, .+"
    assert [one for one in problems if not re.fullmatch(said, one)] == []
    assert len(problems) > 0.7 * len(whole)  # dates, attributes and the like are not looked at


def test_only_what_the_scene_names_is_kept(state: State) -> None:
    count = len(list(state.folder.path.glob("file-*")))
    state.open_scene([("a.toml", BY_NUMBERS.encode()), ("other.npy", scan_bytes())])()
    assert len(list(state.folder.path.glob("file-*"))) == count
