"""Numbers in messages as they were typed, from options and from scenes."""

import pickle
from pathlib import Path

import pytest

from asperity import InvalidInput
from asperity.base.diagnostics import Argument, Value
from asperity.io.typed import Typed, TypedWhole, as_typed
from asperity.scene.scene import load_scene, read_toml
from helpers.scenes import SCENE
from helpers.shell import status_of


@pytest.mark.parametrize(
    ("old", "new", "typed"),
    [
        ("q1_per_m = 1e5", "q1_per_m = 7.00e99", "[surface] q1_per_m = 7.00e99: "),
        ("1e9, 1e8, 1e7", "1e9, -7.00e9, 1e7", " = -7.00e9: "),
        ("[81e3, 2e5]", "{ from = 1.0e5, to = 7.00e12, points = 4 }", " = 7.00e12: "),
        ("[81e3, 2e5]", "100000000000", "[conditions] pressure_pa = 100000000000: "),
        ("[81e3, 2e5]", "[1e5, 1_000.0e9]", "[conditions] pressure_pa = 1_000.0e9: "),
        ("8.3e6", "-7.00e-99", "[adhesion] shear_stress_pa = -7.00e-99: "),
    ],
)
def test_scenes(folder: Path, old: str, new: str, typed: str) -> None:
    path = folder / "wrong.toml"
    path.write_text(SCENE.replace(old, new))
    with pytest.raises(InvalidInput) as error:
        load_scene(path).friction()
    assert typed in str(error.value)


SCAN = ["spectrum", "scan.npy", "--pixel-size", "1e-5", "--unit", "m"]


@pytest.mark.parametrize(
    "arguments",
    [
        [*SCAN, "--q-max", "7.00e99"],
        [*SCAN, "--channel", "7_0"],
        [*SCAN, "--tiles", "064,10_00"],
        ["area", "scene.toml", "--points", "1_000_000"],
        ["map", "scene.toml", "--rtol", "0.50"],
        ["map", "scene.toml", "--checked", "-07"],
        ["app", "--port", "99_999_999"],
    ],
)
def test_options(folder: Path, capsys: pytest.CaptureFixture[str], arguments: list[str]) -> None:
    assert status_of(arguments) == 2
    told = capsys.readouterr().err
    assert arguments[-2] in told
    assert arguments[-1] in told


@pytest.mark.parametrize(
    ("name", "value", "given", "typed"),
    [
        ("--q", 1e6, {"--q": Typed("1000000.0")}, "1000000.0"),
        ("--q-max", 5.0, {"--q": Typed("5.0")}, "shown"),  # another option
        ("--q", 5.0, {"--q": Typed("5.1")}, "shown"),  # another number
        ("--n", 5.0, {"--n": (TypedWhole("05"), TypedWhole("6"))}, "05"),
        ("[a] b", 2.0, {"[a] b": [Typed("1.0"), Typed("2.0")]}, "2.0"),
        ("[a] b", 1.0, {"[a] b": True}, "shown"),
        ("[a] b", 1.0, {"[a] b": 10**400}, "shown"),
    ],
)
def test_numbers_are_as_they_were_typed(
    name: str, value: float, given: dict[str, object], typed: str
) -> None:
    sentence = (Argument(name), " = ", Value("shown", (value,)), ": no")
    assert "".join(as_typed(sentence, given)) == f"{name} = {typed}: no"


def test_numbers_are_plain_where_they_are_written(tmp_path: Path) -> None:
    path = tmp_path / "t.toml"
    path.write_text("[a]\nb = 1_000.00\nc = 7.00e99\n")
    table = read_toml(path)["a"]
    assert (repr(table["b"]), repr(table["c"])) == ("1000.0", "7e+99")
    again = pickle.loads(pickle.dumps(table["c"]))
    assert (again, str(again)) == (7e99, "7.00e99")
