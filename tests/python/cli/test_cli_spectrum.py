"""`asperity spectrum`: line scans, directions, drop-outs, what is flagged."""

import numpy as np
import pytest

import asperity
from asperity.cli.main import main
from asperity.scene.scan import noise_floor

SIDE, PIXEL = 256, 1e-6
SURFACE = asperity.SelfAffineSpectrum(
    rms_height=1e-6, hurst=0.8, q0=2 * np.pi / (SIDE * PIXEL), q1=np.pi / PIXEL
)
SCAN = asperity.synthesize(SURFACE, shape=(SIDE, SIDE), pixel_size=PIXEL, seed=3)
LONG = asperity.synthesize(SURFACE, shape=(SIDE, 4096), pixel_size=PIXEL, seed=3).heights[0]
READ = ["--pixel-size", str(PIXEL), "--unit", "m"]


def run(capsys, *arguments):
    """What was found, and all that was said."""
    assert main(["spectrum", *arguments]) == 0
    said = capsys.readouterr().err
    pairs = [line.split(" = ") for line in said.splitlines() if " = " in line]
    return {name: float(value) for name, value in pairs if name.isidentifier()}, said


def test_a_map_is_fitted_where_it_is_reliable(folder, capsys):
    np.save("map.npy", SCAN.heights)
    result, said = run(capsys, "map.npy", *READ)
    assert result["reliable_from_per_m"] == pytest.approx(16 * 2 * np.pi / (SIDE * PIXEL), rel=0.03)
    assert result["fit_q0_per_m"] == result["reliable_from_per_m"]
    assert result["fit_q1_per_m"] == result["reliable_to_per_m"] <= np.pi / PIXEL / 2
    assert result["fit_hurst"] == pytest.approx(0.8, abs=4 * result["fit_hurst_standard_error"])
    assert result["slope_anisotropy"] == pytest.approx(1, abs=0.1)
    assert "lay" not in said


def test_a_slope_fit_is_eq_28_alone(folder, capsys):
    np.save("map.npy", SCAN.heights)
    result, _ = run(capsys, "map.npy", *READ, "--method", "slope")
    spectrum = asperity.power_spectrum(asperity.HeightMap(SCAN.heights, pixel_size=PIXEL))
    q = spectrum.wavenumber
    used = (q >= 0.9999 * result["fit_q0_per_m"]) & (q <= 1.0001 * result["fit_q1_per_m"])
    slope = np.polyfit(np.log(q[used]), np.log(spectrum.density[used]), 1)[0]
    assert result["fit_hurst"] == pytest.approx(-slope / 2 - 1, abs=1e-5)


def test_a_lay_is_said(folder, capsys):
    np.save("map.npy", SCAN.heights)
    result, said = run(capsys, "map.npy", "--pixel-size", f"{3 * PIXEL},{PIXEL}", "--unit", "m")
    assert result["slope_anisotropy"] > 2
    assert result["lay_deg"] == pytest.approx(90, abs=10)  # x was squeezed
    assert "note: the slope across the lay is" in said


def test_a_line_scan_gives_the_surface_behind_it(folder, capsys):
    np.save("line.npy", LONG)
    arguments = ["line.npy", *READ, "--output", "line.csv"]
    _, said = run(capsys, *arguments)
    assert "note: of a line scan" in said
    assert "slope_anisotropy" not in said
    lines = (folder / "line.csv").read_text().splitlines()
    assert "# pixel_size_m = 1e-06" in lines
    header = next(line for line in lines if not line.startswith("#"))
    assert header == "wavenumber_per_m,density_m4,standard_error_m4,count,flag"


@pytest.mark.parametrize(("limit", "code"), [("0.1", 2), ("0.3", 0)])
def test_the_limit_of_dropouts_is_the_users(folder, capsys, limit, code):
    holed = np.where(
        np.random.default_rng(1).random(SCAN.heights.shape) < 0.2, np.nan, SCAN.heights
    )
    np.save("map.npy", holed)
    assert main(["spectrum", "map.npy", *READ, "--max-dropouts", limit]) == code
    said = capsys.readouterr().err
    assert ("must be at most 10 %, --max-dropouts = 0.1" in said) == (code == 2)


def test_friction_says_where_its_spectrum_is_uncertain(folder):
    spectrum = asperity.power_spectrum(SCAN).truncated(q1=np.pi / PIXEL)
    rubber = asperity.PronySeries(equilibrium_modulus=1e6, moduli=[1e8], relaxation_times=[1e-4])
    notes = asperity.friction(spectrum, rubber, pressure=1e5, velocity=1e-3).notes
    low = spectrum.wavenumber[(np.asarray(spectrum.flag) & 1) != 0][-1]
    assert any(f"uncertain up to {low:.4g} 1/m" in note for note in notes)
    assert any("too high from" in note and "pi / pixel" in note for note in notes)
    sound = spectrum.truncated(q0=4.2e5, q1=1.5e6)
    notes = asperity.friction(sound, rubber, pressure=1e5, velocity=1e-3).notes
    assert not any("measured spectrum" in note for note in notes)


@pytest.mark.parametrize("hurst", [0.3, 1.0])
@pytest.mark.parametrize("rolloff", [None, 8])
@pytest.mark.parametrize("finer", [1, 4])
def test_noise_is_seen_where_it_is_and_nowhere_else(hurst, rolloff, finer):
    """Maps of rings up to pi / pixel, and points of four times finer ones, which fold back."""
    end, first = np.pi / PIXEL, 2 * np.pi / (SIDE * PIXEL)
    road = asperity.SelfAffineSpectrum(
        rms_height=1e-6,
        hurst=hurst,
        q0=first,
        q1=0.999 * finer * end,
        rolloff=None if rolloff is None else rolloff * first,
    )
    shape = (SIDE * finer, SIDE * finer)
    made = asperity.synthesize(road, shape=shape, pixel_size=PIXEL / finer, seed=5)
    # white noise has C = s^2 pixel^2 / (4 pi^2): as much as the surface at 0.4 of pi / pixel
    crossing = 0.4 * end
    deviation = 2 * np.pi / PIXEL * np.sqrt(road.at(crossing))
    white = deviation * np.random.default_rng(6).standard_normal((SIDE, SIDE))
    for side in (SIDE // 2, SIDE):  # a part of it is not periodic
        clean = made.heights[::finer, ::finer][:side, :side]
        noisy = clean + white[:side, :side]
        assert noise_floor(measured(clean)) is None
        assert noise_floor(measured(noisy)) == pytest.approx(crossing, rel=0.2)


def measured(heights):
    return asperity.power_spectrum(asperity.HeightMap(heights, pixel_size=PIXEL))


def test_noise_is_told_and_whether_the_scan_serves(folder, capsys):
    heights = SCAN.heights
    noise = 2 * np.pi / PIXEL * np.sqrt(SURFACE.at(0.3 * np.pi / PIXEL))
    noise = noise * np.random.default_rng(1).standard_normal(heights.shape)
    for name, scan in (("clean.npy", heights), ("noisy.npy", heights + noise)):
        np.save(name, scan)
        result, said = run(capsys, name, *READ, "--output", "s.csv")
        (line,) = [line for line in said.splitlines() if "this scan serves" in line]
        last = result.get("noise_from_per_m", result["reliable_to_per_m"])
        assert f"from {result['reliable_from_per_m']:.3g} to {last:.3g} 1/m" in line
        assert ("ends flat" in said) == ("noise_from_per_m" in result) == (name == "noisy.npy")
        spectrum = measured(np.load(name))
        slopes = [spectrum.truncated(q1=q).rms_slope for q in (result["reliable_from_per_m"], last)]
        share = (slopes[1] ** 2 - slopes[0] ** 2) / spectrum.rms_slope**2
        assert f"with {100 * share:.0f} % of" in line
        assert ("only: mu hangs on the rest" in line) == (share < 0.5)


def test_a_surface_as_flat_as_no_mirror_is_refused(folder, capsys):
    """As where a file states its micrometres to be metres."""
    np.save("map.npy", SCAN.heights)
    assert main(["spectrum", "map.npy", "--pixel-size", "0.3", "--unit", "m"]) == 2
    (line,) = capsys.readouterr().err.splitlines()
    assert "rms slope = " in line
    assert "pixel_size = 0.3: unusual" in line
