"""The table of exact sliding contacts is what `slide` gives."""

import sys
from pathlib import Path

import pytest

sys.path.insert(0, str(Path(__file__).parents[2] / "reference"))
import make_exact_sliding

ROWS = make_exact_sliding.rows()


@pytest.mark.parametrize("name", ["a_39", "ja_7", "sk_5"])
def test_rows_are_what_the_solver_gives(name):
    (row,) = [row for row in ROWS if row["case"] == name]
    found = make_exact_sliding.solved(row)
    assert float(found["A"]) == pytest.approx(float(row["A"]), rel=2e-3)
    assert float(found["mu"]) == pytest.approx(float(row["mu"]), rel=1e-3)
