"""`asperity map`: the map of a scene, what a file holds, and what is refused."""

import json
import re
import subprocess
import sys

import numpy as np
import pytest
import scipy.interpolate
import scipy.io

import asperity
from asperity.scene.scene import load_scene
from helpers.scenes import ADHESION, CONDITIONS, CURVE, HEATING, LAW, RUBBER, SCENE, SURFACE
from helpers.shell import status_of

QUICK = ["--checked", "2000"]


@pytest.fixture
def scene(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    path = tmp_path / "scene.toml"
    path.write_text(SCENE, encoding="utf-8")
    return path


def test_a_map_of_a_scene(scene, capsys):
    assert status_of(["map", scene, "--output", "road.fmap", "--plot", "map.png", *QUICK]) == 0
    told = capsys.readouterr()
    assert "max_error = " in told.out
    result = asperity.FrictionMap.load("road.fmap")
    assert result.pressure == (81e3, 2e5)
    assert result.velocity == pytest.approx((1e-4, 1))
    assert (result.rtol, result.checked, result.exceeded) == (1e-4, 2000, 0)
    parts = load_scene(scene)
    exact = asperity.friction(
        parts.spectrum, parts.rubber, pressure=1e5, velocity=0.03, adhesion=parts.adhesion
    )
    assert result.mu(1e5, 0.03) == pytest.approx(exact.mu, rel=result.max_error)
    assert (scene.parent / "map.png").read_bytes()[:4] == b"\x89PNG"
    assert status_of(["map", "--info", "road.fmap"]) == 0
    info = capsys.readouterr().out
    assert told.out in info
    assert "surface.hurst = 0.7" in info
    assert status_of(["map", "--info", "road.fmap", "--json"]) == 0
    as_json = json.loads(capsys.readouterr().out)
    assert as_json["max_error"] == result.max_error
    assert as_json["pressure_pa"] == [81e3, 2e5]


def test_sides_and_tolerance_may_be_given(scene):
    sides = ["--pressure", "1e4,1e6", "--velocity", "1e-3,0.1"]
    assert status_of(["map", scene, "--output", "a.fmap", *sides, "--rtol", "1e-3", *QUICK]) == 0
    result = asperity.FrictionMap.load("a.fmap")
    assert (result.pressure, result.velocity, result.rtol) == ((1e4, 1e6), (1e-3, 0.1), 1e-3)
    stated = SCENE + "\n[solver]\nrtol = 1e-5\n"
    scene.write_text(stated, encoding="utf-8")
    assert status_of(["map", scene, "--output", "b.fmap", *QUICK]) == 0
    assert asperity.FrictionMap.load("b.fmap").rtol == 1e-5


def test_one_pressure_gets_a_decade_to_either_side_and_a_note(scene, capsys):
    conditions = CONDITIONS.replace("[81e3, 2e5]", "81e3")
    scene.write_text(SURFACE + RUBBER + conditions + ADHESION, encoding="utf-8")
    assert status_of(["map", scene, "--output", "a.fmap", *QUICK]) == 0
    result = asperity.FrictionMap.load("a.fmap")
    np.testing.assert_allclose(result.pressure, (8.1e3, 8.1e5))
    assert any(note.startswith("pressure: the scene has one") for note in result.notes)
    assert "pressure: the scene has one" in capsys.readouterr().err


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (["map"], "SCENE.toml, or --info FILE"),
        (["map", "--info", "a.fmap", "--rtol", "1e-3"], "--rtol: goes with a SCENE.toml"),
        (["map", "--info", "none.fmap"], "none.fmap: cannot be read: No such file"),
        (["map", "--info", "scene.toml"], "scene.toml: is no friction map"),
        (["map", "scene.toml", "--pressure", "2e5,1e5"], "--pressure = 2e5,1e5: must be"),
        (["map", "scene.toml", "--output", "scene.toml"], "scene.toml: is an input"),
        (
            ["map", "scene.toml", "--export", "a.csv", "--output", "a.csv"],
            "must be different files",
        ),
        (["map", "cold.toml", "--output", "a.fmap"], "[conditions] temperature: must be"),
    ],
)
def test_what_cannot_be_done_is_said_in_a_line(scene, capsys, arguments, message):
    (scene.parent / "cold.toml").write_text(with_heat("[298, 302]", heat=""), encoding="utf-8")
    assert status_of(arguments) == 2
    told = capsys.readouterr()
    assert message in told.err
    assert len(told.err.splitlines()) == 1
    assert {path.name for path in scene.parent.iterdir()} == {"scene.toml", "cold.toml"}


@pytest.mark.parametrize(
    ("options", "named"),
    [([], "[conditions] velocity_m_s = "), (["--velocity", "1e-5,1"], "--velocity = 1e-5")],
)
def test_velocities_off_the_curve_are_named_as_they_were_stated(scene, capsys, options, named):
    lines = [f"{w:.6g},{1e6 * w**0.1:.6g},{2e5 * w**0.1:.6g}\n" for w in np.geomspace(1, 1e6, 30)]
    header = "angular_frequency_rad_s,storage_modulus_pa,loss_modulus_pa\n"
    (scene.parent / "curve.csv").write_text(header + "".join(lines), encoding="utf-8")
    scene.write_text(SURFACE + CURVE + CONDITIONS, encoding="utf-8")
    assert status_of(["map", scene, "--output", "a.fmap", *options]) == 2
    assert capsys.readouterr().err.startswith(f"asperity: {scene}: {named}")


INTERRUPTED = """
import os, signal, sys, threading
from asperity.cli.main import main
from asperity.scene import mapped

signal.signal(signal.SIGINT, signal.default_int_handler)  # nohup and CI start with it ignored
running, compute = threading.Event(), mapped.friction_map

def interrupted(surface, rubber, *, progress, **asked):
    def tell(share):
        progress(share)
        if share > 0.2:  # in the check
            running.set()
    return compute(surface, rubber, progress=tell, **asked)

def interrupt():
    running.wait()
    os.kill(os.getpid(), signal.SIGINT)

mapped.friction_map = interrupted
threading.Thread(target=interrupt, daemon=True).start()
sys.exit(main(["map", "scene.toml", "--output", "a.fmap", "--checked", "2000000000"]))  # an hour
"""


def test_interrupt_leaves_no_half_of_a_map(scene):
    done = subprocess.run(
        ["sh", "-c", 'trap "" INT; exec "$0" -c "$1"', sys.executable, INTERRUPTED],
        capture_output=True,
        text=True,
        check=False,
        timeout=100,
    )
    assert (done.returncode, done.stdout, done.stderr) == (130, "", "asperity: interrupted\n")
    assert [path.name for path in scene.parent.iterdir()] == ["scene.toml"]


def with_heat(temperature, heat=HEATING):
    conditions = f"{CONDITIONS}\ntemperature_k = {temperature}\n"
    return SURFACE + RUBBER + LAW + conditions + ADHESION + heat


def test_notes_of_a_map_name_the_keys_of_its_scene(scene, capsys):
    heat = HEATING.replace("contact_diameter_m = 1e-3", "contact_diameter_m = 0.1")
    assert heat != HEATING
    scene.write_text(with_heat("300", heat), encoding="utf-8")
    box = ["--pressure", "1e5,1.1e5", "--velocity", "1e-3,1.1e-3", "--rtol", "1e-2"]
    assert status_of(["map", scene, "--output", "a.fmap", *box, *QUICK]) == 0
    (note,) = (n for n in asperity.FrictionMap.load("a.fmap").notes if n.code[:5] == "macro")
    assert "[heating] contact_diameter_m" in note
    assert note.next_step.startswith("give macro_wavenumber_per_m")
    assert f"note: {note}" in capsys.readouterr().err


@pytest.mark.parametrize("temperature", ["300", "[298, 302]"])
def test_a_map_of_a_scene_with_heat(scene, capsys, temperature):
    scene.write_text(with_heat(temperature), encoding="utf-8")
    box = ["--pressure", "1e5,2e5", "--velocity", "0.1,1", "--rtol", "1e-2"]
    given = ["--output", "road.fmap", "--checked", "400", *box]
    given += ["--plot", "map.png"] if "[" in temperature else []
    assert status_of(["map", scene, *given]) == 0
    told = capsys.readouterr().out
    result = asperity.FrictionMap.load("road.fmap")
    assert result.temperature == ((298, 302) if "[" in temperature else (300, 300))
    assert "temperature_k = " in told
    assert "memory_error = " in told
    parts = load_scene(scene, for_friction=True)
    exact = asperity.friction(
        parts.spectrum,
        parts.built_rubber.at_reference,
        pressure=1.5e5,
        velocity=0.3,
        adhesion=parts.adhesion,
        temperature=300,
        shift=parts.built_rubber.shift,
        heating=parts.heating,
    )
    assert result.mu(1.5e5, 0.3, temperature=300) == pytest.approx(exact.mu, rel=result.max_error)
    cold = result.mu(1.5e5, 0.3, temperature=300, distance=0)
    assert cold == pytest.approx(exact.cold.mu, rel=result.max_error)
    assert (scene.parent / "map.png").exists() == ("--plot" in given)


@pytest.mark.parametrize("name", ["grid.mat", "grid.csv"])
def test_a_grid_for_simulators_that_interpolate(scene, capsys, name):
    assert status_of(["map", scene, "--output", "road.fmap", "--export", name, *QUICK]) == 0
    told = re.search(r"mu is off by up to ([0-9.e-]+)", capsys.readouterr().err)
    result = asperity.FrictionMap.load("road.fmap")
    if name == "grid.mat":
        grid = scipy.io.loadmat(name, squeeze_me=True, simplify_cells=True)["friction"]
        pressure, velocity, mu = grid["pressure_pa"], grid["velocity_m_s"], grid["mu"]
        np.testing.assert_allclose(grid["mu_hysteresis"] + grid["mu_adhesion"], mu, rtol=1e-13)
        assert grid["max_error"] == result.max_error
        stated = grid["interpolation_error"]
    else:
        rows = np.genfromtxt(name, delimiter=",", comments="#")
        lines = (scene.parent / name).read_text(encoding="utf-8").splitlines()
        heading = next(line for line in lines if not line.startswith("#"))
        velocity = np.array(heading.split(",")[1:], dtype=float)
        pressure, mu = rows[1:, 0], rows[1:, 1:]
        stated = float(next(x for x in lines if "interpolation_error" in x).split("=")[1])
    assert stated == pytest.approx(float(told[1]), rel=0.1)
    assert (pressure[0], pressure[-1]) == result.pressure
    assert (velocity[0], velocity[-1]) == result.velocity
    np.testing.assert_allclose(mu, result.mu(pressure[:, None], velocity), rtol=1e-14)
    # a simulator's own interpolation, at points that the error was not taken at
    draws = np.random.default_rng(4)
    p, v = (np.exp(draws.uniform(*np.log(box), 5000)) for box in (result.pressure, result.velocity))
    look_up = scipy.interpolate.RegularGridInterpolator((np.log(pressure), np.log(velocity)), mu)
    off = np.abs(look_up((np.log(p), np.log(v))) / result.mu(p, v) - 1)
    assert off.max() < 1.5 * stated
    (scene.parent / name).unlink()
    assert status_of(["map", "--info", "road.fmap", "--export", name]) == 0
    assert (scene.parent / name).exists()


def test_a_grid_of_several_temperatures(scene, capsys):
    scene.write_text(with_heat("[298, 302]"), encoding="utf-8")
    box = ["--pressure", "1e5,2e5", "--velocity", "0.1,1", "--rtol", "1e-2", "--checked", "100"]
    given = ["--output", "road.fmap", "--export", "grid.mat", *box]
    assert status_of(["map", scene, *given]) == 0
    result = asperity.FrictionMap.load("road.fmap")
    grid = scipy.io.loadmat("grid.mat", squeeze_me=True, simplify_cells=True)["friction"]
    assert (grid["temperature_k"][0], grid["temperature_k"][-1]) == (298, 302)
    assert grid["mu"].shape == (41, 121, 9)
    at = [grid["pressure_pa"][3], grid["velocity_m_s"][5]]
    there = result.mu(*at, temperature=grid["temperature_k"][7])
    assert grid["mu"][3, 5, 7] == pytest.approx(there, rel=1e-14)
    assert status_of(["map", "--info", "road.fmap", "--export", "grid.csv"]) == 2
    assert "the map covers 298 to 302 K, a table has one; choose .mat" in capsys.readouterr().err
    assert not (scene.parent / "grid.csv").exists()
