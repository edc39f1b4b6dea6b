"""The table on the article's page says what docs/article/summary.md says."""

import re

import pytest

from asperity.article.statement import VERDICTS
from helpers.summaries import PUBLISHED, ROOT, statements, unit

PLAIN = re.compile(r"(?<![\w.])-?\d+(?:\.\d+)?(?:e[-+]?\d+)?")
SECTION = (ROOT / "docs/explanation/article.md").read_text(encoding="utf-8")
ROWS = [
    [cell.strip() for cell in line.split("|")[1:-1]]
    for line in SECTION.splitlines()
    if re.match(r"\| [A-Z]\d", line)
]
STATEMENTS = statements(PUBLISHED)


def test_the_page_counts_as_the_summary_does() -> None:
    verdicts = [row["verdict"] for row in STATEMENTS.values()]
    counts = [len(verdicts), *(verdicts.count(verdict) for verdict in VERDICTS)]
    form = (
        r"judges (\d+) statements.*?: (\d+) hold, (\d+) hold in part, (\d+) do not, "
        r"(\d+) are tuned, (\d+) cannot be checked.*?\s(\d+) are true by construction"
    )
    stated = re.search(form, " ".join(SECTION.split()))
    assert stated is not None
    assert [int(n) for n in stated.groups()] == counts
    assert len(ROWS) > 15


@pytest.mark.parametrize("row", ROWS, ids=lambda row: row[0])
def test_a_row_of_the_page_agrees_with_the_summary(row: list[str]) -> None:
    ids, _, found, verdict = row
    meant = [STATEMENTS[name] for name in ids.split(", ")]
    assert verdict == "; ".join(dict.fromkeys(statement["verdict"] for statement in meant))
    there = PLAIN.findall(" ".join(" ".join(statement.values()) for statement in meant))
    for number in PLAIN.findall(found):
        # 0.501: rounded to the digits that the page gives
        slack = 0.501 * unit(number)
        assert any(abs(float(number) - float(other)) <= slack for other in there), number
