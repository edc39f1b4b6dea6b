"""The benchmarks' own methods are right, and the pages say what docs/benchmarks has."""

import re
import sys
from pathlib import Path

import numpy as np
import pytest

import asperity

sys.path.insert(0, str(Path(__file__).parents[2] / "benchmarks"))
import charts
import models
import schemes
from curves import curves, measured_curves

ROOT = Path(__file__).parents[3]
CURVES = {name: curve.thinned() for name, curve in curves().items()}
TERMS = [name for name in CURVES if name != "tabulated modulus"]
SPEED = (ROOT / "docs/explanation/speed.md").read_text(encoding="utf-8")
NOTES = (ROOT / "docs/notes/speed.md").read_text(encoding="utf-8")
WORTH = (ROOT / "docs/explanation/corrections.md").read_text(encoding="utf-8")
DOCS = ROOT / "docs/benchmarks"
TABLES = {path.name: path.read_text(encoding="utf-8") for path in DOCS.glob("*.csv")}


def rows(name):
    return charts.rows_of(TABLES[f"{name}.csv"])[0]


def found(scene, method, setting):
    """Error of a point of the work-precision diagrams."""
    point = {"scene": scene, "method": method, "setting": setting}
    (row,) = [row for row in rows("work_precision") if point.items() <= row.items()]
    return float(row["error"])


@pytest.mark.parametrize("name", CURVES)
def test_graded_panels_reach_what_their_angular_integrals_are_good_to(name):
    curve = CURVES[name]
    # 12 points a row of a table: 2e-13, measured
    allowed = 1e-12 if name == "tabulated modulus" else 2e-14
    assert curve.error(schemes.graded_panels(curve, 24, 3, 0.1, 1)) < allowed


@pytest.mark.parametrize("name", measured_curves())
def test_panels_between_rings_reach_what_is_known(name):
    curve = measured_curves()[name].of_velocities(slice(None, None, 7))
    # a table's angular integrals have 12 points a row
    allowed = {"392 rings, 20 terms": 2e-13, "392 rings, master curve": 1e-12}
    assert curve.error(schemes.graded_panels(curve, 8, 2, 0.03, 1)) < allowed[name]


@pytest.mark.parametrize("name", TERMS)
def test_by_parts_converges(name):
    errors = [CURVES[name].error(schemes.by_parts(CURVES[name], n)) for n in (12, 24, 64)]
    assert errors[1] < errors[0] / 100
    assert errors[2] < 1e-10


@pytest.mark.parametrize("name", CURVES)
def test_slopes_of_the_angular_integrals_are_those_of_differences(name):
    modulus, w, step = CURVES[name].modulus, np.geomspace(1e-2, 1e7, 37), 1e-4
    above, below = (modulus(w * np.exp(sign * step)) for sign in (1, -1))
    for k, slope in enumerate(modulus.with_slopes(w)[2:]):
        difference = (above[k] - below[k]) / (2 * step)
        # second order in the step, and rounding over it
        size = np.abs(modulus(w)[k])
        assert np.all(np.abs(slope - difference) <= 1e-6 * size)


def test_the_logarithmic_trapezoid_converges_with_the_square_of_its_step():
    curve = CURVES["mild"]
    coarse, fine = (curve.error(schemes.log_trapezoid(curve, n)) for n in (301, 601))
    assert coarse / fine == pytest.approx(4, rel=0.02)


def test_nested_quad_meets_a_mild_curve():
    curve = CURVES["mild"].of_velocities(slice(10, 11))
    assert curve.error(schemes.nested_quad(curve, 1e-6)) < 1e-6


def test_the_single_scale_is_light_contact():
    curve = CURVES["weak contact"]
    rubber = asperity.PronySeries(equilibrium_modulus=1e9, moduli=[], relaxation_times=[])
    area = asperity.contact_area(
        curve.road, rubber, pressure=1e3, velocity=1.0, poisson_ratio=0.0, rtol=1e-9
    )
    # erf(x) = 2 x / sqrt(pi) (1 - x^2 / 3), x^2 = 2 p*^2 of 1e-6
    assert models.single_scale(curve.road, 1e9, 1e3) == pytest.approx(area, rel=1e-6)


def test_the_notes_on_speed_have_the_table_of_the_benchmarks():
    assert charts.with_page(NOTES, charts.page(TABLES)) == NOTES


@pytest.mark.parametrize("name", ["work_precision", "models", "scaling"])
def test_the_page_of_speed_shows_the_pictures(name):
    assert f"(../benchmarks/{name}.png)" in SPEED
    assert (DOCS / f"{name}.png").stat().st_size > 10_000
    assert (DOCS / f"{name}.svg").stat().st_size > 10_000


def test_ours_and_gsls_kept_what_they_promised_in_the_diagrams():
    kept = [
        (float(row["error"]), float(row["setting"]))
        for row in rows("work_precision")
        if row["method"] == "ours" or row["method"].startswith("GSL")
    ]
    assert len(kept) > 100
    assert all(error <= max(rtol, 1e-14) for error, rtol in kept)


def test_the_page_of_speed_says_where_other_methods_end():
    text = " ".join(SPEED.split())
    grid = re.search(r"grid of 1e5 points is still wrong by (\d+) %", text)
    quad = re.search(r"nested `quad` asked for (\S+) by (\S+)\.\s", text)
    error = found("steep front", "logarithmic trapezoid", "100000")
    assert f"{100 * error:.0f}" == grid[1]
    asked, error = float(quad[1]), float(quad[2])
    assert f"{found('steep front', 'nested quad', f'{asked:.0e}'):.1e}" == f"{error:.1e}"
    said = re.search(r"by parts with (\d+) nodes", text)
    assert all(found(name, "by parts, fixed nodes", said[1]) < 1e-10 for name in TERMS)


def test_errors_of_the_models_are_those_of_the_validation():
    errors = {row["model"]: row for row in rows("models")}
    table = WORTH.partition("| correction | area, mean")[2]
    for name, line in (
        ("Persson, exact", "none"),
        ("p_T from IGW, added", "IGW, added"),
        ("S by bandwidth (Nayak)", "`NayakSFactor()`"),
    ):
        cells = next(row for row in table.splitlines() if row.startswith(f"| {line} |"))
        numbers = [abs(float(cell)) for cell in cells.split("|")[2:6]]
        stated = zip(("area", "energy"), (numbers[:2], numbers[2:]), strict=True)
        for kind, (mean, worst) in stated:
            row = {key: errors[name][f"{kind}_error_{key}_percent"] for key in ("mean", "worst")}
            assert float(row["mean"]) == pytest.approx(mean, abs=0.06)
            assert float(row["worst"]) == pytest.approx(worst, abs=0.06)


def test_the_page_of_speed_says_what_they_are_worth_on_worn_surfaces():
    text = " ".join(SPEED.partition("On worn surfaces")[2].split())
    worn = {row["model"]: row["worn_mu_error_rms_percent"] for row in rows("models")}
    for names, pattern in (
        (["PartialContact"], r"`PartialContact` is off by (\d+) % rms"),
        (["Persson, exact"], r"no correction by (\d+) %"),
        (["S on the integrand, 0.40", "S on the integrand, 0.50"], r"S by (\d+) to (\d+) %"),
        (["p_T from peaks, lambda0", "p_T from peaks, lambda0/2"], r"peaks by (\d+) and (\d+) %"),
        (["p_T from IGW, added", "p_T from IGW, implicit"], r"peaks by (\d+) to (\d+) %"),
    ):
        assert [*re.search(pattern, text).groups()] == [f"{float(worn[n]):.0f}" for n in names]
    assert float(worn["ScanContact"]) < 0.35
    assert "within 0.3 % rms on both" in text


def test_the_page_of_speed_says_what_the_models_make_of_mu():
    text = " ".join(SPEED.partition("## Models of contact")[2].split())
    errors = {row["model"]: row for row in rows("models")}
    rms = {
        name: float(row["mu_error_rms_percent"])
        for name, row in errors.items()
        if row["mu_contacts"]
    }
    ours, worst = re.search(r"about mu: (\d+) % rms \((\d+) % at worst\)", text).groups()
    assert f"{rms.pop('PartialContact'):.0f}" == ours
    assert f"{float(errors['PartialContact']['mu_error_worst_percent']):.0f}" == worst
    del rms["ScanContact"]  # which knows more than a spectrum
    least, most = re.search(r"off by (\d+) to (\d+) % rms", text).groups()
    assert (f"{min(rms.values()):.0f}", f"{max(rms.values()):.0f}") == (least, most)
    for name, pattern in (
        ("Persson, exact", r"no correction by (\d+) %"),
        ("S on the integrand, 0.40", r"S by (\d+) % with 0.40"),
        ("S on the integrand, 0.50", r"and (\d+) % with 0.50"),
        ("single scale at q_1", r"of a microsecond, by (\d+) %"),
    ):
        assert f"{rms[name]:.0f}" == re.search(pattern, text)[1]


def test_a_single_scale_of_light_contact_has_the_friction_of_its_wave():
    # a narrow band is one scale, and an even loss makes I1 = 4 E'', I2 = 2 pi |E|^2
    loss = asperity.MasterCurve(
        angular_frequency=[1e-6, 1.0, 1e6], storage_modulus=[1e6] * 3, loss_modulus=[5e5] * 3
    )
    road = asperity.SelfAffineSpectrum(rms_height=1e-6, hurst=0.8, q0=1e4, q1=1.0001e4)
    exact = asperity.friction(road, loss, pressure=1.0, velocity=1e-6).hysteresis
    modulus = loss.modulus(1e-6 * road.q1) / 0.75
    found = models.models_sliding.friction_of_a_single_scale(road.rms_slope, modulus, 1.0)
    assert found == pytest.approx(float(exact), rel=1e-3)
