"""Turned surfaces have lines in their spectra, random ones have none."""

import numpy as np
import pytest

import asperity
from asperity.scene.scan import line_notes
from asperity.scene.scene import load_scene

PIXEL = 1e-6


def rough(seed, hurst=0.8, skewness=0):
    """Heights of a random surface, cut so that its edges do not meet."""
    q0, q1 = 2 * np.pi / (200 * PIXEL), 0.99 * np.pi / PIXEL
    law = asperity.SelfAffineSpectrum(rms_height=3e-7, hurst=hurst, q0=q0, q1=q1)
    made = asperity.synthesize(
        law, shape=(210, 210), pixel_size=PIXEL, seed=seed, skewness=skewness
    )
    return made.heights[:200, :196]


def notes(heights):
    spectrum = asperity.power_spectrum(asperity.HeightMap(heights, pixel_size=PIXEL))
    return line_notes(spectrum.truncated(q1=np.pi / PIXEL))


@pytest.mark.parametrize("period", [8.3, 12.7, 20.7])
def test_grooves_are_noted_with_their_distance(period):
    feed = 2e-6 * np.abs(np.sin(np.pi * np.arange(196) / period))  # cusps, as a tool leaves them
    (note,) = notes(rough(1) + feed)
    assert note.code == "lines-in-spectrum"
    assert note.severity == "warning"
    orders = np.arange(1, 9) / (period * PIXEL)
    wave = float(str(note).split("one of ")[1].split(" m")[0])
    assert np.abs(1 / wave - orders).min() < 1 / (200 * PIXEL)  # a ring


def test_a_slope_that_ends_the_spectrum_in_a_line_is_noted():
    """The slope jumps by a third within the line, so a rule on it ends there for many slopes."""
    heights = rough(1) + 1.5e-6 * np.sin(2 * np.pi * np.arange(196) / 12.7)
    spectrum = asperity.power_spectrum(asperity.HeightMap(heights, pixel_size=PIXEL))
    line = 2 * np.pi / (12.7 * PIXEL)
    for share, inside in ((0.7, False), (1.0, True), (1.3, False)):
        slope = spectrum.truncated(q1=share * line).rms_slope
        cut = spectrum.cutoff_for_slope(slope)
        (note,) = line_notes(spectrum, cut)
        assert ("in a line" in note) == inside
        assert ("q1_per_m" in note.next_step) == inside


@pytest.mark.parametrize("kind", ["partial-contact", "scan-contact"])
def test_the_contact_of_the_scan_knows_its_grooves(tmp_path, kind):
    np.save(tmp_path / "scan.npy", rough(1) + 2e-6 * np.abs(np.sin(np.pi * np.arange(196) / 8.3)))
    (tmp_path / "scene.toml").write_text(
        f'[surface]\nfile = "scan.npy"\npixel_size_m = {PIXEL}\nunit = "m"\n'
        "[rubber]\nequilibrium_modulus_pa = 1e6\nmoduli_pa = [9e6]\nrelaxation_times_s = [1e-3]\n"
        "[conditions]\npressure_pa = 2e5\nvelocity_m_s = 0.1\n"
        f'[correction]\nkind = "{kind}"\n'
    )
    codes = [note.code for note in load_scene(tmp_path / "scene.toml").notes]
    assert ("lines-in-spectrum" in codes) == (kind == "partial-contact")


@pytest.mark.parametrize("hurst", [0.2, 0.8, 1.0])
@pytest.mark.parametrize("skewness", [0, -1])
def test_random_surfaces_are_not(hurst, skewness):
    for seed in range(3):
        assert notes(rough(seed, hurst, skewness)) == []
