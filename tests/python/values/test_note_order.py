"""Notes that make a result wrong say so and come first, as docs/howto/fatal_notes.md has them."""

import re
from pathlib import Path

import numpy as np
import pytest

import asperity
from asperity.base.codes import FATAL, NOTES, WARNING
from asperity.cli.main import main

ROOT = Path(__file__).parents[3]
ROAD = asperity.SelfAffineSpectrum(rms_height=1e-4, hurst=0.8, q0=2e3, q1=3e4)
RUBBER = asperity.PronySeries(equilibrium_modulus=3e6, moduli=[1e8], relaxation_times=[1e-4])
POINTS = {"pressure": 1e5, "velocity": np.array([1e-4, 1e-2, 1])}
SCENE = """
surface = {rms_height_m = 1e-4, hurst = 0.8, q0_per_m = 2e3, q1_per_m = 3e4}
rubber = {equilibrium_modulus_pa = 3e6, moduli_pa = [1e8], relaxation_times_s = [1e-4]}
conditions = {pressure_pa = 1e5, velocity_m_s = [1e-4, 1e-2, 1]}
adhesion = {shear_stress_pa = 4e7}
"""


def test_the_page_has_every_note_that_is_to_be_acted_on() -> None:
    page = (ROOT / "docs/howto/fatal_notes.md").read_text(encoding="utf-8")
    stop, act, _ = page.split("\n## ")[1:]
    for part, severity in ((stop, FATAL), (act, WARNING)):
        rows = set(re.findall(r"^\| `([a-z0-9-]+)` \|", part, re.MULTILINE))
        missing = {code for code, (how, _) in NOTES.items() if how == severity} - rows
        assert missing <= OF_UNITS, missing
        assert {NOTES[code][0] for code in rows} == {severity}


OF_UNITS = {code for code in NOTES if code.startswith(("absurd-", "unusual-", "squashed-"))}


def large(**more: object) -> list[str]:
    result = asperity.friction(ROAD, RUBBER, **POINTS, **more)  # type: ignore[arg-type]
    return [note for note in result.notes if note.code == "large-friction"]


def test_friction_that_no_rubber_has_is_noted_with_what_makes_it() -> None:
    assert large() == large(adhesion=asperity.Adhesion(shear_stress=1e6)) == []
    strong = asperity.Adhesion(shear_stress=4e7)
    found = asperity.friction(ROAD, RUBBER, adhesion=strong, **POINTS)  # type: ignore[arg-type]
    top = int(np.argmax(found.mu))
    assert found.mu[top] > 4
    assert found.notes[0].startswith(
        f"fatal: mu reaches {found.mu[top]:.3g} at {found.velocity[top]:.3g} m/s and 1e+05 Pa, "
        f"above 4, more than rubber has on clean glass: adhesion makes {found.adhesion[top]:.3g} "
    )
    steep = asperity.SelfAffineSpectrum(rms_height=5e-4, hurst=0.8, q0=2e3, q1=1e7)
    (note,) = [
        n for n in asperity.friction(steep, RUBBER, **POINTS).notes if n.code == "large-friction"
    ]  # type: ignore[arg-type]
    assert "hysteresis makes" in note


def test_with_heat_the_hot_friction_counts() -> None:
    heating = asperity.Heating(
        density=1200, heat_capacity=1650, conductivity=0.23, contact_diameter=1e-3
    )
    steep = asperity.SelfAffineSpectrum(rms_height=5e-4, hurst=0.8, q0=2e3, q1=1e7)
    soft = asperity.PronySeries(
        equilibrium_modulus=3e6, moduli=[1e7] * 5, relaxation_times=np.geomspace(1e-8, 1e-4, 5)
    )
    law = asperity.WLF(c1=8.86, c2=101.6, reference_temperature=293.15)
    for scale, said in ((1, False), (200, True)):
        found = asperity.friction(
            steep,
            soft,
            pressure=1e5,
            velocity=0.1,
            temperature=293.15,
            shift=law,
            heating=heating,
            adhesion=asperity.Adhesion(shear_stress=1e6 * scale, reference_velocity=1),
            rtol=1e-3,
        )
        assert found.cold.mu > 4
        assert (found.mu > 4) == said
        assert any(note.code == "large-friction" for note in found.notes) == said


def test_the_shell_tells_them_first(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    for name in ("a.toml", "b.toml"):
        Path(name).write_text(SCENE, encoding="utf-8")
    for scenes, said in ((["a.toml"], "mu reaches"), (["a.toml", "b.toml"], "a.toml, b.toml: mu")):
        assert main(["friction", *scenes, "--output", "mu.csv"]) == 0
        told = capsys.readouterr().err.splitlines()
        assert len(told) > 1
        assert told[0].startswith(f"note: fatal: {said}")
        written = [line for line in Path("mu.csv").read_text().splitlines() if "# note: " in line]
        assert [line.removeprefix("# ") for line in written] == told
    assert main(["map", "a.toml", "--output", "mu.fmap", "--checked", "10"]) == 0
    assert capsys.readouterr().err.startswith("note: fatal: mu reaches")
