"""Foolish scene files: each is refused in one line that names file, table and key."""

import re

import numpy as np
import pytest

from asperity import InvalidInput, OutOfRange
from asperity.scene.scene import load_scene
from helpers.scenes import CONDITIONS, CURVE, RUBBER, SCAN, SURFACE


@pytest.fixture
def folder(tmp_path):
    """A folder with a scan and a master curve."""
    rng = np.random.default_rng(1)
    np.save(tmp_path / "scan.npy", rng.normal(size=(30, 40)))
    header = "angular_frequency_rad_s,storage_modulus_pa,loss_modulus_pa"
    (tmp_path / "curve.csv").write_text(f"{header}\n1e-3,1e6,1e5\n1e6,1e9,1e8\n")
    return tmp_path


def refused(folder, text):
    """The error of a scene, in a line that begins with its file, once."""
    path = folder / "scene.toml"
    path.write_text(text, encoding="utf-8")
    with pytest.raises((InvalidInput, OutOfRange)) as caught:
        load_scene(path).friction()
    start, message = str(caught.value)[: len(str(path))], str(caught.value)[len(str(path)) :]
    assert start == str(path)
    assert not message.startswith(f": {path}")
    assert "\n" not in message
    return caught.value


BASE = SURFACE + RUBBER + CONDITIONS
MASTER = SURFACE + CURVE + CONDITIONS
SCANNED = SCAN + RUBBER + CONDITIONS
GW = "[correction]\nkind = 'greenwood-williamson'\n"
S = "[correction]\nkind = 's-factor'\n"
MANY = "{from = 1, to = 2, points = 1001}"
HEX, SWEEP = "0x" + "f" * 5000, "{from = 1, to = 2, points = 100001}"


@pytest.mark.parametrize(
    ("scene", "old", "new", "argument"),
    [
        (BASE, "hurst = 0.7", "", "[surface] hurst"),
        (BASE, "hurst", "Hurst", "[surface] Hurst"),
        (BASE, "0.7", "'a'", "[surface] hurst"),
        (BASE, "0.7", "1.2", "[surface] hurst"),
        (BASE, "0.7", HEX, "[surface] hurst"),
        (BASE, "0.7", "0.7\nfile = 'scan.npy'", "[surface] rms_height_m"),
        (BASE, "0.7", "0.7\nunit = 'm'", "[surface] unit"),
        (BASE, "0.7", "0.7\ncontamination_size_m = 1.0", "[surface] contamination_size_m"),
        (BASE, "0.7", "0.7\ncontamination_size_m = 3.07e-3", "[surface] contamination_size_m"),
        (BASE, "0.7", "0.7\nslope_cutoff = 0", "[surface] slope_cutoff"),
        (BASE, "rms_height_m = 76", "rms_height_m = -76", "[surface] rms_height_m"),
        (BASE, "q1_per_m = 1e5", "q1_per_m = 1e3", "[surface] q1_per_m"),
        (SCANNED, 'unit = "um"', "", "[surface] unit"),
        (SCANNED, '"um"', "'inch'", "[surface] unit"),
        (SCANNED, "unit", f"channel = {HEX}\nunit", "[surface] channel"),
        (SCANNED, "unit", "q0_per_m = 1\nunit", "[surface] q0_per_m"),
        (SCANNED, "unit", "window = 'x'\nunit", "[surface] window"),
        (SCANNED, "unit", "detrend = 'x'\nunit", "[surface] detrend"),
        (SCANNED, "[2e-5, 1e-5]", "[1, 2, 3]", "[surface] pixel_size_m"),
        (SCANNED, "[2e-5, 1e-5]", "-1", "[surface] pixel_size_m"),
        (SCANNED, "scan.npy", "", "[surface] file"),
        (SCANNED, "scan.npy", "a\\u0000b", "[surface] file"),
        (BASE, "moduli_pa", "modulus_pa", "[rubber] modulus_pa"),
        (BASE, "[1e9, 1e8, 1e7]", "1e9", "[rubber] moduli_pa"),
        (BASE, "[1e-8,", "[1e-8, 1.0,", "[rubber] moduli_pa"),
        (BASE, "[1e-8,", "[-1e-8,", "[rubber] relaxation_times_s"),
        (BASE, "= 2e6", "= -2e6", "[rubber] equilibrium_modulus_pa"),
        (BASE, "equilibrium", "extrapolation = 'clamp'\nequilibrium", "[rubber] extrapolation"),
        (BASE, RUBBER, CURVE.replace("curve.csv", ""), "[rubber] master_curve"),
        (BASE, RUBBER, CURVE + "moduli_pa = []", "[rubber] moduli_pa"),
        (BASE, RUBBER, CURVE + "isotherms = ['a.csv']", "[rubber] master_curve"),
        (BASE, "pressure_pa", "presure_pa", "[conditions] presure_pa"),
        (BASE, "pressure_pa", "pressure_kpa", "[conditions] pressure_kpa"),
        (BASE, "velocity_m_s = {from = 1e-4, to = 1, points = 5}", "", "[conditions] velocity_m_s"),
        (BASE, "[81e3, 2e5]", "[]", "[conditions] pressure_pa"),
        (BASE, "[81e3, 2e5]", "['a']", "[conditions] pressure_pa"),
        (BASE, "[81e3, 2e5]", "'1 bar'", "[conditions] pressure_pa"),
        (BASE, "[81e3, 2e5]", "-1", "[conditions] pressure_pa"),
        (BASE, "[81e3, 2e5]", SWEEP, "[conditions] pressure_pa"),
        (BASE, "from =", "form =", "[conditions] velocity_m_s"),
        (BASE, "points = 5", "pionts = 5", "[conditions] velocity_m_s"),
        (BASE, "to = 1", "to = 'x'", "[conditions] velocity_m_s"),
        (BASE, "from = 1e-4", "from = 0", "[conditions] velocity_m_s"),
        (BASE, "points = 5", "points = 5.0", "[conditions] velocity_m_s"),
        (BASE, "pressure_pa", "poisson_ratio = 0.6\npressure_pa", "[conditions] poisson_ratio"),
    ],
)
def test_tables(folder, scene, old, new, argument):
    assert refused(folder, scene.replace(old, new)).argument == argument


@pytest.mark.parametrize(
    ("more", "argument"),
    [
        ("[adhesion]\n", "[adhesion] shear_stress_pa"),
        ("[adhesion]\nshear_stress = 1\n", "[adhesion] shear_stress"),
        ("[adhesion]\nshear_stress_pa = -1\n", "[adhesion] shear_stress_pa"),
        ("[solver]\ntol = 1\n", "[solver] tol"),
        ("[solver]\nrtol = 0\n", "[solver] rtol"),
        ("[solver]\nform = 'fast'\n", "[solver] form"),
        ("[solver]\nmethod = 'simpson'\n", "[solver] method"),
        ("[correction]\n", "[correction] kind"),
        ("[correction]\nkind = 'sfactor'", "[correction] kind"),
        (S + "p = 2.0", "[correction] p"),
        (S + "gamma = 2.0", "[correction] gamma"),
        (S + "applies_to = 'x'", "[correction] applies_to"),
        ("[correction]\nkind = 'affine-shift'", "[correction] p"),
        ("[correction]\nkind = 'affine-shift'\np = 0.5", "[correction] p"),
        ("[correction]\nkind = 'local-peaks'", "[correction] heights_m"),
        (
            "[correction]\nkind = 'local-peaks'\nmin_distance_m = 5e-5\n",
            "[correction] min_distance_m",
        ),
        (GW, "[correction] z_max_m"),
        (GW + "z_max_m = 1e-4\nz_min_m = 2e-4", "[correction] z_min_m"),
    ],
)
def test_other_tables(folder, more, argument):
    assert refused(folder, BASE + more).argument == argument


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("[surface", "not a TOML file"),
        ('[surface]\nfile = "C:\\scans\\road.csv"', 'line 2: in "..." a \\ begins a code'),
        ('[surface]\nfile = "road.csv', "line 2: the quotation mark at the end"),
        ("[surface]\nfile = road.csv", "line 2: texts stand in quotation marks"),
        (SCANNED.replace("scan.npy", r"C:\temp\road.npy"), "a name with / or"),
        (SURFACE + CONDITIONS, "[rubber]: missing"),
        (BASE + "[adhesoin]\n", "[adhesoin]: unknown table, did you mean [adhesion]?"),
        ("hurst = 1\n" + BASE, "hurst: unknown key"),
        (
            BASE.replace("[81e3, 2e5]", MANY).replace("points = 5", "points = 1000"),
            "1001000 points",
        ),
        (BASE.replace("pressure_pa", "pressure_kpa"), "did you mean pressure_pa? Its number is"),
        (BASE + "[correction]\nkind = 'sfactor'", "did you mean s-factor?"),
        (MASTER.replace("curve.csv", "/dev/zero"), "/dev/zero: cannot be read"),
        (SCANNED + GW, "[correction] q0_per_m: missing"),
    ],
)
def test_whole_files_and_what_is_offered(folder, text, words):
    assert words in str(refused(folder, text))


@pytest.mark.parametrize(
    ("content", "words"),
    [
        ("", "is empty"),
        ("frequency,storage,loss\n1,2,3\n", "columns, units and modulus say"),
        ("{}\n1,2\n", "line 2 has 2 cells"),
        ("{}\n1,2,x\n", "line 2: loss = 'x'"),
        ("{}\n", "no numbers"),
        ("{}\n1,1e6,1e6\n1,1e6,1e6\n", "angular_frequency has 1 entries"),
        ("{}\n1,1,1\n2,-1,1\n", "line 3: storage = -1"),
        ("{}\n1,1,1\n2,,1\n", "line 3: storage is empty"),
    ],
)
def test_master_curves(folder, content, words):
    header = "angular_frequency_rad_s,storage_modulus_pa,loss_modulus_pa"
    (folder / "curve.csv").write_text(content.format(header))
    message = str(refused(folder, MASTER))
    assert "curve.csv: " in message
    assert words in message


def test_one_end_of_the_spectrum_is_offered_that_serves_all_velocities(folder):
    """The first step of a progress bar that is refused does not reach the fastest velocity."""
    swept = MASTER.replace("to = 1, points = 5", "to = 200, points = 200")
    message = str(refused(folder, swept))
    assert "[conditions] velocity_m_s = 200: " in message
    both = re.search(
        r'\[rubber\] extrapolation = "power-law" or "clamp" adds a decade at each end, '
        r"and \[surface\] q1_per_m = (\S+) ends the spectrum there; "
        r"\[surface\] q1_per_m = (\S+) ends the spectrum where it is known; velocities from",
        message,
    )
    assert both is not None, message
    (line,) = re.findall(r"velocity_m_s = \{.*?\}", message)
    slower = re.sub(r"velocity_m_s = \{.*?\}", line, swept)
    further = re.sub(r"q1_per_m = \S+", f"q1_per_m = {both[1]}", swept)
    plain = re.sub(r"q1_per_m = \S+", f"q1_per_m = {both[2]}", swept)
    further = further.replace("[rubber]", '[rubber]\nextrapolation = "power-law"')
    for followed in (plain, further, slower):
        (folder / "scene.toml").write_text(followed)
        load_scene(folder / "scene.toml").friction()


@pytest.mark.parametrize("name", ["/dev/zero", "none.toml"])
def test_scenes_that_are_no_files(name):
    with pytest.raises(InvalidInput, match=f"{name}: cannot be read: "):
        load_scene(name)
