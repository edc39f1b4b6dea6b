"""`asperity fit`: measured friction in, adhesion, curve and picture out."""

import csv
import json

import numpy as np
import pytest

import asperity
from asperity.cli.main import main
from asperity.io.read_friction import read_friction
from helpers.shell import status_of

SCENE = """
[surface]
rms_height_m = 265.7e-6
hurst = 0.87
q0_per_m = 2000
q1_per_m = 2e4
[rubber]
equilibrium_modulus_pa = 3e6
moduli_pa = [1e7, 1e8, 1e9]
relaxation_times_s = [1e-2, 1e-4, 1e-6]
[conditions]
pressure_pa = {pressure}
velocity_m_s = {{from = 1e-6, to = 1, points = 25}}
{more}
"""
CORRECTED = '[correction]\nkind = "nayak-s-factor"'
TRUTH = {"shear_stress": 8.3e6, "reference_velocity": 6e-3, "width": 0.1}
KEYS = {
    "shear_stress_pa": "shear_stress",
    "reference_velocity_m_s": "reference_velocity",
    "width": "width",
}


@pytest.fixture
def scene(tmp_path):
    path = tmp_path / "scene.toml"

    def write(more=CORRECTED, pressure="81e3"):
        path.write_text(SCENE.format(more=more, pressure=pressure))
        return path

    return write


def theory(path, pressure, velocity, shear_stress=TRUTH["shear_stress"]):
    """mu of a scene with the true adhesion."""
    loaded = asperity.scene.scene.load_scene(path)
    return asperity.friction(
        loaded.spectrum,
        loaded.rubber,
        pressure=pressure,
        velocity=velocity,
        correction=loaded.correction,
        adhesion=asperity.Adhesion(**{**TRUTH, "shear_stress": shear_stress}),
    ).mu


def measurement(path, noise=0.05, pressure=81e3, seed=1):
    """Rows of pressure, velocity and mu as a friction tester would give them."""
    velocity = np.repeat(np.geomspace(1e-6, 1, 15), 3)
    mu = theory(path, pressure, velocity)
    mu = mu * np.exp(noise * np.random.default_rng(seed).normal(size=mu.size))
    return np.column_stack([np.full(mu.size, pressure), velocity, mu])


def table(path, rows, header="pressure_pa,velocity_m_s,mu"):
    text = [header, *(",".join(f"{x:.9g}" for x in row) for row in rows)]
    path.write_text("\n".join(text))
    return path


def written(path):
    lines = path.read_text().splitlines()
    return list(csv.DictReader(line for line in lines if not line.startswith("#")))


def test_from_a_measurement_to_the_adhesion_its_curve_and_a_picture(scene, tmp_path, capsys):
    pytest.importorskip("matplotlib", reason="pictures need asperity[plot]")
    path = scene()
    measured = table(tmp_path / "measured.csv", measurement(path))
    out, picture = tmp_path / "fit.json", tmp_path / "fit.svg"
    arguments = ["--json", "--output", str(out), "--plot", str(picture)]
    assert main(["fit", str(path), str(measured), *arguments]) == 0
    content = json.loads(out.read_text())
    result = content["inputs"][0]["found"]
    for key, name in KEYS.items():
        error = result[f"{key}_standard_error"]
        assert 0 < error < 0.5 * result[key]
        assert abs(result[key] - TRUTH[name]) < 4 * error
    assert result["residual"] == pytest.approx(0.05, rel=0.5)
    terminal = capsys.readouterr().err
    assert "shear_stress_pa = " in terminal
    low, mu, high = (np.array(content["columns"][name]) for name in ("mu_low", "mu", "mu_high"))
    assert ((low < mu) & (mu < high)).all()  # of the fit alone: nothing else here has errors
    assert "shear_stress_pa_standard_error = " in terminal
    text = picture.read_text()
    for words in ("(a) original", "(b) modified", "total", "hysteresis", "adhesion", "measured"):
        assert words in text


def test_the_table_is_the_curve_at_the_velocities_of_the_scene(scene, tmp_path):
    path = scene()
    measured = table(tmp_path / "measured.csv", measurement(path, noise=0))
    out = tmp_path / "fit.csv"
    assert main(["fit", str(path), str(measured), "--output", str(out)]) == 0
    rows = written(out)
    velocity = np.array([float(row["velocity_m_s"]) for row in rows])
    np.testing.assert_allclose(velocity, np.geomspace(1e-6, 1, 25), rtol=1e-12)
    mu = [float(row["mu"]) for row in rows]
    np.testing.assert_allclose(mu, theory(path, 81e3, velocity), rtol=1e-5)
    for row in rows:
        for end in ("", "_original"):
            parts = float(row[f"hysteresis{end}"]) + float(row[f"adhesion{end}"])
            assert parts == pytest.approx(float(row[f"mu{end}"]), rel=1e-12, abs=0)
        assert float(row["hysteresis_original"]) > float(row["hysteresis"])


def test_several_pressures_are_fitted_together_each_point_at_its_own(scene, tmp_path, capsys):
    path = scene(pressure="[5e4, 2e5]")
    rows = np.vstack([measurement(path, 0, p) for p in (5e4, 2.05e5)])
    measured = table(tmp_path / "measured.csv", rows)
    out = tmp_path / "fit.json"
    assert main(["fit", str(path), str(measured), "--json", "--output", str(out)]) == 0
    content = json.loads(out.read_text())
    assert set(content["columns"]["pressure_pa"]) == {5e4, 2e5}
    for key, name in KEYS.items():
        assert content["inputs"][0]["found"][key] == pytest.approx(TRUTH[name], rel=1e-4)
    assert "drawn beside the nearest" not in capsys.readouterr().err
    far = table(tmp_path / "far.csv", measurement(path, 0, 8e4))
    assert main(["fit", str(path), str(far), "--output", str(out), "--notes", "all"]) == 0
    assert "drawn beside the nearest" in capsys.readouterr().err


def test_the_points_hold_the_sum_of_hysteresis_and_adhesion(scene, tmp_path):
    """Of a drawn surface the points are fitted anew: drawn apart the band would be far wider."""
    surface = asperity.SelfAffineSpectrum(rms_height=2e-5, hurst=0.8, q0=2e4, q1=3e5)
    heights = asperity.synthesize(surface, shape=(64, 64), pixel_size=1e-5, seed=4).heights
    np.save(tmp_path / "scan.npy", heights)
    path = scene()
    text = path.read_text()
    measured_surface = '[surface]\nfile = "scan.npy"\npixel_size_m = 1e-5\nunit = "m"\n'
    path.write_text(measured_surface + text[text.index("[rubber]") :])
    measured = table(tmp_path / "measured.csv", measurement(path, noise=0.01))
    out = tmp_path / "fit.csv"
    assert main(["fit", str(path), str(measured), "--output", str(out)]) == 0
    rows = written(out)
    loaded = asperity.scene.scene.load_scene(path)
    fit = asperity.fit_adhesion(
        loaded.spectrum,
        loaded.rubber,
        correction=loaded.correction,
        pressure=81e3,
        **dict(zip(("velocity", "mu"), measurement(path, noise=0.01)[:, 1:].T, strict=True)),
    )
    slow = rows[4]  # nearly all adhesion
    apart = asperity.friction_band(
        loaded.spectrum,
        loaded.rubber,
        correction=loaded.correction,
        pressure=81e3,
        velocity=float(slow["velocity_m_s"]),
        adhesion=fit,
    )
    assert float(slow["mu_high"]) - float(slow["mu_low"]) < 0.7 * (apart.upper - apart.lower)


def test_parameters_are_held(scene, tmp_path):
    path = scene(more="")
    measured = table(tmp_path / "measured.csv", measurement(path))
    out = tmp_path / "fit.json"
    hold = ["--hold", "width=0.1,reference_velocity_m_s=6e-3", "--json", "--output", str(out)]
    assert main(["fit", str(path), str(measured), *hold]) == 0
    result = json.loads(out.read_text())["inputs"][0]["found"]
    assert (result["width"], result["reference_velocity_m_s"]) == (0.1, 6e-3)
    assert (result["width_standard_error"], result["shear_stress_pa_standard_error"] > 0) == (
        0,
        True,
    )
    assert result["shear_stress_pa"] == pytest.approx(8.3e6, rel=0.05)


def test_an_adhesion_of_the_scene_gives_way_and_says_so(scene, tmp_path, capsys):
    path = scene(more="[adhesion]\nshear_stress_pa = 1e6")
    measured = table(tmp_path / "measured.csv", measurement(path))
    assert main(["fit", str(path), str(measured)]) == 0
    captured = capsys.readouterr()
    assert "the scene's [adhesion] gave way to the fitted one" in captured.err
    assert "adhesion.shear_stress_pa" not in captured.out


def test_units_are_those_of_the_columns_names(scene, tmp_path):
    path = scene()
    rows = measurement(path)
    plain = read_friction(table(tmp_path / "a.csv", rows))
    other = rows / [1e3, 1e-3, 1]
    scaled = read_friction(
        table(tmp_path / "b.csv", other, "pressure_kpa; velocity_mm_s; mu".replace("; ", ","))
    )
    hourly = read_friction(table(tmp_path / "c.csv", rows[:, 1:] * [3.6, 1], "velocity_km_h,mu"))
    german = tmp_path / "d.csv"
    german.write_text("velocity_m_s;mu\n0,001;0,5\n1e-2;1,25\n")
    comma = read_friction(german)
    assert (comma.velocity.tolist(), comma.mu.tolist()) == ([1e-3, 1e-2], [0.5, 1.25])
    for result in (scaled, hourly):
        np.testing.assert_allclose(result.velocity, plain.velocity, rtol=1e-8)
        np.testing.assert_array_equal(result.mu, plain.mu)
    np.testing.assert_allclose(scaled.pressure, plain.pressure, rtol=1e-8)
    assert hourly.pressure is None


GOOD = "velocity_m_s,mu\n1e-6,0.7\n1e-4,1.1\n1e-2,1.3\n1,0.8\n"
BAD = [  # the file, options, and what the line names
    ("velocity,mu\n1,1\n2,1", "", "column 'velocity' names no unit"),
    ("velocity_m_s,friction\n1,1\n2,1", "", "has no mu"),
    ("velocity_m_s,mu\n1,1\n2,-0.1", "", "line 3: mu = -0.1"),
    ("velocity_m_s,mu\nfast,1\n2,1", "", "line 2: velocity_m_s = 'fast'"),
    ("velocity_m_s,mu\n1,0,0,5\n2,0,0,6", "", "line 2 has 4 cells"),
    ("velocity_m_s,velocity_mm_s,mu\n1,1,1", "", "two columns of velocity"),
    ("velocity_m_s,mu\n" + "0.01,1.0\n" * 20, "", "velocity: "),
    (GOOD, "widht=0.1", "--hold widht: did you mean width?"),
    (GOOD, "width=-1", "--hold width = -1"),
    (GOOD, "width=0.1,width=0.2", "--hold"),
]


@pytest.mark.parametrize(("text", "hold", "named"), BAD)
def test_bad_files_and_holds_are_refused_in_one_line(scene, tmp_path, capsys, text, hold, named):
    measured, out = tmp_path / "measured.csv", tmp_path / "fit.csv"
    measured.write_text(text)
    arguments = ["fit", str(scene()), str(measured), "--output", str(out)]
    assert status_of([*arguments, "--hold", hold] if hold else arguments) == 2
    (line,) = capsys.readouterr().err.splitlines()
    assert named in line
    assert not out.exists()


def test_what_the_points_leave_open_is_said_in_words_of_the_command_line(scene, tmp_path, capsys):
    path = scene()
    below = measurement(path)[:12]  # the maximum
    assert main(["fit", str(path), str(table(tmp_path / "measured.csv", below))]) == 2
    (line,) = capsys.readouterr().err.splitlines()
    assert "--hold width=0.1" in line
    assert "fixed" not in line
