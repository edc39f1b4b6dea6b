"""What an FMU is made of: its description, source, binaries, licence, for both standards."""

import zipfile

import fmpy
from fmpy.validation import validate_fmu

from asperity import export_fmu
from asperity.fmu.export import PLATFORMS, platforms


def test_both_standards_are_valid(files):
    for path in files.values():
        assert validate_fmu(str(path)) == []


def test_the_same_map_gives_the_same_bytes(road, files, tmp_path):
    export_fmu(road, tmp_path / "again.fmu", fmi="3.0", points=3)
    assert (tmp_path / "again.fmu").read_bytes() == files["3.0", 3].read_bytes()


def test_description_has_units_and_words(files):
    for (fmi, count), path in files.items():
        described = fmpy.read_model_description(str(path))
        assert described.fmiVersion == fmi
        listed = {variable.name: variable for variable in described.modelVariables}
        first = "pressure[1]" if fmi == "2.0" and count else "pressure"
        assert listed[first].unit == "Pa"
        assert listed[first.replace("pressure", "traction")].unit == "Pa"
        assert listed[first.replace("pressure", "velocity")].unit == "m/s"
        assert all(one.description for one in described.modelVariables if one.name != "time")
        if fmi == "2.0" and count:
            assert [name for name in listed if name.startswith("mu[")] == [
                "mu[1]",
                "mu[2]",
                "mu[3]",
            ]


def test_binaries_carry_no_gpl(files):
    with zipfile.ZipFile(files["2.0", None]) as archive:
        names = archive.namelist()
        assert "documentation/licenses/license.txt" in names
        sources = [name for name in names if name.startswith("sources/")]
        for name in sources:
            assert "SPDX-License-Identifier: 0BSD" in archive.read(name).decode()
        folders = {PLATFORMS[one][0] for one in platforms()}
        assert folders == {name.split("/")[1] for name in names if name.startswith("binaries/")}
