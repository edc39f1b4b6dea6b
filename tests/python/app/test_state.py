"""What the app computes is what the shell computes, and what it is given cannot do harm."""

import io
import os
import pickle
import tomllib
import zipfile
from pathlib import Path

import numpy as np
import pytest

import asperity
from asperity.app import files
from asperity.app.downloads import map_of, report_of, scene_archive, table_csv
from asperity.app.guess import guess_columns
from asperity.app.loaded import OF_SCAN, PLAIN, offered
from asperity.app.state import MOST_VARIANTS, State
from asperity.app.worker import contributions
from asperity.cli.main import main
from asperity.demo import input_files
from asperity.scene.model import Scene
from asperity.scene.scene import load_scene, scene_text
from helpers.dropped import dma_bytes, scan_bytes

pytest.importorskip("matplotlib", reason="the app needs asperity[app]")


def drop_both(state: State) -> None:
    """A scan and sweeps, as the page takes them."""
    state.keep_scan("C:\\data\\my scan.NPY", scan_bytes())
    state.use_scan({"pixel_size_m": 5e-6, "unit": "um"})()
    name = state.keep_dma("dma.csv", dma_bytes())
    guess = state.guesses[name]
    chosen = {"columns": guess.columns, "units": guess.units, "modulus": guess.modulus}
    state.use_dma([name], {**chosen, "prony": True, "beyond": True})()


def drop_scan(state: State, name: str, content: bytes) -> None:
    state.keep_scan(name, content)
    state.use_scan({})()


CASES = {
    "as it opens": lambda state: None,
    "hot": lambda state: state.use("heating", True),
    "hot and dry": lambda state: (state.use("heating", True), state.use("adhesion", False)),
    "a law, cold and dry": lambda state: (
        setattr(state, "surface", "law"),
        state.use("adhesion", False),
    ),
    "two files": drop_both,
    **{kind: lambda state, kind=kind: state.choose_correction(kind) for kind in (*PLAIN, "none")},
}


@pytest.mark.parametrize("case", CASES)
def test_the_downloaded_scene_gives_the_same_bytes_in_the_shell(
    case: str, state: State, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    CASES[case](state)
    scene = state.load()
    with zipfile.ZipFile(io.BytesIO(scene_archive(state)())) as archive:
        assert all(Path(name).name == name for name in archive.namelist())
        archive.extractall(tmp_path)
    monkeypatch.chdir(tmp_path)
    assert main(["friction", "scene.toml", "--output", "mu.csv"]) == 0
    assert (tmp_path / "mu.csv").read_bytes() == table_csv(scene, scene.friction())


def test_corrections_of_scans_are_offered_with_a_map_alone(state: State) -> None:
    assert offered(state.load()) == (*PLAIN, *OF_SCAN)
    state.choose_correction("local-peaks", state.load())
    first = state.load()
    state.conditions = {**state.conditions, "pressure_pa": 2e5}
    assert state.load().correction is first.correction  # the peaks are looked for once
    state.surface = "law"
    with pytest.raises(asperity.InvalidInput, match="is made from a scan: choose a scan"):
        state.load()
    state.choose_correction("partial-contact")
    assert offered(state.load()) == tuple(PLAIN)


def test_a_scene_reads_back_as_it_was_written() -> None:
    odd = 'a "quoted" \\ \x7f \x00 \n \u2028 é'
    tables = {
        "surface": {"file": odd, "pixel_size_m": [1e-6, 1.1e-6], "fit": "self-affine"},
        "rubber": {"moduli_pa": [], "columns": {"storage": "G'", 'a"b': 'G"'}, "prony": True},
        "conditions": {"pressure_pa": 0.1 + 0.2, "points": 10**17, "v": np.float64(1e-300)},
    }
    assert tomllib.loads(scene_text(tables)) == tables


def test_contributions_sum_to_the_hysteresis(state: State) -> None:
    for heat in (False, True):
        state.use("heating", heat)
        scene = state.load()
        k = int(np.searchsorted(scene.velocity, 0.5))
        q, density = contributions(scene, float(scene.velocity[k]))
        total = np.trapezoid(np.ravel(density), np.log(q))
        assert total == pytest.approx(scene.friction().hysteresis[0, k], rel=0.03)


def test_the_surface_is_read_once(state: State) -> None:
    first = state.load()
    state.conditions["pressure_pa"] = 2e5
    state.conditions["temperature_c"] = 40
    second = state.load()
    assert second.surface is first.surface
    assert second.built_rubber is not first.built_rubber
    state.surfaces["shipped scan"]["detrend"] = "plane"
    assert state.load().surface is not first.surface


def test_what_is_kept_is_noted_again_and_absurd_numbers_are_refused(state: State) -> None:
    rubber = {"equilibrium_modulus_pa": 3.0, "moduli_pa": [2e10], "relaxation_times_s": [1e-3]}
    state.rubbers, state.rubber = {"odd": rubber}, "odd"
    shell = load_scene_of(state)
    for _ in range(2):
        scene = state.load()
        assert scene.notes == shell.notes
        assert scene.unusual
    state.keep_scan("scan.npy", scan_bytes())
    with pytest.raises(asperity.InvalidInput, match="must be at"):
        state.use_scan({"pixel_size_m": 5e-6, "unit": "m"})()


def load_scene_of(state: State) -> Scene:
    """The present scene as the shell reads it."""
    path = state.folder.path / "scene.toml"
    path.write_text(state.text)
    return load_scene(path, for_friction=True)


HOSTILE = (
    "../../../etc/passwd",
    "..\\..\\boot.ini",
    "/etc/shadow.npy",
    "scan.npy/../../x.npy",
    "CON.npy",
    "a\x00b.npy",
    "." * 300,
    "x" * 5000 + ".csv",
    "\x1b[31mred.npy",
    "",
)


@pytest.mark.parametrize("name", HOSTILE)
def test_no_name_of_a_client_reaches_the_disk(name: str, state: State) -> None:
    kept = state.folder.keep(name, b"1 2 3")
    assert [p.name for p in state.folder.path.iterdir() if p.read_bytes() == b"1 2 3"] == [kept]
    assert kept in os.listdir(state.folder.path)
    shown = state.folder.shown[kept]
    assert shown.isprintable()
    assert "/" not in shown
    assert "\\" not in shown
    assert len(shown) <= 80


def test_a_wrong_file_is_refused_by_its_own_name_and_changes_nothing(state: State) -> None:
    before, mu = state.text, state.load().friction().mu
    for name, content, problem in (
        ("paper.pdf", b"%PDF-1.7 not a scan", "paper.pdf: "),
        ("empty.npy", b"", "empty.npy: is empty"),
        ("text.npy", b"hello", "text.npy: "),
        ("good.npy", scan_bytes(), "pixel_size"),
    ):
        with pytest.raises(asperity.Error) as caught:
            drop_scan(state, name, content)
        assert problem in str(state.said(caught.value))
        assert str(state.folder.path) not in str(state.said(caught.value))
    for name, content in (("paper.pdf", b"%PDF-1.7"), ("zeros.csv", bytes(1000))):
        with pytest.raises(asperity.InvalidInput, match=f"{name}: no line names columns"):
            state.keep_dma(name, content)
    assert state.text == before
    assert np.array_equal(state.load().friction().mu, mu)
    assert len(list(state.folder.path.glob("file-*"))) == 2  # the shipped scan, and the last tried


class Bomb:
    """Would leave a file behind if it were ever loaded."""

    def __init__(self, path: Path) -> None:
        self.path = path

    def __reduce__(self) -> object:
        return Path.touch, (self.path,)


def test_nothing_that_is_dropped_is_executed(state: State, tmp_path: Path) -> None:
    left = tmp_path / "executed"
    out = io.BytesIO()
    np.save(out, np.array([Bomb(left)], dtype=object), allow_pickle=True)
    for name, content in (
        ("bomb.npy", out.getvalue()),
        ("bomb.npz", pickle.dumps(Bomb(left))),
        ("bomb.csv", pickle.dumps(Bomb(left))),
        ("bomb.opd", pickle.dumps(Bomb(left))),
    ):
        state.keep_scan(name, content)
        with pytest.raises(asperity.Error):
            state.use_scan({"pixel_size_m": 1e-6, "unit": "um"})()
    assert not left.exists()


def test_files_are_bounded(state: State, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(files, "MOST_BYTES", 3 * 2**20)
    with pytest.raises(asperity.InvalidInput, match=r"big\.npy: has 4 MB: must have at most 3"):
        state.keep_scan("big.npy", bytes(4 * 2**20))
    held = len(input_files()["scan.npy"])
    monkeypatch.setattr(files, "MOST_TOGETHER", held + 2**20)
    with pytest.raises(asperity.InvalidInput, match="a session holds at most"):
        state.keep_scan("second.npy", bytes(2**20 + 1))
    for i in range(files.MOST_FILES):  # a scan that is dropped anew takes the place of the last
        state.keep_scan(f"{i}.npy", b"1")
    assert len(list(state.folder.path.glob("file-*"))) == 2


def test_variants_are_kept_with_names_of_their_own(state: State) -> None:
    scene = state.load()
    curves = scene.friction()
    for _ in range(2):
        state.keep_variant("dry\n", state.tables, scene, curves)
    state.keep_variant("", state.tables, scene, curves)
    assert [one.name for one in state.variants] == ["dry", "dry'", "variant 3"]
    state.conditions["pressure_pa"] = 2e5
    assert state.variants[0].tables["conditions"]["pressure_pa"] == 81e3
    while len(state.variants) < MOST_VARIANTS:
        state.keep_variant("more", state.tables, scene, curves)
    with pytest.raises(asperity.InvalidInput, match="must remove one first"):
        state.keep_variant("one more", state.tables, scene, curves)


def test_the_report_tells_no_folder(state: State, monkeypatch: pytest.MonkeyPatch) -> None:
    from asperity.report.drawings import Drawings, Figure

    monkeypatch.setattr(Drawings, "_figure", lambda *_: Figure("", "", ""))
    scene = state.load()
    state.keep_variant("<b>", state.tables, scene, scene.friction())
    state.conditions["pressure_pa"] = 2e5
    page = report_of(state, print)().decode()
    assert str(state.folder.path) not in page
    assert "<title>Friction of this scene, &lt;b&gt;</title>" in page
    assert "variant-1.toml against scene.toml" in page


def test_the_map_is_that_of_the_scene(state: State, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("asperity.app.downloads.CHECKED", 100)
    scene = state.load()
    made = map_of(scene, print)
    inside = scene.velocity[1:-1]
    assert made.mu(81e3, inside) == pytest.approx(scene.friction().mu[0, 1:-1], rel=1e-3)
    assert "asperity-app" not in made.text


LONG = "Angular Frequency,Storage Modulus,Loss Modulus,Temperature"


@pytest.mark.parametrize(
    ("header", "columns", "units", "modulus"),
    [
        (
            "run,freq_hz,temperature_C,G_storage_pa,G_loss_pa,G_abs_pa,tan_delta,force_dyn_N",
            ["freq_hz", "G_storage_pa", "G_loss_pa", "temperature_C"],
            ["Hz", "Pa", "C"],
            "G",
        ),
        (
            "Freq\tG'\tG\"\tTemp\tStrain\nrad/s\tPa\tPa\t°C\t%",
            ["Freq", "G'", 'G"', "Temp"],
            ["rad/s", "Pa", "C"],
            "G",
        ),
        (
            "t [s];T [K];f [Hz];E' [MPa];E'' [MPa];tan(delta)",
            ["f [Hz]", "E' [MPa]", "E'' [MPa]", "T [K]"],
            ["Hz", "MPa", "K"],
            "E",
        ),
        (LONG, LONG.split(","), ["Hz", "MPa", "C"], "E"),
        ("f,T,G1,G2", ["f", "G1", "G2", "T"], ["Hz", "MPa", "C"], "G"),
    ],
)
def test_columns_are_guessed(
    header: str, columns: list[str], units: list[str], modulus: str, tmp_path: Path
) -> None:
    mark = next(one for one in "\t;," if one in header)
    row = mark.join(["1.5"] * len(header.splitlines()[0].split(mark)))
    (tmp_path / "dma.txt").write_text(f"made by nobody\n{header}\n{row}\n{row}\n")
    guess = guess_columns(tmp_path / "dma.txt")
    result = [guess.columns[q] for q in ("frequency", "storage", "loss", "temperature")]
    assert result == columns
    assert [guess.units[kind] for kind in ("frequency", "modulus", "temperature")] == units
    assert guess.modulus == modulus
