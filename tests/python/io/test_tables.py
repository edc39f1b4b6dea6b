"""Tables of DMA as programs of instruments write them."""

from typing import Any

import numpy as np
import pytest

import asperity
from asperity import InvalidInput, read_isotherms, read_master_curve
from asperity.io import plausible
from asperity.scene.scene import load_scene
from helpers.rubbers import prony
from helpers.scenes import CONDITIONS, SURFACE

COLUMNS: dict[str, Any] = {"frequency": "f", "storage": "E'", "loss": "E''"}
UNITS = {"frequency": "Hz", "modulus": "MPa"}
MODULUS = prony(3e6, 10 ** np.linspace(6, 9, 16), 10 ** np.linspace(2, -8, 16)).modulus
HERTZ = np.geomspace(1e-12, 1e3, 40)


def rows(hertz=HERTZ, mark=",", scale=1e-6):
    moduli = [(f, scale * MODULUS(2 * np.pi * f)) for f in hertz]
    return "".join(f"{f:.17g}{mark}{e.real:.9g}{mark}{e.imag:.9g}\n" for f, e in moduli)


def read(path, content, **changed):
    path.write_text(content, encoding="utf-8")
    given = {"columns": COLUMNS, "units": UNITS, "modulus": "E", **changed}
    return read_master_curve(path, **given)


def check(curve, hertz=HERTZ):
    w = 2 * np.pi * hertz
    np.testing.assert_allclose(curve.angular_frequency, w, rtol=1e-12)
    np.testing.assert_allclose(curve.modulus(w), MODULUS(w), rtol=1e-8)


@pytest.mark.parametrize("places", [(1, 2, 3), ("1", "2", "3")])
def test_columns_without_names_are_given_by_their_places(tmp_path, places):
    columns = dict(zip(COLUMNS, places, strict=True))
    check(read(tmp_path / "a.csv", "of the lab\n" + rows(mark="\t"), columns=columns))
    with pytest.raises(InvalidInput, match="no line has numbers in the columns '1', '2', '4'"):
        read(tmp_path / "a.csv", rows(), columns={**columns, "loss": 4})
    with pytest.raises(InvalidInput, match="columns: loss = 0: must be 1 or more"):
        read(tmp_path / "a.csv", rows(), columns={**columns, "loss": 0})


@pytest.mark.parametrize(
    "head", ["f,E',E''\n{}", "f,E',E''\nHz,{u},{u}\n", "f [Hz],E' ({u}),E''/{u}\n"]
)
@pytest.mark.parametrize("unit", ["kPa", "Pa", "GPa", "psi"])
def test_a_unit_of_the_file_that_is_another_is_refused(tmp_path, head, unit):
    head = head.format(unit, u=unit) if "{u}" in head else f"f,E',E''\n[Hz],[{unit}],[{unit}]\n"
    names = dict(zip(COLUMNS, head.splitlines()[0].split(","), strict=True))
    with pytest.raises(InvalidInput, match=rf"modulus = 'MPa': must be '{unit}', as the") as caught:
        read(tmp_path / "a.csv", head + rows(), columns=names)
    assert caught.value.code == "other-unit"
    with pytest.raises(InvalidInput, match="frequency = 'rad/s': must be 'Hz'"):
        read(tmp_path / "a.csv", "f,E',E''\nHz,,\n" + rows(), units={**UNITS, "frequency": "rad/s"})


def test_rows_of_one_frequency_are_averaged_and_any_order_is_read(tmp_path):
    twice = np.concatenate([HERTZ[::-1], HERTZ[5:9], np.nextafter(HERTZ[11:20], 1)])
    with plausible.collected() as notes:
        curve = read(tmp_path / "a.csv", "f,E',E''\n" + rows(twice))
    check(curve)
    assert [note.code for note in notes] == ["rows-averaged"]
    road = asperity.SelfAffineSpectrum(rms_height=1e-5, hurst=0.8, q0=1e3, q1=1e5)
    result = asperity.friction(road, curve, pressure=1e5, velocity=[1e-3, 1e-2])
    assert np.all(result.mu > 0.01)


@pytest.mark.parametrize("nothing", ["", "---", "n/a"])
def test_an_empty_cell_is_named_as_one(tmp_path, nothing):
    with pytest.raises(InvalidInput, match="line 4: storage is empty"):
        read(tmp_path / "a.csv", f"f,E',E''\n1,2,3\n2,3,4\n3,{nothing},5\n")


def test_what_is_declared_is_declared_whole(tmp_path):
    with pytest.raises(InvalidInput, match="units: is missing, which goes with columns"):
        read(tmp_path / "a.csv", rows(), units=None)
    with pytest.raises(InvalidInput, match="temperatures has one for each file"):
        read_isotherms(
            tmp_path / "a.csv", columns=COLUMNS, units={**UNITS, "temperature": "C"}, modulus="E"
        )


@pytest.mark.parametrize(
    ("encoding", "mark"),
    [("utf-16", ""), ("utf-16-le", ""), ("utf-16-be", ""), ("utf-8", "\ufeff"), ("latin-1", "")],
)
def test_encodings(tmp_path, encoding, mark):
    path = tmp_path / "a.txt"
    path.write_bytes(
        (mark + "f\tE'\tE''\tT\nHz\tMPa\tMPa\t°C\n" + rows(mark="\t")).encode(encoding)
    )
    check(read_master_curve(path, columns=COLUMNS, units=UNITS, modulus="E"))


def workbook(path, sheets):
    if path.suffix == ".xls":
        book = pytest.importorskip("xlwt").Workbook()
        for name, content in sheets.items():
            sheet = book.add_sheet(name)
            for y, row in enumerate(content):
                for x, cell in enumerate(row):
                    sheet.write(y, x, cell)
        book.save(str(path))
        return path
    book = pytest.importorskip("openpyxl").Workbook()
    book.remove(book.active)
    for name, content in sheets.items():
        sheet = book.create_sheet(name)
        for row in content:
            sheet.append(row)
    book.save(path)
    return path


NUMBERS = [[float(cell) for cell in line.split(",")] for line in rows().splitlines()]


@pytest.mark.parametrize("name", ["a.xlsx", "a.xls"])
def test_workbooks(tmp_path, name):
    table = [["f", "E'", "E''"], ["Hz", "MPa", "MPa"], *([*row] for row in NUMBERS)]
    path = workbook(tmp_path / name, {"header": [["type", "sweep"], ["load", 0.1]], "data": table})
    check(read_master_curve(path, columns=COLUMNS, units=UNITS, modulus="E"))
    table[5][1] = "---"
    path = workbook(tmp_path / name, {"header": [["type", "sweep"]], "data": table})
    with pytest.raises(InvalidInput, match='row 6 of sheet "data": storage is empty'):
        read_master_curve(path, columns=COLUMNS, units=UNITS, modulus="E")


@pytest.mark.parametrize("begin", [b"PK\x03\x04", b"\xd0\xcf\x11\xe0"])
def test_damaged_workbooks(tmp_path, begin):
    path = tmp_path / "a.xlsx"
    path.write_bytes(begin + b"\x00" * 700)
    with pytest.raises(InvalidInput, match=r"a\.xlsx: not a sound workbook") as caught:
        read_master_curve(path, columns=COLUMNS, units=UNITS, modulus="E")
    assert "\n" not in str(caught.value)


SCENE = """
[rubber]
master_curve = "a.csv"
columns = {frequency = 1, storage = 2, loss = 3}
units = {frequency = "Hz", modulus = "MPa"}
modulus = "G"
"""


def test_a_scene_takes_them(tmp_path):
    (tmp_path / "a.csv").write_text(rows())
    (tmp_path / "scene.toml").write_text(SURFACE + SCENE + CONDITIONS)
    rubber = load_scene(tmp_path / "scene.toml").rubber
    np.testing.assert_allclose(rubber.modulus(1e-3), 3 * MODULUS(1e-3), rtol=0.01)
    (tmp_path / "a.csv").write_text("Hz,kPa,kPa\n" + rows())
    (tmp_path / "scene.toml").write_text(SURFACE + SCENE.replace("1,", "true,") + CONDITIONS)
    with pytest.raises(InvalidInput, match=r"\[rubber\] columns = .*a table of names or places"):
        load_scene(tmp_path / "scene.toml")
