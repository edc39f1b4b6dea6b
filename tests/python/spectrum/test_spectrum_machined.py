"""Turned surfaces have lines in their spectra, random ones have none."""

import numpy as np
import pytest

import asperity
from asperity.base.diagnostics import Note
from asperity.scene.scan import line_notes

PIXEL = 1e-6


def rough(seed: int, hurst: float = 0.8, skewness: float = 0) -> np.ndarray:
    """Heights of a random surface, cut so that its edges do not meet."""
    q0, q1 = 2 * np.pi / (200 * PIXEL), 0.99 * np.pi / PIXEL
    law = asperity.SelfAffineSpectrum(rms_height=3e-7, hurst=hurst, q0=q0, q1=q1)
    made = asperity.synthesize(
        law, shape=(210, 210), pixel_size=PIXEL, seed=seed, skewness=skewness
    )
    return made.heights[:200, :196]


def notes(heights: np.ndarray) -> list[Note]:
    spectrum = asperity.power_spectrum(asperity.HeightMap(heights, pixel_size=PIXEL))
    return line_notes(spectrum.truncated(q1=np.pi / PIXEL))


@pytest.mark.parametrize("period", [8.3, 12.7, 20.7])
def test_grooves_are_noted_with_their_distance(period: float) -> None:
    feed = 2e-6 * np.abs(np.sin(np.pi * np.arange(196) / period))  # cusps, as a tool leaves them
    (note,) = notes(rough(1) + feed)
    assert note.code == "lines-in-spectrum"
    assert note.severity == "warning"
    orders = np.arange(1, 9) / (period * PIXEL)
    wave = float(str(note).split("one of ")[1].split(" m")[0])
    assert np.abs(1 / wave - orders).min() < 1 / (200 * PIXEL)  # a ring


@pytest.mark.parametrize("hurst", [0.2, 0.8, 1.0])
@pytest.mark.parametrize("skewness", [0, -1])
def test_random_surfaces_are_not(hurst: float, skewness: float) -> None:
    for seed in range(3):
        assert notes(rough(seed, hurst, skewness)) == []
