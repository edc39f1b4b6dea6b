"""`asperity spectrum --tiles`: .npy files and Zarr arrays that need not fit in memory."""

from pathlib import Path

import numpy as np
import pytest

import asperity
from asperity.cli.main import main
from helpers.known_surfaces import law, surface

PIXEL = 1e-6
READ = ["--pixel-size", str(PIXEL), "--unit", "um"]
HEIGHTS = surface(law(0.8, rolloff=1e5), (600, 700), PIXEL, 1, dtype=np.float32) * 1e6


def result(capsys, *arguments):
    assert main(["spectrum", *arguments]) == 0
    pairs = [line.split(" = ") for line in capsys.readouterr().err.splitlines() if " = " in line]
    return {name: float(value) for name, value in pairs if name.isidentifier()}


def test_a_file_and_an_array_give_what_python_does(folder, capsys, undrawn):
    zarr = pytest.importorskip("zarr")
    np.save("map.npy", HEIGHTS)
    group = zarr.create_group("scan.zarr")
    group.create_array("x", data=np.arange(5.0))
    group.create_array("height", data=HEIGHTS, chunks=(256, 256))
    first = result(capsys, "map.npy", *READ, "--tiles", "512", "--output", "map.csv")
    arguments = ["--tiles", "512,512", "--threads", "2", "--plot", "a.png"]
    second = result(capsys, "scan.zarr", *READ, *arguments)
    assert first == second
    metres = HEIGHTS * np.float32(1e-6)
    spectrum = asperity.power_spectrum(metres, pixel_size=PIXEL, tiles=512)
    statistics = asperity.height_statistics(metres, pixel_size=PIXEL, detrend="plane")
    fit = asperity.fit_self_affine(spectrum)
    assert first["fit_hurst"] == pytest.approx(fit.hurst, rel=1e-5)
    assert first["kurtosis"] == pytest.approx(statistics.kurtosis, rel=1e-5)
    assert first["z_max_m"] == pytest.approx(statistics.z_max, rel=1e-5)
    assert first["slope_anisotropy"] == pytest.approx(1, abs=0.1)
    text = (folder / "map.csv").read_text().splitlines()
    assert {"# tiles = 512", "# overlap = 0.5", "# shape = [600, 700]"} <= {*text}
    rows = [line for line in text if not line.startswith("#")]
    assert len(rows) == 1 + spectrum.wavenumber.size
    assert float(rows[1].split(",")[1]) == pytest.approx(spectrum.density[0], rel=1e-6)
    assert Path("a.png").stat().st_size > 0
