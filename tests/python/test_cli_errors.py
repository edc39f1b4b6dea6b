"""The shell command in trouble: one line, the right exit status, and no file left behind."""

import sys
from pathlib import Path

import numpy as np
import pytest

import asperity
from asperity.cli import main

SCENE = """
[surface]
rms_height_m = 76.572e-6
hurst = 0.7
q0_per_m = 2000.0
q1_per_m = 1e5
[rubber]
equilibrium_modulus_pa = 2e6
moduli_pa = [1e9, 1e8, 1e7]
relaxation_times_s = [1e-8, 1e-6, 1e-4]
[conditions]
pressure_pa = [81e3, 2e5]
velocity_m_s = {from = 1e-4, to = 1, points = 5}
[adhesion]
shear_stress_pa = 8.3e6
"""


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """The working directory, with a scene and a scan."""
    (tmp_path / "scene.toml").write_text(SCENE)
    spectrum = asperity.SelfAffineSpectrum(rms_height=5e-6, hurst=0.8, q0=2e4, q1=1e6)
    scan = asperity.synthesize(spectrum, shape=(60, 80), pixel_size=(2e-5, 1e-5), seed=1)
    np.save(tmp_path / "scan.npy", scan.heights)
    monkeypatch.chdir(tmp_path)
    return tmp_path


def names(folder: Path) -> list[str]:
    return sorted(path.name for path in folder.iterdir())


SPECTRUM = ["spectrum", "scan.npy", "--pixel-size", "1e-5", "--unit", "m"]


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (["friction", "none.toml"], "none.toml: cannot be read: No such file or directory"),
        (["friction", "scene.toml", "--output", "no/mu.csv"], "no/mu.csv: cannot be written"),
        (["friction", "scene.toml", "--output", "."], ".: cannot be written: not a regular file"),
        (["friction", "scene.toml", "--output", "scene.toml"], "scene.toml: is an input"),
        ([*SPECTRUM, "--output", "scan.npy"], "scan.npy: is an input"),
        (["friction", "scanned.toml", "--output", "scan.npy"], "scan.npy: is an input"),
        (["friction", "scene.toml", "--output", "/dev/null"], "/dev/null: cannot be written"),
        (["friction", "scene.toml", "--plot", "mu.jpg"], "mu.jpg: must end in .png, .svg, .pdf"),
        (
            ["friction", "scene.toml", "--plot", "a.png", "--output", "a.png"],
            "a.png: --output and --plot must be two files",
        ),
        (["friction", "scan.npy"], "scan.npy: not a TOML file"),
        (["area", "none.toml"], "none.toml: cannot be read"),
        (["spectrum", "none.npy"], "none.npy: cannot be read"),
        (["spectrum", "scan.npy"], "scan.npy: --pixel-size [m] is missing"),
        ([*SPECTRUM[:4]], "scan.npy: --unit of the heights is missing"),
        ([*SPECTRUM, "--channel", "2"], "scan.npy: --channel = 2: must be 0"),
        ([*SPECTRUM, "--q-min", "1e4", "--q-max", "1e3"], "scan.npy: "),
        (["spectrum", "holes.npy", *SPECTRUM[2:]], "holes.npy: "),
    ],
)
@pytest.mark.parametrize("output", ["out.csv", None])
def test_bad_input_is_one_line_and_leaves_no_file(
    folder: Path,
    capsys: pytest.CaptureFixture[str],
    arguments: list[str],
    message: str,
    output: str | None,
) -> None:
    holes = np.ones((20, 20))
    holes[:, :3] = np.nan
    np.save(folder / "holes.npy", holes)
    scan = "[surface]\nfile = 'scan.npy'\npixel_size_m = 1e-5\nunit = 'm'\n"
    (folder / "scanned.toml").write_text(scan + SCENE[SCENE.index("[rubber]") :])
    before = names(folder)
    if output and "--output" not in arguments:
        arguments = [*arguments, "--output", output]
    assert main(arguments) == 2
    out, err = capsys.readouterr()
    assert out == ""
    assert len(err.splitlines()) == 1
    assert err.startswith(f"asperity: {message}")
    assert names(folder) == before


@pytest.mark.parametrize(
    "arguments",
    [
        [],
        ["frictoin"],
        ["friction"],
        ["area", "scene.toml", "--points", "1"],
        [*SPECTRUM, "--unit", "inch"],
        [*SPECTRUM, "--pixel-size", "1,2,3"],
        [*SPECTRUM, "--window", "boxcar"],
    ],
)
def test_bad_usage_is_one_line(
    folder: Path, capsys: pytest.CaptureFixture[str], arguments: list[str]
) -> None:
    with pytest.raises(SystemExit) as caught:
        main(arguments)
    assert caught.value.code == 2
    out, err = capsys.readouterr()
    assert out == ""
    assert len(err.splitlines()) == 1
    assert "--help" in err


def test_an_error_in_a_later_scene_keeps_the_old_output(
    folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    (folder / "bad.toml").write_text(SCENE.replace("[81e3, 2e5]", "-1"))
    (folder / "mu.csv").write_text("of yesterday")
    arguments = ["friction", "scene.toml", "bad.toml", "--output", "mu.csv", "--plot", "mu.png"]
    assert main(arguments) == 2
    message = "asperity: bad.toml: [conditions] pressure_pa = -1: must be positive"
    assert capsys.readouterr().err.startswith(message)
    assert (folder / "mu.csv").read_text() == "of yesterday"
    assert not (folder / "mu.png").exists()


def test_not_converged_is_no_bad_input(
    folder: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    def fail(*_: object, **__: object) -> None:
        raise asperity.NotConverged("mu = 1 with error 2,\nwhere rtol = 1e-6 was asked for")

    monkeypatch.setattr("asperity.scene.friction", fail)
    assert main(["friction", "scene.toml", "--output", "mu.csv"]) == 1
    line = "asperity: scene.toml: mu = 1 with error 2, where rtol = 1e-6 was asked for\n"
    assert capsys.readouterr().err == line
    assert not (folder / "mu.csv").exists()


def test_failing_disk_leaves_nothing(
    folder: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    write = Path.write_bytes

    def full(path: Path, data: bytes) -> int:
        if ".png" in path.name:
            write(path, data[:10])
            raise OSError(28, "No space left on device")
        return write(path, data)

    monkeypatch.setattr(Path, "write_bytes", full)
    before = names(folder)
    assert main(["friction", "scene.toml", "--output", "mu.csv", "--plot", "mu.png"]) == 1
    assert "No space left" in capsys.readouterr().err
    assert names(folder) == before


def test_without_matplotlib_says_what_to_install(
    folder: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setitem(sys.modules, "matplotlib", None)
    assert main(["friction", "scene.toml", "--plot", "mu.png"]) == 2
    err = capsys.readouterr().err
    assert err == "asperity: mu.png: pictures are drawn by matplotlib: pip install asperity[plot]\n"
