"""The same files have one number and one set of notes by every door: shell, Python, app, sweep."""

import asyncio
import csv
from collections.abc import Callable
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
import pytest

import asperity
from asperity.app.state import State
from asperity.app.worker import Worker
from asperity.cli.main import main
from helpers.dropped import dma_bytes, scan_bytes
from helpers.measured import COLUMNS, UNITS, present

PRESSURE, CELSIUS = 81e3, 20.0
SCENE = """
[surface]
file = "scan.npy"
pixel_size_m = {pixel}
unit = "m"

[rubber]
isotherms = ["dma.csv"]
columns = {columns}
units = {units}
modulus = "G"

[conditions]
pressure_pa = {pressure}
velocity_m_s = {velocity}
temperature_c = {celsius}
"""


class Files(NamedTuple):
    """A scan and sweeps in a folder, and what their files do not state."""

    folder: Path
    pixel_size: Any
    columns: dict[str, str]
    units: dict[str, str]
    velocity: list[float]

    @property
    def scene(self) -> Path:
        def table(texts: dict[str, str]) -> str:
            return "{" + ", ".join(f"{key} = '''{text}'''" for key, text in texts.items()) + "}"

        text = SCENE.format(
            pixel=np.array(self.pixel_size).tolist(),
            columns=table(self.columns),
            units=table(self.units),
            pressure=PRESSURE,
            velocity=self.velocity,
            celsius=CELSIUS,
        )
        path = self.folder / "scene.toml"
        path.write_text(text, encoding="utf-8")
        return path


def written(
    folder: Path,
    scan: asperity.HeightMap,
    sweeps: bytes,
    velocity: list[float],
    columns: dict[str, str] = COLUMNS,
    units: dict[str, str] = UNITS,
) -> Files:
    np.save(folder / "scan.npy", scan.heights)
    (folder / "dma.csv").write_bytes(sweeps)
    return Files(folder, scan.pixel_size, columns, units, velocity)


def instrument(name: str, times: float) -> asperity.HeightMap:
    pytest.importorskip("SurfaceTopography")
    scan = asperity.read_surface(present("topography", name))
    assert isinstance(scan, asperity.HeightMap)
    return asperity.HeightMap(times * scan.heights, pixel_size=scan.pixel_size)


def al3d_and_epdm(folder: Path) -> Files:
    sweeps = present("dma", "epdm_70", "tf_015p.csv").read_bytes()
    return written(folder, instrument("al3d-1.al3d", 30), sweeps, [1e-5, 1e-4, 1e-3])


def opd_and_material_a(folder: Path) -> Files:
    sweeps = present("dma", "material_a", "tf_015p.csv").read_bytes()
    return written(folder, instrument("opd-1.opd", 1), sweeps, [1e-5, 1e-4])


def synthesized(folder: Path) -> Files:
    (folder / "um.npy").write_bytes(scan_bytes())
    scan = asperity.HeightMap(np.load(folder / "um.npy") * 1e-6, pixel_size=5e-6)
    columns = {"frequency": "Freq", "temperature": "Temperature", "storage": "G'", "loss": 'G"'}
    units = {"frequency": "Hz", "temperature": "C", "modulus": "MPa"}
    return written(folder, scan, dma_bytes(), [1e-4, 1e-3, 1e-2], columns, units)


SETS: dict[str, Callable[[Path], Files]] = {
    "al3d-1 times 30, epdm_70": al3d_and_epdm,
    "opd-1, material_a": opd_and_material_a,
    "synthesized": synthesized,
}


# --- the doors: mu at every velocity, and the codes of fatal notes ---

Seen = tuple[list[float], list[str]]


def fatals(notes: Any) -> list[str]:
    return sorted({note.code for note in notes if note.severity == "fatal"})


def by_shell(files: Files) -> Seen:
    output = files.folder / "mu.csv"
    assert main(["friction", str(files.scene), "--output", str(output)]) == 0
    lines = output.read_text(encoding="utf-8").splitlines()
    assert '# surface.detrend = "plane"' in lines
    assert '# surface.window = "split-cosine-bell"' in lines
    assert f"# derived.q1_per_m = {np.pi / float(np.max(files.pixel_size))!r}" in lines
    assert "# rubber.prony = false" in lines
    assert '# rubber.extrapolation = "none"' in lines
    assert '# correction.kind = "none"' in lines
    rows = csv.DictReader(line for line in lines if not line.startswith("#"))
    fatal = [n for n in asperity.read_scene(files.scene).friction().notes if n.severity == "fatal"]
    assert sum(line.startswith("# note: fatal: ") for line in lines) == len(fatal)
    return [float(row["mu"]) for row in rows], fatals(fatal)


def by_hand(files: Files) -> Seen:
    scan = asperity.read_surface(
        files.folder / "scan.npy", pixel_size=files.pixel_size, unit="m"
    ).fill_dropouts()
    isotherms = asperity.read_isotherms(
        files.folder / "dma.csv", columns=files.columns, units=files.units, modulus="G"
    )
    build = asperity.build_master_curve(isotherms, reference_temperature=CELSIUS + 273.15)
    result = asperity.friction(
        asperity.power_spectrum(scan), build, pressure=PRESSURE, velocity=files.velocity
    )
    return result.mu.tolist(), fatals(result.notes)


def by_read_scene(files: Files) -> Seen:
    scene = asperity.read_scene(files.scene)
    result = scene.friction()
    again = asperity.friction(
        scene.spectrum, scene.rubber, correction=scene.correction, **scene.conditions
    )
    assert np.array_equal(again.mu, result.mu)
    return result.mu[0].tolist(), fatals(result.notes)


def by_app(files: Files) -> Seen:
    state = State()
    try:
        state.keep_scan("scan.npy", (files.folder / "scan.npy").read_bytes())
        pixel = np.array(files.pixel_size).tolist()
        state.use_scan({"pixel_size_m": pixel, "unit": "m"})()
        name = state.keep_dma("dma.csv", (files.folder / "dma.csv").read_bytes())
        read = {"columns": files.columns, "units": files.units, "modulus": "G"}
        state.use_dma([name], read)()
        points = {"pressure_pa": PRESSURE, "velocity_m_s": files.velocity}
        state.conditions = {**points, "temperature_c": CELSIUS}
        state.choose_correction("none")
        worker = Worker(state)
        asyncio.run(worker.changed())
        assert worker.found is not None
        assert worker.found.curves is not None
        return worker.found.curves.mu[0].tolist(), fatals(worker.found.curves.notes)
    finally:
        state.close()


def by_sweep(files: Files) -> Seen:
    with asperity.sweep(files.scene, {"conditions.pressure_pa": [PRESSURE]}) as found:
        labels = found.attrs["note_labels"].splitlines()
        codes = {label.split(" ")[1] for label in labels if label.startswith("fatal")}
        return found.mu.values.ravel().tolist(), sorted(codes)


DOORS = {
    "shell": by_shell,
    "Python by hand": by_hand,
    "read_scene": by_read_scene,
    "app": by_app,
    "sweep": by_sweep,
}


@pytest.mark.parametrize("name", SETS)
def test_every_door_has_the_same_digits_and_fatal_notes(
    name: str, tmp_path: Path, source: str
) -> None:
    if name == "synthesized" and source != "made":
        pytest.skip("it is made")
    files = SETS[name](tmp_path)
    seen = {door: look(files) for door, look in DOORS.items()}
    print("\n".join(f"{door:>15}: {digits} {notes}" for door, (digits, notes) in seen.items()))
    assert min(seen["shell"][0]) > 0
    assert [one for one in seen.values() if one != seen["shell"]] == []


@pytest.fixture(scope="module")
def swapped(tmp_path_factory: pytest.TempPathFactory) -> Files:
    """Sweeps whose storage was taken for the loss: no material has such moduli."""
    files = synthesized(tmp_path_factory.mktemp("swapped"))
    columns = {**files.columns, "storage": files.columns["loss"], "loss": files.columns["storage"]}
    return files._replace(columns=columns)


def test_every_door_has_the_fatal_notes_of_a_rubber(swapped: Files) -> None:
    seen = {door: look(swapped)[1] for door, look in DOORS.items()}
    assert "moduli-contradict" in seen["shell"]
    assert [door for door, codes in seen.items() if codes != seen["shell"]] == []


def test_a_report_has_them_before_all_else(swapped: Files, monkeypatch: pytest.MonkeyPatch) -> None:
    drawings = pytest.importorskip("asperity.report.drawings", reason="needs asperity[plot]")
    blank = drawings.Figure("", "", "")
    monkeypatch.setattr(drawings.Drawings, "_figure", lambda *_: blank)
    output = swapped.folder / "report.html"
    asperity.report([swapped.scene], output)
    page = output.read_text(encoding="utf-8")
    first = page.index('<p class="fatal">')
    assert page.index("</nav>") < first < page.index("no Prony series") < page.index("<figure>")


def test_a_rank_of_a_sweep_counts_them(swapped: Files, capsys: pytest.CaptureFixture[str]) -> None:
    pytest.importorskip("xarray")
    sweep = swapped.folder / "sweep.toml"
    over = '[over]\n"surface.detrend" = ["plane", "quadratic"]\n'
    sweep.write_text(f'scene = "{swapped.scene.name}"\n{over}')
    store = str(swapped.folder / "found.nc")
    assert main(["sweep", str(sweep), "--output", store, "--rank", "surface.detrend"]) == 0
    lines = capsys.readouterr().out.splitlines()
    fatal = [line for line in lines if line.startswith("# note: fatal: ")]
    assert f"# fatal_notes = {len(fatal)}" in lines
    assert any("no Prony series follows" in line for line in fatal)
