"""Foolish scene files: each is refused in one line that names file, table and key."""

import re
from pathlib import Path

import numpy as np
import pytest

from asperity import InvalidInput, OutOfRange
from asperity.scene.scene import load_scene
from helpers.scenes import CONDITIONS, CURVE, RUBBER, SCAN, SURFACE

PEAKS = "[correction]\nkind = '{}'\nmin_distance_m = 5e-5\n"


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    """A folder with a scan and a master curve."""
    rng = np.random.default_rng(1)
    np.save(tmp_path / "scan.npy", rng.normal(size=(30, 40)))
    header = "angular_frequency_rad_s,storage_modulus_pa,loss_modulus_pa"
    (tmp_path / "curve.csv").write_text(f"{header}\n1e-3,1e6,1e5\n1e6,1e9,1e8\n")
    return tmp_path


def refusal(folder: Path, text: str) -> str:
    """Message about a scene, without the path of the file that it must begin with."""
    path = folder / "scene.toml"
    path.write_text(text, encoding="utf-8")
    with pytest.raises((InvalidInput, OutOfRange)) as caught:
        load_scene(path).friction()
    start, message = (
        str(caught.value)[: len(str(path)) + 2],
        str(caught.value)[len(str(path)) + 2 :],
    )
    assert start == f"{path}: "
    assert not message.startswith(f"{path}: [")  # once is enough
    assert "\n" not in message
    return message


BASE = SURFACE + RUBBER + CONDITIONS
MASTER = SURFACE + CURVE + CONDITIONS
GW = "[correction]\nkind = 'greenwood-williamson'\n"


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("[surface", "not a TOML file"),
        *(
            (f"[surface]\nfile = {value}\n", f"line 2: {problem}")
            for value, problem in (
                (r'"C:\scans\road.csv"', "in \"...\" a \\ begins a code: use / or '...'"),
                (r'"C:\Users\road.csv"', "in \"...\" a \\ begins a code: use / or '...'"),
                ('"road.csv', "the quotation mark at the end is missing"),
                ("'road.csv", "the quotation mark at the end is missing"),
                ("road.csv", 'texts stand in quotation marks: "road.csv"'),
            )
        ),
        (SCAN.replace("scan.npy", r"C:\temp\road.npy") + RUBBER + CONDITIONS, "a name with / or"),
        ("\n", "[surface]: missing"),
        (SURFACE + CONDITIONS, "[rubber]: missing"),
        (SURFACE + RUBBER, "[conditions]: missing"),
        (BASE + "[adhesoin]\n", "[adhesoin]: unknown table, did you mean [adhesion]?"),
        (BASE + "[weather]\n", "[weather]: unknown table, allowed are [surface], [rubber]"),
        ("hurst = 1\n" + BASE, "hurst: unknown key"),
        ("solver = 1\n" + BASE, "[solver]: must be a table"),
        (
            BASE.replace("pressure_pa", "presure_pa"),
            "[conditions] presure_pa: unknown key, did you mean pressure_pa?",
        ),
        (
            BASE.replace("pressure_pa", "pressure_kpa"),
            "did you mean pressure_pa? Its number is in another unit.",
        ),
        (BASE.replace("hurst", "Hurst"), "[surface] Hurst: unknown key, did you mean hurst?"),
        (
            BASE.replace("moduli_pa", "modulus_pa"),
            "[rubber] modulus_pa: unknown key, did you mean moduli_pa?",
        ),
        (
            BASE + "[solver]\ntol = 1\n",
            "[solver] tol: unknown key, did you mean rtol?",
        ),
        (
            BASE + "[adhesion]\nshear_stress = 1\n",
            "[adhesion] shear_stress: unknown key, did you mean shear_stress_pa?",
        ),
        (BASE + "[adhesion]\n", "[adhesion] shear_stress_pa: missing"),
        (SURFACE + RUBBER + "[conditions]\npressure_pa = 1", "[conditions] velocity_m_s: missing"),
        (BASE.replace("hurst = 0.7", ""), "[surface] hurst: missing; give file, or rms_height_m"),
        (BASE.replace("hurst = 0.7", "hurst = 'a'"), "[surface] hurst = 'a': must be a number"),
        (BASE.replace("hurst = 0.7", "hurst = true"), "[surface] hurst = true: must be a number"),
        (
            BASE.replace("[1e9, 1e8, 1e7]", "1e9"),
            "[rubber] moduli_pa = 1e9: must be a list",
        ),
        (
            BASE.replace("[81e3, 2e5]", "[]"),
            "[conditions] pressure_pa = []: must be a number, a list",
        ),
        (BASE.replace("[81e3, 2e5]", "['a']"), "[conditions] pressure_pa = ['a']: must be a list"),
        (
            BASE.replace("hurst = 0.7", "hurst = 1979-05-27"),
            "[surface] hurst = 1979-05-27: must be a number",
        ),
        (BASE.replace("0.7", "0x" + "f" * 5000), "ff...: must be a finite number"),
        (BASE.replace("0.7", "9" * 5000), "not a TOML file: nested too deeply, or a number of"),
        ("a = " + "[" * 5000 + BASE, "not a TOML file: nested too deeply"),
        (
            BASE.replace("[81e3, 2e5]", "'1 bar'"),
            "must be a number, a list, or {from = 1e-6, to = 10, points = 60}",
        ),
        (
            BASE.replace("from =", "form ="),
            "[conditions] velocity_m_s = {form = 1e-4, to = 1, points = 5}: "
            "unknown key form, did you mean from?",
        ),
        (BASE.replace("points = 5", "pionts = 5"), "unknown key pionts, did you mean points?"),
        (BASE.replace(", points = 5", ""), "points is missing, as in {from = 1e-6, to = 10, p"),
        (BASE.replace("to = 1", "to = 'x'"), "points = 5}: to must be a number"),
        (BASE.replace("points = 5", "points = 5.0"), "points must be a whole number"),
        (BASE.replace("points = 5", "points = 1"), "points must be in 2..100000"),
        (BASE.replace("points = 5", "points = 5000000000"), "points must be in 2..100000"),
        (
            BASE.replace("[81e3, 2e5]", "{from = 1, to = 2, points = 1001}").replace(
                "points = 5", "points = 1000"
            ),
            "[conditions]: pressure_pa times velocity_m_s are 1001000 points: must be at most",
        ),
        (BASE.replace("from = 1e-4", "from = 0"), "must be a sweep between two positive numbers"),
        (BASE.replace("to = 1", "to = inf"), "must be a sweep between two positive numbers"),
        (
            BASE.replace("hurst = 0.7", "hurst = 0.7\nfile = 'scan.npy'"),
            "[surface] rms_height_m: must",
        ),
        (
            BASE.replace("hurst = 0.7", "hurst = 0.7\nunit = 'm'"),
            "[surface] unit: must be left out",
        ),
        (BASE.replace("hurst = 0.7", "hurst = 1.2"), "[surface] hurst = 1.2"),
        (BASE.replace("hurst = 0.7", "hurst = nan"), "[surface] hurst = nan"),
        (BASE.replace("q1_per_m = 1e5", "q1_per_m = 1e3"), "[surface] q1_per_m = 1e3"),
        (BASE.replace("rms_height_m = 76", "rms_height_m = -76"), "[surface] rms_height_m = -7"),
        (
            BASE.replace("hurst = 0.7", "hurst = 0.7\ncontamination_size_m = 1.0"),
            "[surface] contamination_size_m = 1.0: must be below",
        ),
        (
            BASE.replace("hurst = 0.7", "hurst = 0.7\nslope_cutoff = 0"),
            "[surface] slope_cutoff = 0",
        ),
        (
            BASE.replace("hurst = 0.7", "hurst = 0.7\ncontamination_size_m = 3.07e-3"),
            "[surface] contamination_size_m = 3.07e-3: must leave a band, cuts at 2047 1/m, where "
            "the spectrum begins at 2000: are the heights in another unit?",
        ),
        (BASE.replace("[81e3, 2e5]", "-1"), "[conditions] pressure_pa = -1: must be positive"),
        (BASE.replace("[81e3, 2e5]", "[1e3, nan]"), "[conditions] pressure_pa = nan: must be"),
        (
            BASE.replace("pressure_pa", "poisson_ratio = 0.6\npressure_pa"),
            "[conditions] poisson_ratio",
        ),
        (BASE + "[solver]\nrtol = 0\n", "[solver] rtol = 0: must be"),
        (BASE + "[solver]\nform = 'fast'\n", "[solver] form = "),
        (BASE + "[solver]\nmethod = 'simpson'\n", '[solver] method = "simpson": must be one of'),
        (BASE + "[solver]\nmehtod = 'qag'\n", "[solver] mehtod: unknown key, did you mean method?"),
        (
            BASE.replace("[1e-8,", "[1e-8, 1.0,"),
            "[rubber] moduli_pa (3) and [rubber] relaxation_times_s (4) must have equal length",
        ),
        (BASE.replace("[1e-8,", "[-1e-8,"), "[rubber] relaxation_times_s[0] = -1e-8: must be"),
        (BASE.replace("= 2e6", "= -2e6"), "[rubber] equilibrium_modulus_pa = -2e6"),
        (
            BASE.replace("equilibrium", "extrapolation = 'clamp'\nequilibrium"),
            "[rubber] extrapolation",
        ),
        (MASTER.replace("curve.csv", ""), "[rubber] master_curve = '': must be the name of a file"),
        (MASTER.replace("curve.csv", "/dev/zero"), "/dev/zero: cannot be read: not a regular"),
        (MASTER.replace("curve.csv", "none.csv"), "none.csv: cannot be read: No such file"),
        (MASTER.replace("curve.csv", "scene.toml"), "scene.toml: no line names the columns"),
        (
            MASTER.replace("master", "moduli_pa = []\nmaster"),
            "[rubber] moduli_pa: must be left out",
        ),
        (MASTER.replace("to = 1,", "to = 1e6,"), "[conditions] velocity_m_s = "),
        (
            MASTER.replace("[rubber]", "[rubber]\nisotherms = ['a.csv']"),
            "[rubber] master_curve: must be left out where isotherms is given",
        ),
        (BASE + "[adhesion]\nshear_stress_pa = -1\n", "[adhesion] shear_stress_pa = -1"),
        (BASE + "[correction]\n", "[correction] kind: missing"),
        (BASE + "[correction]\nkind = 'sfactor'", "kind = 'sfactor': did you mean s-factor?"),
        (BASE + "[correction]\nkind = 's-factor'\np = 2.0", "[correction] p: unknown key"),
        (BASE + "[correction]\nkind = 's-factor'\ngamma = 2.0", "[correction] gamma = 2"),
        (BASE + "[correction]\nkind = 's-factor'\napplies_to = 'x'", "[correction] applies_to = "),
        (BASE + "[correction]\nkind = 'affine-shift'", "[correction] p: missing"),
        (BASE + "[correction]\nkind = 'affine-shift'\np = 0.5", "[correction] p = 0.5"),
        (BASE + "[correction]\nkind = 'local-peaks'", "[correction] heights_m: missing"),
        (BASE + PEAKS.format("local-peaks"), "[correction] min_distance_m: needs a surface file"),
        (BASE + GW, "[correction] z_max_m: missing"),
        (BASE + GW + "z_max_m = 1e-4\nz_min_m = 2e-4", "[correction] z_m"),
        (
            BASE + GW + "z_max_m = 1e-4\nz_min_m = -1e-4\nheights_m = []",
            "[correction] heights_m",
        ),
        (SCAN + RUBBER + CONDITIONS + GW, "[correction] q0_per_m: missing"),
        (
            SCAN.replace("scan.npy", "no.npy") + RUBBER + CONDITIONS,
            "no.npy: cannot be read: No such",
        ),
        (
            SCAN.replace("scan.npy", "") + RUBBER + CONDITIONS,
            "[surface] file = '': must be the name",
        ),
        (SCAN.replace("scan.npy", "a\\u0000b") + RUBBER + CONDITIONS, "must be the name of a file"),
        (
            SCAN.replace("scan.npy", "/dev/null") + RUBBER + CONDITIONS,
            "/dev/null: cannot be read: not a regular file",
        ),
        (
            SCAN.replace('unit = "um"', "") + RUBBER + CONDITIONS,
            "scan.npy: [surface] unit is missing: a .npy file does not state the unit of its",
        ),
        (
            SCAN.replace("unit", "channel = 0x" + "f" * 5000 + "\nunit") + RUBBER + CONDITIONS,
            "ff...: must be a whole number",
        ),
        (
            SCAN.replace("unit", "q0_per_m = 1\nunit") + RUBBER + CONDITIONS,
            "[surface] q0_per_m = 1",
        ),
        (SCAN.replace("unit", "window = 'x'\nunit") + RUBBER + CONDITIONS, "[surface] window = "),
        (SCAN.replace("unit", "detrend = 'x'\nunit") + RUBBER + CONDITIONS, "[surface] detrend = "),
        (
            SCAN.replace("'um'", "'inch'").replace('"um"', "'inch'") + RUBBER + CONDITIONS,
            "unit = 'inch'",
        ),
        (SCAN.replace("[2e-5, 1e-5]", "[1, 2, 3]") + RUBBER + CONDITIONS, "[dy, dx]"),
        (SCAN.replace("[2e-5, 1e-5]", "-1") + RUBBER + CONDITIONS, "[surface] pixel_size_m = -1"),
    ],
)
def test_foolish_scenes(folder: Path, text: str, message: str) -> None:
    assert message in refusal(folder, text)


@pytest.mark.parametrize(
    ("content", "message"),
    [
        ("", "is empty"),
        ("#\n", "no line names the columns 'angular_frequency_rad_s', "),
        ("frequency,storage,loss\n1,2,3\n", "; columns, units and modulus say what other tables"),
        ("{}\n1,2\n", "line 2 has 2 cells, must have 3 or more (loss)"),
        ("{}\n1,2,x\n", "line 2: loss = 'x' is not a number"),
        ("{}\n", "no numbers below the names"),
        ("{}\n1,1e6,1e6\n1,1e6,1e6\n", "angular_frequency has 1 entries"),
        ("{}\n1,1,1\n2,-1,1\n", "line 3: storage = -1: must be positive"),
        ("{}\n1,1,1\n2,,1\n", "line 3: storage is empty"),
    ],
)
def test_foolish_master_curves(folder: Path, content: str, message: str) -> None:
    header = "angular_frequency_rad_s,storage_modulus_pa,loss_modulus_pa"
    (folder / "curve.csv").write_text(content.format(header))
    text = refusal(folder, MASTER)
    assert "curve.csv: " in text
    assert message in text


def test_advice_beyond_what_was_measured_is_in_the_keys_of_a_scene(folder: Path) -> None:
    fast = MASTER.replace("to = 1,", "to = 60,")  # 1e6 / 60 has no end
    message = refusal(folder, fast)
    told = r"\[surface\] q1_per_m = (\S+) ends the spectrum where it is known"
    found = re.search(told, message)
    assert found is not None, message
    assert '[rubber] extrapolation = "power-law" or "clamp" adds a decade' in message
    # and the advice holds
    followed = re.sub(r"q1_per_m = \S+", f"q1_per_m = {found[1]}", fast)
    (folder / "scene.toml").write_text(followed)
    load_scene(folder / "scene.toml").friction()


def test_one_end_of_the_spectrum_is_offered_that_serves_all_velocities(folder: Path) -> None:
    """The first step of a progress bar that is refused does not reach the fastest velocity."""
    swept = MASTER.replace("to = 1, points = 5", "to = 200, points = 200")
    message = refusal(folder, swept)
    assert message.startswith("[conditions] velocity_m_s = 200: ")
    both = re.search(
        r'\[rubber\] extrapolation = "power-law" or "clamp" adds a decade at each end, '
        r"and \[surface\] q1_per_m = (\S+) ends the spectrum there; "
        r"\[surface\] q1_per_m = (\S+) ends the spectrum where it is known; velocities from",
        message,
    )
    assert both is not None, message
    further = re.sub(r"q1_per_m = \S+", f"q1_per_m = {both[1]}", swept)
    plain = re.sub(r"q1_per_m = \S+", f"q1_per_m = {both[2]}", swept)
    further = further.replace("[rubber]", '[rubber]\nextrapolation = "power-law"')
    for followed in (plain, further):
        (folder / "scene.toml").write_text(followed)
        load_scene(folder / "scene.toml").friction()


def test_a_range_error_says_that_the_slope_is_not_reached(folder: Path) -> None:
    """The spectrum then ends with the pixels, which is why it asks for so much."""
    scene = SCAN + "slope_cutoff = 90\n" + MASTER[MASTER.index("[rubber]") :]
    message = refusal(folder, scene.replace("to = 1,", "to = 60,"))
    assert re.search(
        r"'Choose where the spectrum ends'\); slope_cutoff = 90 is not reached: the rms slope up",
        message,
    )


def test_endless_scene() -> None:
    with pytest.raises(InvalidInput, match="/dev/zero: cannot be read: not a regular file"):
        load_scene("/dev/zero")


def test_missing_scene(tmp_path: Path) -> None:
    with pytest.raises(InvalidInput, match=r"none\.toml: cannot be read: No such file"):
        load_scene(tmp_path / "none.toml")
