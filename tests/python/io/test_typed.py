"""Numbers in messages as they were typed, from options and from scenes."""

import pickle
from pathlib import Path

import numpy as np
import pytest

import asperity
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
    "correction": {"kind": '"nayak-s-factor"'},
    "adhesion": {"shear_stress_pa": "8.3e6"},
    "heating": {
        "density_kg_m3": "1100",
        "heat_capacity_j_kg_k": "1700",
        "conductivity_w_m_k": "0.2",
        "contact_diameter_m": "1e-3",
    },
    "solver": {"rtol": "1e-6"},
}
# of every key a text that is refused, and the part of it that the message has
REFUSED = [
    *(("surface", key, "7.00e99", "7.00e99") for key in SCENE["surface"]),
    ("surface", "rolloff_per_m", "7.0e8", "7.0e8"),
    ("surface", "slope_cutoff", "-1.30", "-1.30"),
    ("surface", "contamination_size_m", "1.00e-2", "1.00e-2"),
    ("rubber", "equilibrium_modulus_pa", "7.00e99", "7.00e99"),
    ("rubber", "moduli_pa", "[1e7, -7.00e9]", "-7.00e9"),
    ("rubber", "relaxation_times_s", "[-0.10e400, 1e-6]", "-0.10e400"),
    ("rubber", "wlf_c1", "7.00e99", "7.00e99"),
    ("rubber", "wlf_c2_k", "-7.00e9", "-7.00e9"),
    ("rubber", "reference_temperature_c", "7.00e3", "7.00e3"),
    ("conditions", "pressure_pa", "{ from = 1.0e5, to = 7.00e12, points = 4 }", "7.00e12"),
    ("conditions", "pressure_pa", "100000000000", "100000000000"),
    ("conditions", "velocity_m_s", "[1e-3, 1_000.0e9]", "1_000.0e9"),
    ("conditions", "temperature_c", "7.00e3", "7.00e3"),
    ("conditions", "poisson_ratio", "0.700", "0.700"),
    ("correction", "friction_gamma", "1.50", "1.50"),
    *(("adhesion", key, "-7.00e-99", "-7.00e-99") for key in ("shear_stress_pa", "width")),
    ("adhesion", "reference_velocity_m_s", "7.00e9", "7.00e9"),
    *(("heating", key, "7.00e-99", "7.00e-99") for key in SCENE["heating"]),
    ("heating", "interface_share", "1.50", "1.50"),
    ("heating", "macro_area", "1.50", "1.50"),
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
    np.save("scan.npy", np.random.default_rng(1).normal(size=(600, 600)))
    tables = {name: table for name, table in SCENE.items() if name != "heating"}
    Path("scene.toml").write_text(text_of(tables))
    Path("road.fmap").write_bytes(MADE)
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


MADE = asperity.friction_map(
    asperity.SelfAffineSpectrum(rms_height=2e-4, hurst=0.8, q0=2e3, q1=2e4),
    asperity.PronySeries(equilibrium_modulus=3e6, moduli=[1e8], relaxation_times=[1e-4]),
    pressure=(1e5, 2e5),
    velocity=(1e-3, 1e-2),
    rtol=1e-2,
    checked=100,
).to_bytes()
SCAN = ["spectrum", "scan.npy", "--pixel-size", "1e-5", "--unit", "um"]
MAP = ["map", "scene.toml", "--output", "road.fmap"]
FIT = ["fit", "scene.toml", "measured.csv", "--hold"]
PRESS = ["validate", "--surface", "scan.npy", "--pixel-size", "1e-5", "--unit", "um"]
OPTIONS = [
    ([*SCAN, "--q-max"], "7e99"),
    ([*SCAN, "--q-max"], "7.00e99"),
    ([*SCAN, "--q-min"], "0.70e-30"),
    ([*SCAN, "--max-dropouts"], "1.50"),
    ([*SCAN, "--channel"], "7_0"),
    ([*SCAN, "--tiles"], "064"),
    ([*SCAN, "--tiles"], "064,10_00"),
    ([*SCAN, "--tiles", "512", "--overlap"], "2.50e0"),
    ([*SCAN, "--tiles", "512", "--threads"], "1_000_000"),
    ([*SCAN, "--overlap"], "2.50e-1"),
    ([*SCAN, "--threads"], "007"),
    (["spectrum", "scan.npy", "--unit", "um", "--pixel-size"], "7.50e5"),
    (["area", "scene.toml", "--points"], "1_000_000"),
    ([*MAP, "--pressure"], "8.0e5,7.0e5"),
    ([*MAP, "--velocity"], "1.0e-9,7.00e99"),
    ([*MAP, "--rtol"], "0.50"),
    ([*MAP, "--checked"], "-07"),
    ([*FIT], "width=-7.00e-1"),
    ([*FIT], "shear_stress_pa=7.00e99"),
    ([*PRESS, "--q0"], "7.00e99"),
    ([*PRESS, "--periodic", "--loads"], "1e-2,-7.00e-1"),
    (["validate", "--sliding", "--velocities"], "1.0e-3,7.00e99"),
    (["fmu", "road.fmap", "--output", "road.fmu", "--points"], "-07"),
    (["app", "--port"], "99_999_999"),
]
# a pair of which one number is told
ONE_OF = {"1.0e-9,7.00e99": "7.00e99", "1.0e-3,7.00e99": "7.00e99", "1e-2,-7.00e-1": "-7.00e-1"}


@pytest.mark.parametrize(("arguments", "text"), OPTIONS)
def test_options(
    folder: Path, capsys: pytest.CaptureFixture[str], arguments: list[str], text: str
) -> None:
    try:
        status = main([*arguments, text])
    except SystemExit as refused:
        status = refused.code
    assert status == 2
    told = capsys.readouterr().err
    option = arguments[-1]
    name, _, held = text.partition("=")
    if held:
        option, text = f"{option} {name}", held
    assert option in told
    assert ONE_OF.get(text, text) in told.removesuffix("\n").split(" (see ")[0]


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
