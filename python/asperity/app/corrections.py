"""Corrections that the page offers for a scene, and the arguments that they start from."""

import math
from typing import Any

from asperity.base.parameters import parameters
from asperity.scene.model import Scene
from asperity.scene.parts import KINDS
from asperity.surface import HeightMap

OF_PEAKS = ("local-peaks", "greenwood-williamson", "peaks-then-greenwood-williamson")
OF_SCAN = ("scan-contact", *OF_PEAKS)
_BEST = "partial-contact"  # is offered first
PLAIN = (_BEST, *(kind for kind in KINDS if kind not in (_BEST, *OF_SCAN)))


def offered(scene: Scene) -> tuple[str, ...]:
    """Kinds that the scene's surface can give all that they need: some need a map."""
    return (*PLAIN, *OF_SCAN) if isinstance(scene.surface.scan, HeightMap) else PLAIN


def usual(kind: str, scene: Scene | None) -> dict[str, Any]:
    """A kind with its usual arguments. Peaks lie half of the longest wavelength apart or more, and
    the macro-asperities are as wide as that wavelength."""
    if kind not in OF_PEAKS:
        starts = {one.key: one.start for one in parameters(KINDS[kind]) if one.start is not None}
        return {"kind": kind, **starts}
    assert scene is not None
    q0 = scene.spectrum.q0
    table = {"kind": kind, "min_distance_m": float(f"{math.pi / q0:.2g}")}
    return table if kind == "local-peaks" else {**table, "q0_per_m": float(f"{q0:.4g}")}
