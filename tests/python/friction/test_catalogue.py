"""Where methods fail: each row holds, its naive method fails, and the page says what a run does."""

import sys
from pathlib import Path

import pytest

sys.path.insert(0, str(Path(__file__).parents[2] / "stability"))
import catalogue
from rows import ROWS, outcome

ROOT = Path(__file__).parents[3]
PAGE = (ROOT / "docs/stability/catalogue.md").read_text(encoding="utf-8")
README = (ROOT / "README.md").read_text(encoding="utf-8")
LINES = [
    [cell.strip() for cell in line.strip("|\n").split(" | ")]
    for line in PAGE.splitlines()
    if line.startswith("| ")
][2:]


def test_the_page_has_every_row_and_readme_counts_them():
    assert [line[0] for line in LINES] == [row.regime for row in ROWS]
    assert f"[{len(ROWS)} regimes](docs/stability/catalogue.md)" in README


@pytest.mark.parametrize("index", range(len(ROWS)), ids=[row.regime[:40] for row in ROWS])
def test_ours_holds_where_the_naive_method_fails(index):
    row = ROWS[index]
    result = outcome(row)
    assert result.holds(row), result.ours
    assert result.naive_fails(row), result.naive
    stated, expected = LINES[index], catalogue.cells(row, result)
    assert [stated[i] for i in (0, 1, 2, 5)] == [expected[i] for i in (0, 1, 2, 5)]
    if isinstance(result.naive, str):
        assert stated[3] == result.naive
    else:
        # what cancels, or stops at a tolerance of its own, does not repeat to a digit elsewhere
        assert float(stated[3]) == pytest.approx(result.naive, rel=0.5)
    if isinstance(result.ours, float):
        error, _, allowed = stated[4].partition(" (at most ")
        assert float(error) <= row.allowed
        assert allowed == f"{row.allowed:.0e})"
    else:
        assert stated[4] == result.ours
