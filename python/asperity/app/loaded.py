"""Scenes of the tables that the page edits: nothing is edited here, so any thread may call this."""

import math
import tomllib
from pathlib import Path
from typing import Any

from asperity.app.opened import Tables
from asperity.base.diagnostics import Argument, InvalidInput
from asperity.base.parameters import parameters
from asperity.scene.model import Scene
from asperity.scene.parts import KINDS
from asperity.scene.scene import Builders, scene_of, scene_text
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


OPTIONAL = ("correction", "adhesion", "heating", "solver", "uncertainty")


def loaded(path: Path, tables: Tables, builders: Builders) -> Scene:
    """The scene of a file with these tables, as the shell reads it; none is written, which another
    thread could find half written. `path` is whose errors they are."""
    of_scan = tables.get("correction", {}).get("kind") in OF_SCAN
    if of_scan and "file" not in tables["surface"]:
        problem = "this correction is made from a scan: choose a scan, or another one"
        raise InvalidInput(problem)
    as_read = tomllib.loads(scene_text(tables))
    return scene_of(path, as_read, for_friction=True, builders=builders)


def usable(tables: Tables) -> Tables:
    """Copies of the tables, without what has no meaning beside the others."""
    tables = {name: dict(table) for name, table in tables.items()}
    if "heating" in tables and "adhesion" not in tables:
        tables["heating"].pop("interface_share", None)  # of what adhesion makes
    if not {"isotherms", "shift", "wlf_c1"} & tables["rubber"].keys():  # has one temperature
        for key in ("temperature_k", "temperature_c"):
            tables["conditions"].pop(key, None)
    return tables


def editable(name: str, tables: Tables) -> Tables:
    """The tables of a scene with each value where the page edits it; what the shell computes but
    the page has no place for is refused."""
    rubber, conditions = dict(tables["rubber"]), dict(tables["conditions"])
    for key in ("temperature_k", "temperature_c"):  # the slider's place
        if key in rubber:
            conditions[key] = rubber.pop(key)
    for key in ("pressure_pa", "temperature_k", "temperature_c", "direction_deg"):
        if isinstance(conditions.get(key, 0.0), list | dict):
            problem = "the page shows one pressure, temperature and direction: must be a number"
            raise InvalidInput(Argument(f"[conditions] {key}"), f": {problem}", where=name)
    return {**tables, "rubber": rubber, "conditions": conditions}
