"""The workflows of GitHub Actions as a subject."""

import re
from pathlib import Path

WORKFLOWS = Path(__file__).parents[3] / ".github/workflows"


def test_actions_are_pinned_by_commit():
    used = [
        line.strip()
        for path in WORKFLOWS.glob("*.yml")
        for line in path.read_text(encoding="utf-8").splitlines()
        if "uses:" in line
    ]
    assert used
    for line in used:
        assert re.fullmatch(r"- uses: [\w./-]+@[0-9a-f]{40} # v\d+(\.\d+)*", line), line
