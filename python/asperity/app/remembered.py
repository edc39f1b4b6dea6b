"""Builders of a scene's parts that keep what they built."""

from collections.abc import Callable
from pathlib import Path
from typing import Any, TypeVar

from asperity.correction import Correction
from asperity.scene.parts import build_correction
from asperity.spectrum import Spectrum

_Built = TypeVar("_Built")


class Remembered:
    """A builder that keeps its last few parts: files of a session never change."""

    def __init__(self, build: Callable[..., _Built]) -> None:
        self._build = build
        self._kept: dict[str, Any] = {}

    def __call__(self, path: Path, *arguments: Any) -> Any:
        key = repr((path, *arguments))
        if key not in self._kept:
            found = self._build(path, *arguments)
            while len(self._kept) >= 4:
                self._kept.pop(next(iter(self._kept)))
            self._kept[key] = found
        return self._kept[key]


class RememberedCorrection:
    """Builds corrections and keeps the last: to look for the peaks of a map takes its time."""

    def __init__(self) -> None:
        self._kept: tuple[str, Spectrum, tuple[Correction, dict[str, Any]]] | None = None

    def __call__(
        self, path: Path, table: object, spectrum: Spectrum, *of_surface: Any
    ) -> tuple[Correction, dict[str, Any]]:
        kept, key = self._kept, repr((path, table))
        if kept is None or kept[0] != key or kept[1] is not spectrum:
            kept = (key, spectrum, build_correction(path, table, spectrum, *of_surface))
            self._kept = kept
        correction, values = kept[2]
        return correction, dict(values)
