"""Where methods fail: prints the catalogue as a table.

    python tests/stability/catalogue.py [--output docs/stability/catalogue.md]

Each row computes what a naive method and asperity come to and holds both against an independent
truth. Exit status 1 where a row does not hold, or where the naive method does not fail.
"""

import argparse
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parent))

import rows_asperities  # noqa: F401
import rows_bands  # noqa: F401
import rows_contact  # noqa: F401
import rows_fronts  # noqa: F401
import rows_heat  # noqa: F401
import rows_master  # noqa: F401
import rows_partial_contact  # noqa: F401
import rows_rubber  # noqa: F401
import rows_scan  # noqa: F401
import rows_sliding  # noqa: F401
import rows_tables  # noqa: F401
from rows import ROWS, Outcome, Row, outcome

HEAD = """# Where methods fail

Relative errors (the worst of a row's cases) of what is usually written and of asperity, or what
came instead of a number. Made by
`python tests/stability/catalogue.py --output docs/stability/catalogue.md`;
`tests/python/friction/test_catalogue.py` holds every row to it.

"""
COLUMNS = ("regime", "why", "naive method", "its error", "ours", "truth")


def show(error: float | str) -> str:
    return error if isinstance(error, str) else f"{error:.1e}"


def cells(row: Row, result: Outcome) -> list[str]:
    ours = show(result.ours)
    if isinstance(result.ours, float):
        ours = f"{ours} (at most {row.allowed:.0e})"
    return [row.regime, row.reason, row.naive, show(result.naive), ours, row.truth]


def table(outcomes: list[Outcome]) -> str:
    lines = [COLUMNS, ["---"] * len(COLUMNS)]
    lines += [cells(row, result) for row, result in zip(ROWS, outcomes, strict=True)]
    return "".join("| " + " | ".join(line) + " |\n" for line in lines)


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--output", type=Path, help="the page is written there too")
    arguments = parser.parse_args()
    outcomes = [outcome(row) for row in ROWS]
    text = table(outcomes)
    print(text, end="")
    bad = [
        row.regime
        for row, result in zip(ROWS, outcomes, strict=True)
        if not (result.holds(row) and result.naive_fails(row))
    ]
    for regime in bad:
        print(f"does not hold, or shows nothing: {regime}", file=sys.stderr)
    if arguments.output and not bad:
        arguments.output.write_text(HEAD + text, encoding="utf-8")
    return 1 if bad else 0


if __name__ == "__main__":
    sys.exit(main())
