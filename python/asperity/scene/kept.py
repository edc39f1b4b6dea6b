"""Builders of a scene's parts that keep the latest that they built."""

import json
from collections import OrderedDict
from collections.abc import Callable
from concurrent.futures import Future
from pathlib import Path
from threading import Lock
from typing import Any

from asperity.base.diagnostics import Note
from asperity.io import plausible
from asperity.scene.parts import build_correction
from asperity.scene.rubber import BuiltRubber, build_measured, build_rubber
from asperity.scene.scene import Builders
from asperity.scene.section import Made, Section
from asperity.scene.surface import READ, Surface, build_surface, read_scans


class Kept:
    """The latest `most` things that were built, each by one thread while others wait for it."""

    def __init__(self, most: int) -> None:
        self._most = most
        self._lock = Lock()
        self._made: OrderedDict[Any, Future[Any]] = OrderedDict()

    def get(self, key: Any, build: Callable[[], Made]) -> Made:
        """Return what `build` made for the key, and note again what was noted then."""
        with self._lock:
            mine = key not in self._made
            future = self._made.setdefault(key, Future())
            self._made.move_to_end(key)
            while len(self._made) > self._most:
                self._made.popitem(last=False)
        if mine:
            try:
                with plausible.collected() as notes:
                    made = build()
                future.set_result((made, notes))
            except BaseException as error:
                with self._lock:
                    self._made.pop(key, None)
                future.set_exception(error)
        result: tuple[Made, list[Note]] = future.result()
        plausible.tell_again(result[1])
        return result[0]


class KeptBuilders(Builders):
    """Builders that keep the latest `most` parts, of files that stay what they are."""

    def __init__(self, most: int) -> None:
        super().__init__(self._surface, self._rubber, self._correction)
        self._kept = Kept(most)

    def _surface(self, path: Path, table: object) -> Surface:
        key = "surface", as_key(table)
        return self._kept.get(key, lambda: build_surface(path, table, self._read))

    def _read(self, section: Section, every: bool) -> Any:
        which = {key: section.values[key] for key in READ if key in section.values}
        key = "scans", as_key(which), every
        return self._kept.get(key, lambda: read_scans(section, every))

    def _rubber(self, path: Path, table: object, at: float | None) -> BuiltRubber:
        key = "rubber", as_key(table), at
        return self._kept.get(key, lambda: build_rubber(path, table, at, self._measured))

    def _measured(self, section: Section) -> Any:
        key = "isotherms", as_key(section.values)
        return self._kept.get(key, lambda: build_measured(section))

    def _correction(self, path: Path, table: object, spectrum: Any, *scan: Any) -> Any:
        def build() -> Any:  # with the spectrum, so that no other has its id meanwhile
            return build_correction(path, table, spectrum, *scan), spectrum

        return self._kept.get(("correction", as_key(table), id(spectrum)), build)[0]


def as_key(table: object) -> str:
    """Return a table as a text that an equal one has too."""
    return json.dumps(table, sort_keys=True, default=repr)
