"""Surfaces and tables of SurfaceTopography, xarray and pandas, and archives of scans."""

import warnings
import zipfile

import numpy as np
import pytest

import asperity
from asperity import HeightMap, InvalidInput, LineScan, power_spectrum, read_surface
from asperity.scene.scene import load_scene
from helpers.rubbers import prony
from helpers.scenes import CONDITIONS, RUBBER

MAP = HeightMap(np.random.default_rng(1).normal(size=(20, 31)) * 1e-6, pixel_size=(2e-6, 1e-6))
LINE = LineScan(np.random.default_rng(1).normal(size=50) * 1e-6, spacing=1e-6)


def same(result, known):
    assert type(result) is type(known)
    np.testing.assert_allclose(result.heights, known.heights, rtol=1e-12)
    for name in {"pixel_size", "spacing"} & set(vars(known)):
        np.testing.assert_allclose(getattr(result, name), getattr(known, name), rtol=1e-9)


@pytest.mark.parametrize("known", [MAP, LINE])
def test_what_we_gave_to_pandas_and_xarray_comes_back(known):
    dataset = known.to_xarray()
    for given in (known.to_dataframe(), dataset, dataset["height"]):
        same(read_surface(given), known)


def test_a_data_array_in_other_units():
    xarray = pytest.importorskip("xarray")
    places = {
        name: (name, np.arange(n) * step * 1e3, {"units": "mm"})
        for name, n, step in zip(("y", "x"), MAP.heights.shape, MAP.pixel_size, strict=True)
    }
    heights = MAP.heights * 1e9
    array = xarray.DataArray(heights, places, ("y", "x"), attrs={"units": "nm"})
    same(read_surface(array), MAP)
    assert power_spectrum(array) == power_spectrum(read_surface(array))
    with pytest.raises(InvalidInput, match="unit = 'um': must be left out"):
        read_surface(array, unit="um")
    bare = xarray.DataArray(heights, dims=("y", "x"))
    same(read_surface(bare, unit="nm", pixel_size=MAP.pixel_size), MAP)
    for given, argument in (({}, "unit"), ({"unit": "nm"}, "pixel_size")):
        with pytest.raises(InvalidInput) as caught:
            read_surface(bare, **given)
        assert caught.value.argument == argument


def topography(**unit):
    topographies = pytest.importorskip("SurfaceTopography")
    sizes = 31e-3, 40e-3  # mm
    return topographies.Topography(MAP.heights.T * 1e3, sizes, **unit)


def test_a_topography_of_surface_topography():
    same(read_surface(topography(unit="mm")), MAP)
    same(read_surface(topography(), unit="mm"), MAP)
    assert power_spectrum(topography(unit="mm")).q0 == pytest.approx(power_spectrum(MAP).q0)
    with pytest.raises(InvalidInput, match="unit is missing"):
        read_surface(topography())


@pytest.mark.parametrize("columns", [("a", "b", "c"), ("x", "y")])
def test_other_tables_are_refused(columns):
    pandas = pytest.importorskip("pandas")
    with pytest.raises(InvalidInput, match=r"must be of x, \(y,\) and height"):
        read_surface(pandas.DataFrame(np.zeros((3, len(columns))), columns=columns))


def test_moduli_of_tables():
    pandas = pytest.importorskip("pandas")
    w = np.geomspace(0.1, 100, 12)
    rubber = prony(3e6, [1e7, 1e8], [1, 1e-2])
    parts = []
    for celsius in (0.0, 20.0, 40.0):
        e = rubber.modulus(w * 10 ** (-0.05 * celsius)) / 1e6
        parts.append(pandas.DataFrame({"w": w, "T": celsius, "E1": e.real, "E2": e.imag}))
    frame = pandas.concat(parts)
    columns = {"frequency": "w", "temperature": "T", "storage": "E1", "loss": "E2"}
    how = {"columns": columns, "units": {"frequency": "rad/s", "temperature": "C"}, "modulus": "E"}
    how["units"]["modulus"] = "MPa"
    for given in (frame, parts, frame.reset_index(drop=True).to_xarray()):
        isotherms = asperity.read_isotherms(given, **how)
        assert [one.temperature for one in isotherms] == [273.15, 293.15, 313.15]
        np.testing.assert_allclose(isotherms[0].storage_modulus, 1e6 * parts[0]["E1"], rtol=1e-12)
    frame.iloc[4, 2] = np.nan
    with pytest.raises(InvalidInput, match=r"^the table: line 5: storage = nan"):
        asperity.read_isotherms(frame, **how)


def test_a_master_curve_comes_back():
    curve = asperity.MasterCurve(
        angular_frequency=[1e-9, 1.0, 7.0], storage_modulus=[1e6, 3e6, 5e6], loss_modulus=[1e5] * 3
    )
    for given in (curve.to_dataframe(), curve.to_xarray()):
        assert asperity.read_master_curve(given) == curve


def archive(path):
    """Two scans in the layout of contact.engineering."""
    topographies = pytest.importorskip("SurfaceTopography")
    lines = ["surfaces:", "- name: road", "  topographies:"]
    law = asperity.SelfAffineSpectrum(rms_height=1e-6, hurst=0.8, q0=6e4, q1=3.2e7)
    with zipfile.ZipFile(path, "w") as file:
        for at, pixel in enumerate((1e-6, 1e-7)):
            seen = law.truncated(q0=2 * np.pi / (100 * pixel), q1=np.pi / pixel)
            made = asperity.synthesize(seen, shape=(100, 100), pixel_size=pixel, seed=1)
            one = topographies.Topography(made.heights.T, (100 * pixel, 100 * pixel), unit="m")
            with warnings.catch_warnings():
                warnings.simplefilter("ignore")
                one.to_netcdf(str(path.with_suffix(".nc")))
            file.write(path.with_suffix(".nc"), f"{at}.nc")
            lines += [f"  - name: scan {at}", "    datafile:", f"      original: {at}.nc"]
        file.writestr("meta.yml", "\n".join(lines))


def test_an_archive_of_contact_engineering(tmp_path):
    archive(tmp_path / "road.zip")
    for channel, pixel in enumerate((1e-6, 1e-7)):
        scan = read_surface(tmp_path / "road.zip", channel=channel)
        assert isinstance(scan, HeightMap)
        np.testing.assert_allclose(scan.pixel_size, pixel, rtol=1e-6)
    with pytest.raises(InvalidInput, match=r"road\.zip: channel = 2: must be in 0\.\.1"):
        read_surface(tmp_path / "road.zip", channel=2)
    (tmp_path / "a.toml").write_text('[surface]\nfile = "road.zip"\n' + RUBBER + CONDITIONS)
    whole = load_scene(tmp_path / "a.toml").spectrum
    (tmp_path / "a.toml").write_text(
        '[surface]\nfile = "road.zip"\nchannel = 1\n' + RUBBER + CONDITIONS
    )
    fine = load_scene(tmp_path / "a.toml").spectrum
    assert whole.q0 < 0.2 * fine.q0
    assert whole.q1 > 0.9 * fine.q1


def test_other_archives_are_refused(tmp_path):
    pytest.importorskip("SurfaceTopography")
    with zipfile.ZipFile(tmp_path / "a.zip", "w") as file:
        file.writestr("note.txt", "hello")
    for content in (None, b"no archive"):
        if content:
            (tmp_path / "a.zip").write_bytes(content)
        with pytest.raises(InvalidInput, match=r"^[^\n]*a\.zip: "):
            read_surface(tmp_path / "a.zip")
