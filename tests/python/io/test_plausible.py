"""Stated units: what no rubber, road or rig has is refused or noted, and nothing else is."""

import logging
import re

import numpy as np
import pytest

import asperity
from asperity.demo import input_files
from asperity.scene.scene import load_scene
from helpers.measured import COLUMNS, POLYISOPRENE, UNITS, present, scans_of

ASPHALT = "rms_height_m = 265.7e-6\nhurst = 0.87\nq0_per_m = 2000\nq1_per_m = 1e6\n"
RUBBER = (
    "equilibrium_modulus_pa = 3e6\nmoduli_pa = [1e7, 1e8, 1e9]\n"
    "relaxation_times_s = [1e-2, 1e-4, 1e-6]\n"
)
CONDITIONS = "pressure_pa = 81e3\nvelocity_m_s = [1e-3, 1e-2]\n"
SCANNED = 'file = "scan.npy"\npixel_size_m = 5e-6\nunit = "um"\n'
ISOTHERMS = (
    'isotherms = ["dma.csv"]\nmodulus = "E"\n'
    'columns = {frequency = "f", temperature = "T", storage = "a", loss = "b"}\n'
    'units = {frequency = "Hz", temperature = "C", modulus = "MPa"}\n'
)


def scene(folder, *, surface=ASPHALT, rubber=RUBBER, conditions=CONDITIONS, more=""):
    path = folder / "scene.toml"
    tables = f"[surface]\n{surface}\n[rubber]\n{rubber}\n[conditions]\n{conditions}\n{more}"
    path.write_text(tables)
    return path


@pytest.fixture
def measured(tmp_path):
    """A folder with a scan of 0.64 mm in um, and isotherms of rubber in MPa and C."""
    write_scan(tmp_path, 20.0)
    write_dma(tmp_path)
    return tmp_path


def write_scan(folder, rms, *, side=128):
    """A scan of 5 um a pixel with heights of this rms, in whatever unit."""
    spectrum = asperity.SelfAffineSpectrum(rms_height=1.0, hurst=0.8, q0=1e4, q1=6e5)
    heights = asperity.synthesize(spectrum, shape=(side, side), pixel_size=5e-6, seed=1).heights
    np.save(folder / "scan.npy", rms * heights)


def write_dma(folder, *, modulus=1.0, kelvin=0.0):
    """Isotherms of rubber in MPa and C, or in units `modulus` times smaller."""
    lines = ["f,T,a,b"]
    for celsius in range(-80, 61, 10):
        for hertz in (0.1, 1.0, 10.0, 100.0):
            glassy = 1 / (1 + np.exp((celsius - 10 * np.log10(hertz) + 30) / 8))
            storage, loss = 3 * 1000**glassy, 3 * 1000**glassy * (0.05 + glassy * (1 - glassy))
            lines.append(f"{hertz},{celsius + kelvin},{modulus * storage},{modulus * loss}")
    (folder / "dma.csv").write_text("\n".join(lines))


def prony(equilibrium, moduli="", times=""):
    return (
        f"equilibrium_modulus_pa = {equilibrium}\nmoduli_pa = [{moduli}]\n"
        f"relaxation_times_s = [{times}]\n"
    )


def law(rms, q0, q1):
    return f"rms_height_m = {rms}\nhurst = 0.8\nq0_per_m = {q0}\nq1_per_m = {q1}\n"


def slid(pressure, velocity):
    return f"pressure_pa = {pressure}\nvelocity_m_s = {velocity}\n"


# what a user may well mean: none is refused, none is noted
PLAUSIBLE = {
    "the article's asphalt and rubber": {},
    "asphalt up to atoms": {"surface": ASPHALT.replace("1e6", "1e10")},
    "dust": {"surface": ASPHALT + "contamination_size_m = 2e-5"},
    "a polished wafer": {"surface": law(2e-10, 6e6, 6e9)},
    "a road of 3 m with cm heights": {"surface": law(0.02, 2.1, 1e4)},
    "a hydrogel's shear stress": {
        "rubber": prony(1e4),
        "conditions": slid(200, 1e-4),
        "more": "[adhesion]\nshear_stress_pa = 30",
    },
    "rubber as glass, at -80 C": {"rubber": prony(3e9)},
    "a melt, which relaxes to nothing": {"rubber": prony(0, "5e5, 1e3", "1e-2, 1e15")},
    "creep": {"conditions": slid(81e3, "{from = 1e-9, to = 1, points = 3}")},
    "a hydraulic seal": {"conditions": slid(4e7, 0.5)},
}


@pytest.mark.parametrize("name", PLAUSIBLE)
def test_what_is_plausible_goes_through_without_a_word(tmp_path, name):
    assert load_scene(scene(tmp_path, **PLAUSIBLE[name])).unusual == ()


def test_the_demo_goes_through_without_a_word(tmp_path):
    for name, content in input_files().items():
        (tmp_path / name).write_bytes(content)
    assert load_scene(tmp_path / "scene.toml").unusual == ()


@pytest.fixture
def silent(caplog):
    """Nothing is noted by a reader that Python calls."""
    caplog.set_level(logging.INFO, "asperity")
    yield
    assert caplog.messages == []


@pytest.mark.parametrize(("pixel_size", "rms"), [(2e-9, 1e-9), (5e-6, 3e-5), (2e-2, 3e-2)])
@pytest.mark.usefixtures("silent")
def test_scans_from_microscopes_to_roads(tmp_path, pixel_size, rms):
    """1 um of a force microscope with nanometres, 1 m to 10 m of road with centimetres."""
    write_scan(tmp_path, rms, side=256)
    for unit, factor in (("m", 1.0), ("um", 1e6), ("nm", 1e9)):
        np.save(tmp_path / "in.npy", factor * np.load(tmp_path / "scan.npy"))
        asperity.read_surface(tmp_path / "in.npy", pixel_size=pixel_size, unit=unit)


@pytest.mark.parametrize(
    ("source", "name"), scans_of(["opd-1.opd", "al3d-1.al3d", "frt-2.frt", "dektak-1.csv"])
)
@pytest.mark.usefixtures("silent")
def test_scans_of_instruments(source, name, file_of):
    asperity.read_surface(file_of(source, name))


@pytest.mark.usefixtures("silent", "source")
def test_sweeps_of_instruments():
    for name in ("epdm_70", "material_a"):
        frequency = {"columns": COLUMNS, "units": UNITS, "modulus": "G"}
        asperity.read_isotherms(present("dma", name, "tf_015p.csv"), **frequency)
        strain = {**frequency, "columns": {**COLUMNS, "strain": "strain_dyn_pct"}}
        strain["units"] = {**UNITS, "strain": "%"}
        for file in ("sd_10hz.csv", "sd_100hz.csv"):
            asperity.read_strain_sweep(present("dma", name, file), **strain)
    files = sorted(present("dma", "reptate_pi1000k").glob("*.osc"))
    asperity.read_isotherms(files, **POLYISOPRENE)


@pytest.mark.parametrize(("given", "unit"), [(-80, "c"), (523.15, "k")])
def test_a_rubber_from_minus_80_to_250_degrees(tmp_path, given, unit):
    (tmp_path / "a_t.csv").write_text("temperature_k,log10_a_t\n150,9\n293.15,0\n530,-6\n")
    more = f'shift = "a_t.csv"\ntemperature_{unit} = {given}\nreference_temperature_c = 20'
    loaded = load_scene(scene(tmp_path, rubber=RUBBER + more))
    assert loaded.unusual == ()
    kelvin = given + 273.15 if unit == "c" else given
    assert loaded.inputs["rubber"]["temperature_k"] == pytest.approx(kelvin)


PEAKS = "[correction]\nkind = 'local-peaks'\nz_max_m = 3e-4\nheights_m = [100, 200, 150]"
# the table that is changed, how, the key that is blamed, the unit that is guessed
ABSURD = [
    ("surface", ("265.7e-6", "265.7"), "[surface] rms_height_m", "um"),
    ("surface", ("265.7e-6", "0.2657"), "[surface] rms slope", ""),
    ("surface", (ASPHALT, SCANNED.replace("5e-6", "5")), "[surface] pixel_size_m", "um"),
    ("surface", (ASPHALT, SCANNED.replace('"um"', '"m"')), "[surface] unit", "um"),
    ("surface", ("1e6", "1e6\ncontamination_size_m = 20"), "[surface] contamination_size_m", "um"),
    ("conditions", ("81e3", "0.081"), "[conditions] pressure_pa", "MPa"),
    ("conditions", ("1e-2", "1e4"), "[conditions] velocity_m_s", "mm/s"),
    (
        "rubber",
        (RUBBER, prony(3, "10, 100, 1000", "1e-2, 1e-4, 1e-6")),
        "[conditions] pressure_pa",
        "moduli in MPa",
    ),
    ("rubber", ("3e6", "3e15"), "[rubber] equilibrium_modulus_pa", ""),
    ("rubber", (RUBBER, ISOTHERMS + "temperature_k = 25"), "[rubber] temperature_k", "C"),
    ("rubber", (RUBBER, ISOTHERMS + "temperature_c = -200"), "[rubber] temperature_c", ""),
    ("more", ("", "[adhesion]\nshear_stress_pa = 8.3e-3"), "[adhesion] shear_stress_pa", "GPa"),
    ("more", ("", PEAKS), "[correction] heights_m", "um"),
]
UNUSUAL = [
    ("surface", (ASPHALT, law(265.7e-6, 2, 1000)), "[surface] q1_per_m", "1/mm"),
    ("conditions", ("81e3", "81"), "[conditions] pressure_pa", "kPa"),
    ("conditions", ("1e-2", "200"), "[conditions] velocity_m_s", "km/h"),
    ("more", ("", "[adhesion]\nshear_stress_pa = 8.3"), "[adhesion] shear_stress_pa", "MPa"),
    ("rubber", ("3e6", "3"), "[rubber] equilibrium_modulus_pa", "MPa"),
]
TABLES = {"surface": ASPHALT, "rubber": RUBBER, "conditions": CONDITIONS, "more": ""}


def changed(folder, table, change):
    assert change[0] in TABLES[table]
    return scene(folder, **{table: TABLES[table].replace(*change, 1)})


@pytest.mark.parametrize(("table", "change", "argument", "unit"), ABSURD)
def test_what_is_absurd_is_refused_with_a_guess_of_the_unit(
    measured, table, change, argument, unit
):
    with pytest.raises(asperity.InvalidInput) as caught:
        load_scene(changed(measured, table, change))
    error = caught.value
    assert error.code in ("absurd-value", "absurd-pressure", "absurd-heights")
    assert error.argument == argument
    assert error.allowed
    assert f"{unit}?" in str(error) or not unit


@pytest.mark.parametrize(("table", "change", "argument", "unit"), UNUSUAL)
def test_what_is_unusual_is_noted_with_a_guess_of_the_unit(tmp_path, table, change, argument, unit):
    notes = load_scene(changed(tmp_path, table, change)).unusual
    (note,) = [one for one in notes if one.argument == argument]
    assert (note.code, note.severity) == ("unusual-value", "warning")
    assert f"; in {unit}? " in note


DMA = ["rubber", "dma.csv", "--columns", "frequency=f,temperature=T,storage=a,loss=b"]
DMA += ["--modulus", "E", "--units"]


@pytest.mark.parametrize("rms", [20.0, 0.002])  # in um, and in mm
def test_the_reader_of_scans_notes_it(tmp_path, caplog, rms):
    write_scan(tmp_path, rms)
    asperity.read_surface(tmp_path / "scan.npy", pixel_size=5e-6, unit="m")
    (line,) = caplog.messages
    assert f"heights in {'um' if rms > 1 else 'mm'}?" in line


@pytest.mark.parametrize(
    ("written", "units", "message"),
    [
        ({"kelvin": 273.15}, {}, "temperature = 333.15: unusual"),
        ({"kelvin": 273.15 + 400}, {}, "temperature = 733.15: must be at most"),
        ({}, {"modulus": "GPa"}, "largest |E| = 3000.49: must be at most"),
        ({"modulus": 1e-3}, {"modulus": "Pa"}, "largest |E| = 3.00049: must be at least"),
    ],
)
def test_the_reader_of_isotherms_notes_it(tmp_path, caplog, written, units, message):
    write_dma(tmp_path, **written)
    columns = {"frequency": "f", "temperature": "T", "storage": "a", "loss": "b"}
    units = {"frequency": "Hz", "temperature": "C", "modulus": "MPa", **units}
    asperity.read_isotherms(tmp_path / "dma.csv", columns=columns, units=units, modulus="E")
    assert any(message in line for line in caplog.messages), caplog.messages


ROAD = {"rms_height": 1e-4, "hurst": 0.8, "q0": 2e3, "q1": 3e4}
MODULI = np.array([3e6, 1e8])
CALLS = {  # factors of heights, wavenumbers, moduli and pressure, and what the note is about
    "as it should be": (1, 1, 1, 1, None),
    "heights in m that are in um": (1e-6, 1, 1, 1, "rms_slope"),
    "moduli and pressure in MPa": (1, 1, 1e-6, 1e-6, "largest modulus"),
    "moduli in MPa": (1, 1, 1e-6, 1, "largest modulus"),
}


@pytest.mark.parametrize("name", CALLS)
def test_python_notes_what_a_scene_refuses(name):
    height, wave, modulus, load, about = CALLS[name]
    road = asperity.SelfAffineSpectrum(
        rms_height=height * ROAD["rms_height"],
        hurst=ROAD["hurst"],
        q0=wave * ROAD["q0"],
        q1=wave * ROAD["q1"],
    )
    equilibrium, *moduli = modulus * MODULI
    rubber = asperity.PronySeries(
        equilibrium_modulus=equilibrium, moduli=moduli, relaxation_times=[1e-4]
    )
    result = asperity.friction(road, rubber, pressure=load * 1e5, velocity=[1e-3, 1e-2])
    notes = [note for note in result.notes if note.next_step.startswith("check the units: ")]
    assert [note.argument for note in notes] == ([] if about is None else [about])
    small = [note for note in result.notes if note.code == "small-friction"]
    assert [note.value for note in small] == [result.mu.max()] * bool(result.mu.max() < 1e-4)


def test_a_slope_that_is_not_reached_says_what_serves(tmp_path):
    road = asperity.SelfAffineSpectrum(rms_height=5e-5, hurst=0.7, q0=3e3, q1=1e5)
    scan = asperity.synthesize(road, shape=(256, 256), pixel_size=2e-5, seed=1)
    np.save(tmp_path / "scan.npy", scan.heights)
    file = 'file = "scan.npy"\npixel_size_m = 2e-5\nunit = "m"\n'
    made = load_scene(scene(tmp_path, surface=f"{file}slope_cutoff = 1.3"))
    (note,) = [one for one in made.notes if one.code == "slope-not-reached"]
    (end,) = re.findall(r"q1_per_m = ([\d.e+]+)", note.next_step)
    by_law = load_scene(scene(tmp_path, surface=f'{file}fit = "self-affine"\nq1_per_m = {end}'))
    assert by_law.spectrum.rms_slope == pytest.approx(1.3, rel=0.01)
