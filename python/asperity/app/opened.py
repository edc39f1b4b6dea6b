"""Scene files that are dropped, with the files that they name: of these none is looked for."""

import io
from collections.abc import Sequence
from pathlib import PurePosixPath
from typing import Any

from asperity.app.files import MOST_FILES, Folder, plain
from asperity.base.arguments import reading
from asperity.base.diagnostics import InvalidInput, must_be, must_have
from asperity.io.archive import Archive
from asperity.io.instrument import understood
from asperity.io.toml import read_toml_text
from asperity.scene.keys import with_files
from asperity.scene.scene import check_tables

Dropped = Sequence[tuple[str, bytes]]  # names as the client has them, and contents
Tables = dict[str, dict[str, Any]]
_MOST_TEXT = 2**20  # bytes of a scene


def opened(dropped: Dropped, folder: Folder) -> tuple[str, Tables, list[str]]:
    """The name and the tables of the one scene among the files; those that it names are kept in
    the folder, and named in the tables and the list as there.

    Nothing is kept where the scene cannot be taken.
    """
    together = [one for name, content in dropped for one in _unpacked(name, content)]
    scenes = [one for one in together if one[0].lower().endswith(".toml")]
    if len(scenes) != 1:
        problem = f"{len(scenes)} scenes were dropped: must be one .toml, with the files it names"
        raise InvalidInput(problem)
    name, content = plain(scenes[0][0]), scenes[0][1]
    tables = _tables(name, content)
    contents = {plain(shown): one for shown, one in together}
    kept: list[str] = []

    def here(wanted: str) -> str:
        shown = plain(wanted)
        if shown not in contents:
            raise must_be("", "dropped together with the scene", f"{name} names {shown}")
        kept.append(folder.keep(shown, contents[shown]))
        return kept[-1]

    try:
        tables = {
            one: {key: with_files(f"{one}.{key}", value, here) for key, value in table.items()}
            for one, table in tables.items()
        }
    except InvalidInput:
        for one in kept:
            folder.forget(one)
        raise
    return name, tables, kept


def _unpacked(name: str, content: bytes) -> list[tuple[str, bytes]]:
    """The files of an archive, as the page gives its scenes away; any other file is itself."""
    if not name.lower().endswith(".zip"):
        return [(name, content)]
    shown = plain(name)
    with reading(PurePosixPath(shown)), understood("cannot be unpacked"):
        archive = Archive(io.BytesIO(content))
        if len(archive.members) > MOST_FILES:
            raise must_be("", f"at most {MOST_FILES}", f"holds {len(archive.members)} files")
        return [(one.filename, archive.open(one).read_all()) for one in archive.members]


def _tables(name: str, content: bytes) -> Tables:
    if len(content) > _MOST_TEXT:
        raise must_have("", f"at most {_MOST_TEXT}", f"has {len(content)} bytes", where=name)
    with reading(PurePosixPath(name)):
        tables = read_toml_text(content)
    check_tables(PurePosixPath(name), tables)  # type: ignore[arg-type]  # it only names it
    for key, table in tables.items():
        if not isinstance(table, dict):
            raise must_be(key, "a table", where=name)
    return tables
