"""Corrections that the page offers for a scene, and the arguments that they start from."""

import math
from pathlib import Path
from typing import Any

from asperity.correction import Correction
from asperity.scene.model import Scene
from asperity.scene.parts import build_correction
from asperity.spectrum import Spectrum
from asperity.surface import HeightMap

PLAIN: dict[str, dict[str, Any]] = {
    "partial-contact": {"kind": "partial-contact"},
    "s-factor": {"kind": "s-factor", "gamma": 0.5, "applies_to": "friction"},
    "nayak-s-factor": {"kind": "nayak-s-factor"},
    "affine-shift": {"kind": "affine-shift", "p": 1.5},
}
OF_PEAKS = ("local-peaks", "greenwood-williamson", "peaks-then-greenwood-williamson")


def offered(scene: Scene) -> tuple[str, ...]:
    """Kinds that the scene's surface can give all that they need: peaks are seen on maps alone."""
    return (*PLAIN, *OF_PEAKS) if isinstance(scene.surface.scan, HeightMap) else tuple(PLAIN)


def usual(kind: str, scene: Scene | None) -> dict[str, Any]:
    """A kind with its usual arguments. Peaks lie half of the longest wavelength apart or more, and
    the macro-asperities are as wide as that wavelength."""
    if kind in PLAIN:
        return dict(PLAIN[kind])
    assert scene is not None
    q0 = scene.spectrum.q0
    table = {"kind": kind, "min_distance_m": float(f"{math.pi / q0:.2g}")}
    return table if kind == "local-peaks" else {**table, "q0_per_m": float(f"{q0:.4g}")}


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
