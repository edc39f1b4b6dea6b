"""Files in: matrices, instrument formats, and what is refused in one line."""

import io
import os
import sys
import warnings
import zipfile
from pathlib import Path

import numpy as np
import pytest

import asperity
from asperity import InvalidInput, read_surface

HEIGHTS = np.array([[1.0, 2.0, 4.0], [8.0, 16.0, 32.0]])
INSTRUMENT = """\
# Channel: Main
# Width: 10 µm
# Height: 9 µm
# Value units: nm
1 2 3 4 5
6 7 8 9 10
11 12 13 14 15
"""


@pytest.mark.parametrize("dtype", [np.float64, np.float32, np.int16])
def test_npy_keeps_heights_and_orientation(tmp_path: Path, dtype: type) -> None:
    path = tmp_path / "scan.npy"
    np.save(path, HEIGHTS.astype(dtype))
    surface = read_surface(path, pixel_size=(2e-6, 1e-6), unit="m")
    np.testing.assert_array_equal(surface.heights, HEIGHTS)
    assert surface.pixel_size == (2e-6, 1e-6)


def test_float32_stays_float32_when_scaled(tmp_path: Path) -> None:
    path = tmp_path / "scan.npy"
    np.save(path, HEIGHTS.astype(np.float32))
    surface = read_surface(path, pixel_size=1e-6, unit="um")
    assert surface.heights.dtype == np.float32
    np.testing.assert_allclose(surface.heights, HEIGHTS * 1e-6, rtol=1e-6)


@pytest.mark.parametrize(
    ("unit", "metres"),
    [
        ("m", 1),
        ("mm", 1e-3),
        ("um", 1e-6),
        ("\u00b5m", 1e-6),
        ("\u03bcm", 1e-6),
        ("nm", 1e-9),
        ("pm", 1e-12),
    ],
)
def test_unit_is_that_of_the_heights_alone(tmp_path: Path, unit: str, metres: float) -> None:
    path = tmp_path / "scan.csv"
    path.write_text("1,2\n3,4\n")
    surface = read_surface(path, pixel_size=1e-6, unit=unit)
    np.testing.assert_allclose(surface.heights, np.array([[1, 2], [3, 4]]) * metres, rtol=1e-15)
    assert surface.pixel_size == (1e-6, 1e-6)


@pytest.mark.parametrize(
    ("name", "text"),
    [
        ("a.csv", "# by hand\n1,2,\n3,nan,5\n"),
        ("b.txt", "1;2;\n\n3;NaN;5"),
        ("c.txt", "1\t2\t\n3\t\t5\n"),
        ("d.txt", "  1 2   nan\n# between\n3 nan 5\r\n"),
        ("e.csv", "\ufeff1,2,,\n3,,5,\n"),
    ],
)
def test_text_matrices(tmp_path: Path, name: str, text: str) -> None:
    path = tmp_path / name
    path.write_text(text, encoding="utf-8")
    surface = read_surface(path, pixel_size=1.0, unit="m")
    np.testing.assert_array_equal(surface.heights, [[1, 2, np.nan], [3, np.nan, 5]])


@pytest.mark.parametrize(
    "text",
    [
        "1,5;-2,25e1;\n,5;nan;5\n",
        "1,5\t-2,25e1\n0,5\tnan\n",
        "1,5 -2,25e1\n0,5 nan\n",
        "1.5 ,-22.5\n0.5 ,\n",
    ],
)
def test_a_comma_that_parts_no_cells_is_a_decimal_one(tmp_path: Path, text: str) -> None:
    path = tmp_path / "scan.csv"
    path.write_text(text, encoding="utf-8")
    heights = read_surface(path, pixel_size=1.0, unit="m").heights[:, :2]
    np.testing.assert_array_equal(heights, [[1.5, -22.5], [0.5, np.nan]])


def test_npz_channel_is_an_index(tmp_path: Path) -> None:
    path = tmp_path / "scan.npz"
    np.savez(path, first=HEIGHTS, second=-HEIGHTS)
    surface = read_surface(path, channel=1, pixel_size=1.0, unit="m")
    np.testing.assert_array_equal(surface.heights, -HEIGHTS)


def test_instrument_file_is_turned_to_y_x(tmp_path: Path) -> None:
    pytest.importorskip("SurfaceTopography")
    path = tmp_path / "scan.asc"
    path.write_text(INSTRUMENT, encoding="utf-8")
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        surface = read_surface(path)
    expected = np.arange(1, 16).reshape(3, 5) * 1e-9
    np.testing.assert_allclose(surface.heights, expected, rtol=1e-12)
    assert surface.pixel_size == pytest.approx((3e-6, 2e-6), rel=1e-12, abs=0)


def test_instrument_dropouts_are_nan(tmp_path: Path) -> None:
    topography = pytest.importorskip("SurfaceTopography")
    heights = np.ma.masked_equal([[1.0, 2.0], [3.0, 4.0], [5.0, 6.0]], 4.0)
    path = tmp_path / "scan.nc"
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        topography.Topography(heights, physical_sizes=(3.0, 4.0), unit="mm").to_netcdf(str(path))
    surface = read_surface(path)
    np.testing.assert_allclose(surface.heights, [[1e-3, 3e-3, 5e-3], [2e-3, np.nan, 6e-3]])
    assert surface.pixel_size == pytest.approx((2e-3, 1e-3))


@pytest.mark.parametrize(
    ("given", "message"),
    [
        ({"unit": "nm"}, "unit = 'nm': must be left out, the file states its own"),
        ({"pixel_size": 1e-6}, "pixel_size = 1e-06: must be left out, the file states its own"),
        ({"channel": 1}, "channel = 1: must be 0, the only one"),
    ],
)
def test_what_an_instrument_file_states_is_not_overridden(
    tmp_path: Path, given: dict[str, object], message: str
) -> None:
    pytest.importorskip("SurfaceTopography")
    path = tmp_path / "scan.asc"
    path.write_text(INSTRUMENT, encoding="utf-8")
    with pytest.raises(InvalidInput) as caught:
        read_surface(path, **given)  # type: ignore[arg-type]
    assert str(caught.value) == f"{path}: {message}"


def _npy(array: object) -> bytes:
    out = io.BytesIO()
    np.save(out, np.asarray(array), allow_pickle=True)
    return out.getvalue()


def _huge(content: bytes) -> bytes:
    """A header that promises 2^64 numbers."""
    return content.replace(b"(2, 3), }" + b" " * 19, b"(4294967296, 4294967296), } ", 1)


def _zip(name: str | None, content: bytes) -> bytes:
    out = io.BytesIO()
    with zipfile.ZipFile(out, "w") as archive:
        if name is not None:
            archive.writestr(name, content)
    return out.getvalue()


@pytest.mark.parametrize(
    ("name", "content", "given", "message"),
    [
        ("a.npy", _npy(HEIGHTS)[:-8], {}, "not a sound .npy file"),
        ("a.npy", b"", {}, "is empty"),
        ("a.npy", b"1,2\n3,4\n", {}, "not a sound .npy file"),
        ("a.npy", _npy([["a"]]), {}, "must be real numbers"),
        ("a.npy", _npy(HEIGHTS * 1j), {}, "must be real numbers"),
        ("a.npy", _npy([[None]]), {}, "not a sound .npy file"),
        ("a.npy", _npy(1.0), {}, "heights has 0 dimensions: must have 2 (a map) or 1"),
        ("a.npy", _npy(np.zeros((2, 3, 4))), {}, "heights has 3 dimensions: must have 2"),
        ("a.npy", _huge(_npy(HEIGHTS)), {}, "not a sound .npy file"),
        ("a.npy", _npy(np.zeros((0, 4))), {}, "heights"),
        ("a.npy", _npy([[1.0, np.inf], [2.0, 3.0]]), {}, "heights"),
        ("a.npy", _npy(HEIGHTS), {"channel": "0"}, "channel = '0': must be 0, the only one"),
        ("a.npy", _npy(HEIGHTS), {"channel": 1}, "channel = 1: must be 0, the only one"),
        ("a.npy", _npy(HEIGHTS), {"pixel_size": 0.0}, "pixel_size"),
        ("a.npy", _npy(HEIGHTS), {"pixel_size": (1.0, -1.0)}, "pixel_size"),
        ("a.npy", _npy(HEIGHTS), {"pixel_size": np.nan}, "pixel_size"),
        (
            "a.npy",
            _npy(HEIGHTS),
            {"pixel_size": None},
            "pixel_size is missing: a .npy file does not",
        ),
        ("a.npy", _npy(HEIGHTS), {"unit": None}, "unit is missing: a .npy file does not state"),
        ("a.npy", _npy(HEIGHTS), {"unit": "inch"}, "unit = 'inch': must be one of m, mm, um, nm"),
        ("a.npy", _npy(HEIGHTS), {"unit": 1}, "unit = 1: must be one of m, mm, um, nm, pm"),
        ("a.toml", b"[surface]\n", {}, "is a scene, not a surface: must be a scan"),
        ("a.npz", _zip("note.txt", b"hello"), {}, "not a sound .npz file"),
        ("a.npz", _zip(None, b""), {}, "holds no arrays"),
        ("a.npz", _zip("a.npy", _npy(HEIGHTS)[:-8]), {}, "not a sound .npz file"),
        ("a.npz", b"PK\x03\x04 and no more", {}, "not a sound .npz file"),
        ("a.npz", _npy(HEIGHTS), {}, "not a sound .npz file"),
        ("a.csv", b"", {}, "is empty"),
        ("a.csv", b"#\n", {}, "holds no numbers"),
        ("a.csv", b"# nothing but this\n", {}, "holds no numbers"),
        ("a.csv", b"1,2\n3\n", {}, "line 2 has 1 cells; it must have 2"),
        ("a.csv", b"1,2\n3,high\n", {}, "line 2: 'high' is not a number"),
        ("a.csv", b"1_0,2\n3,4\n", {}, "line 1: '1_0' is not a number"),
        ("a.csv", b"1,5,;2,5\n", {}, "line 1: '1.5,' is not a number"),
    ],
)
def test_refusals_name_the_file(
    tmp_path: Path, name: str, content: bytes, given: dict[str, object], message: str
) -> None:
    path = tmp_path / name
    path.write_bytes(content)
    with pytest.raises(InvalidInput) as caught:
        read_surface(path, **{"pixel_size": 1.0, "unit": "m", **given})  # type: ignore[arg-type]
    text = str(caught.value)
    assert text.startswith(f"{path}: ")
    assert message in text
    assert "\n" not in text


def test_npz_channel_out_of_range(tmp_path: Path) -> None:
    path = tmp_path / "scan.npz"
    np.savez(path, first=HEIGHTS, second=HEIGHTS)
    with pytest.raises(InvalidInput, match=r"scan\.npz: channel = 2: must be in 0\.\.1"):
        read_surface(path, channel=2, pixel_size=1.0, unit="m")


@pytest.mark.parametrize("name", ["missing.npy", "missing.opd"])
def test_missing_file(tmp_path: Path, name: str) -> None:
    with pytest.raises(InvalidInput, match=rf"{name}: cannot be read: No such file"):
        read_surface(tmp_path / name, pixel_size=1.0, unit="m")


def test_directory(tmp_path: Path) -> None:
    with pytest.raises(InvalidInput, match="cannot be read: Is a directory"):
        read_surface(tmp_path, pixel_size=1.0, unit="m")


@pytest.mark.parametrize("name", ["/dev/null", "/dev/zero"])
def test_no_regular_file(name: str) -> None:
    with pytest.raises(InvalidInput) as caught:
        read_surface(name, pixel_size=1.0, unit="m")
    assert str(caught.value) == f"{name}: cannot be read: not a regular file"


def test_pipe_is_not_waited_for(tmp_path: Path) -> None:
    os.mkfifo(tmp_path / "scan.csv")
    with pytest.raises(InvalidInput, match="not a regular file"):
        read_surface(tmp_path / "scan.csv", pixel_size=1.0, unit="m")


def test_no_name_of_a_file() -> None:
    with pytest.raises(InvalidInput, match="cannot be read: embedded null"):
        read_surface("a\0b.npy", pixel_size=1.0, unit="m")


@pytest.mark.parametrize("content", [b"", b"\x00\x01\x02" * 100, b"a tale\nof two cities\n"])
def test_unknown_format(tmp_path: Path, content: bytes) -> None:
    pytest.importorskip("SurfaceTopography")
    path = tmp_path / "scan.dat"
    path.write_bytes(content)
    with pytest.raises(InvalidInput) as caught:
        read_surface(path)
    assert str(caught.value).startswith(f"{path}: ")
    assert len(str(caught.value).splitlines()) == 1


def test_without_surface_topography_says_what_to_install(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    for name in [m for m in sys.modules if m.partition(".")[0] == "SurfaceTopography"]:
        monkeypatch.delitem(sys.modules, name)
    monkeypatch.setitem(sys.modules, "SurfaceTopography", None)
    path = tmp_path / "scan.opd"
    path.write_bytes(b"any")
    with pytest.raises(InvalidInput, match=r"scan\.opd: .*-m pip install 'asperity\[io\]'"):
        read_surface(path)


def test_is_public() -> None:
    assert "read_surface" in asperity.__all__


@pytest.mark.parametrize(
    ("dtype", "bits", "signalling"),
    [
        (np.float32, np.uint32, 0x7F800001),
        (np.float64, np.uint64, 0x7FF0000000000001),
        (np.float16, np.uint16, 0x7C01),
    ],
)
@pytest.mark.parametrize("unit", ["m", "um"])
@pytest.mark.filterwarnings("error")
def test_a_signalling_nan_is_a_dropout_like_others(
    tmp_path: Path, dtype: type, bits: type, signalling: int, unit: str
) -> None:
    heights = np.random.default_rng(1).normal(size=(24, 20)).astype(dtype)
    heights.view(bits)[3, 3] = signalling
    for given, name in ((heights, "map.npy"), (heights[3], "line.npy")):
        np.save(tmp_path / name, given)
        read = read_surface(tmp_path / name, pixel_size=1e-6 if unit == "um" else 1.0, unit=unit)
        assert read.dropout_fraction == 1 / given.size
    road = asperity.SelfAffineSpectrum(rms_height=1e-5, hurst=0.8, q0=2e3, q1=1e5)
    with pytest.raises(InvalidInput, match=r"^wavenumber = nan"):
        road.line_density(heights[3, 3:4])
