"""Corrections that the page offers for a scene, and the arguments that they start from."""

import math
from typing import Any

from asperity.scene.model import Scene
from asperity.surface import HeightMap

PLAIN: dict[str, dict[str, Any]] = {
    "partial-contact": {"kind": "partial-contact"},
    "s-factor": {"kind": "s-factor", "gamma": 0.5, "applies_to": "friction"},
    "nayak-s-factor": {"kind": "nayak-s-factor"},
    "affine-shift": {"kind": "affine-shift", "p": 1.5},
}
OF_PEAKS = ("local-peaks", "greenwood-williamson", "peaks-then-greenwood-williamson")
OF_SCAN = ("scan-contact", *OF_PEAKS)


def offered(scene: Scene) -> tuple[str, ...]:
    """Kinds that the scene's surface can give all that they need: some need a map."""
    return (*PLAIN, *OF_SCAN) if isinstance(scene.surface.scan, HeightMap) else tuple(PLAIN)


def usual(kind: str, scene: Scene | None) -> dict[str, Any]:
    """A kind with its usual arguments. Peaks lie half of the longest wavelength apart or more, and
    the macro-asperities are as wide as that wavelength."""
    if kind in PLAIN:
        return dict(PLAIN[kind])
    assert scene is not None
    q0 = scene.spectrum.q0
    table = {"kind": kind, "min_distance_m": float(f"{math.pi / q0:.2g}")}
    return table if kind == "local-peaks" else {**table, "q0_per_m": float(f"{q0:.4g}")}
