"""Scenes whose rubber softens with the strain of each magnification."""

import numpy as np
import pytest

import asperity
from asperity.cli.main import main
from asperity.scene.scene import load_scene
from helpers import scenes
from helpers.scenes import by_python

ROWS = {"strain": [0.01, 0.1, 0.3], "storage": [0.8, 0.5, 0.3], "loss": [1.2, 0.8, 0.4]}
SOFT = """
strain = "by-magnification"
strain_amplitudes = [0.01, 0.1, 0.3]
storage_factors = [0.8, 0.5, 0.3]
loss_factors = [1.2, 0.8, 0.4]
"""
SWEPT = """
strain = "by-magnification"
strain_sweeps = ["sweep.csv"]
strain_kind = "{kind}"
reference_strain = 0.001
strain_per_slope = 0.7
[rubber.strain_columns]
frequency = "f"
temperature = "T"
storage = "G1"
loss = "G2"
strain = "e"
[rubber.strain_units]
frequency = "Hz"
temperature = "C"
modulus = "MPa"
strain = "%"
"""
FILE = "f,T,G1,G2,e\n10,20,8,0.8,0.1\n10,20,6,1.0,1\n10,20,4,0.9,10\n"


@pytest.fixture
def folder(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "sweep.csv").write_text(FILE, encoding="utf-8")
    return tmp_path


def written(of_rubber, more=""):
    with open("soft.toml", "w", encoding="utf-8") as file:
        file.write(scenes.SURFACE + scenes.RUBBER + of_rubber + scenes.CONDITIONS + more)
    return "soft.toml"


def test_rows(folder):
    scene = load_scene(written(SOFT))
    expected = by_python(scene, strain_factors=asperity.StrainFactors(**ROWS))
    result = scene.friction()
    assert np.array_equal(result.mu.ravel(), expected.mu)
    assert "strain-beyond-sweeps" in [note.code for note in result.notes]
    plain = by_python(scene)
    assert np.all(result.contact_area.ravel() > 2 * plain.contact_area)


@pytest.mark.parametrize(("kind", "times"), [("shear", 1), ("peak-to-peak-tension", 2)])
def test_sweeps(folder, kind, times):
    scene = load_scene(written(SWEPT.format(kind=kind)))
    factors = scene.options["strain_factors"]
    np.testing.assert_allclose(factors.strain, [0.001, 0.01 / times, 0.1 / times])
    assert factors.strain_per_slope == 0.7
    expected = by_python(scene, strain_factors=factors)
    assert np.array_equal(scene.friction().mu.ravel(), expected.mu)
    assert folder / "sweep.csv" in [path.resolve() for path in scene.sources]


@pytest.mark.parametrize(
    ("of_rubber", "key"),
    [
        ('strain = "large"\n', "[rubber] strain"),
        ('strain = "by-magnification"\n', "[rubber] strain_amplitudes"),
        ("strain_per_slope = 0.5\n", "[rubber] strain_per_slope"),
        (SOFT + 'strain_kind = "shear"\n', "[rubber] strain_kind"),
        (SOFT.replace("[0.8,", "[0.0,"), "[rubber] storage_factors"),
        (SWEPT.format(kind="torsion"), "[rubber] strain_kind"),
    ],
)
def test_refused(folder, capsys, of_rubber, key):
    assert main(["friction", written(of_rubber)]) == 2
    (line,) = capsys.readouterr().err.splitlines()
    assert key in line
