"""Parts of scenes that a worker keeps: what an axis does not change is built once a process."""

from collections.abc import Callable, Mapping
from dataclasses import replace
from pathlib import Path
from typing import Any

from asperity._core import InvalidInput
from asperity.io.files import sha256
from asperity.scene.kept import Kept, as_key
from asperity.scene.keys import files_of
from asperity.scene.parts import build_correction
from asperity.scene.rubber import BuiltRubber, build_rubber
from asperity.scene.scene import Builders
from asperity.scene.section import Made
from asperity.scene.surface import Surface, build_surface

_SCANS = Kept(2)  # with their heights, for corrections that ask for peaks
_SURFACES, _RUBBERS, _CORRECTIONS = Kept(1000), Kept(1000), Kept(1000)


class WorkersBuilders(Builders):
    """Builders of a scene's parts that ask what was kept, for files of known content.

    `digests` has the SHA-256 of each file, by its path.
    """

    def __init__(self, digests: Mapping[str, str]) -> None:
        super().__init__(self._surface, self._rubber, self._correction)
        self._digests = digests
        self._scan: tuple[Any, Callable[[], Any]] | None = None

    def _surface(self, path: Path, table: object) -> Surface:
        key = self._key(path, "surface", table)

        def whole() -> Surface:
            return _SCANS.get(key, lambda: self._unchanged("surface", table, build_surface, path))

        self._scan = key, whole
        return _SURFACES.get(key, lambda: replace(whole(), scan=None))

    def _rubber(self, path: Path, table: object, temperature: float | None) -> BuiltRubber:
        key = self._key(path, "rubber", table, temperature)
        return _RUBBERS.get(
            key, lambda: self._unchanged("rubber", table, build_rubber, path, temperature)
        )

    def _correction(self, path: Path, table: object, *_: Any) -> Any:
        assert self._scan is not None
        of_surface, whole = self._scan

        def build() -> Any:
            surface = whole()
            return build_correction(path, table, surface.spectrum, surface.scan, surface.values)

        return _CORRECTIONS.get((of_surface, as_key(table)), build)

    def _key(self, path: Path, name: str, table: object, *more: Any) -> Any:
        digests = tuple(self._digests.get(file, "") for file in files_of({name: table}))
        return f"{path}", as_key(table), digests, more

    def _unchanged(
        self, name: str, table: object, build: Callable[..., Made], path: Path, *more: Any
    ) -> Made:
        """What is built of files that are still what they were."""
        for file in files_of({name: table}):
            if file in self._digests and digest(file) != self._digests[file]:
                raise ChangedFile(f"{file}: was changed while the sweep ran")
        return build(path, table, *more)


class ChangedFile(InvalidInput):
    """A file is not what it was when the sweep began: no failure of a scene, the sweep ends."""


def digest(file: str) -> str:
    """SHA-256 of a file's content; a file that cannot be read is no failure of one scene."""
    try:
        return sha256(Path(file))
    except InvalidInput as error:
        raise ChangedFile(*error.sentence, code=error.code, where=error.where) from error
