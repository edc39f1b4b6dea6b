"""Where heights come from: memory maps of any layout, Zarr, Dask; files that change meanwhile."""

import os
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

from asperity import HeightMap, InvalidInput, height_statistics
from asperity.tiles.file_array import FileArray
from asperity.tiles.source import source_of

HEIGHTS = np.random.default_rng(1).normal(size=(40, 60)) * 1e-6
BOX = (slice(3, 17), slice(5, 44))
VIEWS = {
    "whole": np.s_[:, :],
    "part": np.s_[7:, 9:51],
    "every second": np.s_[::2, ::3],
    "turned over": np.s_[::-1, ::-1],
    "rows turned over": np.s_[::-1],
}


def mapped(path: Path, heights: np.ndarray, **options: object) -> np.memmap:
    np.save(path, heights)
    result = np.load(path, mmap_mode="r", **options)
    assert isinstance(result, np.memmap)
    return result


@pytest.mark.parametrize("dtype", ["<f8", ">f8", "<f4", ">f4", "f2", "i4", "u1"])
@pytest.mark.parametrize("order", ["C", "F"])
@pytest.mark.parametrize("view", list(VIEWS))
def test_a_memory_map_is_read_by_file_reads(tmp_path, dtype, order, view):
    heights = (HEIGHTS * 1e7).astype(dtype, order=order)
    for array in (
        mapped(tmp_path / "map.npy", heights)[VIEWS[view]],
        np.asarray(mapped(tmp_path / "map.npy", heights))[VIEWS[view]].T,
    ):
        source = source_of(array, 1)
        assert isinstance(source.array, FileArray)
        box = tuple(
            slice(part.start, min(part.stop, n)) for part, n in zip(BOX, array.shape, strict=True)
        )
        result = source.piece(box).read()
        assert result.dtype == (np.float32 if dtype[-2:] == "f4" else np.float64)
        np.testing.assert_array_equal(result, array[box])


def test_a_raw_memory_map_with_an_offset_is_read_from_there(tmp_path):
    path = tmp_path / "raw.bin"
    path.write_bytes(b"x" * 5003 + HEIGHTS.tobytes())
    array = np.memmap(path, np.float64, "r", offset=5003, shape=HEIGHTS.shape)
    np.testing.assert_array_equal(source_of(array, 1).piece(BOX).read(), HEIGHTS[BOX])


def test_changes_that_stay_in_memory_are_seen(tmp_path):
    np.save(tmp_path / "map.npy", HEIGHTS)
    array = np.load(tmp_path / "map.npy", mmap_mode="c")
    array[5, 7] = 1
    assert source_of(array, 1).piece(BOX).read()[2, 2] == 1


def test_the_numbers_are_those_of_the_array_in_memory(tmp_path):
    zarr, dask = pytest.importorskip("zarr"), pytest.importorskip("dask.array")
    stored = zarr.create_array(tmp_path / "map.zarr", data=HEIGHTS, chunks=(16, 16))
    masked = np.ma.masked_array(HEIGHTS, HEIGHTS > 1e-6)
    expected = height_statistics(HEIGHTS, pixel_size=1)
    for array in (
        mapped(tmp_path / "map.npy", HEIGHTS),
        stored,
        dask.from_array(HEIGHTS, chunks=16),
        dask.from_zarr(stored),
        HEIGHTS.tolist(),
    ):
        assert height_statistics(array, pixel_size=1) == expected
    assert height_statistics(HeightMap(HEIGHTS, pixel_size=1)) == expected
    holed = height_statistics(masked, pixel_size=1)
    assert holed == height_statistics(masked.filled(np.nan), pixel_size=1)
    assert holed.dropout_fraction == masked.mask.mean()


TRUNCATE = """
import os, sys
import numpy as np
import asperity
array = np.load(sys.argv[1], mmap_mode="r")
os.truncate(sys.argv[1], {length})
try:
    asperity.height_statistics(array, pixel_size=1)
except asperity.InvalidInput as error:
    print(error)
"""


@pytest.mark.parametrize("length", [9000, 0])
def test_a_file_that_is_cut_short_is_an_error_and_no_crash(tmp_path, length):
    np.save(tmp_path / "map.npy", HEIGHTS)
    code = TRUNCATE.format(length=length)
    done = subprocess.run(
        [sys.executable, "-c", code, str(tmp_path / "map.npy")], capture_output=True, text=True
    )
    assert done.returncode == 0, done.stderr  # SIGBUS would be -7
    assert "map.npy: ends before its heights do" in done.stdout


def test_a_file_that_is_written_meanwhile_is_an_error(tmp_path):
    array = mapped(tmp_path / "map.npy", HEIGHTS)
    piece = source_of(array, 1).piece(BOX)
    piece.read()
    for change in (
        lambda: os.utime(tmp_path / "map.npy", ns=(1, 1)),
        lambda: np.save(tmp_path / "map.npy", HEIGHTS[:30]),
    ):
        change()
        with pytest.raises(InvalidInput, match=r"map\.npy: was changed while it was read"):
            piece.read()
    (tmp_path / "map.npy").unlink()
    with pytest.raises(InvalidInput, match=r"map\.npy: cannot be read: No such file"):
        piece.read()
    with pytest.raises(InvalidInput, match=r"map\.npy: cannot be read: No such file"):
        source_of(array, 1)


INSIDE = HEIGHTS.copy()
INSIDE[10:30] *= 7


@pytest.mark.parametrize("other", [7 * HEIGHTS[:30], 7 * HEIGHTS, INSIDE], ids=len)
def test_a_file_that_was_replaced_after_it_was_mapped_is_refused(tmp_path, other):
    array = mapped(tmp_path / "map.npy", HEIGHTS)
    np.save(tmp_path / "new.npy", other)
    os.replace(tmp_path / "new.npy", tmp_path / "map.npy")
    with pytest.raises(InvalidInput, match=r"map\.npy: was replaced after it was mapped: load it"):
        height_statistics(array, pixel_size=1)
    again = np.load(tmp_path / "map.npy", mmap_mode="r")
    assert height_statistics(again, pixel_size=1).rms_height == pytest.approx(np.std(again))


def test_a_damaged_chunk_is_an_error(tmp_path):
    zarr = pytest.importorskip("zarr")
    stored = zarr.create_array(tmp_path / "map.zarr", data=HEIGHTS, chunks=(40, 60))
    (tmp_path / "map.zarr/c/0/0").write_bytes(b"no chunk")
    with pytest.raises(InvalidInput, match="heights: cannot be read: "):
        source_of(stored, 1).piece(BOX).read()


def no_maps(folder):
    """What has no heights to read, and what the error says of it."""
    zarr, dask = pytest.importorskip("zarr"), pytest.importorskip("dask.array")
    group = zarr.create_group(folder / "group.zarr")
    yield group, "(none)"
    heights = group.create_array("heights", data=HEIGHTS)
    yield group, "(heights)"
    yield group.create_array("cube", data=np.ones((2, 3, 4))), "shape (2, 3, 4)"
    yield np.array([["a", "b"]]), "holds <U1 values"
    unknown = dask.from_array(HEIGHTS, chunks=16)
    yield unknown[unknown[:, 0] > 0], "must be known and not empty"
    heights.attrs["scale_factor"] = 0.1
    yield heights, "is packed (scale_factor)"


def test_arrays_that_are_no_maps_are_refused(tmp_path):
    for array, words in no_maps(tmp_path):
        with pytest.raises(InvalidInput) as caught:
            source_of(array, 1)
        assert words in str(caught.value)


@pytest.mark.parametrize("version", [2, 3])
@pytest.mark.parametrize("dtype", ["int16", "float32"])
def test_fill_values_are_drop_outs(tmp_path, version, dtype):
    xarray, zarr = pytest.importorskip("xarray"), pytest.importorskip("zarr")
    heights = np.round(HEIGHTS * 1e9)
    heights[4:9, 11:30] = np.nan
    path = tmp_path / f"{dtype}.{version}.zarr"
    fill = {"dtype": dtype, "_FillValue": -32768}
    xarray.Dataset({"h": (("y", "x"), heights)}).to_zarr(
        path, encoding={"h": fill}, zarr_format=version, consolidated=False
    )
    stored = zarr.open(path, mode="r")["h"]
    assert stored[4, 11] == -32768
    opened = {"engine": "zarr", "consolidated": False}
    raw = xarray.open_dataset(path, decode_cf=False, **opened).h
    decoded = xarray.open_dataset(path, **opened).h
    expected = height_statistics(heights.astype(decoded.dtype), pixel_size=1)
    assert expected.dropout_fraction == 95 / 2400
    for array in (stored, raw, decoded):
        result = height_statistics(array, pixel_size=1)
        assert result.dropout_fraction == expected.dropout_fraction
        assert result.rms_height == pytest.approx(expected.rms_height, rel=1e-6)
        assert result.skewness == pytest.approx(expected.skewness, rel=1e-5)


def test_missing_values_may_be_several_and_go_before_the_unit(tmp_path):
    zarr = pytest.importorskip("zarr")
    heights = np.arange(2400, dtype=np.int32).reshape(40, 60)
    stored = zarr.create_array(tmp_path / "map.zarr", data=heights)
    stored.attrs["missing_value"] = [7, 9]
    box = slice(0, 1), slice(5, 11)
    result = source_of(stored, 1, 1e-9).piece(box).read()
    np.testing.assert_array_equal(result, np.array([[5, 6, np.nan, 8, np.nan, 10]]) * 1e-9)


def test_a_zarr_array_without_attributes_has_heights_that_are_0(tmp_path):
    zarr = pytest.importorskip("zarr")
    stored = zarr.create_array(
        tmp_path / "map.zarr", data=np.zeros((40, 60), np.int16), fill_value=0, zarr_format=2
    )
    assert height_statistics(stored, pixel_size=1).dropout_fraction == 0


@pytest.mark.parametrize(
    "attributes",
    [
        {"scale_factor": 1e-9},
        {"add_offset": 0.0, "_FillValue": -1},
        {"_Unsigned": "true"},
        {"_FillValue": 65535},
        {"_FillValue": 0.5},
        {"missing_value": "none"},
    ],
)
def test_numbers_that_are_packed_are_refused_whoever_holds_them(attributes):
    xarray = pytest.importorskip("xarray")
    raw = xarray.DataArray(np.ones((40, 60), np.int16), dims=("y", "x"), attrs=attributes)
    with pytest.raises(InvalidInput, match=next(iter(attributes))):
        source_of(raw, 1)
