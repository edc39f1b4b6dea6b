"""The pictures of the shell command."""

from pathlib import Path

import numpy as np
import pytest

import asperity
from asperity.cli import main

pytest.importorskip("matplotlib")

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
MAGIC = {".png": b"\x89PNG", ".pdf": b"%PDF", ".svg": b"<?xml"}


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """The working directory, with a scene and a scan."""
    (tmp_path / "scene.toml").write_text(SCENE)
    spectrum = asperity.SelfAffineSpectrum(rms_height=5e-6, hurst=0.8, q0=2e4, q1=1e6)
    scan = asperity.synthesize(spectrum, shape=(60, 80), pixel_size=(2e-5, 1e-5), seed=1)
    np.save(tmp_path / "scan.npy", scan.heights)
    monkeypatch.chdir(tmp_path)
    return tmp_path


@pytest.mark.parametrize("ending", [".png", ".svg", ".pdf"])
@pytest.mark.parametrize(
    "verb",
    [
        ["friction", "scene.toml"],
        ["area", "scene.toml", "--points", "9"],
        ["spectrum", "scan.npy", "--pixel-size", "2e-5,1e-5", "--unit", "m"],
    ],
    ids=lambda verb: verb[0],
)
def test_plot_by_ending(folder: Path, verb: list[str], ending: str) -> None:
    picture = f"picture{ending}"
    assert main([*verb, "--plot", picture, "--output", "table.csv"]) == 0
    assert (folder / picture).read_bytes().startswith(MAGIC[ending])
    assert sorted(path.name for path in folder.iterdir()) == sorted(
        ["scan.npy", "scene.toml", picture, "table.csv"]
    )


@pytest.mark.parametrize(
    ("old", "new"),
    [
        ("{from = 1e-4, to = 1, points = 5}", "1e-2"),
        ("[81e3, 2e5]", "{from = 1e4, to = 1e6, points = 12}"),
        ("[adhesion]\nshear_stress_pa = 8.3e6\n", ""),
    ],
)
@pytest.mark.parametrize("verb", ["friction", "area"])
def test_plots_of_other_scenes(folder: Path, verb: str, old: str, new: str) -> None:
    (folder / "scene.toml").write_text(SCENE.replace(old, new))
    assert main([verb, "scene.toml", "--plot", "a.png", "--output", "a.csv"]) == 0
    assert (folder / "a.png").stat().st_size > 10000


@pytest.mark.parametrize(("form", "said"), [("exact", False), ("interpolated", True)])
def test_distribution_says_when_the_area_has_another_form(
    folder: Path, monkeypatch: pytest.MonkeyPatch, form: str, said: bool
) -> None:
    titles: list[str] = []
    monkeypatch.setattr("matplotlib.axes.Axes.set_title", lambda _, text, **__: titles.append(text))
    (folder / "scene.toml").write_text(f"{SCENE}[solver]\nform = '{form}'\n")
    arguments = ["area", "scene.toml", "--points", "3", "--output", "a.csv", "--plot", "a.svg"]
    assert main(arguments) == 0
    (title,) = titles
    assert title.startswith("81 kPa, 0.0001 m/s")
    assert ("exact form" in title) == said


STRANGE = ["_hidden.toml", "a$b_$^.toml", "größe.toml", "日.toml"]


def test_strange_names_of_files(folder: Path) -> None:
    for name in STRANGE:
        (folder / name).write_text(SCENE)
    assert main(["friction", *STRANGE, "--plot", "mu.svg", "--output", "mu.csv"]) == 0
    lines = (folder / "mu.csv").read_text(encoding="utf-8").splitlines()
    rows = [line for line in lines if not line.startswith("#")][1:]
    assert [row.partition(",")[0] for row in rows[::10]] == STRANGE
