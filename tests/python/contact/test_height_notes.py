"""What a spectrum does not know of its map is noted, with the size of the error."""

import pickle
import re

import numpy as np
import pytest

import asperity
from asperity.scene.scene import load_scene
from asperity.validation import slide
from helpers.rubbers import prony

LENGTH, POINTS = 0.01, 128
ROAD = asperity.SelfAffineSpectrum(
    rms_height=1e-4, hurst=0.8, q0=8 * np.pi / LENGTH, q1=32 * np.pi / LENGTH
)
RUBBER = prony(1e6, np.geomspace(3e5, 3e8, 8), np.geomspace(1e-1, 1e-7, 8))
NOTES = {"heights-not-gaussian", "gathered-waves"}


def height_map(shape):
    z = asperity.synthesize(ROAD, shape=(POINTS, POINTS), pixel_size=LENGTH / POINTS, seed=5)
    z = z.heights / z.heights.std()
    made = {
        "Gaussian": z,
        "worn": -np.logaddexp(0, -2 * z),
        "peaks": np.exp(0.5 * z),
        "gathered": z + 0.5 * short_waves(z) * (np.arange(POINTS) < POINTS / 4),
    }[shape]
    made = (made - made.mean()) / made.std()
    return asperity.HeightMap(1e-4 * made, pixel_size=LENGTH / POINTS)


def short_waves(z):
    q = 2 * np.pi * np.fft.fftfreq(POINTS, LENGTH / POINTS)
    kept = (q**2 + q[:, None] ** 2 > (2 * ROAD.q0) ** 2) & (q**2 + q[:, None] ** 2 < ROAD.q1**2)
    waves = np.fft.ifft2(np.fft.fft2(np.random.default_rng(1).normal(size=z.shape)) * kept).real
    return waves / waves.std()


def rings(scan):
    spectrum = asperity.power_spectrum(scan, window="none", detrend=None)
    return spectrum.truncated(q0=ROAD.q0, q1=ROAD.q1)


def notes(spectrum, correction):
    result = asperity.friction(
        spectrum, RUBBER, pressure=2e5, velocity=0.1, correction=correction, rtol=1e-3
    )
    assert np.isnan(result.model_error) == any(note.code in NOTES for note in result.notes)
    return [note for note in result.notes if note.code in NOTES]


def of_heights(table):
    shape = table.skewness, table.kurtosis, table.curvature_kurtosis
    return [number for number in shape if number is not None]


def curvature_kurtosis(z):
    found = []
    for along in (z, z.T)[: z.ndim]:
        second = along[..., 4:] - 2 * along[..., 2:-2] + along[..., :-4]
        found.append(float((second**4).mean() / (second**2).mean() ** 2))
    return max(found)


def shape_of(scan):
    return [scan.skewness, scan.kurtosis, curvature_kurtosis(scan.heights)]


def test_a_spectrum_knows_the_heights_that_it_was_measured_on():
    scan = height_map("worn")
    tilted = asperity.HeightMap(
        scan.heights + 1e-5 * np.arange(POINTS) + 3.0, pixel_size=LENGTH / POINTS
    )
    table = asperity.power_spectrum(tilted)
    flat = tilted.detrend("plane")
    assert of_heights(table) == pytest.approx(shape_of(flat), rel=1e-9)
    raw = of_heights(asperity.power_spectrum(tilted, detrend=None))
    assert raw == pytest.approx(shape_of(tilted), rel=1e-6)
    changed = [table.truncated(q0=ROAD.q0), table.scaled(2.0), table.log_binned(per_decade=8)]
    changed += [asperity.merge_spectra([table, table]), pickle.loads(pickle.dumps(table))]
    for other in changed:
        assert of_heights(other) == pytest.approx(of_heights(table), rel=1e-12)
    assert asperity.power_spectrum(tilted, part="top").skewness is None
    unknown = asperity.TabulatedSpectrum(wavenumber=table.wavenumber, density=table.density)
    assert asperity.merge_spectra([unknown, unknown]).kurtosis is None
    line = asperity.LineScan(tilted.heights[7], spacing=LENGTH / POINTS)
    straight = line.detrend("plane")
    profile = asperity.line_spectrum(line)
    assert of_heights(profile) == pytest.approx(shape_of(straight), rel=1e-9)
    flat_map = asperity.HeightMap(np.zeros((32, 32)), pixel_size=1e-6)
    assert asperity.power_spectrum(flat_map).skewness is None


@pytest.mark.parametrize("shape", ["worn", "peaks", "gathered"])
def test_it_is_noted_with_what_exact_contacts_had(shape):
    scan = height_map(shape)
    table = rings(scan)
    [note] = notes(table, asperity.PartialContact())
    assert notes(table, None) == [note]
    said = asperity.friction(
        table, RUBBER, pressure=2e5, velocity=0.1, correction=asperity.PartialContact()
    )
    exact = slide(scan, RUBBER, pressure=2e5, velocity=0.1, periodic=True)
    found = re.search(r"had ([\d.]+) times the mu of PartialContact \(([\d.]+) to ([\d.]+)\)", note)
    assert found is not None
    mean, lowest, highest = map(float, found.groups())
    assert lowest < mean < highest
    assert lowest <= exact.hysteresis / said.mu <= highest


def test_there_is_no_note_where_nothing_is_to_say():
    assert notes(rings(height_map("Gaussian")), asperity.PartialContact()) == []
    worn = height_map("worn")
    table = rings(worn)
    alone = asperity.TabulatedSpectrum(wavenumber=table.wavenumber, density=table.density)
    assert notes(alone, asperity.PartialContact()) == []
    exact = asperity.friction(
        table,
        RUBBER,
        pressure=2e5,
        velocity=0.1,
        correction=asperity.ScanContact(worn, periodic=True),
    )
    assert not any(note.code in NOTES for note in exact.notes)


@pytest.mark.parametrize("fit", ["", 'fit = "self-affine"\n'])
@pytest.mark.parametrize("kind", ["partial-contact", "scan-contact"])
def test_a_scene_notes_it(tmp_path, fit, kind):
    fine = asperity.SelfAffineSpectrum(rms_height=1e-4, hurst=0.8, q0=ROAD.q0, q1=5 * ROAD.q1)
    pixel = LENGTH / 256
    rough = asperity.synthesize(fine, shape=(256, 256), pixel_size=pixel, seed=5).heights
    np.save(tmp_path / "scan.npy", -5e-5 * np.logaddexp(0, -2e4 * rough))
    ends = f"q0_per_m = {ROAD.q0}\nq1_per_m = {ROAD.q1}\n"
    (tmp_path / "scene.toml").write_text(
        f'[surface]\nfile = "scan.npy"\npixel_size_m = {pixel}\nunit = "m"\n{fit}{ends}'
        "[rubber]\nequilibrium_modulus_pa = 1e6\nmoduli_pa = [9e6]\nrelaxation_times_s = [1e-3]\n"
        "[conditions]\npressure_pa = 2e5\nvelocity_m_s = 0.1\n"
        f'[correction]\nkind = "{kind}"\n[solver]\nrtol = 1e-3\n'
    )
    found = load_scene(tmp_path / "scene.toml").friction().notes
    assert sum(note.code in NOTES for note in found) == (kind == "partial-contact")


@pytest.mark.parametrize("shape", ["worn", "Gaussian", "peaks"])
def test_a_scene_says_of_a_worn_line_scan_what_its_tops_have(tmp_path, shape):
    heights = height_map(shape).heights.reshape(-1)
    np.save(tmp_path / "line.npy", heights)
    (tmp_path / "scene.toml").write_text(
        f'[surface]\nfile = "line.npy"\npixel_size_m = {LENGTH / POINTS}\nunit = "m"\n'
        "[rubber]\nequilibrium_modulus_pa = 1e6\nmoduli_pa = [9e6]\nrelaxation_times_s = [1e-3]\n"
        "[conditions]\npressure_pa = 2e5\nvelocity_m_s = 0.1\n"
    )
    found = load_scene(tmp_path / "scene.toml").friction().notes
    said = [note for note in found if note.code == "worn-line-scan"]
    assert len(said) == (shape == "worn")
    for note in said:
        steep = np.diff(heights) ** 2
        share = steep[heights[1:] > heights.mean()].mean() / steep.mean()
        assert float(note.split(" of the mean square slope")[0].split()[-1]) == pytest.approx(
            share, rel=0.03
        )
        assert share < 0.8  # half of the points have all of the slope in a Gaussian map: 1


def test_waves_may_be_gathered_along_either_axis():
    rng = np.random.default_rng(2)
    place = np.arange(256) / 256
    grooves = np.sin(2 * np.pi * 40 * place) * np.exp(-(((place - 0.5) / 0.1) ** 2))
    heights = 1e-6 * (grooves[:, None] + 0.05 * rng.normal(size=(256, 256)))
    heights += 3e-6 * rng.normal(size=4) @ np.cos(2 * np.pi * np.outer(np.arange(1, 5), place))
    for z in (heights, heights.T):
        table = asperity.power_spectrum(asperity.HeightMap(z, pixel_size=1e-6))
        assert table.curvature_kurtosis == pytest.approx(curvature_kurtosis(z), rel=1e-3)
        assert table.curvature_kurtosis > 4
