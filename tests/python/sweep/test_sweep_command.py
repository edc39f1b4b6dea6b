"""The verb `sweep`: what it writes, what it says last, and how bad input is refused."""

import os

import numpy as np
import pytest

import asperity
from asperity.cli.main import main
from asperity.sweep import run
from helpers.cases import case
from helpers.sweeps import SCENE, toml

xarray = pytest.importorskip("xarray", reason="a sweep needs asperity[sweep]")
pytest.importorskip("zarr", reason="a store needs asperity[sweep]")

SWEEP = """
scene = "scene.toml"
variables = ["mu", "contact_area"]
[over]
surface.hurst = [0.7, 0.8]
"correction.kind" = ["none", "s-factor"]
conditions.pressure_pa = {from = 1e4, to = 1e6, points = 3}
[over.road]
surface.rms_height_m = [1e-4, 2e-4]
"surface.q0_per_m" = [1e3, 2e3]
"""


@pytest.fixture(autouse=True)
def folder(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "scene.toml").write_text(toml(SCENE))
    (tmp_path / "sweep.toml").write_text(SWEEP)
    return tmp_path


def refused(capsys, *line):
    """What the command says in its one line."""
    status = main(["sweep", *line])
    out, err = capsys.readouterr()
    assert status == 2, err
    assert out == ""
    assert len(err.splitlines()) == 1
    return err


def test_it_writes_what_python_computes(capsys):
    assert main(["sweep", "sweep.toml", "--output", "r.zarr"]) == 0
    err = capsys.readouterr().err.splitlines()
    assert err[-1] == "r.zarr: 168 points, none failed"
    assert any(line.startswith("note: above 0.01 m/s flash") for line in err)
    over = {
        "surface.hurst": [0.7, 0.8],
        "correction.kind": ["none", "s-factor"],
        "conditions.pressure_pa": np.geomspace(1e4, 1e6, 3),
        "road": {"surface.rms_height_m": [1e-4, 2e-4], "surface.q0_per_m": [1e3, 2e3]},
    }
    expected = asperity.sweep("scene.toml", over)
    with xarray.open_dataset("r.zarr") as result:
        assert [*result.data_vars] == ["contact_area", "failure", "failure_message", "mu"]
        assert result.mu.dims == expected.mu.dims
        assert np.array_equal(result.mu, expected.mu)
    assert main(["sweep", "sweep.toml", "--output", "r.zarr", "--resume"]) == 0
    capsys.readouterr()
    assert "exists already" in refused(capsys, "sweep.toml", "--output", "r.zarr")
    assert main(["sweep", "sweep.toml", "--output", "r.zarr", "--force", "--variables", "mu"]) == 0
    with xarray.open_dataset("r.zarr") as result:
        assert "contact_area" not in result


def test_numbers_of_a_file_are_numbers_of_any_key(folder):
    """Also of a key that a scene takes one of; their axis is read and drawn as such."""
    sweep = 'scene = "scene.toml"\n[over]\nadhesion.shear_stress_pa = [4e6, 8.3e6]\n'
    (folder / "sweep.toml").write_text(sweep)
    assert main(["sweep", "sweep.toml", "--output", "r.zarr"]) == 0
    with xarray.open_zarr("r.zarr") as stored:
        stress = stored["adhesion.shear_stress_pa"]
        np.testing.assert_array_equal(stress, [4e6, 8.3e6])
        assert stress.attrs["units"] == "Pa"


def test_a_dry_run_tells_what_it_would_take(capsys):
    assert main(["sweep", "sweep.toml", "--dry-run"]) == 0
    told = dict(line.split(" = ") for line in capsys.readouterr().out.splitlines())
    assert told["points"] == "168"
    assert told["bytes"] == str(168 * 24)
    assert int(told["tasks"]) >= 1
    assert float(told["seconds_of_one_worker"]) > 0
    assert sorted(os.listdir()) == ["scene.toml", "sweep.toml"]


def test_failures_are_counted_in_the_last_line_and_the_status(folder, capsys):
    text = SWEEP.replace("surface.hurst = [0.7, 0.8]", "surface.q1_per_m = [1e5, 900.0]")
    (folder / "sweep.toml").write_text(text.replace("900.0", "2e3"))
    assert main(["sweep", "sweep.toml", "--output", "r.zarr"]) == 1
    last = capsys.readouterr().err.splitlines()[-1]
    assert last.startswith("asperity: r.zarr: 42 of 168 points failed: scene.toml: [surface]")
    with xarray.open_dataset("r.zarr") as result:
        assert int((result.failure != 0).sum()) == 42
        assert int(np.isnan(result.mu).sum()) == 42


BAD = {
    "surface.hurts = [0.7]": "surface.hurts: is no key of a scene, did you mean surface.hurst?",
    "surface.x = [0.7]": "surface.x: is no key of a scene, allowed are surface.file, surface.",
    "surface.hurst = []": "surface.hurst: is empty",
    "surface.hurst = 0.7": "surface.hurst = 0.7: must be a list",
    'surface.hurst = ["x"]': 'hurst = "x": must be a number',
    "surface.rms_height_m = [1e-4, 100.0]": "must be at most 1 m",
    'correction.kind = ["s-faktor"]': "did you mean s-factor?",
    "conditions.pressure_pa = [-1e5]": "must be positive and finite",
    "conditions.pressure_pa = {from = 1, points = 3}": "to is missing",
    "[over.road]": "over road: has no keys",
    "[over.road]\nsurface.hurst = [0.7, 0.8]\nsurface.q0_per_m = [1e3]": "must be equally long",
    "surface.hurst = [0.7]\n[over.road]\nsurface.hurst = [0.7]": "is in two axes",
    "surface.rolloff_per_m = [1e9]": "rolloff",
    "[over.mu]\nsurface.hurst = [0.7]": "over 'mu': is the name of a variable",
    '[over.""]\nsurface.hurst = [0.7]': "over '': must be of letters",
    '[over."conditions.velocity_m_s"]\nsurface.hurst = [0.7]': "is a key of a scene",
}


def test_bad_axes_are_refused_in_a_line_that_names_them(folder, capsys):
    for text, said in BAD.items():
        with case(text=text):
            (folder / "sweep.toml").write_text(f'scene = "scene.toml"\n[over]\n{text}\n')
            line = refused(capsys, "sweep.toml", "--output", "r.zarr")
            assert said in line
            # a value that another key of the scene forbids is said of the scene
            assert ("scene.toml: [" if "rolloff" in text else "sweep.toml: ") in line
            assert sorted(os.listdir()) == ["scene.toml", "sweep.toml"]


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("[over]\nsurface.hurst = [0.7]", "scene: must be the name of a file"),
        ('scene = "scene.toml"', "[over]: must be a table"),
        ('scene = "scene.toml"\nvelocities = 3\n[over]', "velocities: unknown key"),
        ('scene = "scene.toml"\nvariables = ["my"]\n[over]', "did you mean mu?"),
        ("scene = ", "not a TOML file"),
    ],
)
def test_a_bad_file_is_refused(text, said, folder, capsys):
    (folder / "sweep.toml").write_text(text)
    assert said in refused(capsys, "sweep.toml", "--output", "r.zarr")


@pytest.mark.parametrize(
    ("line", "said"),
    [
        ("sweep.toml", "--output: is missing"),
        ("sweep.toml --output r.csv", "must end in .zarr or .nc"),
        ("sweep.toml --output r.zarr --force --resume", "--force, --resume: must be one of them"),
        ("sweep.toml --dry-run --resume", "--dry-run, --resume: must be one of them"),
        ("sweep.toml --output r.zarr --workers 0", "--workers 0: must be from 1"),
        ("sweep.toml --output r.zarr --variables mu,my", "did you mean mu?"),
        ("sweep.toml --output r.zarr --scheduler nowhere:x", "--scheduler nowhere:x"),
    ],
)
def test_bad_options_are_refused(line, said, capsys):
    assert said in refused(capsys, *line.split())
    assert sorted(os.listdir()) == ["scene.toml", "sweep.toml"]


def test_an_executor_that_ends_is_told(monkeypatch):
    from concurrent.futures import ThreadPoolExecutor

    pool = ThreadPoolExecutor(1)
    pool.shutdown()
    with pytest.raises(asperity.Error, match="the executor takes no tasks"):
        asperity.sweep(SCENE, {"surface.hurst": [0.7]}, executor=pool)
    monkeypatch.setattr(run, "work", lambda task: 1 / 0)
    with pytest.raises(asperity.Error, match="a task failed on its worker: ZeroDivisionError"):
        asperity.sweep(SCENE, {"surface.hurst": [0.7]})
