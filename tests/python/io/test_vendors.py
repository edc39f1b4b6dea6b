"""DMA in the layouts of three vendors' programs, and temperature ramps."""

from typing import Any

import numpy as np
import pytest

import asperity
from asperity import InvalidInput, read_isotherms
from asperity.io import plausible
from asperity.scene.scene import load_scene
from helpers.rubbers import prony
from helpers.scenes import CONDITIONS, SURFACE

RUBBER = prony(3e6, 10 ** np.linspace(6, 9, 16) / 3, 10 ** np.linspace(2, -8, 16))
LAW = asperity.WLF(c1=10.0, c2=80.0, reference_temperature=293.15)
HERTZ = np.geomspace(0.1, 50, 9)
CELSIUS = (0, 10, 20, 30)


def modulus(hertz, celsius):
    a_t = 10 ** LAW.log10_a_T(celsius + 273.15)
    return complex(RUBBER.modulus(2 * np.pi * hertz * a_t))


def read(path, **given):
    units = {"frequency": "Hz", "temperature": "C", "modulus": "MPa", **given.pop("units", {})}
    return read_isotherms(path, units=units, modulus="E", **given)


def check(isotherms, factor=1):
    kelvin = [one.temperature for one in isotherms]
    np.testing.assert_allclose(kelvin, np.add(CELSIUS, 273.15), rtol=1e-12)
    for one, celsius in zip(isotherms, CELSIUS, strict=True):
        e = factor * np.array([modulus(f, celsius) for f in HERTZ])
        np.testing.assert_allclose(one.angular_frequency, 2 * np.pi * HERTZ, rtol=1e-6)
        np.testing.assert_allclose(one.storage_modulus, e.real, rtol=1e-4)
        np.testing.assert_allclose(one.loss_modulus, e.imag, rtol=1e-4)


def trios(mark):
    """Facts in pairs, then a block for each step of the test: a strain sweep, ramps, sweeps."""
    lines = [mark.join(pair) for pair in (("Filename", "tread"), ("Operator", "N. N."))]
    names = ["Angular frequency", "Temperature", "Storage modulus", "Loss modulus", "Tan(delta)"]
    units = ["rad/s", "°C", "MPa", "MPa", ""]
    lines += [
        "[Procedure]",
        "",
        "[step]",
        "Amplitude sweep - 1",
        mark.join(names),
        mark.join(units),
    ]
    w = 2 * np.pi
    for strain in range(6):
        lines.append(mark.join([f"{w}", "20.01", f"{9 - strain}", "1", "0.1"]))
    lines += ["", "[step]", "Conditioning - 2", mark.join(["Time", "Axial force"]), f"s{mark}N"]
    lines += [f"1{mark}2", f"2{mark}3"]
    for step, celsius in enumerate(CELSIUS):
        lines += ["", "[step]", f"Frequency sweep - {step + 3}", mark.join(names), mark.join(units)]
        for f in HERTZ:
            e = modulus(f, celsius) / 1e6
            cells = [w * f, celsius, e.real, e.imag, e.imag / e.real]
            lines.append(mark.join(f"{cell:.7g}" for cell in cells))
    return "\n".join(lines)


@pytest.mark.parametrize("mark", ["\t", ","])
def test_steps_of_trios(tmp_path, mark):
    (tmp_path / "a.txt").write_text(trios(mark), encoding="utf-8")
    columns = {"frequency": "Angular frequency", "temperature": "Temperature"}
    columns |= {"storage": "Storage modulus", "loss": "Loss modulus"}
    with plausible.collected() as notes:
        check(read(tmp_path / "a.txt", columns=columns, units={"frequency": "rad/s"}))
    assert [note.code for note in notes] == ["rows-left-out"] * 2
    with pytest.raises(InvalidInput, match="frequency = 'Hz': must be 'rad/s'"):
        read(tmp_path / "a.txt", columns=columns)


def test_intervals_of_rheocompass(tmp_path):
    """UTF-16, decimal commas, units two lines below the names, rows that begin with a tab."""
    lines = ["Project:\ttread", "", "Interval and data points:\t5"]
    names = ["Interval data:", "Point No.", "Frequency", "Shear Rate", "Storage Modulus"]
    names += ["Loss Modulus", "Temperature", "Status"]
    units = ["", "", "[Hz]", "[1/s]", "[MPa]", "[MPa]", "[°C]", ""]
    flow = ["", "1", "", "300", "", "", "21,5", "Dy_auto"]
    lines += ["\t".join(names), "\t\t\t\tSinusoidal\tSinusoidal\t\t", "\t".join(units)]
    lines += ["\t".join(flow)] * 3
    for celsius in CELSIUS:
        lines += ["", "\t".join(names), "\t\t\t\tSinusoidal\t\t\t", "\t".join(units)]
        for at, f in enumerate(HERTZ):
            e = modulus(f, celsius) / 1e6
            cells = [
                "",
                f"{at + 1}",
                f"{f:.8g}",
                "",
                f"{e.real:.8g}",
                f"{e.imag:.8g}",
                f"{celsius}",
            ]
            lines.append("\t".join([*cells, "DSO"]).replace(".", ","))
    (tmp_path / "a.csv").write_bytes("\r\n".join(lines).encode("utf-16"))
    columns = {"frequency": "Frequency", "temperature": "Temperature"}
    columns |= {"storage": "Storage Modulus", "loss": "Loss Modulus"}
    check(read(tmp_path / "a.csv", columns=columns))


def test_sheets_of_eplexor(tmp_path):
    """A sheet of shifts, one of data with a line of units, one of settings."""
    book = pytest.importorskip("xlwt").Workbook()
    data = [["Nr", "f", "T", "E'", "E''"], ["", "Hz", "°C", "MPa", "MPa"]]
    for celsius in CELSIUS:
        for f in HERTZ:
            e = modulus(f, celsius) / 1e6
            data.append([len(data) - 1, f, celsius, e.real, e.imag])
    shifts = [["Ref.Temp.", "20.0 °C"], ["Temp.", "Shift"], [30.0, -1.2], [20.0, 0.0], [0.0, 3.0]]
    settings = [["Measurement type:", "Temp. Freq. Sweep"], ["Values:", 0.1]]
    for name, rows in (("Shiftlist", shifts), ("Exported Data", data), ("Header", settings)):
        sheet = book.add_sheet(name)
        for y, row in enumerate(rows):
            for x, cell in enumerate(row):
                sheet.write(y, x, cell)
    book.save(str(tmp_path / "a.xls"))
    columns = {"frequency": "f", "temperature": "T", "storage": "E'", "loss": "E''"}
    check(read(tmp_path / "a.xls", columns=columns))
    result = asperity.read_shift_factors(tmp_path / "a.xls", reference_temperature=293.15)
    np.testing.assert_array_equal(result.log10_a_T, [3, 0, -1.2])


COLUMNS = {"frequency": "f", "temperature": "T", "storage": "E1", "loss": "E2"}


def ramp(path, hertz, noise, coldest=-20):
    rng = np.random.default_rng(1)
    rows = []
    for at, celsius in enumerate(np.arange(coldest, 50, 0.25)):
        f = hertz[at % len(hertz)]
        e = modulus(f, celsius) / 1e6
        a, b = np.exp(noise * rng.normal(size=2))
        rows.append(f"{f},{celsius},{e.real * a},{e.imag * b}")
    path.write_text("\n".join(["f,T,E1,E2", *rows]))
    return path


@pytest.mark.parametrize(
    "hertz", [(0.5, 1, 2, 5, 10, 20), (1, 3, 10, 30), (0.1, 1, 10, 100), (1, 10, 100), (10, 1)]
)
def test_a_ramp_at_several_frequencies_is_shifted(tmp_path, hertz):
    isotherms = read(ramp(tmp_path / "a.csv", hertz, 0.01), columns=COLUMNS)
    build = asperity.build_master_curve(isotherms, reference_temperature=293.15)
    off = build.log10_a_T - LAW.log10_a_T(build.temperature)
    assert np.abs(off).max() < 0.08
    w = np.geomspace(0.1, 1e7, 40)
    np.testing.assert_allclose(build.master_curve.modulus(w), RUBBER.modulus(w), rtol=0.05)


def test_a_glass_that_tells_no_shift_is_cut_off(tmp_path):
    path = ramp(tmp_path / "a.csv", (10, 1), 0.01, coldest=-50)
    with plausible.collected() as notes:
        isotherms = read(path, columns=COLUMNS)
    assert [note.code for note in notes] == ["ramp-cut"]
    assert isotherms[0].temperature > 243
    build = asperity.build_master_curve(isotherms, reference_temperature=293.15)
    off = build.log10_a_T - LAW.log10_a_T(build.temperature)
    assert np.abs(off).max() < 0.08


def test_a_ramp_at_one_frequency_is_named_as_one(tmp_path):
    with pytest.raises(InvalidInput, match="is a temperature ramp at 10 Hz alone") as caught:
        read(ramp(tmp_path / "a.csv", (10.0,), 0.01), columns=COLUMNS)
    assert caught.value.code == "temperature-ramp"


SCENE = """
[rubber]
master_curve = "a.csv"
columns = {frequency = "f", temperature = "T", storage = "E1", loss = "E2"}
units = {frequency = "Hz", temperature = "C", modulus = "MPa"}
modulus = "E"
wlf_c1 = 10
wlf_c2_k = 80
reference_temperature_c = 20
temperature_c = 30
"""


@pytest.mark.parametrize("hertz", [(10.0,), (1, 10, 100)])
def test_a_ramp_whose_shift_is_known_is_a_master_curve(tmp_path, hertz):
    ramp(tmp_path / "a.csv", hertz, 0.01)
    units = {"frequency": "Hz", "temperature": "C", "modulus": "MPa"}
    how: dict[str, Any] = {"columns": COLUMNS, "units": units, "modulus": "E"}
    curve = asperity.read_master_curve(tmp_path / "a.csv", shift=LAW, **how)
    w = np.geomspace(1, 1e8, 40)
    np.testing.assert_allclose(curve.modulus(w), RUBBER.modulus(w), rtol=0.06)
    (tmp_path / "scene.toml").write_text(SURFACE + SCENE + CONDITIONS)
    shifted = load_scene(tmp_path / "scene.toml").rubber
    a_t = 10 ** LAW.log10_a_T(303.15)
    np.testing.assert_allclose(shifted.modulus(1e2), RUBBER.modulus(1e2 * a_t), rtol=0.06)
    with pytest.raises(InvalidInput, match="'temperature' is unknown without shift"):
        asperity.read_master_curve(tmp_path / "a.csv", **how)
