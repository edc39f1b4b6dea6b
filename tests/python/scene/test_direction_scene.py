"""Scenes that know directions: what they build, their column, and what they refuse."""

from contextlib import nullcontext
from typing import Any

import numpy as np
import pytest

import asperity
from asperity import InvalidInput
from asperity.cli.main import main
from asperity.scene.results import friction_table
from asperity.scene.scene import load_scene
from helpers.scenes import CONDITIONS, RUBBER, SCAN, SURFACE, by_python

RIDGES = SURFACE + "axis_ratio = 2.0\nlay_deg = 30\n"
TURNED = CONDITIONS + "direction_deg = 75\n"


@pytest.fixture
def ridged(tmp_path):
    """A folder with a scan of ridges."""
    law = asperity.SelfAffineSpectrum(
        rms_height=5e-6, hurst=0.8, q0=2e4, q1=1e5, axis_ratio=3.0, lay=0.4
    )
    scan = asperity.synthesize(law, shape=(96, 128), pixel_size=(2e-5, 1e-5), seed=1)
    np.save(tmp_path / "scan.npy", np.array(scan.heights) * 1e6)
    return tmp_path


def written(folder, text):
    (folder / "scene.toml").write_text(text)
    return folder / "scene.toml"


def test_friction_is_that_of_the_core_in_radians(tmp_path):
    scene = load_scene(written(tmp_path, RIDGES + RUBBER + TURNED), for_friction=True)
    assert isinstance(scene.spectrum, asperity.SelfAffineSpectrum)
    assert (scene.spectrum.axis_ratio, scene.spectrum.lay) == (2.0, np.radians(30))
    result = scene.friction()
    expected = by_python(scene, direction=np.radians(75))
    np.testing.assert_array_equal(result.mu.ravel(), expected.mu)
    np.testing.assert_array_equal(result.lateral.ravel(), expected.lateral)
    assert np.all(result.lateral != 0)


def test_the_table_ends_with_the_force_across(tmp_path):
    path = written(tmp_path, RIDGES + RUBBER + TURNED)
    assert main(["friction", str(path), "--output", str(tmp_path / "out.csv")]) == 0
    lines = (tmp_path / "out.csv").read_text().splitlines()
    rows = [line.split(",") for line in lines if not line.startswith("#")]
    assert rows[0][-1] == "lateral"
    several = TURNED.replace("75", "[0, 75]")
    path_of_several = written(tmp_path, RIDGES + RUBBER + several)
    assert main(["friction", str(path_of_several), "--output", str(tmp_path / "all.csv")]) == 0
    assert "direction_deg [deg]" in (tmp_path / "all.csv").read_text()
    path = written(tmp_path, RIDGES + RUBBER + TURNED)
    result = load_scene(path, for_friction=True).friction().lateral.ravel()
    np.testing.assert_array_equal([float(row[-1]) for row in rows[1:]], result)
    path = written(tmp_path, SURFACE + RUBBER + CONDITIONS)
    assert main(["friction", str(path), "--output", str(tmp_path / "plain.csv")]) == 0
    assert "lateral" not in (tmp_path / "plain.csv").read_text()


def test_a_scan_keeps_its_directions_where_it_is_asked_to(ridged):
    scan = SCAN + "window = 'none'\ndetrend = 'none'\n"
    plain = load_scene(written(ridged, scan + RUBBER + CONDITIONS))
    kept = load_scene(written(ridged, scan + "directional = true\n" + RUBBER + TURNED))
    assert [plain.spectrum.is_directional, kept.spectrum.is_directional] == [False, True]
    np.testing.assert_array_equal(plain.spectrum.density, kept.spectrum.density)
    assert [note.code for note in plain.notes if note.code == "lay"] == ["lay"]
    assert not [note for note in kept.notes if note.code == "lay"]


@pytest.mark.parametrize(
    ("surface", "conditions", "argument"),
    [
        (SURFACE + "directional = true\n", CONDITIONS, "[surface] directional"),
        (SCAN + "directional = true\nfit = 'self-affine'\n", CONDITIONS, "[surface] directional"),
        (SURFACE + "axis_ratio = 0.5\n", CONDITIONS, "[surface] axis_ratio"),
        (RIDGES, CONDITIONS + "direction_deg = 'x'\n", "[conditions] direction_deg"),
    ],
)
def test_what_has_no_direction_is_refused(ridged, surface, conditions, argument):
    with pytest.raises(InvalidInput) as caught:
        load_scene(written(ridged, surface + RUBBER + conditions))
    assert argument in str(caught.value)


def test_a_line_scan_has_no_directions(tmp_path):
    np.save(tmp_path / "scan.npy", np.sin(0.3 * np.arange(200.0)))
    surface = SCAN.replace("[2e-5, 1e-5]", "1e-5") + "directional = true\n"
    with pytest.raises(InvalidInput, match="line scan"):
        load_scene(written(tmp_path, surface + RUBBER + CONDITIONS))


def test_directions_over_velocity_are_one_entry_each(tmp_path, monkeypatch):
    pytest.importorskip("matplotlib")
    from asperity.plot import friction

    drawn: list[Any] = []
    monkeypatch.setattr(friction, "picture", lambda figure, path: drawn.append(figure))
    over = "[conditions]\npressure_pa = 2e5\nvelocity_m_s = [1e-3, 1e-2, 1e-1]\n"
    path = written(tmp_path, RIDGES + RUBBER + over + "direction_deg = [0, 60]\n")
    scene = load_scene(path, for_friction=True)
    scenes = [scene, *scene.others]
    friction.friction_figure(scenes, [one.friction() for one in scenes], tmp_path / "mu.svg")
    texts = [text.get_text() for text in drawn[0].axes[0].get_legend().get_texts()]
    assert texts[:3] == ["200 kPa", "0°", "60°"]


def test_a_list_of_directions_is_a_table_and_a_polar_picture(tmp_path):
    pytest.importorskip("matplotlib")
    around = CONDITIONS + "direction_deg = {from = 0, to = 90, points = 4}\n"
    path = written(tmp_path, RIDGES + RUBBER + around)
    outputs = ["--output", str(tmp_path / "out.csv"), "--plot", str(tmp_path / "out.svg")]
    assert main(["friction", str(path), *outputs]) == 0
    lines = (tmp_path / "out.csv").read_text().splitlines()
    head, *rows = [line.split(",") for line in lines if not line.startswith("#")]
    assert head[-2:] == ["direction_deg", "lateral"]
    scene = load_scene(path, for_friction=True)
    scenes = [scene, *scene.others]
    assert [one.direction_deg for one in scenes] == [0, 30, 60, 90]
    directions = np.array([float(row[-2]) for row in rows])
    mu = np.array([float(row[head.index("mu")]) for row in rows])
    for one in scenes:
        np.testing.assert_array_equal(
            mu[directions == one.direction_deg], one.friction().mu.ravel()
        )
    with pytest.raises(InvalidInput, match="direction_deg"):
        load_scene(path)
    steps: dict[str, int] = {}

    def bar(title):
        def shown(chunks):
            steps[title] = len(chunks)
            return nullcontext(chunks)

        return shown

    friction_table(scenes, bands=False, bar=bar)
    assert steps == {str(path): 4}  # a direction may take less than a bar waits


def test_a_band_is_that_of_the_direction(ridged):
    scan = SCAN + "directional = true\n"
    text = scan + RUBBER + TURNED + "[uncertainty]\nsamples = 20\nseed = 3\n"
    scene = load_scene(written(ridged, text), for_friction=True)
    at = {"pressure": scene.pressure[0], "velocity": scene.velocity[:1]}
    result = scene.band_at(np.atleast_1d(at["pressure"]), at["velocity"])
    band = asperity.friction_band(
        scene.spectrum, scene.rubber, **at, direction=np.radians(75), samples=20, seed=3
    )
    np.testing.assert_allclose(result.lower * band.mu, band.lower, rtol=1e-12)
    np.testing.assert_allclose(result.upper * band.mu, band.upper, rtol=1e-12)


@pytest.mark.parametrize("typed", ["", "direction_deg = 0\n"])
def test_sliding_along_x_is_noted_where_no_direction_is_typed(tmp_path, typed):
    path = written(tmp_path, RIDGES + RUBBER + CONDITIONS + typed)
    scene = load_scene(path, for_friction=True)
    for notes in (scene.friction().notes, scene.contact_notes()):
        assert ("along-x" in [note.code for note in notes]) is not bool(typed)
