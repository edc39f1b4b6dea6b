"""The shipped scene and `asperity demo`."""

import importlib.util
from pathlib import Path

import numpy as np
import pytest

import asperity
from asperity import demo
from asperity.cli import main


@pytest.fixture(scope="module")
def finished(tmp_path_factory: pytest.TempPathFactory) -> Path:
    directory = tmp_path_factory.mktemp("demo") / "out"
    assert main(["demo", "--output", str(directory)]) == 0
    return directory


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


def test_its_spectrum_is_table_1s() -> None:
    surface = asperity.HeightMap(demo.scan(), pixel_size=demo.PIXEL_SIZE).fill_dropouts()
    spectrum = asperity.power_spectrum(surface, detrend="quadratic")
    fit = asperity.fit_self_affine(spectrum, q_min=2500.0, q_max=1.5e4)
    assert fit.hurst == pytest.approx(0.87, abs=0.06)


def test_demo_leaves_what_it_says(finished: Path) -> None:
    wanted = {"scan.npy", "scene.toml", "friction.csv"}
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


def test_demo_runs_twice_and_prints_where(
    finished: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    before = (finished / "friction.csv").read_text()
    assert main(["demo", "--output", str(finished)]) == 0
    out = capsys.readouterr().out
    assert "velocity_m_s" in out
    assert str(finished / "friction.csv") in out
    assert "picture: " in out
    assert (finished / "friction.csv").read_text() == before


def test_demo_does_not_overwrite_an_edited_scene(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    (tmp_path / "scene.toml").write_text("# mine\n")
    assert main(["demo", "--output", str(tmp_path)]) == 2
    assert "is not the demo's own" in capsys.readouterr().err
    assert [path.name for path in tmp_path.iterdir()] == ["scene.toml"]


def test_demo_into_a_file_is_refused(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    (tmp_path / "taken").write_text("")
    assert main(["demo", "--output", str(tmp_path / "taken")]) == 2
    assert len(capsys.readouterr().err.splitlines()) == 1
