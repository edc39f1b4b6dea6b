"""Scene files: what they build."""

from contextlib import nullcontext

import numpy as np
import pytest

import asperity
from asperity.scene.model import COLUMNS
from asperity.scene.scene import load_scene
from helpers.rubbers import prony
from helpers.scenes import CONDITIONS, CURVE, RUBBER, SCAN, SURFACE

PRONY = prony(2e6, [1e9, 1e8, 1e7], [1e-8, 1e-6, 1e-4])
SPECTRUM = asperity.SelfAffineSpectrum(rms_height=76.572e-6, hurst=0.7, q0=2000.0, q1=1e5)


def scan():
    spectrum = asperity.SelfAffineSpectrum(rms_height=5e-6, hurst=0.8, q0=2e4, q1=1e6)
    return asperity.synthesize(spectrum, shape=(60, 80), pixel_size=(2e-5, 1e-5), seed=1)


@pytest.fixture
def folder(tmp_path):
    """A folder with a tilted scan and a master curve."""
    heights = np.array(scan().heights) + 1e-5 * np.linspace(0, 1, 80)
    np.save(tmp_path / "scan.npy", heights * 1e6)
    w = np.geomspace(1e-3, 1e9, 40)
    modulus = PRONY.modulus(w)
    rows = np.column_stack([w, modulus.real, modulus.imag])
    header = "angular_frequency_rad_s,storage_modulus_pa,loss_modulus_pa"
    (tmp_path / "curve.csv").write_text(
        "# made up\n" + header + "\n" + "\n".join(",".join(map(repr, r)) for r in rows.tolist())
    )
    return tmp_path


def write(folder, text):
    path = folder / "scene.toml"
    path.write_text(text, encoding="utf-8")
    return path


def test_parts_are_those_named(folder):
    scene = load_scene(write(folder, SURFACE + RUBBER + CONDITIONS))
    assert scene.spectrum == SPECTRUM
    assert scene.rubber == PRONY
    np.testing.assert_array_equal(scene.pressure, [81e3, 2e5])
    np.testing.assert_allclose(scene.velocity, [1e-4, 1e-3, 1e-2, 1e-1, 1], rtol=1e-12)
    assert scene.velocity[[0, -1]].tolist() == [1e-4, 1.0]
    assert scene.correction is None
    assert scene.adhesion is None


def test_friction_is_that_of_the_core_with_its_defaults(folder):
    text = SURFACE + RUBBER + CONDITIONS.replace("points = 5", "points = 11")
    scene = load_scene(write(folder, text))
    curves = scene.friction()
    expected = asperity.friction(
        SPECTRUM, PRONY, pressure=[[81e3], [2e5]], velocity=np.geomspace(1e-4, 1, 11)
    )
    for name in COLUMNS:
        np.testing.assert_array_equal(getattr(curves, name), getattr(expected, name), err_msg=name)
    assert curves.notes == expected.notes
    assert any("flash heating" in note for note in curves.notes)
    recorded = {**scene.inputs["conditions"], **scene.inputs["solver"]}
    defaults = {"poisson_ratio": 0.5, "rtol": 1e-6, "form": "exact", "method": "gauss"}
    assert {name: recorded[name] for name in defaults} == defaults


def test_everything_named_reaches_the_core(folder):
    text = (
        SURFACE
        + "rolloff_per_m = 4000.0\n"
        + RUBBER
        + CONDITIONS
        + "poisson_ratio = 0.45\n"
        + "[correction]\nkind = 's-factor'\ngamma = 0.4\napplies_to = 'both'\n"
        + "[adhesion]\nshear_stress_pa = 8.3e6\nreference_velocity_m_s = 5e-3\nwidth = 0.2\n"
        + "[solver]\nrtol = 1e-4\nform = 'interpolated'\nmethod = 'cquad'\n"
    )
    curves = load_scene(write(folder, text)).friction()
    expected = asperity.friction(
        asperity.SelfAffineSpectrum(
            rms_height=76.572e-6, hurst=0.7, q0=2000.0, q1=1e5, rolloff=4000.0
        ),
        PRONY,
        pressure=[[81e3], [2e5]],
        velocity=np.geomspace(1e-4, 1, 5),
        poisson_ratio=0.45,
        correction=asperity.SFactor(gamma=0.4, applies_to="both"),
        adhesion=asperity.Adhesion(shear_stress=8.3e6, reference_velocity=5e-3, width=0.2),
        rtol=1e-4,
        form="interpolated",
        method="cquad",
    )
    np.testing.assert_array_equal(curves.mu, expected.mu)
    assert np.all(curves.adhesion > 0)


def test_scan_is_measured_as_by_hand(folder):
    text = SCAN + "window = 'hann'\ndetrend = 'quadratic'\nq0_per_m = 1.5e4\nq1_per_m = 2e5\n"
    scene = load_scene(write(folder, text + RUBBER + CONDITIONS))
    surface = asperity.read_surface(folder / "scan.npy", pixel_size=(2e-5, 1e-5), unit="um")
    by_hand = asperity.power_spectrum(surface, window="hann", detrend="quadratic")
    assert scene.spectrum == by_hand.truncated(q0=1.5e4, q1=2e5)
    assert scene.derived["shape"] == [60, 80]
    assert scene.derived["pixel_size_m"] == [2e-5, 1e-5]


def test_smaller_cutoff_wins(folder):
    def q1(keys):
        return load_scene(write(folder, SURFACE + keys + RUBBER + CONDITIONS)).spectrum.q1

    by_slope, by_size = SPECTRUM.cutoff_for_slope(1.0), 2 * np.pi / 2e-4
    assert q1("slope_cutoff = 1.0\n") == pytest.approx(by_slope)
    assert q1("contamination_size_m = 2e-4\n") == pytest.approx(by_size)
    both = q1("slope_cutoff = 1.0\ncontamination_size_m = 2e-4\n")
    assert both == pytest.approx(min(by_slope, by_size))


def test_master_curve(folder):
    scene = load_scene(write(folder, SURFACE + CURVE + "extrapolation = 'clamp'\n" + CONDITIONS))
    assert isinstance(scene.rubber, asperity.MasterCurve)
    assert scene.rubber.extrapolation == "clamp"
    w = np.geomspace(1e-3, 1e9, 40)
    np.testing.assert_allclose(scene.rubber.modulus(w), PRONY.modulus(w), rtol=1e-9)


PEAKS = "[correction]\nkind = '{}'\nmin_distance_m = 5e-5\n"
MACRO = "q0_per_m = 2e4\n"


def _measured():
    heights = np.array(scan().heights) + 1e-5 * np.linspace(0, 1, 80)
    surface = asperity.HeightMap(heights * 1e6 * 1e-6, pixel_size=(2e-5, 1e-5)).detrend("plane")
    return surface, surface.local_peaks(min_distance=5e-5)


def test_local_peaks_come_from_the_scan(folder):
    text = SCAN + RUBBER + CONDITIONS + PEAKS.format("local-peaks")
    scene = load_scene(write(folder, text))
    surface, peaks = _measured()
    assert isinstance(scene.correction, asperity.LocalPeaks)
    expected = asperity.LocalPeaks(peaks, z_max=surface.z_max).shift_factor
    assert scene.correction.shift_factor == pytest.approx(expected, rel=1e-9)
    assert scene.inputs["correction"]["peaks"] == len(peaks)
    np.testing.assert_allclose(scene.friction().shift_factor, expected, rtol=1e-9)


def test_asperities_take_their_extremes_from_the_scan(folder):
    text = SCAN + RUBBER + CONDITIONS + PEAKS.format("greenwood-williamson") + MACRO
    scene = load_scene(write(folder, text))
    surface, peaks = _measured()
    assert isinstance(scene.correction, asperity.GreenwoodWilliamson)
    assert scene.correction.z_max == pytest.approx(surface.z_max, rel=1e-9, abs=0)
    assert scene.correction.z_min == pytest.approx(surface.z_min, rel=1e-9, abs=0)
    np.testing.assert_allclose(np.asarray(scene.correction.peaks), peaks, rtol=1e-9)
    assert scene.inputs["correction"]["reading"] == "implicit"


LISTED = "heights_m = [1e-4, 2e-4, 1e-4]\nreading = 'added'\nrms_height_m = 7e-5\nq0_per_m = 2e3\n"


@pytest.mark.parametrize(
    ("kind", "more", "expected"),
    [
        ("greenwood-williamson", "", asperity.GreenwoodWilliamson(z_max=3e-4, z_min=-3e-4)),
        (
            "peaks-then-greenwood-williamson",
            LISTED,
            asperity.PeaksThenGreenwoodWilliamson(
                [1e-4, 2e-4, 1e-4],
                z_max=3e-4,
                z_min=-3e-4,
                reading="added",
                rms_height=7e-5,
                q0=2e3,
            ),
        ),
    ],
)
def test_asperities_of_numbers(folder, kind, more, expected):
    table = f"[correction]\nkind = '{kind}'\nz_max_m = 3e-4\nz_min_m = -3e-4\n"
    scene = load_scene(write(folder, SURFACE + RUBBER + CONDITIONS + table + more))
    assert scene.correction == expected


@pytest.mark.parametrize("points", [1, 11])
def test_points_are_computed_in_chunks_that_change_nothing(folder, points, monkeypatch):
    monkeypatch.setattr("asperity.scene.model._CHUNK", 4)
    seen: list[slice] = []

    def watch(chunks):
        seen.extend(chunks)
        return nullcontext(chunks)

    velocity = np.geomspace(1e-4, 1, points)
    text = CONDITIONS.replace("{from = 1e-4, to = 1, points = 5}", str(velocity.tolist()))
    scene = load_scene(write(folder, SURFACE + RUBBER + text))
    pressure = np.array([[81e3], [2e5]])
    expected = asperity.friction(SPECTRUM, PRONY, pressure=pressure, velocity=velocity)
    np.testing.assert_array_equal(scene.friction(watch).mu, expected.mu)
    assert len(seen) == -(-2 * points // 4)  # pressures and velocities flattened
    q = np.array([2e3, 1e4, 1e5])
    area = asperity.contact_area(
        SPECTRUM, PRONY, pressure=pressure, velocity=velocity, wavenumber=q
    )
    seen.clear()
    np.testing.assert_array_equal(scene.contact_area(q, watch), area)
    assert len(seen) == -(-2 * points // 4)


def test_contact_notes_are_the_cores(folder):
    table = "[correction]\nkind = 'greenwood-williamson'\nz_max_m = 3e-4\nz_min_m = -3e-4\n"
    scene = load_scene(write(folder, SURFACE + RUBBER + CONDITIONS + table))
    expected = asperity.contact_notes(
        SPECTRUM,
        PRONY,
        pressure=[[81e3], [2e5]],
        velocity=scene.velocity,
        correction=scene.correction,
    )
    assert set(scene.contact_notes()) == set(expected) == set(scene.friction().notes)
    assert len(expected) > 1
