"""Reports that cannot be made are refused in one line, and verdicts of differences by hand."""

import os
import sys
from pathlib import Path

import numpy as np
import pytest

import asperity
from asperity.base.extras import to_install
from asperity.cli.main import main
from asperity.report import make
from asperity.report.comparison import VERDICTS, compared
from asperity.report.texts import percent_text
from asperity.scene.model import Curves
from asperity.scene.scene import load_scene
from helpers.scenes import CONDITIONS, RUBBER, SURFACE

pytest.importorskip("matplotlib", reason="reports need asperity[plot]")


def refused(arguments: list[str], capsys: pytest.CaptureFixture[str]) -> str:
    assert main(["report", *arguments]) == 2
    (line,) = capsys.readouterr().err.splitlines()
    return line


def test_bad_input_is_one_line(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    Path("broken.toml").write_text("[surface]\nfile = 3\n")
    before = Path("scene.toml").read_bytes()
    for arguments, problem in (
        (["none.toml", "--output", "r.html"], "none.toml: cannot be read"),
        (["broken.toml", "--output", "r.html"], "broken.toml: [rubber]: missing"),
        (["scene.toml", "--output", "none/r.html"], "none does not exist"),
        (["scene.toml", "--output", "."], "cannot be written: it is a directory"),
        (["scene.toml", "--output", "scene.toml"], "scene.toml: is an input"),
        (["scene.toml", "./scene.toml", "--output", "r.html"], "scenes: must be different files"),
        ([f"{i}.toml" for i in range(21)] + ["--output", "r.html"], "scenes has 21 entries"),
    ):
        assert problem in refused(arguments, capsys)
    assert Path("scene.toml").read_bytes() == before
    assert not Path("r.html").exists()


@pytest.mark.parametrize("module", ["jinja2", "matplotlib"])
def test_what_is_missing_is_named(
    module: str,
    folder: Path,
    capsys: pytest.CaptureFixture[str],
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setitem(sys.modules, module, None)
    line = refused(["scene.toml", "--output", "r.html"], capsys)
    assert line == f"asperity: report: {module} is missing: {to_install('plot')}"


def test_bad_calls(folder: Path) -> None:
    with pytest.raises(asperity.InvalidInput, match="scenes has 0 entries: must have 1 to 20"):
        asperity.report([], "r.html")
    with pytest.raises(asperity.InvalidInput, match=r"scenes\[1\]"):
        asperity.report(["scene.toml", 3], "r.html")  # type: ignore[list-item]
    with pytest.raises(asperity.InvalidInput, match="scenes = 3"):
        asperity.report(3, "r.html")  # type: ignore[arg-type]
    with pytest.raises(asperity.InvalidInput, match="title = 3: must be a text"):
        asperity.report("scene.toml", "r.html", title=3)  # type: ignore[arg-type]
    with pytest.raises(asperity.InvalidInput, match="path"):
        asperity.report("scene.toml", 3)  # type: ignore[arg-type]


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


def curves(mu: list[float], error: float, band: float, model: float) -> Curves:
    """Results by hand: everything is hysteresis."""
    row = np.array([mu])
    return Curves(
        notes=[],
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
    assert pair.summary == [f"1 of 1 points differ {VERDICTS[verdict]}, from 0.001 to 0.001 m/s."]


def test_only_points_that_are_shared_are_compared(folder: Path) -> None:
    Path("one.toml").write_text(
        SURFACE + RUBBER + "[conditions]\npressure_pa = [2e5]\nvelocity_m_s = [1e-3, 1e-1, 3]\n"
    )
    one, other = load_scene("one.toml"), load_scene("scene.toml")
    assert CONDITIONS in Path("scene.toml").read_text()
    names = ["one", "other"]
    (pair,) = compared(names, [one, other], [one.friction(), other.friction()])
    assert [(d.pressure, d.velocity) for d in pair.differences] == [
        (2e5, pytest.approx(1e-3)),
        (2e5, pytest.approx(0.1)),
    ]
    Path("two.toml").write_text(
        SURFACE + RUBBER + "[conditions]\npressure_pa = 3e5\nvelocity_m_s = 1e-3\n"
    )
    two = load_scene("two.toml")
    (pair,) = compared(names, [one, two], [one.friction(), two.friction()])
    assert pair.differences == []
    assert pair.summary == [
        "The two have no pressure and velocity in common: give both the same sweep."
    ]


def test_an_output_that_is_an_input_is_refused_before_anything_is_computed(
    folder: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(make, "friction_table", None)
    with pytest.raises(asperity.InvalidInput, match="is an input"):
        asperity.report(["scene.toml"], "scene.toml")


def test_a_scene_may_have_a_name_that_is_no_text(folder: Path) -> None:
    name = os.fsdecode(b"\xff.toml")
    Path(name).write_bytes(Path("scene.toml").read_bytes())
    asperity.report([name], "r.html")
    assert r"\udcff.toml: mu from" in Path("r.html").read_text()


def test_percents_have_no_exponent() -> None:
    assert [percent_text(x, "+") for x in (0.0123, 12.34, 99.4, 99.6, -900)] == [
        "+0.012 %",
        "+12 %",
        "+99 %",
        "+100 %",
        "-900 %",
    ]
