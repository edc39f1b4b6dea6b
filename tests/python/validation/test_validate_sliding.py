"""`asperity validate --sliding`: the theory against exact sliding contact, by the shell."""

import csv

import numpy as np
import pytest

import asperity
from asperity.cli.main import main
from asperity.validation import slide
from asperity_scripts.validate.compared import compare
from asperity_scripts.validate.sliding import own_map

SURFACE = asperity.SelfAffineSpectrum(rms_height=2e-5, hurst=0.8, q0=2.5e3, q1=1.5e4)
PIXEL = 4 * 2 * np.pi / SURFACE.q0 / 64
SOLID = asperity.PronySeries(equilibrium_modulus=1e6, moduli=[9e6], relaxation_times=[1e-3])
MAP = asperity.synthesize(SURFACE, shape=(64, 64), pixel_size=PIXEL, seed=6)


def rows(path):
    lines = [line for line in path.read_text().splitlines() if not line.startswith("#")]
    return list(csv.DictReader(lines))


def test_exact_figures_are_those_of_slide_and_predicted_ones_those_of_friction():
    result = compare(MAP, SOLID, pressure=[5e4, 2e5], velocity=[0.01, 0.1, 1.0], periodic=True)
    assert result.hysteresis.shape == (2, 3)
    one = slide(MAP, SOLID, pressure=2e5, velocity=0.1, periodic=True)
    assert result.hysteresis[1, 1] == pytest.approx(one.hysteresis, rel=1e-12)
    assert result.area[1, 1] == pytest.approx(one.contact_area, rel=1e-12)
    # full modes of the map: where contact is complete the theory without correction is exact but
    # for directions, of which a map has few
    heavy = compare(MAP, SOLID, pressure=[1e8], velocity=[0.1], periodic=True)
    assert heavy.area == pytest.approx(1)
    mu, area = heavy.predicted["none"]
    assert area == pytest.approx(1, abs=1e-6)
    assert mu == pytest.approx(heavy.hysteresis, rel=0.12)


def test_a_map_and_a_rubber_of_ones_own(undrawn, tmp_path, capsys):
    np.save(tmp_path / "scan.npy", MAP.heights)
    assert main(["demo", "--output", str(tmp_path / "demo")]) == 0
    command = ["validate", "--sliding", "--surface", str(tmp_path / "scan.npy"), "--unit", "m"]
    command += ["--pixel-size", str(PIXEL), "--rubber", str(tmp_path / "demo/scene.toml")]
    command += ["--velocities", "1e-3,0.1", "--output", str(tmp_path / "worth")]
    assert main(command) == 0
    told = capsys.readouterr()
    assert "note: the map was made periodic: its end is blended" in told.err
    assert "| Nayak S |" in told.out
    table = rows(tmp_path / "worth/sliding.csv")
    assert [float(row["velocity_m_s"]) for row in table] == [1e-3, 0.1]
    for row in table:
        assert 0 < float(row["contact_area_exact"]) < 1
        assert float(row["hysteresis_exact"]) > 0
        assert float(row["hysteresis, none"]) > 0
    assert (tmp_path / "worth/sliding.png").read_bytes() == b"picture"


def test_the_picture_has_exact_marks_and_predicted_lines(tmp_path):
    pytest.importorskip("matplotlib")
    result = compare(MAP, SOLID, pressure=[5e4], velocity=[0.1, 1.0], periodic=True)
    assert result.figure(tmp_path / "x.png").startswith(b"\x89PNG")


def test_the_map_where_none_is_given_holds_its_waves():
    # 4 to 32 waves along a side of 256 points
    assert own_map().heights.shape == (256, 256)
    assert own_map().rms_height == pytest.approx(265.7e-6, rel=0.1)
