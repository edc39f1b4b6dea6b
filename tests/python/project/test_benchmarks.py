"""The benchmarks' own methods are right, and the pages say what docs/benchmarks has."""

import sys
from pathlib import Path

import pytest

sys.path.insert(0, str(Path(__file__).parents[2] / "benchmarks"))
import charts
import schemes
from curves import curves, measured_curves

ROOT = Path(__file__).parents[3]
CURVES = {name: curve.thinned() for name, curve in curves().items()}
NOTES = (ROOT / "docs/notes/speed.md").read_text(encoding="utf-8")
TABLES = {
    path.name: path.read_text(encoding="utf-8") for path in (ROOT / "docs/benchmarks").glob("*.csv")
}


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


def test_the_notes_on_speed_have_the_table_of_the_benchmarks():
    assert charts.with_page(NOTES, charts.page(TABLES)) == NOTES
