"""Arrays of any layout, line scans, and texts that an instrument wrote."""

import tracemalloc
import warnings
from itertools import product

import numpy as np
import pytest

from asperity import HeightMap, InvalidInput, LineScan, read_surface

MAP = np.array([[1.0, 2.0, 4.0], [8.0, 16.0, 32.0]])
PROFILE = np.array([1.0, 2.0, 4.0, 8.0, 16.0])
GWYDDION = """\
# Channel: Main
# Width: 8 µm
# Height: 9 µm
# Value units: nm
1 2 3 4
5 6 7 8
9 10 11 12
"""
DEKTAK = "Scan Parameters\nStylus,Radius: 2.5 µm\n\nScan Data\n\nLateral um,Raw Micrometer,\n"


@pytest.mark.parametrize("order", ["C", "F"])
@pytest.mark.parametrize("dtype", ["f4", "f8", ">f4", ">f8", "f2", "i2", "u1", "g"])
@pytest.mark.parametrize(("unit", "metres"), [("m", 1.0), ("nm", 1e-9)])
@pytest.mark.parametrize("save", [np.save, np.savez])
def test_arrays_of_any_type_and_order(tmp_path, save, unit, metres, dtype, order):
    path = tmp_path / ("scan.npy" if save is np.save else "scan.npz")
    heights = MAP.astype(dtype).copy(order)
    save(path, heights)
    surface = read_surface(path, pixel_size=(2e-6, 1e-6), unit=unit)
    assert surface.pixel_size == (2e-6, 1e-6)
    assert surface.heights.dtype == (np.float32 if dtype.endswith("f4") else np.float64)
    np.testing.assert_allclose(surface.heights, MAP * metres, rtol=1e-7)
    np.testing.assert_array_equal(np.load(path) if save is np.save else heights, heights)


def _traced(path, unit):
    """The map, and the most bytes that reading it took at once."""
    tracemalloc.start()
    try:
        surface = read_surface(path, pixel_size=1e-6, unit=unit)
        return surface, tracemalloc.get_traced_memory()[1]
    finally:
        tracemalloc.stop()


@pytest.mark.parametrize("order", ["C", "F"])
@pytest.mark.parametrize("dtype", [np.float32, np.float64])
def test_no_hidden_copy(tmp_path, dtype, order):
    heights = np.ones((1000, 500), dtype, order)
    np.save(tmp_path / "scan.npy", heights)
    np.savez(tmp_path / "scan.npz", heights)
    read_surface(tmp_path / "scan.npz", pixel_size=1.0, unit="m")  # imports once
    for name, unit in product(("scan.npy", "scan.npz"), ("m", "um")):
        read, peak = _traced(tmp_path / name, unit)
        assert peak < 1.9 * heights.nbytes
        np.testing.assert_allclose(read.heights[0], 1.0 if unit == "m" else 1e-6)


def test_a_memory_mapped_file_is_shared(tmp_path):
    np.save(tmp_path / "scan.npy", np.ones((100, 50)))
    mapped = np.load(tmp_path / "scan.npy", mmap_mode="r")
    assert np.shares_memory(HeightMap(mapped, pixel_size=1.0).heights, mapped)
    assert np.shares_memory(LineScan(mapped[:, 3], spacing=1.0).heights, mapped)


@pytest.mark.parametrize("save", [np.save, np.savez, np.savez_compressed])
def test_damaged_arrays(tmp_path, save):
    path = tmp_path / ("scan.npy" if save is np.save else "scan.npz")
    random = np.random.default_rng(1)
    save(path, random.standard_normal((20, 30)))
    content = path.read_bytes()
    refused = []
    for _ in range(100):
        data = bytearray(content)
        if random.random() < 0.3:
            del data[random.integers(len(data)) :]
        else:
            data[random.integers(min(len(data), 200))] ^= 1 << random.integers(8)
        path.write_bytes(data)
        try:
            read_surface(path, pixel_size=1.0, unit="m")
        except InvalidInput as error:
            refused.append(str(error))
    assert refused
    assert all(text.startswith(f"{path}: ") and "\n" not in text for text in refused)


@pytest.mark.parametrize("dtype", [np.float32, np.float64, ">f8", np.int16])
@pytest.mark.parametrize(("unit", "metres"), [("m", 1.0), ("um", 1e-6)])
def test_arrays_of_one_dimension(tmp_path, dtype, unit, metres):
    profile = PROFILE.astype(dtype)
    np.save(tmp_path / "scan.npy", profile)
    np.savez(tmp_path / "scan.npz", -profile, profile)
    for name, channel in (("scan.npy", 0), ("scan.npz", 1)):
        scan = read_surface(tmp_path / name, channel=channel, pixel_size=2e-7, unit=unit)
        assert isinstance(scan, LineScan)
        assert scan.spacing == 2e-7
        assert scan.heights.dtype == (np.float32 if dtype == np.float32 else np.float64)
        np.testing.assert_allclose(scan.heights, PROFILE * metres, rtol=1e-7)


@pytest.mark.parametrize(
    "text",
    [
        "1\n2\nnan\n4\n",
        "\n# by hand\n1\n# between\n2\nNaN\n4\n\n",
        "1,\n2,\n,\n4,\n",
        "1, 2,, 4\n",
        "1 2 nan 4",
        "1;2;;4;\n",
        "\ufeff1\t2\t\t4\n",
    ],
)
def test_text_of_one_column_or_line(tmp_path, text):
    path = tmp_path / "scan.txt"
    path.write_text(text, encoding="utf-8")
    scan = read_surface(path, pixel_size=1e-6, unit="um")
    assert isinstance(scan, LineScan)
    np.testing.assert_allclose(scan.heights, [1e-6, 2e-6, np.nan, 4e-6])


def test_line_of_dropouts_in_a_map_parted_by_tabs(tmp_path):
    path = tmp_path / "scan.txt"
    path.write_text("1\t2\n\t\n3\t4\n")
    surface = read_surface(path, pixel_size=1.0, unit="m")
    np.testing.assert_array_equal(surface.heights, [[1, 2], [np.nan, np.nan], [3, 4]])


def _read(path, text, **given):
    pytest.importorskip("SurfaceTopography")
    path.write_text(text, encoding="latin-1" if text.startswith("Scan") else "utf-8")
    return read_surface(path, **given)


def test_unit_of_an_instrument_file_is_that_of_all_its_lengths(tmp_path):
    scan = _read(tmp_path / "scan.xyz", "0 1\n1 2\n2 3\n", unit="mm")
    assert isinstance(scan, LineScan)
    assert scan.spacing == pytest.approx(1e-3, rel=1e-12, abs=0)
    np.testing.assert_allclose(scan.heights, [1e-3, 2e-3, 3e-3])


def test_profile_without_positions(tmp_path):
    scan = _read(tmp_path / "scan.dat", "1\n2\n3\n", unit="um", pixel_size=3e-7)
    assert isinstance(scan, LineScan)
    assert scan.spacing == 3e-7
    np.testing.assert_allclose(scan.heights, [1e-6, 2e-6, 3e-6])


@pytest.mark.parametrize(("spacing", "digits"), [(0.15625, 1), (0.7, 1), (156.25, -1), (1.3, 0)])
def test_positions_that_were_rounded_in_print(tmp_path, spacing, digits):
    positions = np.round(spacing * np.arange(400), digits)
    rows = "".join(f"{x:.10g},{np.sin(x):.5f},,\n" for x in positions)
    scan = _read(tmp_path / "scan.csv", DEKTAK + rows)
    assert isinstance(scan, LineScan)
    assert scan.spacing == pytest.approx(positions[-1] / 399 * 1e-6, rel=1e-12, abs=0)
    np.testing.assert_allclose(scan.heights, np.sin(positions) * 1e-6, atol=1e-11)


@pytest.mark.parametrize(
    "positions",
    [
        [0, 1, 2.5],
        [0, 1, 2, 4.01, 5, 6],
        [0.0, 0.1, 0.2, 0.5, 0.6],
        np.geomspace(1, 3, 50),
        np.delete(np.round(0.15625 * np.arange(400), 1), 200),
    ],
)
def test_positions_that_are_not_equally_spaced(tmp_path, positions):
    path = tmp_path / "scan.csv"
    with pytest.raises(InvalidInput) as caught:
        _read(path, DEKTAK + "".join(f"{x:.10g},1.0,,\n" for x in positions))
    assert caught.value.allowed == "equally spaced"


def test_matrix_with_a_header_that_states_unit_and_size(tmp_path):
    path = tmp_path / "scan.txt"
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        surface = _read(path, GWYDDION)
    assert isinstance(surface, HeightMap)
    np.testing.assert_allclose(surface.heights, np.arange(1, 13).reshape(3, 4) * 1e-9)
    assert surface.pixel_size == pytest.approx((3e-6, 2e-6), rel=1e-12, abs=0)
    with pytest.raises(InvalidInput, match=r"scan\.txt: line 6: 'high' is not a number"):
        _read(path, GWYDDION.replace("7", "high"))
    with pytest.raises(InvalidInput, match=r"scan\.txt: pixel_size is missing"):
        _read(path, GWYDDION, unit="nm")
