"""The verb `rubber`: measured sets, its table as a scene's rubber, pictures and refusals."""

import json

import numpy as np
import pytest

from asperity import PronySeries
from asperity.cli.main import main
from asperity.io.read_master_curve import read_master_curve
from asperity.scene.scene import load_scene
from helpers.measured import COLUMNS, POLYISOPRENE, UNITS, present
from helpers.rubbers import SWEEP, TEMPERATURES, sweeps, true_modulus, true_shift
from helpers.scenes import CONDITIONS, SURFACE
from helpers.shell import status_of


def flags(columns, units):
    def pairs(values):
        return ",".join(f"{key}={value}" for key, value in values.items())

    return ["--columns", pairs(columns), "--units", pairs(units)]


SHEAR = [*flags(COLUMNS, UNITS), "--modulus", "G"]
NAMES = {"frequency": "w", "temperature": "T", "storage": "E1", "loss": "E2"}
SYNTHETIC = [
    *flags(NAMES, {"frequency": "rad/s", "temperature": "K", "modulus": "Pa"}),
    "--modulus",
    "E",
]


@pytest.fixture
def folder(tmp_path, monkeypatch):
    """The working directory, with synthetic isotherms in one file and their shift factors."""
    lines = ["T,w,E1,E2"]
    for isotherm in sweeps(noise=0.01, seed=2):
        columns = (isotherm.angular_frequency, isotherm.storage_modulus, isotherm.loss_modulus)
        rows = zip(*(column.tolist() for column in columns), strict=True)
        lines += [",".join(map(repr, (isotherm.temperature, *row))) for row in rows]
    (tmp_path / "dma.csv").write_text("\n".join(lines))
    table = zip(TEMPERATURES.tolist(), true_shift(TEMPERATURES).tolist(), strict=True)
    text = "\n".join(["temperature_k,log10_a_t", *(f"{t!r},{a!r}" for t, a in table)])
    (tmp_path / "shift.csv").write_text(text)
    monkeypatch.chdir(tmp_path)
    return tmp_path


def found_in(text):
    """Names and numbers that were printed."""
    pairs = [
        line.split(" = ") for line in text.splitlines() if " = " in line and "note" not in line
    ]
    return {name: float(value) for name, value in pairs}


@pytest.mark.parametrize(
    ("name", "follows", "residual"), [("material_a", True, 0.021), ("epdm_70", False, 0.135)]
)
def test_set_of_isotherms_to_a_table_that_a_scene_can_use(
    tmp_path, capsys, name, follows, residual, source
):
    file, table = present("dma", name, "tf_015p.csv"), tmp_path / "a.csv"
    assert main(["rubber", str(file), *SHEAR, "--output", str(table), "--notes", "all"]) == 0
    out, err = capsys.readouterr()
    assert out == ""
    assert ("note: the shift factors follow WLF" in err) == follows
    assert ("note: the shift factors do not follow WLF" in err) == (not follows)
    result = found_in(err)
    if source == "measured":
        assert result["wlf_residual_decades"] == pytest.approx(residual, rel=0.1)
    assert (result["wlf_residual_decades"] < 0.05) == follows
    assert result["prony_storage_residual"] < 0.03
    curve = read_master_curve(table)
    ends = result["lowest_frequency_rad_s"], result["highest_frequency_rad_s"]
    np.testing.assert_allclose(curve.angular_frequency[[0, -1]], ends, rtol=1e-5)

    scene = tmp_path / "scene.toml"
    rubber = '[rubber]\nmaster_curve = "a.csv"\n'
    conditions = CONDITIONS.replace("from = 1e-4, to = 1", "from = 1e-4, to = 1e-3")
    scene.write_text(SURFACE + rubber + conditions)
    mu = load_scene(scene).friction().mu
    assert (mu > 0.01).all()
    assert (mu < 5).all()


def test_files_of_one_temperature_each(tmp_path, capsys, source):
    files = sorted(map(str, present("dma", "reptate_pi1000k").glob("*.osc")))
    melt = [*flags(POLYISOPRENE["columns"], POLYISOPRENE["units"]), "--modulus", "G"]
    options = ["--vertical-shift", "T/T_ref", "--reference-temperature", "273.15", "--json"]
    options += ["--notes", "all"]
    assert main(["rubber", *files, *melt, *options]) == 0
    out, err = capsys.readouterr()
    assert "note: the shift factors follow WLF" in err
    result = found_in(err)
    assert result["reference_temperature_k"] == 273.15
    # by the published law B1 / (B2 + 0 C) is 6.05, less what b_T leaves to the density
    c1 = {"made": 6.05, "measured": 5.8}[source]
    assert result["wlf_c1"] == pytest.approx(c1, abs=0.1)
    assert json.loads(out)["columns"]["storage_modulus_pa"]


def test_table_of_a_synthetic_rubber(folder, capsys):
    """Its header has the isotherms, and a Prony series that a scene can take."""
    assert main(["rubber", "dma.csv", *SYNTHETIC, "--reference-temperature", "293.15"]) == 0
    out, err = capsys.readouterr()
    header = dict(
        line[2:].split(" = ", 1)
        for line in out.splitlines()
        if line.startswith("# ") and " = " in line
    )
    np.testing.assert_allclose(json.loads(header["isotherms.temperature_k"]), TEMPERATURES)
    shifts = np.array(json.loads(header["isotherms.log10_a_t"]))
    np.testing.assert_allclose(shifts, true_shift(TEMPERATURES), atol=0.06)
    assert max(json.loads(header["isotherms.standard_deviation"])) < 0.03
    assert json.loads(header["isotherms.b_t"]) == [1.0] * 22
    names = ("equilibrium_modulus_pa", "moduli_pa", "relaxation_times_s")
    series = [json.loads(header[f"prony.{name}"]) for name in names]
    prony = PronySeries(equilibrium_modulus=series[0], moduli=series[1], relaxation_times=series[2])
    result = found_in(err)
    assert result["wlf_c1"] == pytest.approx(8.86, abs=0.05)
    w = np.geomspace(result["lowest_frequency_rad_s"], result["highest_frequency_rad_s"], 100)
    assert np.abs(prony.modulus(w).real / true_modulus(w).real - 1).max() < 0.02
    assert np.abs(prony.modulus(w).imag / true_modulus(w).imag - 1).max() < 0.07


def test_shift_factors_from_a_file(folder, capsys):
    options = ["--shift", "shift.csv", "--reference-temperature", "293.15", "--json"]
    assert main(["rubber", "dma.csv", *SYNTHETIC, *options]) == 0
    result = found_in(capsys.readouterr().err)
    assert result["wlf_c1"] == pytest.approx(8.86, rel=1e-6)
    assert result["wlf_c2_k"] == pytest.approx(101.6, rel=1e-6)


def without(option):
    at = SYNTHETIC.index(option)
    return SYNTHETIC[:at] + SYNTHETIC[at + 2 :]


def replaced(old, new):
    return [text.replace(old, new) for text in SYNTHETIC]


@pytest.mark.parametrize(
    ("arguments", "named"),
    [
        (["dma.csv", *without("--units")], "--units"),
        (["dma.csv", *replaced(",modulus=Pa", "")], "--units"),
        (["dma.csv", *replaced("loss=E2", "loss=E3")], "dma.csv: no line names the columns 'E3'"),
        (["dma.csv", *replaced("T,", ",")], "--columns"),
        (["one.csv", *SYNTHETIC], "isotherms"),
        (
            ["dma.csv", *SYNTHETIC, "--reference-temperature", "400"],
            "--reference-temperature = 400",
        ),
        (["dma.csv", *SYNTHETIC, "--shift", "dma.csv"], "dma.csv"),
        (["dma.csv", *SYNTHETIC, "--output", "dma.csv"], "dma.csv: is an input"),
    ],
)
def test_refusals_are_one_line_and_status_2(folder, capsys, arguments, named):
    head = (folder / "dma.csv").read_text().splitlines()[: 1 + SWEEP.size]
    (folder / "one.csv").write_text("\n".join(head))  # one isotherm
    assert status_of(["rubber", *arguments]) == 2
    out, err = capsys.readouterr()
    assert out == ""
    (line,) = err.splitlines()
    assert named in line
    assert line.startswith("asperity")
