"""The shipped scene and `asperity demo`."""

import importlib.util
import os
import shutil
from pathlib import Path

import numpy as np
import pytest

import asperity
from asperity import demo
from asperity.cli.main import main


@pytest.fixture(scope="module")
def finished(tmp_path_factory: pytest.TempPathFactory) -> Path:
    directory = tmp_path_factory.mktemp("demo") / "out"
    assert main(["demo", "--output", str(directory)]) == 0
    return directory


def contents(directory: Path) -> dict[Path, bytes | None]:
    return {path: path.read_bytes() if path.is_file() else None for path in directory.rglob("*")}


def test_scan_is_what_the_issue_asks_for() -> None:
    heights = demo.scan()
    ny, nx = heights.shape
    dy, dx = demo.PIXEL_SIZE
    assert ny != nx
    assert dy != dx
    assert np.isnan(heights).mean() == pytest.approx(0.02, abs=0.002)
    np.testing.assert_array_equal(heights, demo.scan())
    surface = asperity.HeightMap(heights, pixel_size=demo.PIXEL_SIZE).fill_dropouts()
    flat = surface.detrend("quadratic")
    assert flat.rms_height == pytest.approx(265.7e-6, rel=0.05)
    assert surface.rms_height > 2 * flat.rms_height  # tilted
    assert surface.detrend("plane").rms_height > 1.05 * flat.rms_height  # and curved


def test_demo_leaves_what_it_says(finished: Path) -> None:
    wanted = {"scan.npy", "scene.toml", "hot.toml", "friction.csv"}
    if importlib.util.find_spec("matplotlib") is not None:
        wanted.add("friction.png")
    assert {path.name for path in finished.iterdir()} == wanted


def test_demo_curve_is_a_friction_curve(finished: Path) -> None:
    text = (finished / "friction.csv").read_text()
    names, *rows = (line for line in text.splitlines() if not line.startswith("#"))
    table = dict(
        zip(names.split(","), np.array([r.split(",") for r in rows], float).T, strict=True)
    )
    assert table["velocity_m_s"].size == 29
    assert table["velocity_m_s"][[0, -1]].tolist() == [1e-6, 10.0]
    np.testing.assert_allclose(table["mu"], table["hysteresis"] + table["adhesion"], rtol=1e-12)
    assert np.all(table["error_estimate"] <= 1e-6 * table["mu"])
    peak = table["mu"].argmax()
    assert 0 < peak < 28  # bell-shaped
    assert 0.3 < table["mu"][peak] < 3
    assert np.all(np.diff(table["contact_area"]) < 0)  # stiffer with speed
    rise = table["hot_temperature_k"] - table["temperature_k"]
    assert np.all(np.diff(rise) > 0)
    assert 5 < rise[-1] < 50
    assert table["mu"][-1] < 0.96 * table["mu_cold"][-1]  # at 10 m/s
    assert table["mu"][0] == pytest.approx(table["mu_cold"][0], rel=1e-3)
    assert "not modelled" not in text


def test_demo_overwrites_nothing_unless_told_to(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    for name in ("scan.npy", "scene.toml", "hot.toml", "friction.csv", "friction.png"):
        (tmp_path / name).write_text("mine\n")
        assert main(["demo", "--output", str(tmp_path)]) == 2
        out, err = capsys.readouterr()
        message = f"holds {name} already; choose another --output, or replace them with --force"
        assert (out, err) == ("", f"asperity: {tmp_path}: {message}\n")
        assert [path.name for path in tmp_path.iterdir()] == [name]
        assert (tmp_path / name).read_text() == "mine\n"
        (tmp_path / name).unlink()


@pytest.mark.parametrize("before", ["nothing", "a finished demo"])
def test_demo_that_fails_leaves_what_was_there(
    finished: Path,
    tmp_path: Path,
    capsys: pytest.CaptureFixture[str],
    monkeypatch: pytest.MonkeyPatch,
    before: str,
) -> None:
    directory = tmp_path / "far" / "out"
    if before == "a finished demo":
        shutil.copytree(finished, directory)
    held = contents(tmp_path)

    def fail(*_: object, **__: object) -> None:
        raise asperity.NotConverged("mu = 1 with error 2")

    monkeypatch.setattr("asperity.scene.model.friction", fail)
    assert main(["demo", "--output", str(directory), "--force"]) == 1
    line = f"asperity: {directory / 'hot.toml'}: mu = 1 with error 2\n"
    assert capsys.readouterr().err == line
    assert contents(tmp_path) == held


def test_demo_on_a_full_disk_leaves_no_half_of_a_file(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    directory = tmp_path / "far" / "out"
    replace = os.replace

    def full(part: Path, target: Path) -> None:
        if directory in target.parents and target.name == "friction.csv":
            raise OSError(28, "No space left on device")
        replace(part, target)

    monkeypatch.setattr("os.replace", full)
    assert main(["demo", "--output", str(directory)]) == 1
    line = f"asperity: {directory / 'friction.csv'}: cannot be written: No space left on device\n"
    assert capsys.readouterr().err == line
    # those before it are whole, and no part of it is left
    assert {path.name for path in directory.iterdir()} == {"scan.npy", "scene.toml", "hot.toml"}
