"""Numbers in messages as they were typed, from options and from scenes."""

import pickle
from pathlib import Path

import numpy as np
import pytest

from asperity import InvalidInput, OutOfRange
from asperity.base.diagnostics import Argument, Value
from asperity.cli import main
from asperity.io.typed import Typed, TypedWhole, as_typed
from asperity.scene.scene import load_scene, read_toml

SCENE = {
    "surface": {"rms_height_m": "265.7e-6", "hurst": "0.87", "q0_per_m": "2e3", "q1_per_m": "24e3"},
    "rubber": {
        "equilibrium_modulus_pa": "3e6",
        "moduli_pa": "[1e7, 1e9]",
        "relaxation_times_s": "[1e-2, 1e-6]",
        "wlf_c1": "8.06",
        "wlf_c2_k": "111.6",
        "reference_temperature_c": "20",
    },
    "conditions": {"pressure_pa": "81e3", "velocity_m_s": "[1e-3, 1.0]", "temperature_c": "20"},
}
# a key of every table, of a list and of a sweep, and the part of its text that the message has
REFUSED = [
    ("surface", "q1_per_m", "7.00e99", "7.00e99"),
    ("rubber", "moduli_pa", "[1e7, -7.00e9]", "-7.00e9"),
    ("rubber", "reference_temperature_c", "7.00e3", "7.00e3"),
    ("conditions", "pressure_pa", "{ from = 1.0e5, to = 7.00e12, points = 4 }", "7.00e12"),
    ("conditions", "pressure_pa", "100000000000", "100000000000"),
    ("conditions", "velocity_m_s", "[1e-3, 1_000.0e9]", "1_000.0e9"),
    ("correction", "friction_gamma", '1.50\nkind = "nayak-s-factor"', "1.50"),
    ("adhesion", "shear_stress_pa", "-7.00e-99", "-7.00e-99"),
    ("solver", "rtol", "0.50", "0.50"),
]


def text_of(tables: dict[str, dict[str, str]]) -> str:
    return "\n".join(
        f"[{name}]\n" + "".join(f"{key} = {text}\n" for key, text in table.items())
        for name, table in tables.items()
    )


def scene_file(folder: Path, table: str, key: str, text: str) -> Path:
    """SCENE with one key as it is given."""
    path = folder / "wrong.toml"
    path.write_text(text_of({**SCENE, table: {**SCENE.get(table, {}), key: text}}))
    return path


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.chdir(tmp_path)
    np.save("scan.npy", np.random.default_rng(1).normal(size=(100, 100)))
    Path("scene.toml").write_text(text_of(SCENE))
    Path("measured.csv").write_text("velocity_m_s,mu\n1e-3,1\n1e-2,1.2\n1e-1,1.3\n1,0.9\n")
    return tmp_path


@pytest.mark.parametrize(("table", "key", "text", "typed"), REFUSED)
def test_scenes(folder: Path, table: str, key: str, text: str, typed: str) -> None:
    path = scene_file(folder, table, key, text)
    with pytest.raises((InvalidInput, OutOfRange)) as error:
        load_scene(path, for_friction=True).friction()
    told = str(error.value)
    assert f"[{table}] {key}" in told
    assert f" = {typed}: " in told


SCAN = ["spectrum", "scan.npy", "--pixel-size", "1e-5", "--unit", "um"]
MAP = ["map", "scene.toml", "--output", "road.fmap"]
OPTIONS = [  # the last text, or that which is named behind it, is in the message
    [*SCAN, "--q-max", "7.00e99"],
    [*SCAN, "--channel", "7_0"],
    [*SCAN, "--tiles", "064,10_00"],
    ["spectrum", "scan.npy", "--unit", "um", "--pixel-size", "7.50e5"],
    ["area", "scene.toml", "--points", "1_000_000"],
    [*MAP, "--rtol", "0.50"],
    [*MAP, "--checked", "-07"],
    [*MAP, "--velocity", "1.0e-9,7.00e99", "7.00e99"],
    ["fit", "scene.toml", "measured.csv", "--hold", "width=-7.00e-1", "width = -7.00e-1"],
    ["validate", "--sliding", "--velocities", "1.0e-3,7.00e99", "7.00e99"],
    ["app", "--port", "99_999_999"],
]


@pytest.mark.parametrize("arguments", OPTIONS)
def test_options(folder: Path, capsys: pytest.CaptureFixture[str], arguments: list[str]) -> None:
    typed = arguments[-1]
    asked = arguments if arguments[-2].startswith("--") else arguments[:-1]
    try:
        status = main(asked)
    except SystemExit as refused:
        status = refused.code
    assert status == 2
    told = capsys.readouterr().err
    assert asked[-2] in told
    assert typed in told


def test_notes_on_options(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    asked = ["--velocity", "1.0e-6,2.00e2", "--rtol", "1e-2", "--checked", "100"]
    assert main([*MAP, *asked]) == 0
    assert "note: --velocity = 2.00e2: unusual, above 150 m/s" in capsys.readouterr().err


def test_notes_on_scenes(folder: Path) -> None:
    scene = load_scene(scene_file(folder, "surface", "slope_cutoff", "9.90"), for_friction=True)
    assert any("slope_cutoff = 9.90 is not reached" in note for note in scene.notes)
    path = scene_file(folder, "conditions", "velocity_m_s", "2.00e2")
    notes = load_scene(path, for_friction=True).notes
    assert any("[conditions] velocity_m_s = 2.00e2: unusual" in note for note in notes)


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
