"""Reports that cannot be made are refused in one line, and verdicts of differences by hand."""

import os
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

import asperity
from asperity.cli.main import main
from asperity.report import make
from asperity.report.comparison import MOST, VERDICTS, compared
from asperity.report.drawings import Drawings, Figure
from asperity.scene.model import Scene, SceneFriction
from asperity.scene.scene import load_scene
from helpers.scenes import RUBBER, SURFACE

pytest.importorskip("matplotlib", reason="reports need asperity[plot]")


@pytest.mark.parametrize(
    ("arguments", "problem"),
    [
        (["none.toml", "--output", "r.html"], "none.toml: cannot be read"),
        (["broken.toml", "--output", "r.html"], "broken.toml: [rubber]: missing"),
        (["scene.toml", "--output", "none/r.html"], "none/r.html: cannot be written"),
        (["scene.toml", "--output", "."], ".: cannot be written"),
        (["scene.toml", "--output", "scene.toml"], "scene.toml: is an input"),
        (["scene.toml", "./scene.toml", "--output", "r.html"], "scenes: must be different files"),
        ([*(f"{i}.toml" for i in range(21)), "--output", "r.html"], "scenes has 21 entries"),
    ],
)
def test_bad_input_is_one_line_before_anything_is_computed(
    folder: Path,
    capsys: pytest.CaptureFixture[str],
    monkeypatch: pytest.MonkeyPatch,
    arguments: list[str],
    problem: str,
) -> None:
    monkeypatch.setattr(make, "friction_table", None)
    Path("broken.toml").write_text("[surface]\nfile = 3\n")
    before = Path("scene.toml").read_bytes()
    assert main(["report", *arguments]) == 2
    (line,) = capsys.readouterr().err.splitlines()
    assert problem in line
    assert Path("scene.toml").read_bytes() == before
    assert not Path("r.html").exists()


def test_a_file_that_changes_meanwhile_is_refused(
    folder: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    compute = make.friction_table

    def meanwhile(*arguments: object, **options: object) -> object:
        Path("scene.toml").write_text(Path("scene.toml").read_text() + "# later\n")
        return compute(*arguments, **options)  # type: ignore[arg-type]

    monkeypatch.setattr(make, "friction_table", meanwhile)
    with pytest.raises(asperity.InvalidInput, match=r"scene\.toml: has changed while the report"):
        asperity.report("scene.toml", "r.html")
    assert not Path("r.html").exists()


def curves(mu: list[float], error: float, band: float, model: float) -> SceneFriction:
    """Results by hand: everything is hysteresis."""
    row = np.array([mu])
    return SceneFriction._made(
        notes=(),
        mu=row,
        hysteresis=row,
        adhesion=0 * row,
        contact_area=row,
        shift_factor=row,
        error_estimate=np.full(row.shape, error),
        model_error=np.full(row.shape, model),
        band=None if np.isnan(band) else (row - band, row + band),
    )


@pytest.mark.parametrize(
    ("second", "band", "model", "verdict"),
    [
        # each interval is that of 1.0 and of the second; errors of the numbers are 0.001
        (1.0019, 0.1, 0.1, 0),
        (1.0021, 0.1, 0.1, 1),
        (1.2019, 0.1, 0.1, 1),
        (1.2021, 0.1, 0.1, 2),
        # 1 + 0.1 + 0.001 + 0.1 against x - 0.1 - 0.001 - 0.1 x: x = 1.302 / 0.9
        (1.4466, 0.1, 0.1, 2),
        (1.4467, 0.1, 0.1, 3),
        (1.2021, 0.1, np.nan, 3),
        (1.0021, np.nan, np.nan, 3),
        (0.9981, np.nan, np.nan, 0),
        (0.9979, np.nan, 0.1, 2),
    ],
)
def test_verdicts_by_hand(
    folder: Path, second: float, band: float, model: float, verdict: int
) -> None:
    one = "[conditions]\npressure_pa = 81e3\nvelocity_m_s = [1e-3]\n"
    Path("one.toml").write_text(SURFACE + RUBBER + one)
    scene = load_scene("one.toml")
    results = [curves([mu], 1e-3, band, model) for mu in (1.0, second)]
    (pair,) = compared(["a", "b"], [scene, scene], results)
    (difference,) = pair.differences
    assert difference.verdict == verdict
    assert VERDICTS[verdict] in pair.summary[1]


def scene_of(name: str, pressure: str, velocity: str, more: str = "") -> Scene:
    conditions = f"[conditions]\npressure_pa = {pressure}\nvelocity_m_s = {velocity}\n"
    Path(name).write_text(SURFACE + RUBBER + conditions + more)
    return load_scene(name)


def test_scenes_of_other_points_are_computed_where_both_are_known(folder: Path) -> None:
    one = scene_of("one.toml", "[2e5]", "[1e-3, 1e-1, 3]")
    other = scene_of(
        "other.toml", "2e5", "[1e-4, 1e-2, 0.1, 1]", '[correction]\nkind = "nayak-s-factor"\n'
    )
    (pair,) = compared(["one", "other"], [one, other], [one.friction(), other.friction()])
    result = [(d.velocity, d.first, d.second) for d in pair.differences]
    velocity = np.array([1e-3, 1e-2, 0.1, 1])  # of both, where their ranges overlap
    mu = [replace(scene, velocity=velocity).friction().mu[0] for scene in (one, other)]
    assert result == list(zip(velocity, *mu, strict=True))


def test_single_pressures_are_compared_as_they_are(folder: Path) -> None:
    one = scene_of("one.toml", "2e5", "[1e-3, 1e-1]")
    two = scene_of("two.toml", "3e5", "[1e-3, 1e-1]")
    results = [one.friction(), two.friction()]
    (pair,) = compared(["one", "two"], [one, two], results)
    assert [d.second for d in pair.differences] == results[1].mu[0].tolist()


@pytest.mark.parametrize(("pressure", "velocity"), [("2e5", "[10, 20]"), ("[3e5, 4e5]", "0.1")])
def test_without_a_point_in_common_nothing_is_compared(
    folder: Path, pressure: str, velocity: str
) -> None:
    one = scene_of("one.toml", "[1e5, 2e5]", "[1e-3, 1]")
    two = scene_of("two.toml", pressure, velocity)
    (pair,) = compared(["one", "two"], [one, two], [one.friction(), two.friction()])
    assert pair.differences == []
    assert len(pair.summary) == 1


def test_many_points_are_thinned(folder: Path) -> None:
    one = scene_of("one.toml", "2e5", "{from = 1e-4, to = 1, points = 200}")
    two = scene_of("two.toml", "2e5", "{from = 1e-3, to = 10, points = 201}")
    (pair,) = compared(["one", "two"], [one, two], [one.friction(), two.friction()])
    velocity = [d.velocity for d in pair.differences]
    assert len(velocity) == MOST
    assert velocity[0] == pytest.approx(1e-3, rel=0.1)
    assert velocity[-1] == pytest.approx(1, rel=0.1)
    assert np.all(np.diff(velocity) > 0)


def test_a_scene_may_have_a_name_that_is_no_text(
    folder: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(Drawings, "_figure", lambda *_: Figure("", "", ""))
    name = os.fsdecode(b"\xff.toml")
    Path(name).write_bytes(Path("scene.toml").read_bytes())
    asperity.report([name], "r.html")
    assert r"\udcff.toml" in Path("r.html").read_text()
