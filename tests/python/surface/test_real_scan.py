"""Measured scans from public sources: as they are, damaged, and through the shell command."""

import os
import subprocess
import sys
import tomllib
from pathlib import Path

import numpy as np
import pytest

from asperity import HeightMap, InvalidInput, LineScan, read_surface
from asperity.cli.main import main
from asperity.demo import scene_text

DATA = Path(os.environ.get("ASPERITY_DATA", Path(__file__).parents[3].parent / "shared" / "data"))

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


SCANS = {  # shape, distance of the points [m], rms height without tilt [m], share of drop-outs
    "opd-1.opd": ((480, 640), (1.9673303e-7, 1.9673303e-7), 6.7112e-9, 116 / 307200),
    "al3d-1.al3d": ((296, 200), (4.38027e-7, 4.38027e-7), 2.89822e-7, 0.0),
    "frt-2.frt": ((300, 150), (2e-4, 2e-4), 8.71655e-6, 12314 / 45000),
    "dektak-1.csv": ((9600,), 1499.8e-6 / 9599, 9.4243e-8, 0.0),
}


def measured(name: str) -> Path:
    """A measured scan; the test skips where it is absent or cannot be read."""
    pytest.importorskip("SurfaceTopography", reason="reading it needs asperity[io]")
    file = (DATA / "topography" / name).resolve()
    if not file.exists():
        pytest.skip(f"no {name}: measured data is in shared/data or ASPERITY_DATA")
    return file


def scene(folder: Path, name: str) -> Path:
    """A scene of a measured scan and the shipped rubber."""
    file = measured(name).as_posix()
    path = folder / "scene.toml"
    path.write_text(SCENE.format(file=file, **tomllib.loads(scene_text())["rubber"]))
    return path


@pytest.mark.parametrize("name", SCANS)
def test_scan_as_it_is(name: str) -> None:
    shape, distance, rms_height, dropouts = SCANS[name]
    scan = read_surface(measured(name))
    assert isinstance(scan, HeightMap if len(shape) == 2 else LineScan)
    assert scan.heights.shape == shape
    found = scan.pixel_size if isinstance(scan, HeightMap) else scan.spacing
    assert found == pytest.approx(distance, rel=1e-7)
    assert scan.detrend("plane").rms_height == pytest.approx(rms_height, rel=1e-5)
    assert scan.dropout_fraction == pytest.approx(dropouts, rel=1e-12)


def test_scan_states_its_own_unit() -> None:
    with pytest.raises(InvalidInput, match=r"csv: unit = 'um': must be left out"):
        read_surface(measured("dektak-1.csv"), unit="um")


def test_dropouts_are_not_filled_where_they_are_many() -> None:
    with pytest.raises(InvalidInput, match=r"27\.36 % of the points are drop-outs"):
        read_surface(measured("frt-2.frt")).fill_dropouts()


def read_if_sound(path: Path) -> HeightMap | LineScan | None:
    """The scan, or nothing after one error of one line that names the file."""
    try:
        return read_surface(path)
    except InvalidInput as error:
        text = str(error)
    assert text.startswith(f"{path}: ")
    assert text.count(path.name) == 1
    assert "\n" not in text
    return None


@pytest.mark.parametrize("name", SCANS)
def test_truncated_scan(tmp_path: Path, name: str, capfd: pytest.CaptureFixture[str]) -> None:
    content, whole = measured(name).read_bytes(), read_surface(measured(name)).heights
    path = tmp_path / name
    shares = (0, 1e-5, 1e-4, 1e-3, 0.01, 0.1, 0.3, 0.5, 0.7, 0.9, 0.99)
    refused = 0
    for length in {*(int(share * len(content)) for share in shares), len(content) - 1}:
        path.write_bytes(content[:length])
        rest = read_if_sound(path)
        if rest is None:
            refused += 1
        else:  # what is gone was none of the heights, or whole lines of a text
            assert rest.heights.shape == whole.shape or path.suffix == ".csv"
            np.testing.assert_array_equal(rest.heights, whole[: len(rest.heights)])
    assert refused >= 5
    assert capfd.readouterr() == ("", "")


@pytest.mark.parametrize("name", SCANS)
def test_corrupt_scan(tmp_path: Path, name: str, capfd: pytest.CaptureFixture[str]) -> None:
    content = measured(name).read_bytes()
    path = tmp_path / name
    random = np.random.default_rng(3)
    refused = 0
    for flips in [1, 1, 1, 1, 3, 3, 10, 10, 30, 30, 100, 1000]:
        data = np.frombuffer(content, np.uint8).copy()
        end = random.choice([64, 600, len(data)])
        data[random.integers(end, size=flips)] ^= np.uint8(1 << random.integers(8))
        path.write_bytes(data.tobytes())
        refused += read_if_sound(path) is None
    assert refused
    assert capfd.readouterr() == ("", "")


def test_parsers_do_not_print(tmp_path: Path) -> None:
    path = tmp_path / "scan.opd"
    path.write_bytes(measured("opd-1.opd").read_bytes()[:500])
    code = f"import asperity; asperity.read_surface({str(path)!r})"
    run = [sys.executable, "-c", f"try:\n {code}\nexcept ValueError as error: print(error)"]
    done = subprocess.run(run, capture_output=True, text=True, check=True)
    assert done.stdout == f"{path}: of no known format, or damaged\n"
    assert done.stderr == ""


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
