"""Friction that no rubber has is fatal, by whatever makes it, and is told before other notes."""

import re
from pathlib import Path

import numpy as np
import pytest

import asperity
from asperity.base.codes import FATAL, NOTES, WARNING
from helpers.heat import HEATING, LAW
from helpers.rubbers import prony

PAGE = Path(__file__).parents[3] / "docs/howto/fatal_notes.md"
ROAD = asperity.SelfAffineSpectrum(rms_height=1e-4, hurst=0.8, q0=2e3, q1=3e4)
STEEP = asperity.SelfAffineSpectrum(rms_height=5e-4, hurst=0.8, q0=2e3, q1=1e7)
RUBBER = asperity.PronySeries(equilibrium_modulus=3e6, moduli=[1e8], relaxation_times=[1e-4])
SOFT = prony(3e6, [1e7] * 5, np.geomspace(1e-8, 1e-4, 5))


def test_the_page_has_every_note_that_is_to_be_acted_on():
    stop, act, _ = PAGE.read_text(encoding="utf-8").split("\n## ")[1:]
    of_units = {code for code in NOTES if code.startswith(("absurd-", "unusual-", "squashed-"))}
    for part, severity in ((stop, FATAL), (act, WARNING)):
        rows = set(re.findall(r"^\| `([a-z0-9-]+)` \|", part, re.MULTILINE))
        assert {code for code, (how, _) in NOTES.items() if how == severity} - rows <= of_units
        assert {NOTES[code][0] for code in rows} == {severity}


@pytest.mark.parametrize(
    ("road", "shear_stress", "large"),
    [(ROAD, 0.0, False), (ROAD, 1e6, False), (ROAD, 4e7, True), (STEEP, 0.0, True)],
)
def test_its_note_has_the_largest_mu(road, shear_stress, large):
    result = asperity.friction(
        road,
        RUBBER,
        pressure=1e5,
        velocity=[1e-4, 1e-2, 1],
        adhesion=asperity.Adhesion(shear_stress=shear_stress),
    )
    values = [note.value for note in result.notes if note.code == "large-friction"]
    assert values == ([result.mu.max()] if large else [])
    assert (result.mu.max() > 4) == large


@pytest.mark.parametrize(("shear_stress", "large"), [(1e6, False), (2e8, True)])
def test_with_heat_the_hot_friction_counts(shear_stress, large):
    result = asperity.friction(
        STEEP,
        SOFT,
        pressure=1e5,
        velocity=0.1,
        temperature=293.15,
        shift=LAW,
        heating=HEATING,
        adhesion=asperity.Adhesion(shear_stress=shear_stress, reference_velocity=1),
        rtol=1e-3,
    )
    assert result.cold.mu > 4
    assert (result.mu > 4) == large
    assert any(note.code == "large-friction" for note in result.notes) == large
