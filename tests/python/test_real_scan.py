"""Measured scans from public sources through the shell command."""

import os
import tomllib
from pathlib import Path

import numpy as np
import pytest

from asperity.cli import main
from asperity.demo import scene_text

DATA = Path(os.environ.get("ASPERITY_DATA", Path(__file__).parents[2].parent / "shared" / "data"))

SCENE = """
[surface]
file = "{file}"
detrend = "quadratic"
[rubber]
equilibrium_modulus_pa = {equilibrium_modulus_pa}
moduli_pa = {moduli_pa}
relaxation_times_s = {relaxation_times_s}
[conditions]
pressure_pa = 81e3
velocity_m_s = {{from = 1e-6, to = 1e-2, points = 9}}
"""


def scene(folder: Path, name: str) -> Path:
    """A scene of a measured scan and the shipped rubber, on which the test skips if it must."""
    pytest.importorskip("SurfaceTopography", reason="reading it needs asperity[io]")
    file = (DATA / "topography" / name).resolve()
    if not file.exists():
        pytest.skip(f"no {name}: measured data is in shared/data or ASPERITY_DATA")
    path = folder / "scene.toml"
    path.write_text(SCENE.format(file=file.as_posix(), **tomllib.loads(scene_text())["rubber"]))
    return path


def test_interferometer_map(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    pytest.importorskip("matplotlib", reason="its picture needs asperity[plot]")
    path = scene(tmp_path, "opd-1.opd")
    outputs = ["--output", str(tmp_path / "mu.csv"), "--plot", str(tmp_path / "mu.png")]
    assert main(["friction", str(path), *outputs]) == 0
    lines = (tmp_path / "mu.csv").read_text().splitlines()
    header = [line for line in lines if line.startswith("#")]
    assert "# derived.shape = [480, 640]" in header
    assert any(line.startswith("# derived.dropout_fraction = 0.000377") for line in header)
    rows = np.array([line.split(",") for line in lines[len(header) + 1 :]], float)
    assert rows.shape == (9, 8)
    assert np.all(np.isfinite(rows))
    mu, hysteresis, adhesion, area, _, error = rows.T[2:]
    assert np.all(hysteresis > 0)
    assert np.all(adhesion == 0)
    np.testing.assert_array_equal(mu, hysteresis)
    assert np.all((area > 0) & (area <= 1))
    assert np.all(error <= 1e-6 * mu)
    assert (tmp_path / "mu.png").stat().st_size > 10000
    for line in capsys.readouterr().err.splitlines():
        assert line.startswith("note: ")


def test_scan_with_too_many_dropouts(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    path = scene(tmp_path, "frt-2.frt")
    before = sorted(tmp_path.iterdir())
    assert main(["friction", str(path), "--output", str(tmp_path / "mu.csv")]) == 2
    out, err = capsys.readouterr()
    assert out == ""
    assert len(err.splitlines()) == 1
    assert err.startswith(f"asperity: {path}: ")
    assert "frt-2.frt" in err
    assert "27.36 % of the points are drop-outs: must be at most 10 %" in err
    assert sorted(tmp_path.iterdir()) == before
