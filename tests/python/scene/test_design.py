"""What 10 % of each part of a scene is worth: the slopes, put together for a person."""

import csv
import io

import numpy as np
import pytest

import asperity
from asperity.cli.main import main
from asperity.scene.design import MORE, by_decade, design, temperature_of_dma
from asperity.scene.scene import load_scene

SCENE = """
[surface]
rms_height_m = 265e-6
hurst = 0.87
q0_per_m = 300
q1_per_m = 2e5
[rubber]
equilibrium_modulus_pa = 3e6
moduli_pa = [1e7, 1e8]
relaxation_times_s = [1e-4, 1e-6]
wlf_c1 = 9.645
wlf_c2_k = 93.3
reference_temperature_c = 20
[conditions]
pressure_pa = [1e5, 2e5]
velocity_m_s = 0.1
temperature_c = 30
[correction]
kind = "partial-contact"
"""


@pytest.fixture
def scene(tmp_path):
    path = tmp_path / "scene.toml"
    path.write_text(SCENE)
    return path


def test_decades_sum_to_the_slope_over_a_factor(scene):
    found = design(load_scene(scene))
    for i, pressure in enumerate((1e5, 2e5)):
        here = [one for one in found.worths if one.pressure == pressure]
        worth = {part: sum(one.mu for one in here if one.part == part) for part in PARTS}
        of = found.gradients
        assert worth["spectrum"] == pytest.approx(MORE * of.rms_height[i, 0] / 2, rel=1e-2)
        whole = worth["storage"] + worth["loss"]
        assert whole == pytest.approx(-MORE * of.pressure[i, 0], abs=1e-3 * found.result.mu[i, 0])


PARTS = ("storage", "loss", "spectrum")


def test_a_decade_has_the_integral_of_a_line():
    rows = np.array([1.0, 7.0, 300.0, 2e3])
    density = np.log(rows)  # linear in ln, as between rows
    edges, sums = by_decade(rows, density)
    assert edges == [1, 10, 100, 1000, 10000]
    ends = np.log([1, 10, 100, 1000, 2000])
    np.testing.assert_allclose(sums, np.diff(ends**2 / 2), rtol=1e-12)


def test_the_temperature_of_a_dma_has_the_decades_frequency():
    shift = asperity.WLF(c1=9.645, c2=93.3, reference_temperature=293.15)
    for reduced in (1e-1, 1e3, 1e7):
        at = temperature_of_dma(shift, reduced)
        assert 2 * np.pi * 10 * 10 ** shift.log10_a_T(at) == pytest.approx(reduced, rel=0.02)
    assert temperature_of_dma(shift, 1e-40) is None


def test_the_verb_writes_a_row_a_part_and_a_picture(scene, tmp_path):
    pytest.importorskip("matplotlib")
    out, picture = tmp_path / "design.csv", tmp_path / "design.png"
    assert main(["design", str(scene), "--output", str(out), "--plot", str(picture)]) == 0
    lines = [line for line in out.read_text().splitlines() if not line.startswith("#")]
    rows = list(csv.DictReader(io.StringIO("\n".join(lines))))
    parts = {row["part"] for row in rows}
    assert {*PARTS, "pressure", "velocity", "temperature", "hurst", "q1"} <= parts
    assert all(row["dma_temperature_k"] for row in rows if row["part"] == "loss")
    assert picture.stat().st_size > 10_000


def test_heat_has_its_parts(scene):
    heating = "density_kg_m3 = 1e3\nheat_capacity_j_kg_k = 2e3\nconductivity_w_m_k = 0.2\n"
    text = SCENE + "[heating]\n" + heating + "contact_diameter_m = 1e-3\n[solver]\nrtol = 1e-9\n"

    def mu(spot):
        scene.write_text(text.replace("1e-3\n", spot + "\n"))
        return float(load_scene(scene, for_friction=True).friction().mu[0, 0])

    smaller, larger = mu("0.99e-3"), mu("1.01e-3")
    assert main(["design", str(scene)]) == 0
    worths = design(load_scene(scene, for_friction=True)).worths
    spot = next(one for one in worths if one.part == "contact_diameter" and one.pressure == 1e5)
    assert spot.mu == pytest.approx(MORE * (larger - smaller) / np.log(1.01 / 0.99), rel=1e-2)


def test_several_temperatures_are_refused(scene, capsys):
    scene.write_text(SCENE.replace("temperature_c = 30", "temperature_c = [20, 30]"))
    assert main(["design", str(scene)]) == 2
    assert "[conditions]" in capsys.readouterr().err


def test_an_error_names_the_key_that_the_scene_has(scene, capsys):
    """Friction, which knows a T only as a temperature, refuses one below 150 K."""
    cold = SCENE.replace("temperature_c = 30\n", "")
    scene.write_text(cold.replace("wlf_c2_k = 93.3", "wlf_c2_k = 300\ntemperature_c = -130"))
    assert main(["design", str(scene)]) == 2
    assert "[rubber] temperature_c = -130" in capsys.readouterr().err


def test_a_scene_has_slopes_in_the_shape_of_its_friction(scene):
    scene.write_text(SCENE.replace("velocity_m_s = 0.1", "velocity_m_s = [0.01, 0.1, 1]"))
    read = asperity.read_scene(scene)
    found, plain = read.friction(gradients=True), read.friction()
    np.testing.assert_allclose(found.mu, plain.mu, rtol=1e-6)
    of = found.gradients
    assert of.temperature.shape == of.rms_height.shape == (2, 3)
    assert of.spectrum.shape == (2, 3, of.wavenumber.size)
    assert of.moduli.shape == (2, 3, 2)
    one = asperity.friction(
        read.spectrum,
        read.rubber,
        pressure=2e5,
        velocity=1.0,
        correction=read.correction,
        gradients=True,
    ).gradients
    assert of.pressure[1, 2] == pytest.approx(one.pressure, abs=1e-4 * found.mu[1, 2])
    assert of.moduli[1, 2] == pytest.approx(one.moduli, abs=1e-4 * found.mu[1, 2])
