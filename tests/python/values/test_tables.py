"""Measured objects and results as tables of xarray and pandas, and drawn by matplotlib."""

import subprocess
import sys

import numpy as np
import pytest

import asperity
from asperity.base.table import Table
from helpers.examples import ALL, CLASSES, RUBBER

TABLES = {name: value for name, value in ALL.items() if isinstance(value, Table)}
UNITS = {"", "1", "K", "Pa", "rad", "rad/s", "s", "m", "1/m", "m^3", "m^4", "m/s", "Pa, m/s, 1"}
# Values, whose arguments are all that there is to them.
PLAIN = {*asperity.correction.__all__, "Adhesion", "ArrheniusFit", "Heating", "WLF", "WlfFit"}


def test_every_class_is_a_table_but_the_plain_values():
    plain = {name for name, cls in CLASSES.items() if not issubclass(cls, Table)}
    assert plain == PLAIN


@pytest.mark.parametrize("name", TABLES)
def test_datasets_have_units_and_the_numbers_of_the_attributes(name):
    pytest.importorskip("xarray")
    value = TABLES[name]
    dataset = value.to_xarray()
    assert dataset.data_vars
    for column in (*dataset.data_vars, *dataset.coords):
        assert dataset[column].attrs["units"] in UNITS
        own = getattr(value, column, None)
        known = own is not None and not callable(own)
        if known and np.shape(own) == dataset[column].shape:
            np.testing.assert_array_equal(dataset[column], own)
    dataset[next(iter(dataset.data_vars))].values[...] = 0  # is the reader's own


def test_a_sweep_has_its_pressures_and_velocities_as_coordinates():
    pytest.importorskip("xarray")
    value = ALL["friction of many points"]
    dataset = value.to_xarray()
    assert dict(dataset.sizes) == {"pressure": 2, "velocity": 40}
    assert dataset.mu.dims == ("pressure", "velocity")
    assert float(dataset.mu.sel(pressure=2e5).isel(velocity=7)) == value.mu[1, 7]
    assert dataset.velocity.attrs["units"] == "m/s"
    assert ALL["a measured spectrum"].to_xarray().density.attrs["units"] == "m^4"


@pytest.mark.parametrize("name", TABLES)
def test_frames_have_a_row_an_entry(name):
    pytest.importorskip("pandas")
    value = TABLES[name]
    frame = value.to_dataframe()
    columns = value._columns()
    named = {**columns.coordinates, **columns.variables}
    assert [*frame.columns] == [*named]
    sizes = {}
    for column in named.values():
        sizes.update(zip(column.dimensions, np.shape(column.values), strict=True))
    assert len(frame) == np.prod([*sizes.values()])


def test_rows_of_a_frame_are_those_of_the_arrays():
    pytest.importorskip("pandas")
    value = ALL["friction of many points"]
    row = value.to_dataframe().iloc[47]
    assert (row.pressure, row.velocity, row.mu) == (2e5, value.velocity[1, 7], value.mu[1, 7])


@pytest.mark.parametrize("name", {type(value): name for name, value in TABLES.items()}.values())
def test_plots_draw_into_the_axes_given_or_new_ones(name):
    pytest.importorskip("matplotlib").use("agg")
    from matplotlib import pyplot

    value = TABLES[name]
    axes = pyplot.figure(figsize=(3, 2)).add_subplot()
    assert value.plot(axes) is axes
    assert axes.has_data()
    assert axes.get_xlabel()
    assert axes.get_ylabel()
    axes.figure.canvas.draw()
    made = value.plot()
    assert made.has_data()
    assert made is not axes
    pyplot.close("all")


def test_what_is_missing_is_said_with_what_to_install():
    code = """
import sys
sys.modules.update(dict.fromkeys(["pandas", "xarray", "matplotlib"]))  # as if not installed
import asperity
from asperity.base.table import to_install
spectrum = asperity.TabulatedSpectrum(wavenumber=[1, 2], density=[4, 3])
for call, said in {
    spectrum.to_xarray: "xarray is missing: " + to_install("tables"),
    spectrum.to_dataframe: "pandas is missing: " + to_install("tables"),
    spectrum.plot: "matplotlib is missing: " + to_install("plot"),
}.items():
    try:
        call()
    except ImportError as error:
        assert str(error) == said, error
    else:
        raise AssertionError(said)
"""
    subprocess.run([sys.executable, "-c", code], check=True, timeout=60)


def test_a_band_is_drawn_over_velocity():
    pytest.importorskip("matplotlib").use("agg")
    fit = ALL["a fit of the slope"]
    points = {"pressure": [[1e5], [2e5]], "velocity": [0.1, 0.01]}
    band = asperity.friction_band(fit, RUBBER, **points, samples=20)
    assert band.lower.shape == band.pressure.shape == band.velocity.shape == (2, 2)
    mu = asperity.friction(fit.spectrum, RUBBER, **points).mu
    assert np.all((band.lower < mu) & (mu < band.upper))
    axes = band.plot()
    assert len(axes.collections) == 2 + 1  # and the legend's
    np.testing.assert_array_equal(axes.lines[0].get_ydata(), mu[0][::-1])
