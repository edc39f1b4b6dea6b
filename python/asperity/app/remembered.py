"""Builders of a scene's parts that keep what they built."""

from collections.abc import Callable
from pathlib import Path
from typing import Any, TypeVar

from asperity.base.diagnostics import Note
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
        self._kept: dict[str, tuple[Any, list[Note]]] = {}

    def __call__(self, *arguments: Any) -> Any:
        key = repr(arguments)
        kept = self._kept.get(key)
        if kept is None:
            with plausible.collected() as notes:
                kept = self._build(*arguments), notes
            for old in list(self._kept)[: 1 - _MOST]:  # all but the newest
                self._kept.pop(old, None)  # unless another thread did
            self._kept[key] = kept
        result, notes = kept
        plausible.tell_again(notes)
        return result


class RememberedCorrection:
    """Builds corrections and keeps the last: to look for the peaks of a map takes its time."""

    def __init__(self) -> None:
        self._last: tuple[Spectrum, Remembered] | None = None

    def __call__(
        self, path: Path, table: object, spectrum: Spectrum, *of_surface: Any
    ) -> tuple[Correction, dict[str, Any]]:
        last = self._last  # another thread may put its own there meanwhile
        if last is None or last[0] is not spectrum:

            def build(path: Path, table: object) -> tuple[Correction, dict[str, Any]]:
                return build_correction(path, table, spectrum, *of_surface)

            self._last = last = spectrum, Remembered(build)
        correction, values = last[1](path, table)
        return correction, dict(values)
