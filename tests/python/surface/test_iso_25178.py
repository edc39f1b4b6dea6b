"""Parameters of ISO 25178-2 by their definitions."""

import numpy as np
import pytest

from asperity import HeightMap
from asperity.cli.main import main

PIXEL = 1e-6


def test_of_a_surface_with_known_ones():
    y, x = np.mgrid[:128, :128] * 2 * np.pi / 16
    result = HeightMap(1e-6 * np.cos(x) * np.cos(y), pixel_size=PIXEL).iso_25178
    assert result["Sq"] == pytest.approx(0.5e-6, rel=1e-12, abs=0)
    assert result["Sku"] == pytest.approx(2.25, rel=1e-9)
    assert result["Sz"] == pytest.approx(2e-6, rel=1e-12, abs=0)
    assert result["Sp"] + result["Sv"] == pytest.approx(result["Sz"], rel=1e-12, abs=0)
    slope = np.sqrt(0.5) * 1e-6 * np.sin(2 * np.pi / 16) / PIXEL  # of central differences
    assert result["Sdq"] == pytest.approx(slope, rel=0.02)
    inside = 128 - 15  # two peaks in each of 64 squares, without those on the edge
    assert result["Spd"] == pytest.approx(inside / (127 * PIXEL) ** 2, rel=1e-12)


def test_the_area_of_a_tilted_plane():
    y, x = np.mgrid[:9, :7] * PIXEL
    result = HeightMap(0.3 * x + 0.4 * y, pixel_size=PIXEL).iso_25178
    assert result["Sdr"] == pytest.approx(np.sqrt(1.25) - 1, rel=1e-9)
    assert result["Spd"] == 0


def hills(z):
    """By the definition: a hill counts whose peak is 5 % of Sz above every way to a higher one."""
    label = pytest.importorskip("scipy.ndimage").label
    count = 0
    for y, x in np.ndindex(z.shape):
        if not (0 < y < z.shape[0] - 1 and 0 < x < z.shape[1] - 1):
            continue
        if z[y, x] < z[y - 1 : y + 2, x - 1 : x + 2].max():
            continue
        around = label(z > z[y, x] - 0.05 * np.ptp(z), np.ones((3, 3)))[0]
        count += z[around == around[y, x]].max() == z[y, x]
    return count


@pytest.mark.parametrize("seed", range(6))
def test_hills_are_those_that_stand_above_their_saddles(seed):
    rng = np.random.default_rng(seed)
    z = rng.normal(size=(24, 20))
    for _ in range(seed % 3):  # smoother ones too
        z = z + np.roll(z, 1, 0) + np.roll(z, 1, 1)
    z = z + 0.02 * rng.normal(size=z.shape)
    result = HeightMap(z * 1e-6, pixel_size=PIXEL).iso_25178
    assert result["Spd"] * 23 * 19 * PIXEL**2 == pytest.approx(hills(z), abs=1e-6)


def test_dropouts_leave_the_hills_out():
    z = np.random.default_rng(1).normal(size=(20, 20))
    z[3, 4] = np.nan
    result = HeightMap(z, pixel_size=1.0).iso_25178
    assert "Spd" not in result
    assert np.isfinite(list(result.values())).all()


def test_the_verb_tells_them(tmp_path, capsys):
    z = np.random.default_rng(1).normal(size=(40, 50)) * 1e-7
    np.save(f"{tmp_path}/a.npy", z)
    how = ["--pixel-size", "1e-6", "--unit", "m", "--output", f"{tmp_path}/a.csv"]
    assert main(["spectrum", f"{tmp_path}/a.npy", *how]) == 0
    told = dict(line.split(" = ") for line in capsys.readouterr().err.splitlines() if " = " in line)
    known = HeightMap(z, pixel_size=1e-6).detrend("plane").iso_25178
    assert float(told["Sq_m"]) == pytest.approx(known["Sq"], rel=1e-5, abs=0)
    assert float(told["Spd_per_m2"]) == pytest.approx(known["Spd"], rel=1e-5)
