"""DMA files: declared columns and units, encodings, decimal commas; refusals name the line."""

import numpy as np
import pytest

from asperity import InvalidInput, Isotherm, read_isotherms, read_strain_sweep

COLUMNS = {"frequency": "f", "temperature": "T", "storage": "stor", "loss": "loss"}
UNITS = {"frequency": "Hz", "temperature": "C", "modulus": "MPa"}
F = [0.1, 0.3, 1.0, 3.0, 10.0]
ROWS = [(t, f, (20 - t) / 10 * f**0.1, 0.5 * f**0.2) for t in (-10.0, 10.0) for f in F]


def text(separator=",", decimal=".", header="T,f,stor,loss", rows=ROWS):
    """A table of all rows; `header` is written with commas, which the separator replaces."""
    lines = [separator.join(repr(x).replace(".", decimal) for x in row) for row in rows]
    return "\n".join([header.replace(",", separator), *lines]) + "\n"


def read(folder, content, encoding="utf-8", **changed):
    file = folder / "dma.csv"
    file.write_bytes(content.encode(encoding))
    arguments = {"columns": COLUMNS, "units": UNITS, "modulus": "E"} | changed
    return read_isotherms(file, **arguments)


def check(isotherms):
    """The two isotherms of ROWS, in SI units."""
    assert [isotherm.temperature for isotherm in isotherms] == pytest.approx([263.15, 283.15])
    for isotherm, t in zip(isotherms, (-10, 10), strict=True):
        np.testing.assert_allclose(isotherm.angular_frequency, 2 * np.pi * np.array(F), rtol=1e-14)
        expected = 1e6 * (20 - t) / 10 * np.array(F) ** 0.1
        np.testing.assert_allclose(isotherm.storage_modulus, expected, rtol=1e-14)
        np.testing.assert_allclose(isotherm.loss_modulus, 5e5 * np.array(F) ** 0.2, rtol=1e-14)


@pytest.mark.parametrize(
    ("separator", "decimal"),
    [
        (",", "."),
        (";", "."),
        (";", ","),
        ("\t", "."),
        ("\t", ","),
        (" ", "."),
        (" ", ","),
        ("  ", "."),
    ],
)
def test_separators_and_decimal_commas(tmp_path, separator, decimal):
    check(read(tmp_path, text(separator, decimal)))


@pytest.mark.parametrize("encoding", ["utf-8", "utf-8-sig", "latin-1"])
@pytest.mark.parametrize("newline", ["\n", "\r\n"])
def test_encodings_comments_and_lines_of_units(tmp_path, encoding, newline):
    header = "# Prüfling Ä\nT=20;Mw=3;\n\nT,f,stor,loss\n°C,Hz,MPa,MPa"
    content = text(header=header).replace("\n", newline)
    check(read(tmp_path, f"{content}# end, 3 µm{newline}", encoding))


def test_rows_of_several_temperatures_in_any_order(tmp_path):
    order = np.random.default_rng(1).permutation(len(ROWS))
    check(read(tmp_path, text(rows=[ROWS[i] for i in order])))


def test_one_file_for_each_isotherm(tmp_path):
    files = []
    for name, rows in (("b.txt", ROWS[:5]), ("a.txt", ROWS[5:])):
        (tmp_path / name).write_text(text("\t", rows=rows))
        files.append(tmp_path / name)
    for paths in (files, files[::-1], map(str, files)):
        check(read_isotherms(paths, columns=COLUMNS, units=UNITS, modulus="E"))


def test_temperatures_that_drift_are_one_isotherm_at_their_mean(tmp_path):
    drift = [(t + 0.1 * i % 0.35, *rest) for i, (t, *rest) in enumerate(ROWS)]
    isotherms = read(tmp_path, text(rows=drift))
    expected = [273.15 + np.mean([row[0] for row in drift[k : k + 5]]) for k in (0, 5)]
    assert [isotherm.temperature for isotherm in isotherms] == pytest.approx(expected, abs=1e-9)


@pytest.mark.parametrize(("unit", "factor"), [("Pa", 1), ("kPa", 1e3), ("MPa", 1e6), ("GPa", 1e9)])
def test_units_of_moduli(tmp_path, unit, factor):
    first, _ = read(tmp_path, text(), units=UNITS | {"modulus": unit})
    assert first.storage_modulus[2] == pytest.approx(3 * factor, rel=1e-14, abs=0)
    assert first.loss_modulus[2] == pytest.approx(0.5 * factor, rel=1e-14, abs=0)


def test_units_of_frequency_and_temperature(tmp_path):
    kelvin = [(t + 273.15, *rest) for t, *rest in ROWS]
    units = {"frequency": "rad/s", "temperature": "K", "modulus": "MPa"}
    first, _ = read(tmp_path, text(rows=kelvin), units=units)
    np.testing.assert_array_equal(first.angular_frequency, F)
    assert first.temperature == pytest.approx(263.15)


@pytest.mark.parametrize(("poisson_ratio", "factor"), [(None, 3), (0.5, 3), (0.25, 2.5), (0, 2)])
def test_shear_moduli_become_youngs(tmp_path, poisson_ratio, factor):
    given = {} if poisson_ratio is None else {"poisson_ratio": poisson_ratio}
    first, _ = read(tmp_path, text(), modulus="G", **given)
    assert first.storage_modulus[2] == pytest.approx(factor * 3e6, rel=1e-14)
    assert first.loss_modulus[2] == pytest.approx(factor * 0.5e6, rel=1e-14)


@pytest.mark.parametrize(
    ("changed", "message"),
    [
        *(
            ({"units": {k: v for k, v in UNITS.items() if k != key}}, f"units: '{key}' is missing")
            for key in UNITS
        ),
        (
            {"units": UNITS | {"frequency": "kHz"}},
            "units: frequency = 'kHz': must be one of rad/s, Hz",
        ),
        ({"units": UNITS | {"modulus": "psi"}}, "units: modulus = 'psi': must be one of Pa, MPa"),
        ({"units": UNITS | {"temperature": "F"}}, "units: temperature = 'F': must be one of K, C"),
        ({"units": UNITS | {"storage": "Pa"}}, "units: 'storage' is unknown"),
        ({"columns": COLUMNS | {"strain": "e"}}, "columns: 'strain' is unknown"),
        ({"columns": {"frequency": "f"}}, "columns: 'loss' is missing"),
        ({"columns": COLUMNS | {"loss": "G2"}}, ": no line names the columns 'G2'; line "),
        ({"modulus": "K"}, 'modulus = "K": must be one of'),
        ({"modulus": "G", "poisson_ratio": 0.6}, r"poisson_ratio = 0\.6: must be in \[0, 0\.5\]"),
    ],
)
def test_nothing_is_guessed(tmp_path, changed, message):
    with pytest.raises(InvalidInput, match=message):
        read(tmp_path, text(), **changed)


def spoilt(row, column, value):
    rows = [list(row) for row in ROWS]
    rows[row][column] = value
    return rows


@pytest.mark.parametrize(
    ("row", "column", "value", "message"),
    [
        (3, 2, np.nan, "line 5: storage = nan: must be finite"),
        (3, 3, np.inf, "line 5: loss = inf: must be finite"),
        (7, 2, -1.0, "line 9: storage = -1: must be positive"),
        (7, 3, 0.0, "line 9: loss = 0: must be positive"),
        (0, 1, 0.0, "line 2: frequency = 0: must be positive"),
        (0, 0, -300.0, r"isotherm in lines 2 to 2: temperature = -26\.85: must be in kelvin"),
    ],
)
def test_bad_values_are_named_by_file_and_line(tmp_path, row, column, value, message):
    content = text(rows=spoilt(row, column, value))
    with pytest.raises(InvalidInput, match=message) as caught:
        read(tmp_path, content)
    assert str(caught.value).startswith(f"{tmp_path / 'dma.csv'}: ")


@pytest.mark.parametrize(
    ("content", "message"),
    [
        (text().replace("0.5\n", "oops\n", 1), "line 4: loss = 'oops'"),
        (text() + "10.0,1\n", "line 12 has 2 cells, must have"),
        (
            text() + "10,0,20,0,5e6,1,2,3,4,5,6\n",
            r"line 12 has 11 cells, the names \d: numbers have a decimal point",
        ),
        (text(rows=[]), "no numbers below the names of the columns"),
        ("", "is empty"),
        (text(rows=ROWS[:3]), "has 3 different entries .* must have 4 or more for an isotherm$"),
        (text(rows=ROWS[:1] * 5), "has 1 different .*; rows of one frequency are a strain sweep"),
        (text(rows=ROWS[:8]), "isotherm in lines 7 to 9: .*has 3 different entries"),
    ],
)
def test_bad_files(tmp_path, content, message):
    with pytest.raises(InvalidInput, match=message):
        read(tmp_path, content)


def isotherm(**changed):
    values = {"temperature": 300.0, "angular_frequency": [1.0, 2, 4, 8, 16]}
    values |= {"storage_modulus": [1e6, 2e6, 3e6, 4e6, 5e6], "loss_modulus": [1e5] * 5}
    return Isotherm(**{**values, **changed})


def test_points_within_one_percent_are_averaged_in_the_logarithm_and_said():
    result = isotherm(
        angular_frequency=[1.0, 2, 4, 2.019, 16], loss_modulus=[1e5, 1e5, 1e5, 4e5, 1e5]
    )
    np.testing.assert_allclose(result.angular_frequency, [1, (2 * 2.019) ** 0.5, 4, 16])
    np.testing.assert_allclose(result.storage_modulus, [1e6, 8e12**0.5, 3e6, 5e6])
    np.testing.assert_allclose(result.loss_modulus, [1e5, 2e5, 1e5, 1e5])
    (note,) = result.notes
    assert note.startswith("isotherm at 300 K: rows 1, 3 lie within 1 % of 2.009 rad/s")
    assert isotherm(angular_frequency=[1.0, 2, 4, 2.021, 16]).notes == ()


def test_points_that_are_one_do_not_make_four():
    with pytest.raises(InvalidInput, match="has 3 different entries at temperature = 300: must"):
        isotherm(angular_frequency=[1.0, 1.001, 4, 4.001, 16])


def test_frequencies_in_any_order():
    result = isotherm(angular_frequency=[16.0, 8, 4, 2, 1])
    np.testing.assert_array_equal(result.angular_frequency, [1, 2, 4, 8, 16])
    np.testing.assert_array_equal(result.storage_modulus, [5e6, 4e6, 3e6, 2e6, 1e6])


def test_a_sweep_of_strain(tmp_path):
    file = tmp_path / "strain.csv"
    file.write_text("e;f;T;stor;loss\n1,0;10;20,1;4;1\n0,1;10;19,9;5;0,9\n10;10;20;3;0,8\n")
    sweep = read_strain_sweep(
        file,
        columns=COLUMNS | {"strain": "e"},
        units=UNITS | {"strain": "%"},
        modulus="G",
    )
    assert sweep.temperature == pytest.approx(293.15)
    assert sweep.angular_frequency == pytest.approx(20 * np.pi)
    np.testing.assert_allclose(sweep.strain, [1e-3, 1e-2, 0.1])
    np.testing.assert_allclose(sweep.storage_modulus, [15e6, 12e6, 9e6])
    np.testing.assert_allclose(sweep.loss_modulus, [2.7e6, 3e6, 2.4e6])
    with pytest.raises(InvalidInput, match="units: 'strain' is missing"):
        read_strain_sweep(file, columns=COLUMNS | {"strain": "e"}, units=UNITS, modulus="G")
