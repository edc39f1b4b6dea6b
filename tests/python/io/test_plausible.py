"""Stated units: what no rubber, road or rig has is refused or noted, and nothing else is."""

import logging
import subprocess
import sys

import numpy as np
import pytest

import asperity
from asperity.base import quantities
from asperity.cli.main import main
from asperity.demo import input_files
from asperity.io import plausible
from asperity.io.read_friction import read_friction
from asperity.scene.scene import load_scene
from helpers.measured import COLUMNS, POLYISOPRENE, UNITS, present, scans_of

ASPHALT = "rms_height_m = 265.7e-6\nhurst = 0.87\nq0_per_m = 2000\nq1_per_m = 1e6"
RUBBER = (
    "equilibrium_modulus_pa = 3e6\nmoduli_pa = [1e7, 1e8, 1e9]\n"
    "relaxation_times_s = [1e-2, 1e-4, 1e-6]"
)
CONDITIONS = "pressure_pa = 81e3\nvelocity_m_s = [1e-3, 1e-2]"
ISOTHERMS = (
    'isotherms = ["dma.csv"]\nmodulus = "E"\n'
    'columns = {frequency = "f", temperature = "T", storage = "a", loss = "b"}\n'
    'units = {frequency = "Hz", temperature = "C", modulus = "MPa"}'
)


def scene(folder, *, surface=ASPHALT, rubber=RUBBER, conditions=CONDITIONS, more=""):
    path = folder / "scene.toml"
    tables = f"[surface]\n{surface}\n[rubber]\n{rubber}\n[conditions]\n{conditions}\n{more}"
    path.write_text(tables)
    return path


def write_scan(folder, rms, *, side=128):
    """A scan of 0.64 mm with heights of this rms, in whatever unit."""
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


GEL = "equilibrium_modulus_pa = 1e3\nmoduli_pa = []\nrelaxation_times_s = []"
SILICONE = "equilibrium_modulus_pa = 5e4\nmoduli_pa = [5e4]\nrelaxation_times_s = [1e-3]"
GLASS = "equilibrium_modulus_pa = 3e9\nmoduli_pa = []\nrelaxation_times_s = []"
MELT = "equilibrium_modulus_pa = 0\nmoduli_pa = [5e5, 1e3]\nrelaxation_times_s = [1e-2, 1e15]"
# what a user may well mean: none is refused, none is noted
PLAUSIBLE = {
    "the article's asphalt and rubber": {},
    "asphalt up to atoms": {"surface": ASPHALT.replace("1e6", "1e10")},
    "sandpaper, cut where its slope says": {"surface": ASPHALT + "\nslope_cutoff = 1.3"},
    "a polished wafer": {
        "surface": "rms_height_m = 2e-10\nhurst = 0.8\nq0_per_m = 6e6\nq1_per_m = 6e9"
    },
    "a road of 3 m with cm heights": {
        "surface": "rms_height_m = 0.02\nhurst = 0.8\nq0_per_m = 2.1\nq1_per_m = 1e4"
    },
    "a gel of 1 kPa under 20 Pa": {
        "rubber": GEL,
        "conditions": "pressure_pa = 20\nvelocity_m_s = 1e-4",
    },
    "a hydrogel's shear stress": {
        "rubber": GEL,
        "conditions": "pressure_pa = 200\nvelocity_m_s = 1e-4",
        "more": "[adhesion]\nshear_stress_pa = 30",
    },
    "the softest silicone": {
        "rubber": SILICONE,
        "conditions": "pressure_pa = 50\nvelocity_m_s = 1",
    },
    "rubber as glass, at -80 C": {"rubber": GLASS},
    "a melt, which relaxes to nothing": {"rubber": MELT},
    "creep": {"conditions": "pressure_pa = 81e3\nvelocity_m_s = {from = 1e-9, to = 1, points = 3}"},
    "racing": {"conditions": "pressure_pa = 3e5\nvelocity_m_s = 100"},
    "a truck tyre, an aircraft's": {"conditions": "pressure_pa = [8e5, 2e6]\nvelocity_m_s = 60"},
    "a hydraulic seal": {"conditions": "pressure_pa = 4e7\nvelocity_m_s = 0.5"},
    "a light touch": {"conditions": "pressure_pa = 300\nvelocity_m_s = 0.5"},
    "dust": {"surface": ASPHALT + "\ncontamination_size_m = 2e-5"},
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


@pytest.mark.parametrize(
    ("pixel_size", "rms"), [(2e-9, 1e-9), (1e-7, 1e-9), (5e-6, 3e-5), (1e-3, 2e-4), (2e-2, 3e-2)]
)
@pytest.mark.usefixtures("silent")
def test_scans_from_microscopes_to_roads(tmp_path, pixel_size, rms):
    """1 um of a force microscope with nanometres, 1 m to 10 m of road with centimetres."""
    write_scan(tmp_path, rms, side=512 if pixel_size < 1e-2 else 256)
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


@pytest.mark.parametrize(
    ("given", "unit"), [(-80, "C"), (25, "C"), (250, "C"), (193.15, "K"), (523.15, "K")]
)
def test_a_rubber_from_minus_80_to_250_degrees(tmp_path, given, unit):
    (tmp_path / "a_t.csv").write_text("temperature_k,log10_a_t\n150,9\n293.15,0\n530,-6\n")
    more = f'shift = "a_t.csv"\ntemperature_{unit.lower()} = {given}\nreference_temperature_c = 20'
    loaded = load_scene(scene(tmp_path, rubber=f"{RUBBER}\n{more}"))
    assert loaded.unusual == ()
    kelvin = given + 273.15 if unit == "C" else given
    assert loaded.inputs["rubber"]["temperature_k"] == pytest.approx(kelvin)


# what is written, the key that is blamed, the unit that is guessed
ABSURD = {
    "heights in um": (
        {"surface": ASPHALT.replace("265.7e-6", "265.7")},
        ("[surface] rms_height_m", "um"),
    ),
    "heights in mm": (
        {"surface": ASPHALT.replace("265.7e-6", "0.2657")},
        ("[surface] rms slope", ""),
    ),
    "wavenumbers in 1/um": (
        {"surface": ASPHALT.replace("2000", "2e-3").replace("1e6", "1")},
        ("[surface] q1_per_m", "1/um"),
    ),
    "pressure in MPa": (
        {"conditions": CONDITIONS.replace("81e3", "0.081")},
        ("[conditions] pressure_pa", "MPa"),
    ),
    "pressure in a list": (
        {"conditions": CONDITIONS.replace("81e3", "[0.08, 0.4]")},
        ("[conditions] pressure_pa", "MPa"),
    ),
    "moduli in MPa": (
        {"rubber": RUBBER.replace("3e6", "3").replace("[1e7, 1e8, 1e9]", "[10, 100, 1000]")},
        ("[conditions] pressure_pa", "moduli in MPa"),
    ),
    "moduli in GPa": (
        {"rubber": RUBBER.replace("3e6", "3e-3").replace("[1e7, 1e8, 1e9]", "[0.01, 0.1, 1]")},
        ("[rubber] equilibrium_modulus_pa and moduli_pa together", "MPa"),
    ),
    "a modulus of 3e15": (
        {"rubber": RUBBER.replace("3e6", "3e15")},
        ("[rubber] equilibrium_modulus_pa", ""),
    ),
    "a term of 3e15": (
        {"rubber": RUBBER.replace("1e9", "3e15")},
        ("[rubber] equilibrium_modulus_pa and moduli_pa together", ""),
    ),
    "velocity in um/s": (
        {"conditions": CONDITIONS.replace("1e-2", "1e4")},
        ("[conditions] velocity_m_s", "mm/s"),
    ),
    "a pixel in um": (
        {"surface": 'file = "scan.npy"\npixel_size_m = 5\nunit = "um"'},
        ("[surface] pixel_size_m", "um"),
    ),
    "dirt in um": (
        {"surface": ASPHALT + "\ncontamination_size_m = 20"},
        ("[surface] contamination_size_m", "um"),
    ),
    "25 C as kelvin": (
        {"rubber": ISOTHERMS + "\ntemperature_k = 25"},
        ("[rubber] temperature_k", "C"),
    ),
    "-10 C as kelvin": (
        {"rubber": ISOTHERMS + "\ntemperature_k = 293\nreference_temperature_k = -10"},
        ("[rubber] reference_temperature_k", "C"),
    ),
    "adhesion in GPa": (
        {"more": "[adhesion]\nshear_stress_pa = 8.3e-3"},
        ("[adhesion] shear_stress_pa", "GPa"),
    ),
    "peaks in um": (
        {"more": "[correction]\nkind = 'local-peaks'\nz_max_m = 3e-4\nheights_m = [100, 200, 150]"},
        ("[correction] heights_m", "um"),
    ),
}


@pytest.mark.parametrize("name", ABSURD)
def test_what_is_absurd_is_refused_with_a_guess_of_the_unit(tmp_path, name):
    write_scan(tmp_path, 20.0)
    write_dma(tmp_path)
    tables, (argument, unit) = ABSURD[name]
    with pytest.raises(asperity.InvalidInput) as caught:
        load_scene(scene(tmp_path, **tables))
    error = caught.value
    assert error.code in ("absurd-value", "absurd-pressure")
    assert error.argument == argument
    assert error.allowed
    assert f"{unit}?" in str(error) or not unit


def test_the_shell_refuses_what_is_absurd_in_one_line(tmp_path, capsys):
    path = scene(tmp_path, surface=ASPHALT.replace("265.7e-6", "265.7"))
    assert main(["friction", str(path)]) == 2
    assert capsys.readouterr() == (
        "",
        f"asperity: {path}: [surface] rms_height_m = 265.7: must be at most 1 m (no road or stone "
        "is so rough); in um? 265.7 um is 0.0002657 m\n",
    )


UNUSUAL = {
    "wavenumbers in 1/mm": (
        {"surface": ASPHALT.replace("2000", "2").replace("1e6", "1000")},
        ("[surface] q1_per_m", "1/mm"),
    ),
    "pressure in bar": (
        {"conditions": CONDITIONS.replace("81e3", "2.5")},
        ("[conditions] pressure_pa", "bar"),
    ),
    "pressure in kPa": (
        {"conditions": CONDITIONS.replace("81e3", "81")},
        ("[conditions] pressure_pa", "kPa"),
    ),
    "velocity in km/h": (
        {"conditions": CONDITIONS.replace("1e-2", "200")},
        ("[conditions] velocity_m_s", "km/h"),
    ),
    "velocity in mm/s": (
        {"conditions": CONDITIONS.replace("1e-2", "1000")},
        ("[conditions] velocity_m_s", "mm/s"),
    ),
    "adhesion in MPa": (
        {"more": "[adhesion]\nshear_stress_pa = 8.3"},
        ("[adhesion] shear_stress_pa", "MPa"),
    ),
    "equilibrium modulus in MPa": (
        {"rubber": RUBBER.replace("3e6", "3")},
        ("[rubber] equilibrium_modulus_pa", "MPa"),
    ),
}


@pytest.mark.parametrize("name", UNUSUAL)
def test_what_is_unusual_is_noted_with_a_guess_of_the_unit(tmp_path, name):
    tables, (argument, unit) = UNUSUAL[name]
    notes = load_scene(scene(tmp_path, **tables)).unusual
    (note,) = [one for one in notes if one.argument == argument]
    assert (note.code, note.severity) == ("unusual-value", "warning")
    assert f"; in {unit}? " in note


def test_the_shell_notes_what_is_unusual_in_one_line_and_in_the_table(tmp_path, capsys):
    path = scene(tmp_path, conditions=CONDITIONS.replace("81e3", "81"))
    assert main(["friction", str(path), "--output", str(tmp_path / "mu.csv")]) == 0
    line = (
        f"note: {path}: [conditions] pressure_pa = 81: unusual, below 100 Pa (the weight of 1 cm "
        "of rubber); in kPa? 81 kPa is 81000 Pa\n"
    )
    assert capsys.readouterr().err.count(line) == 1
    assert (tmp_path / "mu.csv").read_text().count(f"# {line}") == 1


@pytest.mark.parametrize(
    ("options", "message"),
    [
        (["--pixel-size", "5e-6", "--unit", "m"], "--unit = 'm': rms height 17"),
        (["--pixel-size", "5", "--unit", "um"], "--pixel-size = 5: must be at most 1 m"),
        (
            ["--pixel-size", "5e-6", "--unit", "um", "--q-min", "1e-4"],
            "--q-min = 1e-4: must be at least 0.001 1/m",
        ),
    ],
)
def test_a_scan_in_another_unit_is_refused_on_the_command_line(tmp_path, capsys, options, message):
    write_scan(tmp_path, 20.0)
    assert main(["spectrum", str(tmp_path / "scan.npy"), *options]) == 2
    err = capsys.readouterr().err
    assert err.count("\n") == 1
    assert message in err


def test_a_scan_in_another_unit_is_refused_in_a_scene_and_noted_by_the_reader(tmp_path, caplog):
    write_scan(tmp_path, 20.0)
    path = scene(tmp_path, surface='file = "scan.npy"\npixel_size_m = 5e-6\nunit = "m"')
    with pytest.raises(asperity.InvalidInput, match=r"heights in um\? 17"):
        load_scene(path)
    assert caplog.messages == []
    asperity.read_surface(tmp_path / "scan.npy", pixel_size=5e-6, unit="m")
    (line,) = caplog.messages
    assert "unit = 'm': rms height 17" in line
    write_scan(tmp_path, 0.002)  # in mm
    caplog.clear()
    asperity.read_surface(tmp_path / "scan.npy", pixel_size=5e-6, unit="m")
    (line,) = caplog.messages
    assert "rms height 0.001702 m on a length of 0.00064 m: unusual" in line
    assert "heights in mm?" in line


def test_the_readers_note_is_one_line_on_stderr(tmp_path):
    write_scan(tmp_path, 20.0)
    code = "import asperity; asperity.read_surface('scan.npy', pixel_size=5e-6, unit='m')"
    run = subprocess.run(
        [sys.executable, "-c", code], cwd=tmp_path, capture_output=True, text=True, check=True
    )
    assert run.stdout == ""
    assert run.stderr.startswith("scan.npy: unit = 'm': rms height ")
    assert run.stderr.count("\n") == 1


DMA = ["--columns", "frequency=f,temperature=T,storage=a,loss=b", "--modulus", "E"]


@pytest.mark.parametrize(
    ("written", "declared", "message"),
    [
        ({"modulus": 1e6}, "MPa", "largest |E| = 3.00049e+09: must be at most"),
        ({"kelvin": 273.15 + 400}, "MPa", "temperature = 733.15: must be at most 426.85 C"),
        ({"modulus": 1e-3}, "Pa", "largest |E| = 3.00049: must be at least 100 Pa"),
    ],
)
def test_dma_in_other_units_is_refused(tmp_path, capsys, written, declared, message):
    write_dma(tmp_path, **written)
    units = f"frequency=Hz,temperature=C,modulus={declared}"
    assert main(["rubber", str(tmp_path / "dma.csv"), *DMA, "--units", units]) == 2
    err = capsys.readouterr().err
    assert err.count("\n") == 1
    assert message in err


@pytest.mark.parametrize(
    ("written", "units", "message"),
    [
        ({}, {"temperature": "K"}, "temperature = -80: must be at least 120 K"),
        (
            {"kelvin": 273.15},
            {"temperature": "C"},
            "temperature = 333.15: unusual, above 256.85 C (257 C; silicone rubber is used up to "
            "250 C); in K? 333.15 K is 60 C",
        ),
        ({}, {"modulus": "GPa"}, "largest |E| = 3000.49: must be at most 100 GPa"),
    ],
)
def test_the_reader_of_isotherms_notes_it(tmp_path, caplog, written, units, message):
    write_dma(tmp_path, **written)
    columns = {"frequency": "f", "temperature": "T", "storage": "a", "loss": "b"}
    units = {"frequency": "Hz", "temperature": "C", "modulus": "MPa", **units}
    try:
        asperity.read_isotherms(tmp_path / "dma.csv", columns=columns, units=units, modulus="E")
    except asperity.InvalidInput:
        assert units["temperature"] == "K"  # -80 K is impossible, not only implausible
    assert any(message in line for line in caplog.messages), caplog.messages


def test_master_curve_and_measured_friction_in_other_units(tmp_path):
    header = "angular_frequency_rad_s,storage_modulus_pa,loss_modulus_pa\n"
    (tmp_path / "curve.csv").write_text(header + "1,3e-3,1e-3\n1e3,0.03,0.01\n1e6,1.0,0.1\n")
    with pytest.raises(asperity.InvalidInput, match=r"curve\.csv: largest \|E\| = 1\.00.*in MPa\?"):
        load_scene(scene(tmp_path, rubber='master_curve = "curve.csv"'))
    (tmp_path / "test.csv").write_text("velocity_m_s,mu,pressure_mpa\n0.1,1.1,81e3\n0.2,1.2,81e3\n")
    with (
        plausible.collected(),
        pytest.raises(
            asperity.InvalidInput, match=r"pressure_mpa = 81000: must be at most 1000 MPa"
        ),
    ):
        read_friction(tmp_path / "test.csv")


@pytest.mark.parametrize(
    ("options", "message"),
    [
        (["--pressure", "0.01,0.1"], "--pressure = 0.01: must be at least 0.1 Pa"),
        (["--velocity", "1,1e5"], "--velocity = 1e5: must be at most 1500 m/s"),
        (["--pressure", "1e4,1e11"], "--pressure = 1e11: must be at most 1e+09 Pa"),
    ],
)
def test_sides_of_a_map(tmp_path, capsys, options, message):
    assert main(["map", str(scene(tmp_path)), *options]) == 2
    assert capsys.readouterr().err.startswith(f"asperity: {message}")


class TestTemperature:
    def test_celsius_and_kelvin_are_the_same_rubber(self, tmp_path):
        write_dma(tmp_path)
        w = np.geomspace(1, 100, 5)
        found = [
            load_scene(scene(tmp_path, rubber=f"{ISOTHERMS}\n{keys}")).rubber.modulus(w)
            for keys in ("temperature_c = 25", "temperature_k = 298.15")
        ]
        np.testing.assert_array_equal(*found)

    @pytest.mark.parametrize(
        ("keys", "message"),
        [
            ("", "temperature_k: missing; add temperature_k or temperature_c"),
            (
                "temperature_c = 25\ntemperature_k = 298.15",
                "temperature_c: must be left out where temperature_k is given",
            ),
            (
                "temperature_c = 25\nreference_temperature_c = 20\nreference_temperature_k = 293",
                "reference_temperature_c: must be left out where reference_temperature_k is given",
            ),
            ("temperature_c = 25\nmoduli_pa = []", "moduli_pa: must be left out where isotherms"),
            (
                "temperature_c = 25\nprony = 1",
                "prony = 1: must be true or false",
            ),
            ("temperature_c = 725", "temperature_c = 725: must be at most 426.85 C (427 C; rubber"),
            ("temperature_c = -200", "temperature_c = -200: must be at least -153.15 C"),
        ],
    )
    def test_refused(self, tmp_path, keys, message):
        write_dma(tmp_path)
        path = scene(tmp_path, rubber=f"{ISOTHERMS}\n{keys}")
        with pytest.raises(asperity.InvalidInput) as error:
            load_scene(path)
        assert str(error.value).startswith(f"{path}: [rubber] {message}")

    def test_a_temperature_without_a_shift_is_refused_by_its_own_key(self, tmp_path):
        path = scene(tmp_path, rubber=f"{RUBBER}\ntemperature_c = 25")
        with pytest.raises(asperity.InvalidInput, match="temperature_c: needs shift"):
            load_scene(path)

    def test_kelvin_given_as_celsius_is_noted(self, tmp_path):
        write_dma(tmp_path)
        more = "\ntemperature_c = 298.15\nreference_temperature_c = 25"
        with pytest.raises(asperity.Error) as error:  # no isotherm is so hot
            load_scene(scene(tmp_path, rubber=ISOTHERMS + more))
        said = str(error.value)
        assert "[rubber] temperature_c = 298.15: " in said
        assert "temperature_c = 298.15: unusual, above 256.85 C" in said
        assert said.endswith("in K? 298.15 K is 25 C")

    def test_a_unit_is_offered_only_where_the_number_is_likely_in_it(self):
        with plausible.collected(), pytest.raises(asperity.InvalidInput) as error:
            plausible.check("temperature", -300, quantities.TEMPERATURE, "C")
        assert str(error.value).endswith("no DMA cools so far)")


def test_every_limit_has_its_reason():
    found = {name: q for name, q in vars(quantities).items() if isinstance(q, quantities.Quantity)}
    assert len(found) > 12
    for name, quantity in found.items():
        least, most = quantity.least.value, quantity.most.value
        low = least if quantity.low is None else quantity.low.value
        high = most if quantity.high is None else quantity.high.value
        assert least <= low < high <= most, name
        limits = (quantity.least, quantity.low, quantity.high, quantity.most)
        assert all(limit.reason for limit in limits if limit is not None and limit.value > 0), name


def test_the_library_takes_any_consistent_units(caplog):
    """Lengths, moduli and loads of order 1, as exact contacts have them."""
    road = asperity.SelfAffineSpectrum(rms_height=1.0, hurst=0.8, q0=1.0, q1=100.0)
    rubber = asperity.PronySeries(equilibrium_modulus=1.0, moduli=[10.0], relaxation_times=[1.0])
    assert asperity.friction(road, rubber, pressure=0.01, velocity=1.0).mu > 0
    asperity.HeightMap(np.arange(12.0).reshape(3, 4), pixel_size=1e-6)
    assert caplog.messages == []
