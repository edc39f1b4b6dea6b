"""`export_fmu` and the command `fmu`: what they refuse, and what they tell."""

import pytest
from fmpy.validation import validate_fmu

import asperity
from asperity import InvalidInput, export_fmu


@pytest.mark.parametrize(
    ("options", "message"),
    [
        ({"name": "my road"}, r"name = 'my road': must be an identifier of C, such as friction"),
        ({"name": ""}, r"name = '': must be an identifier of C"),
        ({"fmi": "1.0"}, r'fmi = "1.0": must be one of "2.0", "3.0"'),
        ({"points": 0}, r"points = 0: must be a whole number, from 1 to 1000000"),
        ({"points": 2.5}, r"points = 2.5: must be a whole number"),
    ],
)
def test_bad_input_is_one_line_and_writes_nothing(road, tmp_path, options, message):
    with pytest.raises(InvalidInput, match=message):
        export_fmu(road, tmp_path / "road.fmu", **options)
    assert list(tmp_path.iterdir()) == []


def test_other_bad_input(road, tmp_path):
    with pytest.raises(InvalidInput, match=r"^map = 3: must be a FrictionMap$"):
        export_fmu(3, tmp_path / "road.fmu")
    with pytest.raises(InvalidInput, match=r"cannot be written: "):
        export_fmu(road, tmp_path / "missing" / "road.fmu")
    with pytest.raises(InvalidInput, match=r"cannot be written: |is a directory"):
        export_fmu(road, tmp_path)
    assert list(tmp_path.iterdir()) == []


def test_command(road, tmp_path, capsys):
    from asperity.cli import main

    road.save(tmp_path / "road.fmap")
    output = tmp_path / "road.fmu"
    assert main(["fmu", str(tmp_path / "road.fmap"), "--output", str(output), "--fmi", "3.0"]) == 0
    assert "binaries = " in capsys.readouterr().out
    assert validate_fmu(str(output)) == []
    assert main(["fmu", str(output), "--output", str(tmp_path / "no.fmu")]) == 2
    assert "is no friction map: it begins otherwise" in capsys.readouterr().err
    assert main(["fmu", str(tmp_path / "road.fmap"), "--output", str(output), "--name", "1"]) == 2
    assert "--name = '1': must be an identifier of C" in capsys.readouterr().err
    assert main(["fmu", str(output), "--output", str(output)]) == 2
    assert "is an input" in capsys.readouterr().err
    other = bytearray(road.to_bytes())
    other[12] = 3  # its version
    (tmp_path / "other.fmap").write_bytes(other)
    assert main(["fmu", str(tmp_path / "other.fmap"), "--output", str(tmp_path / "no.fmu")]) == 2
    assert "other.fmap: has layout version 3: must be 1 or 2" in capsys.readouterr().err
    with pytest.raises(SystemExit) as ended:
        main(
            ["fmu", str(tmp_path / "road.fmap"), "--output", str(tmp_path / "no.fmu"), "--fmi", "1"]
        )
    assert ended.value.code == 2
    assert "invalid choice: '1' (choose from '2.0', '3.0')" in capsys.readouterr().err
    assert not (tmp_path / "no.fmu").exists()
    assert asperity.export_fmu is export_fmu
