"""Notes that make a result wrong say so and come first, as docs/howto/fatal_notes.md has them."""

import re
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

import asperity
from asperity.base.notes import fatal_first, note_about
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


def runs(text: str, length: int = 3) -> set[str]:
    """All words that follow one another, so many at a time."""
    found = re.findall(r"[\w'-]+", text)
    return {" ".join(found[i : i + length]) for i in range(len(found) + 1 - length)}


def test_the_page_and_the_code_have_the_same_fatal_notes() -> None:
    page = (ROOT / "docs/howto/fatal_notes.md").read_text(encoding="utf-8")
    parts = page.split("\n## ")[1:]
    stop, *rest = [re.findall(r"^\| ([^|]+?) \|", part, re.MULTILINE)[2:] for part in parts]
    others = [row for table in rest for row in table]
    sources = [*(ROOT / "cpp/src").rglob("*.cpp"), *(ROOT / "python/asperity").rglob("*.py")]
    literal = re.compile(r'"fatal: (.+?)(?:;|\]\n)', re.DOTALL)  # up to the end of the statement
    told = [
        re.sub(r'"\s*"', "", found)
        for source in sources
        for found in literal.findall(source.read_text(encoding="utf-8"))
        if not found.startswith('"')  # the word alone
    ]
    assert len(told) == 11
    for note in told:
        assert any(runs(note) & runs(row) for row in stop), note
    for row in stop:
        assert any(runs(note) & runs(row) for note in told), row
    for row in others:
        assert not any(runs(note, 5) & runs(row, 5) for note in told), row


def large(**more: object) -> list[str]:
    result = asperity.friction(ROAD, RUBBER, **POINTS, **more)  # type: ignore[arg-type]
    return [note for note in result.notes if "mu reaches" in note]


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
    (note,) = [n for n in asperity.friction(steep, RUBBER, **POINTS).notes if "mu reaches" in n]  # type: ignore[arg-type]
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
    for model in ("profile", "one-temperature"):
        for scale, said in ((1, False), (200, True)):
            found = asperity.friction(
                steep,
                soft,
                pressure=1e5,
                velocity=0.1,
                temperature=293.15,
                shift=law,
                heating=replace(heating, model=model),
                adhesion=asperity.Adhesion(shear_stress=1e6 * scale, reference_velocity=1),
                rtol=1e-3,
            )
            assert found.cold.mu > 4
            assert (found.mu > 4) == said
            assert any("mu reaches" in note for note in found.notes) == said


def test_fatal_notes_come_first_and_each_once() -> None:
    notes = ["b", "fatal: z", "a", "b", "fatal: y"]
    assert fatal_first(notes) == ["fatal: z", "fatal: y", "b", "a"]
    assert note_about("one.toml", "fatal: z") == "fatal: one.toml: z"
    assert note_about("one.toml", "b") == "one.toml: b"


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
