"""Scenes of a scan and of isotherms: what a user's own files need before there is a curve."""

import numpy as np
import pytest

import asperity
from asperity import InvalidInput, OutOfRange
from asperity.scene.scene import load_scene
from helpers import scenes
from helpers.scenes import HEATING

RUBBER = asperity.PronySeries(
    equilibrium_modulus=3e6,
    moduli=np.geomspace(3e8, 1e6, 12),
    relaxation_times=np.geomspace(1e-9, 1e2, 12),
)
LAW = asperity.WLF(c1=8.86, c2=101.6, reference_temperature=293.15)
CELSIUS = range(0, 51, 10)
SCENE = """
[rubber]
isotherms = ["dma/T*.csv"]
columns = { frequency = "f", temperature = "T", storage = "E1", loss = "E2" }
units = { frequency = "Hz", temperature = "C", modulus = "MPa" }
modulus = "E"
temperature_c = 20
[conditions]
pressure_pa = 2e5
velocity_m_s = { from = 1e-4, to = 1e-3, points = 9 }
"""

# a fit on a narrower band than that of its scan
FITTED = scenes.SCAN + 'fit = "self-affine"\nq0_per_m = 5000.0\nq1_per_m = 8e4\n'


@pytest.fixture
def dma(tmp_path):
    """A folder with a sweep a temperature, 1 % of noise on every modulus."""
    noise = np.random.default_rng(4)
    (tmp_path / "dma").mkdir()
    for celsius in CELSIUS:
        lines = ["f,T,E1,E2"]
        for hertz in np.geomspace(0.1, 50, 12):
            modulus = RUBBER.modulus(2 * np.pi * hertz * 10 ** LAW.log10_a_T(273.15 + celsius))
            one, two = 1e-6 * (1 + 0.01 * noise.normal(size=2))
            lines.append(f"{hertz},{celsius},{modulus.real * one},{modulus.imag * two}")
        (tmp_path / f"dma/T{celsius:02d}.csv").write_text("\n".join(lines) + "\n")
    return tmp_path


def loaded(folder, text, surface=scenes.SURFACE, **how):
    (folder / "scene.toml").write_text(surface + text)
    return load_scene(folder / "scene.toml", **how)


def known(folder):
    """Velocities [m/s] from which to which the measured modulus reaches."""
    scene = loaded(folder, SCENE)
    low, high = scene.rubber.angular_frequency[[0, -1]]
    return float(low / scene.spectrum.q0), float(high / scene.spectrum.q1)


def swept(text, slowest, fastest):
    return text.replace("from = 1e-4, to = 1e-3", f"from = {slowest!r}, to = {fastest!r}")


def test_a_pattern_stands_for_files(dma):
    names = [f"dma/T{celsius:02d}.csv" for celsius in CELSIUS]
    by_pattern = loaded(dma, SCENE)
    assert by_pattern.inputs["rubber"]["isotherms"] == names
    mu = by_pattern.friction().mu
    one_by_one = loaded(dma, SCENE.replace('["dma/T*.csv"]', str(names)))
    np.testing.assert_array_equal(mu, one_by_one.friction().mu)
    with pytest.raises(InvalidInput, match=r"isotherms = 'dma/X\*': no file has such a name"):
        loaded(dma, SCENE.replace("T*.csv", "X*"))
    with pytest.raises(InvalidInput, match="must name its files one by one, as temperatures gives"):
        loaded(dma, SCENE.replace("[conditions]", "temperatures = [1, 2]\n[conditions]"))
    (dma / "dma").rename(dma / "[2026] dma")
    in_brackets = loaded(dma, SCENE.replace("dma/T", "[2026] dma/T"))
    np.testing.assert_array_equal(mu, in_brackets.friction().mu)


def test_notes_say_where_the_modulus_is_extrapolated(dma):
    _, fastest = known(dma)
    beyond = SCENE.replace("[conditions]", 'extrapolation = "power-law"\n[conditions]')
    result = loaded(dma, swept(beyond, 3 * fastest, 9.9 * fastest)).friction()
    share = result.extrapolated_share[0]
    velocity = np.geomspace(3 * fastest, 9.9 * fastest, 9)
    assert (share <= 1).all()
    (most,) = [note for note in result.notes if "that of an extrapolated modulus" in note]
    first = velocity[share > 0.5][0]
    count = (share > 0.5).sum()
    assert 1 < count < 9
    span = f"from {first:.3g} to {velocity[-1]:.3g} m/s"
    assert most.endswith(f" at {count} of 9 velocities, {span}")
    assert most.startswith("fatal: ")


@pytest.mark.parametrize(
    ("text", "argument"),
    [
        (SCENE.replace("= 20", "= 80"), "[rubber] temperature_c"),
        (
            SCENE.replace("= 20", "= 80\nreference_temperature_c = 20"),
            "[rubber] temperature_c",
        ),
        (
            SCENE.replace("temperature_c = 20\n", "") + "temperature_c = 80\n",
            "[conditions] temperature_c",
        ),
    ],
)
def test_a_temperature_beyond_the_isotherms_is_out_of_range(dma, text, argument):
    with pytest.raises(OutOfRange) as caught:
        loaded(dma, text)
    assert caught.value.argument == argument
    assert "wlf_c1 and wlf_c2_k, which asperity rubber gives" in str(caught.value)


def test_heat_starts_from_the_rubbers_temperature(dma):
    """It may stand in [rubber], beside isotherms, or in [conditions]."""
    there = loaded(dma, SCENE + HEATING, for_friction=True)
    moved = SCENE.replace("temperature_c = 20\n", "") + "temperature_c = 20\n" + HEATING
    here = loaded(dma, moved, for_friction=True)
    assert there.temperature == here.temperature == pytest.approx(293.15)
    np.testing.assert_array_equal(there.friction().mu, here.friction().mu)


def test_a_scan_too_small_for_its_spectrum_is_fatal(dma):
    """Most of the slope is then of waves of which it holds fewer than 16."""
    road = asperity.SelfAffineSpectrum(rms_height=1e-4, hurst=0.8, q0=500, q1=1e5)
    scan = asperity.synthesize(road, shape=(256, 256), pixel_size=5e-5, seed=2)
    np.save(dma / "scan.npy", scan.heights)
    surface = '[surface]\nfile = "scan.npy"\npixel_size_m = 5e-5\nunit = "m"\nq1_per_m = {}\n'
    slow = SCENE.replace("from = 1e-4, to = 1e-3", "from = 1e-3, to = 1e-2")

    def fatal(q1):
        notes = loaded(dma, slow, surface.format(q1)).friction().notes
        return [
            note for note in notes if note.startswith("fatal: more than half of the mean square")
        ]

    few = 16 * 2 * np.pi / (256 * 5e-5)
    assert len(fatal(1.2 * few)) == 1
    assert fatal(4 * few) == []


def test_noise_that_the_spectrum_reaches_into_is_noted(dma):
    road = asperity.SelfAffineSpectrum(rms_height=1e-4, hurst=0.8, q0=500, q1=6e4)
    scan = asperity.synthesize(road, shape=(256, 256), pixel_size=5e-5, seed=2)
    noise = 1e-5 * np.random.default_rng(2).normal(size=(256, 256))
    np.save(dma / "scan.npy", scan.heights + noise)
    surface = '[surface]\nfile = "scan.npy"\npixel_size_m = 5e-5\nunit = "m"\n'
    slow = SCENE.replace("from = 1e-4, to = 1e-3", "from = 1e-3, to = 1e-2")
    (note,) = [one for one in loaded(dma, slow, surface).notes if "noise of the instrument" in one]
    begins = float(note.partition("from ")[2].split()[0])
    cut = surface + f"q1_per_m = {0.99 * begins}\n"
    assert not any("noise of the instrument" in one for one in loaded(dma, slow, cut).notes)


def test_notes_with_heat_are_of_the_rubber_as_it_then_is(dma):
    """Heat takes v q a_T to where the modulus was measured."""
    _, fastest = known(dma)
    text = SCENE.replace("temperature_c = 20", 'extrapolation = "power-law"\ntemperature_c = 20')
    for factor in np.geomspace(1, 9, 7):
        scene = text.replace("{ from = 1e-4, to = 1e-3, points = 9 }", f"{factor * fastest}")
        result = loaded(dma, scene + HEATING, for_friction=True).friction()
        told = [note for note in result.notes if "outside of the measured ones" in note]
        assert len(told) == (result.extrapolated_share.max() > 0.05)


def test_a_comparison_has_the_notes_of_the_scene_once_in_its_unit(dma):
    """A rubber carries its notes into results, which know nothing of degrees C."""
    for k, celsius in enumerate(CELSIUS):  # E'' shifts by itself
        hertz, rise = np.geomspace(0.1, 50, 12), np.geomspace(1, 3, 12)
        rows = zip(hertz, 0.8**k * rise, 0.1 * 0.5**k * rise, strict=True)
        lines = ["f,T,E1,E2", *(f"{f},{celsius},{one},{two}" for f, one, two in rows)]
        (dma / f"dma/T{celsius:02d}.csv").write_text("\n".join(lines) + "\n")
    scene = loaded(dma, SCENE.replace("temperature_c = 20", "temperature_c = 0"), for_friction=True)
    assert any(" C" in note for note in scene.notes if note.code == "different-shifts")
    measured = {"velocity": [1e-4, 1e-3], "mu": [0.5, 0.6]}
    codes = [note.code for note in asperity.fit_scene(scene, measured).notes]
    assert codes.count("different-shifts") == 1


@pytest.mark.parametrize("surface", [scenes.SURFACE, FITTED])
def test_a_linear_band_is_about_that_of_draws(dma, surface):
    if "scan" in surface:
        law = asperity.SelfAffineSpectrum(rms_height=76e-6, hurst=0.7, q0=5000.0, q1=1e5)
        rough = asperity.synthesize(law, shape=(512, 1024), pixel_size=(2e-5, 1e-5), seed=1)
        np.save(dma / "scan.npy", rough.heights * 1e6)
    slow, _ = known(dma)
    text = swept(SCENE, slow * 10, slow * 1e3)

    def widths(method):
        asked = f'[uncertainty]\nmethod = "{method}"\nsamples = 200\n'
        scene = loaded(dma, text + asked, surface)
        low, high, _ = scene.band(np.ones((1, scene.velocity.size)))
        assert (low < high).all()
        return np.log(high / low)

    np.testing.assert_allclose(widths("linear"), widths("draws"), rtol=0.25)


def test_a_linear_band_is_refused_where_the_rubber_is_drawn_otherwise(dma):
    asked = '[uncertainty]\nmethod = "linear"\n'
    text = SCENE.replace("temperature_c", "prony = true\ntemperature_c")
    scene = loaded(dma, text + asked)
    with pytest.raises(InvalidInput) as refused:
        scene.band(np.ones((1, scene.velocity.size)))
    assert "[uncertainty] method" in str(refused.value)
