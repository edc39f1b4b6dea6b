"""Files of instruments, made and measured: as they are, damaged, and through the shell command."""

import re

import numpy as np
import pytest

from asperity import HeightMap, InvalidInput, LineScan, read_surface
from helpers import made_files
from helpers.measured import SOURCES, scans_of

MEASURED = {  # shape, distance of the points [m], rms height without tilt [m], share of drop-outs
    "opd-1.opd": ((480, 640), (1.9673303e-7, 1.9673303e-7), 6.7112e-9, 116 / 307200),
    "al3d-1.al3d": ((296, 200), (4.38027e-7, 4.38027e-7), 2.89822e-7, 0.0),
    "frt-2.frt": ((300, 150), (2e-4, 2e-4), 8.71655e-6, 12314 / 45000),
    "dektak-1.csv": ((9600,), 1499.8e-6 / 9599, 9.4243e-8, 0.0),
}
SCANS = scans_of(MEASURED)
LINES = {"made": "line-1.csv", "measured": "dektak-1.csv"}
HOLES = {"made": ("holes.al3d", "30"), "measured": ("frt-2.frt", "27.36")}

scans = pytest.mark.parametrize(("source", "name"), SCANS)
sources = pytest.mark.parametrize("source", SOURCES)


def untilted(heights):
    """rms height [m] about the plane or line through the points, by NumPy's least squares."""
    there = np.isfinite(heights)
    where = [np.ones(there.sum()), *(axis[there] for axis in np.indices(heights.shape))]
    left = (
        heights[there]
        - np.column_stack(where)
        @ np.linalg.lstsq(np.column_stack(where), heights[there], rcond=None)[0]
    )
    return float(np.sqrt(np.mean(left**2)))


@scans
def test_scan_as_it_is(source, name, file_of):
    scan = read_surface(file_of(source, name))
    if source == "made":
        truth = made_files.heights_of(name)
        shape, rms_height = truth.shape, untilted(truth)
        distance = (made_files.PIXEL,) * 2 if truth.ndim == 2 else made_files.PIXEL
        dropouts = float(np.mean(np.isnan(truth)))
        tolerance = 1e-6 if truth.ndim == 2 else 6e-12  # floats; digits of the profile's file
        np.testing.assert_allclose(scan.heights, truth, rtol=tolerance, atol=6e-12)
    else:
        shape, distance, rms_height, dropouts = MEASURED[name]
    assert isinstance(scan, HeightMap if len(shape) == 2 else LineScan)
    assert scan.heights.shape == shape
    result = scan.pixel_size if isinstance(scan, HeightMap) else scan.spacing
    assert result == pytest.approx(distance, rel=1e-7, abs=0)
    assert scan.detrend("plane").rms_height == pytest.approx(rms_height, rel=1e-5, abs=0)
    assert scan.dropout_fraction == pytest.approx(dropouts, rel=1e-12, abs=0)


@sources
def test_scan_states_its_own_unit(source, file_of):
    with pytest.raises(InvalidInput, match=r"csv: unit = 'um': must be left out"):
        read_surface(file_of(source, LINES[source]), unit="um")


@sources
def test_dropouts_are_not_filled_where_they_are_many(source, file_of):
    name, share = HOLES[source]
    with pytest.raises(InvalidInput, match=rf"{re.escape(share)} % of the points are drop-outs"):
        read_surface(file_of(source, name)).fill_dropouts()


def read_if_sound(path):
    """The scan, or nothing after one error of one line that names the file."""
    try:
        return read_surface(path)
    except InvalidInput as error:
        text = str(error)
    assert text.startswith(f"{path}: ")
    assert text.count(path.name) == 1
    assert "\n" not in text
    return None


@scans
def test_truncated_scan(source, name, file_of, tmp_path, capfd):
    file = file_of(source, name)
    content, whole = file.read_bytes(), read_surface(file).heights
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


@scans
def test_corrupt_scan(source, name, file_of, tmp_path, capfd):
    content = file_of(source, name).read_bytes()
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
