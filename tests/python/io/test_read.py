"""Files in: matrices, instrument formats, and what is refused in one line."""

import warnings
import zipfile

import numpy as np
import pytest

import asperity
from asperity import InvalidInput, read_surface


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
def test_unit_is_that_of_the_heights_alone(tmp_path, unit, metres):
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
def test_text_matrices(tmp_path, name, text):
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
def test_a_comma_that_parts_no_cells_is_a_decimal_one(tmp_path, text):
    path = tmp_path / "scan.csv"
    path.write_text(text, encoding="utf-8")
    heights = read_surface(path, pixel_size=1.0, unit="m").heights[:, :2]
    np.testing.assert_array_equal(heights, [[1.5, -22.5], [0.5, np.nan]])


def test_instrument_dropouts_are_nan(tmp_path):
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
    ("dtype", "bits", "signalling"),
    [
        (np.float32, np.uint32, 0x7F800001),
        (np.float64, np.uint64, 0x7FF0000000000001),
        (np.float16, np.uint16, 0x7C01),
    ],
)
@pytest.mark.parametrize("unit", ["m", "um"])
@pytest.mark.filterwarnings("error")
def test_a_signalling_nan_is_a_dropout_like_others(tmp_path, dtype, bits, signalling, unit):
    heights = np.random.default_rng(1).normal(size=(24, 20)).astype(dtype)
    heights.view(bits)[3, 3] = signalling
    for given, name in ((heights, "map.npy"), (heights[3], "line.npy")):
        np.save(tmp_path / name, given)
        read = read_surface(tmp_path / name, pixel_size=1e-6 if unit == "um" else 1.0, unit=unit)
        assert read.dropout_fraction == 1 / given.size
    road = asperity.SelfAffineSpectrum(rms_height=1e-5, hurst=0.8, q0=2e3, q1=1e5)
    with pytest.raises(InvalidInput, match=r"^wavenumber = nan"):
        road.line_density(heights[3, 3:4])


AXIS = "<C{0}><AxisType>{1}</AxisType><DataType>D</DataType><Increment>{2}</Increment>{3}</C{0}>"
OFFSET = "<Offset>0</Offset>"


@pytest.mark.parametrize(("folder", "offset"), [("", OFFSET), ("scan/", OFFSET), ("", "<Offset/>")])
def test_x3p_with_its_files_in_a_folder_or_an_empty_offset(tmp_path, folder, offset):
    """As file managers pack them, and R's x3ptools write them."""
    pytest.importorskip("SurfaceTopography")
    heights = np.arange(12.0).reshape(3, 4) * 1e-7
    axes = AXIS.format("X", "I", 2e-6, OFFSET) + AXIS.format("Y", "I", 2e-6, OFFSET)
    axes += AXIS.format("Z", "A", 1, offset)
    size = "<SizeX>4</SizeX><SizeY>3</SizeY><SizeZ>1</SizeZ>"
    kind = "<Revision>ISO5436 - 2000</Revision><FeatureType>SUR</FeatureType>"
    main = (
        f"<ISO5436><Record1>{kind}<Axes>{axes}</Axes></Record1><Record3>"
        f"<MatrixDimension>{size}</MatrixDimension><DataLink><PointDataLink>bindata/data.bin"
        "</PointDataLink></DataLink></Record3></ISO5436>"
    )
    with zipfile.ZipFile(tmp_path / "scan.x3p", "w") as archive:
        archive.writestr("__MACOSX/._scan", b"any")
        archive.writestr(f"{folder}main.xml", main)
        archive.writestr(f"{folder}bindata/data.bin", heights.tobytes())
    surface = read_surface(tmp_path / "scan.x3p")
    np.testing.assert_array_equal(np.sort(surface.heights, axis=None), heights.ravel())
    assert surface.pixel_size == (2e-6, 2e-6)


def test_a_pixel_that_no_scan_has_may_be_given(tmp_path):
    """A file in micrometres whose program stated them as metres."""
    pytest.importorskip("SurfaceTopography")
    path = tmp_path / "scan.asc"
    text = "# Channel: Main\n# Width: 8 m\n# Height: 8 m\n# Value units: nm\n1 2\n4 5\n"
    path.write_text(text, encoding="utf-8")
    assert read_surface(path).pixel_size == pytest.approx((4.0, 4.0))
    surface = read_surface(path, pixel_size=4e-6)
    assert surface.pixel_size == (4e-6, 4e-6)
    np.testing.assert_allclose(np.sort(surface.heights, axis=None), np.array([1, 2, 4, 5]) * 1e-9)
