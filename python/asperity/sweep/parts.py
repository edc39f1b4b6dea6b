"""Parts of scenes that a worker keeps: what an axis does not change is built once a process."""

import json
from collections import OrderedDict
from collections.abc import Callable, Mapping
from concurrent.futures import Future
from dataclasses import replace
from pathlib import Path
from threading import Lock
from typing import Any

from asperity._core import InvalidInput
from asperity.base.diagnostics import Note
from asperity.io import plausible
from asperity.io.files import sha256
from asperity.scene.known import FILES
from asperity.scene.parts import build_correction
from asperity.scene.rubber import BuiltRubber, build_rubber
from asperity.scene.surface import Surface, build_surface


class Kept:
    """The latest `most` things that were built, each by one thread while others wait for it."""

    def __init__(self, most: int) -> None:
        self._most = most
        self._lock = Lock()
        self._made: OrderedDict[Any, Future[Any]] = OrderedDict()

    def get(self, key: Any, build: Callable[[], Any]) -> Any:
        with self._lock:
            mine = key not in self._made
            future = self._made.setdefault(key, Future())
            self._made.move_to_end(key)
            while len(self._made) > self._most:
                self._made.popitem(last=False)
        if mine:
            try:
                future.set_result(build())
            except BaseException as error:
                with self._lock:
                    self._made.pop(key, None)
                future.set_exception(error)
        return future.result()


_SCANS = Kept(2)  # with their heights, for corrections that ask for peaks
_SURFACES, _RUBBERS, _CORRECTIONS = Kept(1000), Kept(1000), Kept(1000)


class KeptBuilders:
    """Builders of a scene's parts that ask what was kept, for files of known content.

    `digests` has the SHA-256 of each file, by its path.
    """

    def __init__(self, digests: Mapping[str, str]) -> None:
        self._digests = digests
        self._surface: tuple[Any, Callable[[], Any]] | None = None

    def surface(self, path: Path, table: object) -> Surface:
        key = self._key(path, "surface", table)

        def whole() -> Any:
            return _SCANS.get(
                key, self._noting(lambda: build_surface(path, table), "surface", table)
            )

        def lean() -> Any:
            made, notes = whole()
            return replace(made, scan=None), notes

        self._surface = key, whole
        surface: Surface = _with_notes(_SURFACES.get(key, lean))
        return surface

    def rubber(self, path: Path, table: object, temperature: float | None) -> BuiltRubber:
        key = self._key(path, "rubber", table, temperature)
        build = self._noting(lambda: build_rubber(path, table, temperature), "rubber", table)
        rubber: BuiltRubber = _with_notes(_RUBBERS.get(key, build))
        return rubber

    def correction(self, path: Path, table: object, *_: Any) -> Any:
        assert self._surface is not None
        of_surface, whole = self._surface

        def build() -> Any:
            surface, _ = whole()
            return build_correction(path, table, surface.spectrum, surface.scan, surface.values)

        key = (of_surface, self._key(path, "correction", table))
        return _with_notes(_CORRECTIONS.get(key, self._noting(build, "correction", table)))

    def _key(self, path: Path, name: str, table: object, *more: Any) -> Any:
        digests = tuple(self._digests.get(file, "") for file in files_of({name: table}))
        return f"{path}", json.dumps(table, sort_keys=True, default=repr), digests, more

    def _noting(self, build: Callable[[], Any], name: str, table: object) -> Callable[[], Any]:
        """What builds a part of files that are still what they were, and collects its notes."""

        def noted() -> Any:
            for file in files_of({name: table}):
                if file in self._digests and digest(file) != self._digests[file]:
                    raise ChangedFile(f"{file}: was changed while the sweep ran")
            with plausible.collected() as notes:
                made = build()
            return made, tuple(notes)

        return noted


class ChangedFile(InvalidInput):
    """A file is not what it was when the sweep began: no failure of a scene, the sweep ends."""


def _with_notes(made: tuple[Any, tuple[Note, ...]]) -> Any:
    part, notes = made
    plausible.tell_again(notes)
    return part


def digest(file: str) -> str:
    """SHA-256 of a file's content; a file that cannot be read is no failure of one scene."""
    try:
        return sha256(Path(file))
    except InvalidInput as error:
        raise ChangedFile(*error.sentence, code=error.code, where=error.where) from error


def files_of(tables: Mapping[str, Any]) -> list[str]:
    """Files that the tables of a scene name."""
    files: list[str] = []
    for key in FILES:
        table, _, field = key.partition(".")
        entries = tables.get(table)
        names = entries.get(field) if isinstance(entries, Mapping) else None
        files += [names] if isinstance(names, str) else list(names or [])
    return files
