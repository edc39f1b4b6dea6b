"""Scene files that are dropped, with the files that they name: of these none is looked for."""

import io
import tomllib
import zipfile
from collections.abc import Callable, Mapping, Sequence
from pathlib import PurePosixPath
from typing import Any

from asperity._core import InvalidInput
from asperity.app.files import MOST_BYTES, MOST_FILES, Folder, plain
from asperity.scene.scene import check_tables

Dropped = Sequence[tuple[str, bytes]]  # names as the client has them, and contents
Tables = dict[str, dict[str, Any]]
_MOST_TEXT = 2**20  # bytes of a scene
_FILES = {"surface": ("file",), "rubber": ("master_curve", "shift", "isotherms")}


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
            raise InvalidInput(f"{name} names {shown}: must be dropped together with the scene")
        kept.append(folder.keep(shown, contents[shown]))
        return kept[-1]

    try:
        tables = {one: _with_files(one, table, here) for one, table in tables.items()}
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
    try:
        with zipfile.ZipFile(io.BytesIO(content)) as archive:
            inside = [one for one in archive.infolist() if not one.is_dir()]
            if len(inside) > MOST_FILES or sum(one.file_size for one in inside) > MOST_BYTES:
                most = f"{MOST_FILES} files and {MOST_BYTES // 2**20} MB"
                raise InvalidInput(f"{shown}: must unpack to at most {most}")
            return [(one.filename, archive.read(one)) for one in inside]
    except InvalidInput:
        raise
    except Exception as error:  # each way to compress has errors of its own for bytes it cannot be
        said = str(error) or "it ends too early"
        raise InvalidInput(f"{shown}: cannot be unpacked: {said}") from error


def _tables(name: str, content: bytes) -> Tables:
    if len(content) > _MOST_TEXT:
        raise InvalidInput(f"{name}: has {len(content)} bytes: must have at most {_MOST_TEXT}")
    try:
        tables = tomllib.loads(content.decode("utf-8"))
    except (tomllib.TOMLDecodeError, UnicodeDecodeError) as error:
        raise InvalidInput(f"{name}: not a TOML file: {error}") from error
    except (ValueError, RecursionError):  # Python's limits
        raise InvalidInput(f"{name}: not a TOML file: nested too deeply") from None
    check_tables(PurePosixPath(name), tables)  # type: ignore[arg-type]  # it only names it
    for key, table in tables.items():
        if not isinstance(table, dict):
            raise InvalidInput(f"{name}: {key}: must be a table")
    return tables


def _with_files(name: str, table: Mapping[str, Any], here: Callable[[str], str]) -> dict[str, Any]:
    """The table with the names of files as they are here; what is no name is refused later."""
    table = dict(table)
    for key in _FILES.get(name, ()):
        value = table.get(key)
        if isinstance(value, str):
            table[key] = here(value)
        elif isinstance(value, list) and all(isinstance(one, str) for one in value):
            table[key] = [here(one) for one in value]
    return table
