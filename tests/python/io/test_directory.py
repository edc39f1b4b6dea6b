"""What a command takes for its own in a directory that it fills again."""

from pathlib import Path

import pytest

import asperity
from asperity.io.directory import Mark, begins, check_own_directory, table_of

MARKS: dict[str, list[Mark]] = {
    "a.csv": [table_of("worth a")],
    "a.png": ["a.csv"],
    "notes.md": [begins("# Worth\n")],
}
OWN = {"a.csv": "# asperity 0.0.9 worth a\nx\n", "a.png": "drawn", "notes.md": "# Worth\nmuch"}


def refused(directory: Path) -> str:
    with pytest.raises(asperity.InvalidInput) as caught:
        check_own_directory(directory, "the worth", MARKS)
    return str(caught.value)


def fill(directory: Path, files: dict[str, str]) -> None:
    for name, text in files.items():
        (directory / name).write_text(text)


def test_nothing_and_own_files_are_let_pass(tmp_path: Path) -> None:
    check_own_directory(tmp_path / "far" / "out", "the worth", MARKS)
    assert list(tmp_path.iterdir()) == []
    fill(tmp_path, {"others.txt": ""})
    check_own_directory(tmp_path, "the worth", MARKS)
    fill(tmp_path, OWN)
    check_own_directory(tmp_path, "the worth", MARKS)
    assert {name: (tmp_path / name).read_text() for name in OWN} == OWN


@pytest.mark.parametrize(
    ("files", "foreign"),
    [
        ({"a.png": "drawn"}, "a.png"),
        ({**OWN, "a.csv": "x\n1\n"}, "a.csv, a.png"),
        ({**OWN, "a.csv": "# asperity 0.0.9 worth\n"}, "a.csv, a.png"),
        ({**OWN, "a.csv": ""}, "a.csv, a.png"),
        ({**OWN, "notes.md": "# Worth"}, "notes.md"),
    ],
)
def test_files_of_another_are_named(tmp_path: Path, files: dict[str, str], foreign: str) -> None:
    fill(tmp_path, files)
    wanted = f"{tmp_path}: holds {foreign}, not the worth's own: choose another --output"
    assert refused(tmp_path) == wanted


def test_a_directory_or_a_dead_link_of_the_name_is_anothers(tmp_path: Path) -> None:
    (tmp_path / "a.csv").mkdir()
    (tmp_path / "notes.md").symlink_to("nowhere")
    assert "holds a.csv, notes.md, not the worth's own" in refused(tmp_path)
