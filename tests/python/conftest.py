"""Reference tables, each row with its own tolerance, and a folder to run the shell command in."""

import csv
import os
from collections.abc import Callable, Iterator
from pathlib import Path

os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")  # tests run side by side on all cores

import numpy as np
import pytest

import asperity
from helpers import made_files, made_sweeps, measured, scenes

REFERENCE = Path(__file__).parents[1] / "reference"
LISTS = {
    "moduli",
    "relaxation_times",
    "peaks",
    "table_frequency",
    "table_storage",
    "table_loss",
    "table_wavenumber",
    "table_density",
    "pressures",
    "velocities",
    "hystereses",
    "measured",
    "outliers",
    "kx",
    "ky",
    "amplitude",
    "phase",
    "strain",
    "storage",
    "loss",
}


def reference(name: str) -> list[dict[str, object]]:
    """Rows of tests/reference/<name>.csv: numbers, lists (`;`), None for an empty cell."""
    with (REFERENCE / f"{name}.csv").open(encoding="utf-8") as file:
        rows = csv.DictReader(line for line in file if not line.startswith("#"))
        return [{key: value_of(key, cell) for key, cell in row.items()} for row in rows]


def value_of(column: str, cell: str) -> object:
    if column in ("case", "form", "kind", "residence", "extrapolation"):
        return cell
    if column in LISTS or ";" in cell:
        return np.array([float(x) for x in cell.split(";") if x])
    return float(cell) if cell else None


def pytest_configure(config: pytest.Config) -> None:
    for marker in (
        "reference(name): the test runs once for each row of tests/reference/<name>.csv",
        "long: left out unless asked for by -m long, as tests/stability/long.sh does",
    ):
        config.addinivalue_line("markers", marker)


def pytest_generate_tests(metafunc: pytest.Metafunc) -> None:
    marker = metafunc.definition.get_closest_marker("reference")
    if marker is not None:
        rows = reference(marker.args[0])
        metafunc.parametrize("row", rows, ids=[str(row["case"]) for row in rows])


@pytest.fixture(scope="session")
def reference_table() -> Callable[[str], list[dict[str, object]]]:
    return reference


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """The working directory, with a scene and a scan."""
    (tmp_path / "scene.toml").write_text(scenes.SCENE)
    spectrum = asperity.SelfAffineSpectrum(rms_height=5e-6, hurst=0.8, q0=2e4, q1=1e6)
    scan = asperity.synthesize(spectrum, shape=(60, 80), pixel_size=(2e-5, 1e-5), seed=1)
    np.save(tmp_path / "scan.npy", scan.heights)
    monkeypatch.chdir(tmp_path)
    return tmp_path


@pytest.fixture
def undrawn(monkeypatch: pytest.MonkeyPatch) -> None:
    """Pictures are seconds each; here they are a word."""
    pytest.importorskip("matplotlib", reason="its pictures need asperity[plot]")
    monkeypatch.setattr(
        "matplotlib.figure.Figure.savefig", lambda _, file, **__: file.write(b"picture")
    )


@pytest.fixture(scope="session")
def made(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A folder of files as instruments write them."""
    folder = tmp_path_factory.mktemp("made")
    made_files.write_scans(folder)
    made_sweeps.write_sweeps(folder)
    return folder


@pytest.fixture(params=measured.SOURCES)
def source(request: pytest.FixtureRequest, made: Path) -> Iterator[str]:
    """Each test once with made files, and once with measured ones where there are any."""
    with measured.files_from(made if request.param == "made" else None):
        yield request.param


@pytest.fixture
def file_of(made: Path) -> Callable[[str, str], Path]:
    """A scan of a source, made or measured; the test skips where SurfaceTopography is absent."""
    pytest.importorskip("SurfaceTopography", reason="reading it needs asperity[io]")

    def file(source: str, name: str) -> Path:
        with measured.files_from(made if source == "made" else None):
            return measured.present("topography", name)

    return file
