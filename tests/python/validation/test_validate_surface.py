"""`asperity validate --surface`: theory and boundary elements on a map of one's own."""

import csv

import numpy as np
import pytest

import asperity
from asperity.cli.main import main
from asperity_scripts.validate.boundary_elements import own_contacts
from helpers.cases import long

SURFACE = asperity.SelfAffineSpectrum(rms_height=2e-5, hurst=0.8, q0=2.5e3, q1=2e4)
SIDE = 256
PIXEL = 8 * 2 * np.pi / SURFACE.q0 / SIDE  # eight longest waves along a side, 32 pixels each


@pytest.fixture(scope="module")
def scan(tmp_path_factory):
    path = tmp_path_factory.mktemp("surface") / "scan.npy"
    pixels = (SIDE, SIDE)
    np.save(path, asperity.synthesize(SURFACE, shape=pixels, pixel_size=PIXEL, seed=6).heights)
    return path


def arguments(scan, *more):
    return ["validate", "--surface", str(scan), "--pixel-size", str(PIXEL), "--unit", "m", *more]


def rows(path):
    lines = [line for line in path.read_text().splitlines() if not line.startswith("#")]
    return list(csv.DictReader(lines))


@pytest.mark.parametrize("loads", ["0.1", long("0.02,0.1,0.5")])
def test_a_run_on_a_map_of_ones_own(undrawn, scan, tmp_path, loads):
    more = ["--periodic", "--detrend", "none", "--q0", "2500", "--loads", loads]
    assert main(arguments(scan, *more, "--output", str(tmp_path / "worth"))) == 0
    table = rows(tmp_path / "worth/errors.csv")
    error = {}
    for row in table:
        error.setdefault(row["model"], []).append(float(row["contact_area_error"]))
        assert float(row["p_over_Eh"]) in [pytest.approx(float(load)) for load in loads.split(",")]
    assert len(error) == 14
    # q1 / q0 = 8: that of the shipped rows, whose worst are 30.8 and 1.7 %, and a seed's scatter
    assert -0.36 < min(error["none"]) < -0.15
    assert np.abs(error["Nayak S"]).max() < 0.05
    assert np.mean(error["shift 2"]) > 0.25


def test_the_theory_is_told_the_slope_and_energy_of_the_maps_own_modes():
    surface = asperity.synthesize(SURFACE, shape=(64, 64), pixel_size=PIXEL, seed=6)
    (full,), _ = own_contacts(surface, "map", loads=[50.0], periodic=True)
    q = 2 * np.pi * np.hypot(*np.meshgrid(*2 * [np.fft.fftfreq(64, PIXEL)]))
    power = np.abs(np.fft.fft2(surface.heights) / 64**2) ** 2
    assert full.area == 1
    assert full.spectrum.rms_slope == pytest.approx(np.sqrt(np.sum(q**2 * power)), rel=1e-9)
    assert full.pressure == pytest.approx(50 * full.spectrum.rms_slope, rel=1e-9)
    # Johnson, Contact Mechanics, sect. 13.2: a wave pressed flat holds E* q |h_q|^2 / 4 an area
    assert full.energy == pytest.approx(np.sum(q * power) / 4, rel=1e-9, abs=0)


@pytest.mark.parametrize("load", ["0", "-0.1"])
def test_loads_are_positive(scan, tmp_path, capsys, load):
    assert main(arguments(scan, f"--loads={load}", "--output", str(tmp_path / "worth"))) == 2
    assert f"--loads = {load}: must be positive" in capsys.readouterr().err


def test_without_the_wavenumber_of_the_asperities_their_models_are_left_out(
    undrawn, scan, tmp_path
):
    more = ["--periodic", "--loads", "0.5", "--output", str(tmp_path / "worth")]
    assert main(arguments(scan, *more)) == 0
    names = {row["model"] for row in rows(tmp_path / "worth/errors.csv")}
    assert "Nayak S" in names
    assert not any("IGW" in name or "peaks" in name for name in names)


def test_patches_of_few_pixels_are_said(undrawn, tmp_path, capsys):
    np.save(tmp_path / "rough.npy", np.random.default_rng(1).normal(size=(32, 32)))
    more = ["--loads", "0.02", "--output", str(tmp_path / "worth")]
    path = tmp_path / "rough.npy"
    assert (
        main(["validate", "--surface", str(path), "--pixel-size", "1", "--unit", "m", *more]) == 0
    )
    assert "note: at p* up to 0.02 the points touch in patches" in capsys.readouterr().err
