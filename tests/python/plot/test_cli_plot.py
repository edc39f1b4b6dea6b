"""The pictures of the shell command."""

from pathlib import Path

import pytest

from asperity.cli.main import main
from helpers.scenes import SCENE

pytest.importorskip("matplotlib")

MAGIC = {".png": b"\x89PNG", ".pdf": b"%PDF", ".svg": b"<?xml"}


@pytest.mark.parametrize(
    ("ending", "verb"),
    [
        (".png", ["friction", "scene.toml"]),
        (".svg", ["area", "scene.toml", "--points", "9"]),
        (".pdf", ["spectrum", "scan.npy", "--pixel-size", "2e-5,1e-5", "--unit", "m"]),
    ],
)
def test_plot_by_ending(folder: Path, verb: list[str], ending: str) -> None:
    picture = f"picture{ending}"
    assert main([*verb, "--plot", picture, "--output", "table.csv"]) == 0
    drawn = (folder / picture).read_bytes()
    assert drawn.startswith(MAGIC[ending])
    assert main([*verb, "--plot", picture, "--output", "table.csv"]) == 0
    assert (folder / picture).read_bytes() == drawn  # neither dates nor random names in it
    assert sorted(path.name for path in folder.iterdir()) == sorted(
        ["scan.npy", "scene.toml", picture, "table.csv"]
    )


@pytest.mark.parametrize(
    ("verb", "old", "new"),
    [
        ("friction", "{from = 1e-4, to = 1, points = 5}", "1e-2"),
        ("area", "{from = 1e-4, to = 1, points = 5}", "1e-2"),
        ("friction", "[adhesion]\nshear_stress_pa = 8.3e6\n", ""),
    ],
)
def test_plots_of_other_scenes(folder: Path, verb: str, old: str, new: str) -> None:
    (folder / "scene.toml").write_text(SCENE.replace(old, new))
    assert main([verb, "scene.toml", "--plot", "a.png", "--output", "a.csv"]) == 0
    assert (folder / "a.png").stat().st_size > 10000


STRANGE = ["_hidden.toml", "a$b_$^.toml", "größe.toml", "日.toml"]


def test_strange_names_of_files(folder: Path) -> None:
    for name in STRANGE:
        (folder / name).write_text(SCENE)
    assert main(["friction", *STRANGE, "--plot", "mu.svg", "--output", "mu.csv"]) == 0
    lines = (folder / "mu.csv").read_text(encoding="utf-8").splitlines()
    rows = [line for line in lines if not line.startswith("#")][1:]
    assert [row.partition(",")[0] for row in rows[::10]] == STRANGE
