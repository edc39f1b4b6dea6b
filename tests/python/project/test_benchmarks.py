"""The notes on speed have the table of the benchmark."""

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parents[2] / "benchmarks"))
import rings


def test_the_notes_on_speed_have_the_table_of_the_benchmark():
    page, table = (path.read_text(encoding="utf-8") for path in (rings.PAGE, rings.TABLE))
    assert rings.with_table(page, rings.markdown(table)) == page
