"""Builders of a scene's parts that keep what they built."""

from collections.abc import Callable
from pathlib import Path
from typing import Any, TypeVar

from asperity.correction import Correction
from asperity.io import plausible
from asperity.scene.parts import build_correction
from asperity.spectrum import Spectrum

_MOST = 4  # parts that one builder keeps
_Built = TypeVar("_Built")


class Remembered:
    """Keeps the last few that it built, with their notes: files of a session never change."""

    def __init__(self, build: Callable[..., _Built]) -> None:
        self._build = build
        self._kept: dict[str, tuple[Any, list[str]]] = {}

    def __call__(self, *arguments: Any) -> Any:
        key = repr(arguments)
        if key not in self._kept:
            with plausible.collected() as notes:
                found = self._build(*arguments)
            while len(self._kept) >= _MOST:
                self._kept.pop(next(iter(self._kept)), None)
            self._kept[key] = found, notes
        found, notes = self._kept[key]
        plausible.tell_again(notes)
        return found


class RememberedCorrection:
    """Builds corrections and keeps the last: to look for the peaks of a map takes its time."""

    def __init__(self) -> None:
        self._last: tuple[Spectrum, Remembered] | None = None

    def __call__(
        self, path: Path, table: object, spectrum: Spectrum, *of_surface: Any
    ) -> tuple[Correction, dict[str, Any]]:
        if self._last is None or self._last[0] is not spectrum:

            def build(path: Path, table: object) -> tuple[Correction, dict[str, Any]]:
                return build_correction(path, table, spectrum, *of_surface)

            self._last = spectrum, Remembered(build)
        correction, values = self._last[1](path, table)
        return correction, dict(values)
