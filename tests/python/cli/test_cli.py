"""The shell command: what it writes and prints."""

import csv
import json
import os
import subprocess
import sys
from contextlib import nullcontext

import numpy as np
import pytest

import asperity
from asperity.cli.main import main
from asperity.io.table import Table
from helpers.rubbers import prony
from helpers.scenes import SCENE

FRICTION = (
    "pressure_pa,velocity_m_s,mu,hysteresis,adhesion,contact_area,shift_factor,error_estimate"
)


def rows_of(text):
    """Comment lines and rows of a CSV text."""
    lines = text.splitlines()
    comments = [line for line in lines if line.startswith("#")]
    return comments, list(csv.DictReader(lines[len(comments) :]))


def expected():
    return asperity.friction(
        asperity.SelfAffineSpectrum(rms_height=76.572e-6, hurst=0.7, q0=2000.0, q1=1e5),
        prony(2e6, [1e9, 1e8, 1e7], [1e-8, 1e-6, 1e-4]),
        pressure=[[81e3], [2e5]],
        velocity=np.geomspace(1e-4, 1, 5),
        adhesion=asperity.Adhesion(shear_stress=8.3e6),
    )


def test_friction_table_is_the_cores_to_the_last_digit(folder, capsys):
    assert main(["friction", "scene.toml", "--notes", "all"]) == 0
    out, err = capsys.readouterr()
    comments, rows = rows_of(out)
    assert out.splitlines()[len(comments)] == FRICTION
    assert len(rows) == 10
    result = expected()
    for name in ("pressure", "velocity", *FRICTION.split(",")[2:]):
        column = {"pressure": "pressure_pa", "velocity": "velocity_m_s"}.get(name, name)
        values = [float(row[column]) for row in rows]
        np.testing.assert_array_equal(values, np.ravel(getattr(result, name)), err_msg=name)
    ends = [float(result.model_error.min()), float(result.model_error.max())]
    assert f"# model_error = {json.dumps(ends)}" in comments
    *notes, step = err.splitlines()
    plain = 'take [correction] kind = "partial-contact", which was 4 % rms off'
    heat = "give [heating], with a temperature and the shift of the rubber"
    steps = {"heat-left-out": heat, "no-correction": plain}
    expected_notes = [f"note: {n} -> {steps.get(n.code, n.next_step)}" for n in result.notes]
    assert notes == [line.removesuffix(" -> ") for line in expected_notes]
    assert step.startswith("next: ")


def test_several_scenes_stand_under_one_another(folder, capsys):
    (folder / "half.toml").write_text(SCENE.replace("hurst = 0.7", "hurst = 0.5"))
    assert main(["friction", "scene.toml", "half.toml", "--plot", "mu.png"]) == 0
    comments, rows = rows_of(capsys.readouterr().out)
    assert list(rows[0])[:2] == ["scene", "pressure_pa"]
    assert [row["scene"] for row in rows] == ["scene.toml"] * 10 + ["half.toml"] * 10
    assert rows[0]["mu"] != rows[10]["mu"]
    assert "# surface.hurst = 0.5" in comments
    assert (folder / "mu.png").read_bytes().startswith(b"\x89PNG")


def test_json_has_the_same_content(folder, capsys):
    assert main(["friction", "scene.toml", "--json", "--output", "mu.json"]) == 0
    assert capsys.readouterr().out == ""
    content = json.loads((folder / "mu.json").read_text())
    result = expected()
    assert ",".join(content["columns"]) == FRICTION
    assert content["columns"]["mu"] == np.ravel(result.mu).tolist()
    assert content["inputs"][0]["surface"]["hurst"] == 0.7
    assert content["units"]["pressure_pa"] == "Pa"
    assert content["notes"] == list(result.notes)


def test_area_over_wavenumber(folder, capsys):
    assert main(["area", "scene.toml", "--points", "7"]) == 0
    comments, rows = rows_of(capsys.readouterr().out)
    assert list(rows[0]) == ["pressure_pa", "velocity_m_s", "wavenumber_per_m", "contact_area"]
    assert "# points = 7" in comments
    assert len(rows) == 2 * 5 * 7
    area = np.array([float(row["contact_area"]) for row in rows]).reshape(2, 5, 7)
    assert np.all(area[..., 0] == 1)
    assert np.all(np.diff(area, axis=-1) < 0)
    np.testing.assert_allclose(area[..., -1], expected().contact_area, rtol=1e-5)


def test_spectrum_and_what_it_prints(folder, capsys):
    arguments = ["spectrum", "scan.npy", "--pixel-size", "2e-5,1e-5", "--unit", "m"]
    assert main([*arguments, "--window", "none", "--q-min", "2.5e4", "--q-max", "1.5e5"]) == 0
    out, err = capsys.readouterr()
    comments, rows = rows_of(out)
    names = ["wavenumber_per_m", "density_m4", "standard_error_m4", "count", "flag"]
    assert list(rows[0]) == names
    assert sum(int(row["count"]) for row in rows) == 60 * 80 - 1
    for line in ("# pixel_size_m = [2e-05, 1e-05]", '# unit = "m"', "# q_min = 25000.0"):
        assert line in comments
    found = dict(line.split(" = ") for line in err.splitlines() if " = " in line)
    assert float(found["fit_hurst"]) == pytest.approx(0.8, abs=0.1)
    assert 0 < float(found["fit_hurst_standard_error"]) < 0.1
    assert {"rms_height_m", "rms_slope", "rms_slope_by_differences", "skewness"} < set(found)
    assert {"slope_cutoff_1.3_per_m", "reliable_to_per_m", "fit_residual"} < set(found)
    assert any(line.startswith("# found.fit_hurst = 0.") for line in comments)
    # where the slope is not reached, no wavenumber is told as if it were
    assert found["slope_cutoff_1.3_per_m"] == "none"
    assert "note: slope_cutoff = 1.3 ends nothing here: the rms slope up to pi / pixel" in err


@pytest.mark.parametrize("verb", ["friction", "area"])
def test_bar_only_on_a_terminal(folder, capsys, monkeypatch, verb):
    tqdm = pytest.importorskip("tqdm")
    bars: list[object] = []

    def bar(chunks, **settings):
        bars.append((settings["delay"], len(chunks)))
        return nullcontext(chunks)

    monkeypatch.setattr(tqdm, "tqdm", bar)
    monkeypatch.setattr("asperity.scene.model._CHUNK", 4)
    main([verb, "scene.toml"])
    assert bars == []
    monkeypatch.setattr("sys.stderr.isatty", lambda: True)
    main([verb, "scene.toml"])
    assert bars == [(2, 3)]  # two seconds, ten points


FLAT, NOISE = np.zeros((20, 30)), np.random.default_rng(1).normal(size=(64, 64))


@pytest.mark.parametrize(
    ("heights", "arguments"),
    [
        (FLAT, []),
        (FLAT, ["--q-min", "1"]),
        (NOISE, ["--q-min", "5e5"]),
        (NOISE, ["--q-min", "1e9"]),
    ],
)
def test_spectrum_without_a_fit(folder, capsys, heights, arguments):
    np.save("scan.npy", heights)
    arguments = [*arguments, "--pixel-size", "1e-6", "--unit", "um"]
    assert main(["spectrum", "scan.npy", *arguments]) == 0
    out, err = capsys.readouterr()
    comments, rows = rows_of(out)
    assert rows
    (note,) = [line for line in err.splitlines() if line.startswith("note: no self-affine fit: ")]
    assert f"# {note}" in comments
    assert "fit_hurst" not in out + err


@pytest.mark.parametrize("form", [[], ["--json"]])
def test_names_that_the_terminal_cannot_show(folder, form):
    (folder / "größe日.toml").write_text(SCENE)
    done = subprocess.run(
        [sys.executable, "-m", "asperity", "friction", "größe日.toml", *form],
        capture_output=True,
        env={**os.environ, "PYTHONIOENCODING": "ascii"},
        check=True,
    )
    text = done.stdout.decode("ascii")
    if form:
        name = json.loads(text)["inputs"][0]["scene"]
    else:
        name = json.loads(text.splitlines()[1].removeprefix("# scene = "))
    assert name == "größe日.toml"


def test_numbers_have_the_shortest_digits_that_read_back():
    values = [0.1, 81e3, 1e-6, 1 / 3, 5e-324, 1.7976931348623157e308, 0.1 + 0.2]
    text = Table("t", [], [], {"x": values}).csv().splitlines()
    cells = text[text.index("x") + 1 :]
    assert cells[:5] == ["0.1", "81000", "1e-06", "0.3333333333333333", "5e-324"]
    assert [float(cell) for cell in cells] == values


def test_infinite_numbers_survive_both_forms():
    table = Table(
        "friction", [{}], [], {"shift_factor": [np.float64(np.inf), 1.5], "count": [3, 4]}
    )
    assert table.csv().splitlines()[-2:] == ["inf,3", "1.5,4"]
    assert json.loads(table.json())["columns"] == {"shift_factor": ["inf", 1.5], "count": [3, 4]}
