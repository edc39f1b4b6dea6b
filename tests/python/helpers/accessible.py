"""What axe-core, whose rules are those of WCAG and of good practice, finds on a page."""

from typing import Any

import pytest


def violations(page: Any) -> list[str]:
    """A line for each rule that is broken, with where and why."""
    axe = pytest.importorskip(
        "axe_playwright_python.sync_playwright", reason="axe-core comes with asperity[browser]"
    )
    result = axe.Axe().run(page).response
    assert len(result["passes"]) > 15
    return [
        f"{rule['id']}: {node['target']}: {node['failureSummary']}"
        for rule in result["violations"]
        for node in rule["nodes"]
    ]
