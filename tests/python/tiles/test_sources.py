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
from helpers.cases import each

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
    found = np.load(path, mmap_mode="r", **options)
    assert isinstance(found, np.memmap)
    return found


@each("dtype", ["<f8", ">f8", "<f4", ">f4", "f2", "i4", "u1"])
@each("order", ["C", "F"])
@each("view", list(VIEWS))
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
        found = source.piece(box).read()
        assert found.dtype == (np.float32 if dtype[-2:] == "f4" else np.float64)
        np.testing.assert_array_equal(found, array[box])


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
{after}
try:
    asperity.height_statistics(array, pixel_size=1)
except asperity.InvalidInput as error:
    print(error)
"""


@each(("length", "message"), [(9000, "ends before its heights do"), (0, "ends before its heights")])
def test_a_file_that_is_cut_short_is_an_error_and_no_crash(tmp_path, length, message):
    np.save(tmp_path / "map.npy", HEIGHTS)
    code = TRUNCATE.format(length=length, after="")
    done = subprocess.run(
        [sys.executable, "-c", code, str(tmp_path / "map.npy")], capture_output=True, text=True
    )
    assert done.returncode == 0, done.stderr  # SIGBUS would be -7
    assert f"map.npy: {message}" in done.stdout


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


def test_a_damaged_chunk_is_an_error(tmp_path):
    zarr = pytest.importorskip("zarr")
    stored = zarr.create_array(tmp_path / "map.zarr", data=HEIGHTS, chunks=(40, 60))
    (tmp_path / "map.zarr/c/0/0").write_bytes(b"no chunk")
    with pytest.raises(InvalidInput, match="heights: cannot be read: "):
        source_of(stored, 1).piece(BOX).read()


def test_arrays_that_are_no_maps_are_refused(tmp_path):
    zarr, dask = pytest.importorskip("zarr"), pytest.importorskip("dask.array")
    group = zarr.create_group(tmp_path / "group.zarr")
    with pytest.raises(InvalidInput, match=r"surface = a group of arrays: .* \(none\)"):
        source_of(group, 1)
    group.create_array("heights", data=HEIGHTS)
    with pytest.raises(InvalidInput, match=r"give one of them \(heights\)"):
        source_of(group, 1)
    cube = group.create_array("cube", data=np.ones((2, 3, 4)))
    with pytest.raises(InvalidInput, match=r"surface has shape \(2, 3, 4\): must have two axes"):
        source_of(cube, 1)
    words = np.array([["a", "b"]])
    with pytest.raises(InvalidInput, match="holds <U1 values: must be real numbers"):
        source_of(words, 1)
    unknown = dask.from_array(HEIGHTS, chunks=16)
    unknown = unknown[unknown[:, 0] > 0]
    with pytest.raises(InvalidInput, match="must be known and not empty"):
        source_of(unknown, 1)
    group["heights"].attrs["scale_factor"] = 0.1
    with pytest.raises(InvalidInput, match=r"is packed \(scale_factor\): unpack it first"):
        source_of(group["heights"], 1)
