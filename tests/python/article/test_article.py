"""`asperity article`: its files, its verdicts and the numbers behind them."""

import contextlib
import csv
import io
import os
import re
import sys
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest

import asperity
from asperity.article.inputs import PRESSURES, Inputs, prepare
from asperity.article.readings import PRINTED
from asperity.article.statement import VERDICTS
from asperity.article.summary import OPENING
from asperity.cli import article_command as command
from asperity.cli.main import main
from helpers.summaries import COLUMNS, PUBLISHED, numbers, same, statements

pytest.importorskip("matplotlib")


@pytest.fixture(scope="module")
def run(tmp_path_factory: pytest.TempPathFactory) -> tuple[Path, str]:
    """The directory that one whole run leaves, and what it prints."""
    directory = tmp_path_factory.mktemp("article") / "out"
    with contextlib.redirect_stdout(io.StringIO()) as printed:
        assert main(["article", "--output", str(directory)]) == 0
    return directory, printed.getvalue()


@pytest.fixture(scope="module")
def remade(run: tuple[Path, str]) -> Path:
    return run[0]


@pytest.fixture(scope="module")
def inputs() -> Inputs:
    return prepare((1, 2))


@pytest.fixture(scope="module")
def rows(remade: Path) -> dict[str, dict[str, str]]:
    return statements((remade / "summary.md").read_text())


def table(path: Path) -> dict[str, np.ndarray]:
    lines = [line for line in path.read_text().splitlines() if not line.startswith("#")]
    names, *cells = csv.reader(lines)
    return dict(zip(names, np.array(cells).T, strict=True))


def test_every_file_is_there_and_no_other(remade: Path) -> None:
    figures = [f"fig{n:02d}" for n in (1, 2, 3, *range(5, 16))]
    wanted = {f"{name}.{kind}" for name in (*figures, "table1") for kind in ("png", "csv")}
    assert {path.name for path in remade.iterdir()} == wanted | {"summary.md"}
    for path in remade.glob("*.png"):
        assert path.read_bytes().startswith(b"\x89PNG")


@pytest.mark.parametrize("name", [name for name in command.PAGES if name != "table1"])
def test_tables_are_numbers_with_units(remade: Path, name: str) -> None:
    path = remade / f"{name}.csv"
    head = [line for line in path.read_text().splitlines() if line.startswith("#")]
    assert head[0] == f"# asperity {asperity.__version__} article {name}"
    units = dict(re.findall(r"(\w+) \[([^]]+)\]", head[-1]))
    columns = table(path)
    assert list(units) == list(columns)
    labels = {"curve", "part", "surface", "compound", "reading", "theory", "cutoff"}
    for title, cells in columns.items():
        if title in labels:
            continue
        values = [float(cell) for cell in cells if cell]
        assert values, title
        assert not np.isnan(values).any()
        assert units[title] != "-" or not title.endswith(("_m", "_pa", "_s"))


def test_summary_has_all_statements_with_a_criterion(rows: dict[str, dict[str, str]]) -> None:
    assert len(rows) > 70
    for row in rows.values():
        assert row["verdict"] in VERDICTS
        assert row["claim"] != ""
        assert row["reason"] != ""
        if row["verdict"] != "cannot be checked":
            assert row["criterion"] != "-"
            assert numbers(row["found"]) != []


def test_terminal_and_summary_count_alike(
    run: tuple[Path, str], rows: dict[str, dict[str, str]]
) -> None:
    directory, printed = run
    parts = [f"{sum(r['verdict'] == v for r in rows.values())} {v}" for v in VERDICTS]
    line = f"{len(rows)} statements: {', '.join(parts[:-1])}; {parts[-1]}, set apart"
    summary = directory / "summary.md"
    assert f"\n{line}.\n" in summary.read_text()
    assert printed == f"{line}\nsummary: {summary}\n"


def test_the_published_summary_is_that_of_a_run(rows: dict[str, dict[str, str]]) -> None:
    """Ids, statements, criteria and verdicts to the letter; numbers found to their last digit."""
    published = statements(PUBLISHED)
    assert list(published) == list(rows)
    for name, row in rows.items():
        for column in COLUMNS:
            agree = same if column in ("found", "reason") else str.__eq__
            assert agree(row[column], published[name][column]), (name, column)


# What the issue names, by id: the verdict and numbers that must be among those found.
EXPECTED = {
    "A4": ("does not hold", [0.7071]),
    "C1": ("does not hold", []),
    "C2": ("tuned", [1.01, 1.09, 1.25, 1.36, 3.97, 8.16, 1.14, 2.11, 3.82]),
    "C7": ("holds in part", [-75.0]),
    "C8": ("holds in part", [0.407, 0.495, 0.546]),
    "C11": ("tuned", []),
    "C12": ("cannot be checked", []),
    "C13": ("by construction", []),
    "C14": ("tuned", [2.46, 2.02, 1.83]),
    "E1": ("does not hold", []),
    "E5": ("does not hold", []),
    "F1": ("does not hold", [320.0, 11.7, 1.49, 2.76]),
    "F3": ("does not hold", [-20.0]),
    "F4": ("holds", []),
    "F6": ("holds in part", [46.0, 92.0]),
    "F10": ("cannot be checked", []),
    "F11": ("cannot be checked", []),
    "G1": ("tuned", [2.46, 2.02, 1.83]),
    "G2": ("tuned", []),
    "G3": ("cannot be checked", []),
    "G4": ("holds in part", []),
    "G5": ("holds", []),
    "G7": ("holds in part", []),
    "G10": ("tuned", []),
    "G11": ("tuned", []),
    "P2": ("holds", [2.72, 2.51]),
    "P3": ("holds", [1.97, 1.85]),
    "T4": ("by construction", []),
    "T5": ("by construction", []),
}


@pytest.mark.parametrize("name", EXPECTED)
def test_verdicts(rows: dict[str, dict[str, str]], name: str) -> None:
    verdict, values = EXPECTED[name]
    assert rows[name]["verdict"] == verdict
    assert set(values) <= set(numbers(rows[name]["found"]))


@pytest.mark.parametrize("reading", ["implicit", "added"])
def test_tuned_compound_gives_the_printed_p_t(inputs: Inputs, reading: str) -> None:
    tuned = inputs.tuned[reading]
    result = asperity.friction(
        inputs.sandpaper,
        tuned.rubber,
        pressure=PRESSURES,
        velocity=0.1,
        correction=tuned.correction,
    )
    assert result.shift_factor.round(2).tolist() == list(PRINTED.values())


def test_figures_13_and_14_rise_and_fall_as_is_said(remade: Path) -> None:
    for name in ("fig13", "fig14"):
        columns = table(remade / f"{name}.csv")
        for reading in ("implicit", "added"):
            mine = columns["reading"] == reading
            pressure, velocity, d, p = (
                columns[title][mine].astype(float)
                for title in ("pressure_pa", "velocity_m_s", "separation_m", "shift_factor")
            )
            assert np.all(p >= 1)
            for v in set(velocity):
                assert np.all(np.diff(d[velocity == v]) < 0)
                assert np.all(np.diff(p[velocity == v]) <= 0)
            for load in set(pressure):
                assert np.all(np.diff(d[pressure == load]) > 0)
                assert np.all(np.diff(p[pressure == load]) >= 0)


@pytest.mark.parametrize(("name", "factors"), [("fig10", [2, 2, 2]), ("fig12", PRINTED.values())])
def test_modified_area_is_larger_by_p_t(remade: Path, name: str, factors: list[float]) -> None:
    columns = {title: cells.astype(float) for title, cells in table(remade / f"{name}.csv").items()}
    assert np.all(columns["modified_area"] >= columns["original_area"])
    last = columns["magnification"] == 500
    # erf(x) is 2 x / sqrt(pi) to x^2 / 3: below 1e-6 at the areas of 1e-3 here
    ratio = (columns["modified_area"] / columns["original_area"])[last]
    np.testing.assert_allclose(ratio, list(factors), rtol=1e-5)


def test_table_1_follows_from_its_parameters(remade: Path) -> None:
    rows = table(remade / "table1.csv")
    found = dict(zip(rows["quantity"], rows["value"].astype(float), strict=True))
    # THEORY: C(q0) = (H / pi) (h0 / q0)^2 / (1 - (q1 / q0)^(-2 H)), Eq. 12 with half of H / pi
    density = 0.87 / np.pi * (265.7e-6 / 2000) ** 2
    whole = density / (1 - 500.0 ** (-2 * 0.87))
    assert found["spectrum at q0, rms height h0"] == pytest.approx(whole, rel=1e-12)
    assert found["spectrum at q0, Eq. 12 as printed"] == pytest.approx(density / 2, rel=1e-12)
    assert found["q1 at rms slope 1.3"] == pytest.approx(11.67, abs=0.005)
    assert found["rms slope to 500 q0"] == pytest.approx(2.76, abs=0.005)
    assert not set("".join(rows["symbol"]) + "".join(rows["unit"])) & set("$\\")


def test_figure_15_adds_up_and_shows_no_measured_points(remade: Path) -> None:
    text = (remade / "fig15.csv").read_text()
    assert "note: the measured points of the article's Fig. 15 are not at hand" in text
    columns = table(remade / "fig15.csv")
    mu, hysteresis, adhesion = (
        columns[title].astype(float) for title in ("mu", "hysteresis", "adhesion")
    )
    np.testing.assert_allclose(mu, hysteresis + adhesion, rtol=1e-12)
    assert set(columns["theory"]) == {"original", "modified, implicit", "modified, added"}


BY = f"{asperity.__version__} article"


def stub(mark: str) -> Callable[[], tuple[dict[str, bytes], list[object]]]:
    tables = {n: f"# asperity {BY} {n[:-4]}\n{mark}" for n in command.FILES if n[-4:] == ".csv"}
    files = {name: tables.get(name, mark).encode() for name in command.FILES}
    return lambda: (
        files | {"summary.md": f"{OPENING}{BY}`. {mark}".encode()},
        [],
    )


def test_it_replaces_its_files_when_told_to(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    out = str(tmp_path / "out")
    monkeypatch.setattr(command, "remake", stub("old"))
    assert main(["article", "--output", out]) == 0
    monkeypatch.setattr(command, "remake", stub("new"))
    assert main(["article", "--output", out]) == 2
    assert "fig01.csv" in (problem := capsys.readouterr().err)
    assert "already; choose another --output, or replace them with --force" in problem
    assert main(["article", "--output", out, "--force"]) == 0
    for name in command.FILES:
        assert (tmp_path / "out" / name).read_text().endswith("new")


def test_without_matplotlib_it_says_what_to_install(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setitem(sys.modules, "matplotlib", None)
    assert main(["article", "--output", str(tmp_path / "out")]) == 2
    line = "pictures are drawn by matplotlib: pip install asperity[plot]"
    assert capsys.readouterr().err == f"asperity: {tmp_path / 'out' / 'fig01.png'}: {line}\n"
    assert list(tmp_path.iterdir()) == []


def test_a_full_disk_is_said(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    replace = os.replace

    def full(part: Path, target: Path) -> None:
        if target.name == "fig09.csv":
            raise OSError(28, "No space left on device")
        replace(part, target)

    monkeypatch.setattr("os.replace", full)
    monkeypatch.setattr(command, "remake", stub(""))
    assert main(["article", "--output", str(tmp_path / "out")]) == 1
    assert "fig09.csv: cannot be written: No space left on device" in capsys.readouterr().err
