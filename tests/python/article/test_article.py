"""`asperity article` as a whole: its files, its verdicts, what its figures should show."""

import contextlib
import csv
import io
import itertools
import json
import re
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import asperity
from asperity.cli.main import main
from asperity_scripts.article.inputs import Inputs, prepare
from asperity_scripts.article.statement import VERDICTS
from helpers.summaries import PUBLISHED, same, statements

matplotlib = pytest.importorskip("matplotlib")
pytest.importorskip("matplotlib.figure")

H = {"sandpaper": 0.7, "asphalt": 0.87}
H0 = {"sandpaper": 76.572e-6, "asphalt": 265.7e-6}
Q0, GAMMA = 2000.0, 0.5
PRINTED = (2.46, 2.02, 1.83)
LOADS = (0.1e6, 0.3e6, 0.5e6)


class Figure:
    """A table of the run: what it was made from, and its columns, numbers where they are."""

    def __init__(self, path: Path) -> None:
        lines = path.read_text().splitlines()
        self.notes = [line[2:] for line in lines if line.startswith("#")]
        given = (re.fullmatch(r"(\S+) = (.*)", note) for note in self.notes)
        self.given = {match[1]: json.loads(match[2]) for match in given if match}
        names, *cells = csv.reader(line for line in lines if not line.startswith("#"))
        self.text = dict(zip(names, np.array(cells).T, strict=True))

    def __getitem__(self, name: str) -> Any:
        return self.text[name].astype(float)

    def part(self, column: str, value: Any, *names: str) -> Any:
        rows = self.text[column] == value if isinstance(value, str) else self[column] == value
        parts = [self.text[name][rows].astype(float) for name in names]
        return parts[0] if len(parts) == 1 else parts


@pytest.fixture(scope="module")
def run(tmp_path_factory: pytest.TempPathFactory) -> tuple[Path, str]:
    """The directory that one whole run leaves, and what it prints; every fifth picture is drawn."""
    directory = tmp_path_factory.mktemp("article") / "out"
    drawn, savefig = itertools.count(), matplotlib.figure.Figure.savefig

    def some(figure: Any, file: Any, **options: Any) -> None:
        if next(drawn) % 5 == 0:
            savefig(figure, file, **options)
        else:
            file.write(b"\x89PNG")

    with (
        contextlib.redirect_stdout(io.StringIO()) as printed,
        pytest.MonkeyPatch.context() as patch,
    ):
        patch.setattr(matplotlib.figure.Figure, "savefig", some)
        assert main(["article", "--output", str(directory)]) == 0
    return directory, printed.getvalue()


@pytest.fixture(scope="module")
def figure(run: tuple[Path, str]) -> Callable[[str], Figure]:
    return lambda name: Figure(run[0] / f"{name}.csv")


@pytest.fixture(scope="module")
def inputs() -> Inputs:
    return prepare((1, 2))


def test_the_files(run: tuple[Path, str]) -> None:
    figures = [f"fig{n:02d}" for n in (1, 2, 3, *range(5, 16))]
    wanted = {f"{name}.{kind}" for name in (*figures, "table1") for kind in ("png", "csv")}
    assert {path.name for path in run[0].iterdir()} == wanted | {"summary.md"}
    for path in run[0].glob("*.png"):
        assert path.read_bytes().startswith(b"\x89PNG")
    for path in run[0].glob("*.csv"):
        notes = Figure(path).notes
        assert notes[0] == f"asperity {asperity.__version__} article {path.stem}"
        assert re.findall(r"(\w+) \[[^]]+\]", notes[-1]) == list(Figure(path).text)


def test_the_published_summary_is_that_of_a_run(run: tuple[Path, str]) -> None:
    """Word by word, numbers found to their last digit; the terminal has the same counts."""
    directory, printed = run
    summary = directory / "summary.md"
    text = summary.read_text()
    for ours, published in zip(text.splitlines(), PUBLISHED.splitlines(), strict=True):
        assert same(ours, published)
    for ours, published in zip(
        statements(text).values(), statements(PUBLISHED).values(), strict=True
    ):
        assert {**ours, "found": ""} == {**published, "found": ""}
    result = [row["verdict"] for row in statements(PUBLISHED).values()]
    parts = [f"{result.count(verdict)} {verdict}" for verdict in VERDICTS]
    line = f"77 statements: {', '.join(parts[:-1])}; {parts[-1]}, set apart"
    assert f"\n{line}.\n" in PUBLISHED
    assert printed == f"{line}\nsummary: {summary}\n"


def density(surface: str, q: Any) -> Any:
    """C(q) = (H / pi) (h0 / q0)^2 (q / q0)^(-2 - 2 H) / (1 - (q1 / q0)^(-2 H)), 0 below q0."""
    h = H[surface]
    top = h / np.pi * (H0[surface] / Q0) ** 2 / (1 - 500 ** (-2 * h))
    return np.where(q < Q0, 0.0, top * (q / Q0) ** (-2 - 2 * h))


def test_figure_1_distributes_the_load(figure: Callable[[str], Figure]) -> None:
    """Its integral is A/A0 and its first moment the nominal pressure, as far as it is drawn: at 25
    q0 a part of the tail is not."""
    for zeta, slack in ((1.5, 1e-6), (5.0, 1e-6), (25.0, 0.01)):
        columns = ("stress_pa", "density_per_pa", "contact_area")
        stress, p, area = figure("fig01").part("magnification", zeta, *columns)
        corner = p[1] * stress[1] / 12  # the trapezoids' error where P rises from 0
        assert np.trapezoid(p, stress) + corner == pytest.approx(area[0], rel=slack)
        assert np.trapezoid(p * stress, stress) == pytest.approx(0.5e6, rel=slack)


def test_figure_5_has_one_rubber_moved(figure: Callable[[str], Figure], inputs: Inputs) -> None:
    """B is A by WLF of their T_g, and each tuned A by its decades."""
    result, columns = figure("fig05"), ("storage_modulus_pa", "loss_modulus_pa")
    w = result.part("compound", "A", "angular_frequency_rad_s")

    def log_a_t(t_g: float) -> float:
        return -17.44 * (20 - t_g) / (51.6 + 20 - t_g)

    decades = {"B": log_a_t(-21.7) - log_a_t(-32.0)}
    decades |= {f"A, tuned ({k})": result.given[f"tuned_by_decades_{k}"] for k in inputs.tuned}
    for name, moved in decades.items():
        modulus = inputs.compound_a.modulus(w * 10**moved)
        for column, wanted in zip(columns, (modulus.real, modulus.imag), strict=True):
            np.testing.assert_allclose(result.part("compound", name, column), wanted, rtol=1e-9)


@pytest.mark.parametrize("surface", H)
def test_figure_7_is_about_the_spectrum_put_in(
    figure: Callable[[str], Figure], surface: str
) -> None:
    name = "120-grit sandpaper" if surface == "sandpaper" else surface
    columns = ("wavenumber_per_m", "density_m4", "synthesized_density_m4", "reliable")
    q, measured, truth, reliable = figure("fig07").part("surface", name, *columns)
    np.testing.assert_allclose(truth, density(surface, q), rtol=1e-12)
    rows = (reliable == 1) & (q > 1.25 * Q0)
    assert np.mean(np.log(measured[rows] / truth[rows])) == pytest.approx(0, abs=0.05)


@pytest.mark.parametrize(("name", "distance", "p_t"), [("fig08", 1.0, 2.5), ("fig09", 0.5, 2.0)])
def test_figures_8_and_9_are_of_peaks_apart(
    figure: Callable[[str], Figure], name: str, distance: float, p_t: float
) -> None:
    result = figure(name)
    x, y, height = result.part("part", "peaks", "x_m", "y_m", "height_m")
    apart = np.hypot(x[:, None] - x, y[:, None] - y)[np.triu_indices(x.size, 1)]
    assert distance * 2 * np.pi / Q0 * (1 - 1e-9) <= apart.min()
    scan = height.max() / (height.max() - height.mean())  # Eq. 13: the highest peak is z_max
    assert result.given["p_t1_scan"] == pytest.approx(scan)
    for column, p in (("lp_cf_printed", p_t), ("lp_cf_scan", scan)):
        plain, factor = result.part("part", "factors", "pf_cf", column)
        # light contact: LP-CF / PF-CF is 1 / (p_T gamma) to 1e-6; full contact: 1 / p_T^2
        assert factor[-1] / plain[-1] == pytest.approx(1 / (p * GAMMA), rel=1e-5)
        assert factor[0] / plain[0] == pytest.approx(1 / p**2, rel=1e-12)


@pytest.mark.parametrize(
    ("name", "columns", "ratio"),
    [
        ("fig10", ("original_area", "modified_area"), (2.0, 2.0, 2.0)),
        ("fig11", ("pf_cf", "igw_cf"), [1 / (p * GAMMA) for p in PRINTED]),
        ("fig12", ("original_area", "modified_area"), PRINTED),
    ],
)
def test_figures_10_to_12_end_by_p_t(
    figure: Callable[[str], Figure], name: str, columns: tuple[str, str], ratio: Any
) -> None:
    result = figure(name)
    for load, wanted in zip(LOADS, ratio, strict=True):
        zeta, before, after = result.part("pressure_pa", load, "magnification", *columns)
        assert zeta[0] == 1
        assert before[0] == 1
        assert zeta[-1] == 500
        # erf(x) is 2 x / sqrt(pi) to x^2 / 3: below 1e-6 at the areas of 1e-3 here
        assert after[-1] / before[-1] == pytest.approx(wanted, rel=1e-5)


@pytest.mark.parametrize("name", ["fig01", "fig08", "fig09", "fig10", "fig11"])
def test_areas_and_factors_are_of_the_tuned_compound(
    figure: Callable[[str], Figure], inputs: Inputs, name: str
) -> None:
    """Again at the load, from the parameters as the article prints them."""
    first, result = name == "fig01", figure(name)
    zeta = np.array([1.5, 5.0, 25.0] if first else [1.001, 1.01, 2.0, 30.0])
    area = asperity.contact_area(
        asperity.SelfAffineSpectrum(rms_height=H0["sandpaper"], hurst=0.7, q0=Q0, q1=500 * Q0),
        inputs.tuned["implicit"].rubber,
        pressure=0.5e6 if first else 0.3e6,
        velocity=1e-3 if first else 0.1,
        wavenumber=zeta * Q0,
    )
    if first:
        assert np.unique(result["contact_area"]).tolist() == pytest.approx(area[::-1])
        return
    rows = ("part", "factors") if name < "fig10" else ("pressure_pa", 0.3e6)
    curve = "original_area" if name == "fig10" else "pf_cf"
    x, y = result.part(*rows, "magnification", curve)
    if curve == "pf_cf":
        area *= GAMMA + (1 - GAMMA) * area**2  # S = gamma + (1 - gamma) P^2
    np.testing.assert_allclose(np.exp(np.interp(zeta, x, np.log(y))), area, rtol=2e-3)


@pytest.mark.parametrize("name", ["fig13", "fig14"])
def test_figures_13_and_14_rise_and_fall_as_is_said(
    figure: Callable[[str], Figure], name: str
) -> None:
    columns = ("pressure_pa", "velocity_m_s", "separation_m", "shift_factor")
    for reading in ("implicit", "added"):
        result = figure(name)
        pressure, velocity, d, p = result.part("reading", reading, *columns)
        z_max, z_min = (result.given[f"{reading}.z_{end}_m"] for end in ("max", "min"))
        partial = (d > z_min) & (d < z_max)
        wanted = (z_max - z_min) / (z_max - d[partial])
        np.testing.assert_allclose(p[partial], wanted, rtol=1e-9)
        for v in set(velocity):
            assert np.all(np.diff(d[velocity == v]) < 0)
            assert np.all(np.diff(p[velocity == v]) <= 0)
        for load in set(pressure):
            assert np.all(np.diff(d[pressure == load]) > 0)
            assert np.all(np.diff(p[pressure == load]) >= 0)
        if name == "fig13":
            at = [p[np.isclose(pressure, load) & (velocity == 0.1)][0] for load in LOADS]
            assert np.round(at, 2).tolist() == list(PRINTED)


def test_figure_15_and_table_1_follow_from_the_parameters(figure: Callable[[str], Figure]) -> None:
    result, table = figure("fig15"), figure("table1")
    values = dict(zip(table.text["quantity"], table["value"], strict=True))
    assert table["value"][:8] == pytest.approx([0.87, 265.7, 2000, 1e6, 0.1, 6, 8.3, 81])
    whole = float(density("asphalt", Q0))
    assert values["spectrum at q0, rms height h0"] == pytest.approx(whole, rel=1e-12)
    printed = 0.87 / (2 * np.pi) * (H0["asphalt"] / Q0) ** 2  # Eq. 12: half of H / pi, no end
    assert values["spectrum at q0, Eq. 12 as printed"] == pytest.approx(printed, rel=1e-12)
    assert values["rms slope to 500 q0"] == pytest.approx(2.76, abs=0.005)
    assert values["q1 at rms slope 1.3"] == pytest.approx(11.67, abs=0.005)
    np.testing.assert_allclose(result["mu"], result["hysteresis"] + result["adhesion"], rtol=1e-12)
    # Eq. 23, c = 0.1, v0 = 6 mm/s
    law = np.exp(-0.1 * np.log10(result["velocity_m_s"] / 6e-3) ** 2)
    adhesion = 8.3e6 / 81e3 * result["contact_area"] * law
    np.testing.assert_allclose(result["adhesion"], adhesion, rtol=1e-9)
    for k, which in enumerate(("original", "modified, implicit")):
        v, mu, p = result.part("theory", which, "velocity_m_s", "mu", "shift_factor")
        assert p.min() >= 1 if k else np.all(p == 1)
        listed = table["value"][table.text["symbol"] == "mu"][[4 * k + 2, 8 + 4 * k + 2]]
        assert mu[abs(v - 0.1) < 1e-9].tolist() == listed.tolist()
    assert any(
        "measured points of the article's Fig. 15 are not at hand" in n for n in result.notes
    )
