"""The recipes of CONTRIBUTING name files that exist and hold what the recipe says."""

import re
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[3]
TEXT = (ROOT / "CONTRIBUTING.md").read_text(encoding="utf-8")
SECTION = re.compile(r"^### (Add [^\n]*)\n(.*?)(?=^##|\Z)", re.M | re.S)
RECIPES = dict(SECTION.findall(TEXT))
SOURCES = [
    path
    for folder in ("cpp/include", "cpp/src", "python")
    for path in (ROOT / folder).rglob("*")
    if path.suffix in {".hpp", ".cpp", ".inc", ".py"}
]


def rows(recipe: str) -> dict[Path, list[str]]:
    """Files of a recipe, and the names that must stand in each."""
    found = re.findall(r"^\| `([^`]+)` \| (.*) \|$", RECIPES[recipe], re.M)
    return {ROOT / file: re.findall(r"`([^`]+)`", what) for file, what in found}


def holds(path: Path, name: str) -> bool:
    text = path.read_text(encoding="utf-8")
    return re.search(rf"(?<!\w){re.escape(name)}(?!\w)", text) is not None


def test_there_are_recipes() -> None:
    assert len(RECIPES) >= 4


@pytest.mark.parametrize("recipe", RECIPES)
def test_what_a_recipe_names_stands_in_its_files(recipe: str) -> None:
    example = re.search(r"^Example: `(\w+)`", RECIPES[recipe], re.M)
    assert example is not None
    files = rows(recipe)
    assert len(files) >= 3
    missing = [
        f"{path.relative_to(ROOT)}: {name}"
        for path, names in files.items()
        for name in (*names, example[1])
        if not path.is_file() or not holds(path, name)
    ]
    assert missing == []
    if "which stands in no other source" in RECIPES[recipe]:
        assert {path for path in SOURCES if holds(path, example[1])} == files.keys()


def test_what_a_change_costs() -> None:
    """So many files that a person edits; more is a step back."""
    costs = {recipe: len(rows(recipe)) for recipe in RECIPES}
    assert costs["Add a parameter"] == 4
    assert costs["Add a correction by an S"] == 5
    assert costs["Add a correction with a rule of its own"] == 8
    assert costs["Add a column of the friction result"] == 3
