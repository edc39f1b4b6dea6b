"""The choice of a correction, and its arguments."""

from collections.abc import Awaitable, Callable
from typing import Any

from nicegui import ui

from asperity.app.corrections import OF_SCAN, PLAIN, offered
from asperity.app.parts import Quantity
from asperity.app.state import State
from asperity.app.worker import Worker
from asperity.scene.model import Scene

_NAMES = {
    "none": "none: Persson's theory alone",
    "partial-contact": "partial contact (recommended)",
    "scan-contact": "exact contact of the scan itself",
    "s-factor": "S-factor",
    "nayak-s-factor": "S-factor after Nayak",
    "affine-shift": "affine shift",
    "local-peaks": "local peaks of the scan",
    "greenwood-williamson": "Greenwood-Williamson on the scan's peaks",
    "peaks-then-greenwood-williamson": "local peaks, then Greenwood-Williamson",
}
# of an argument: its name, its unit, the ends of the slider, whether that is logarithmic, default
_ARGUMENTS: dict[str, tuple[str, float, tuple[float, float], bool, float]] = {
    "tolerance": ("tolerance", 1.0, (0.001, 0.1), True, 0.02),
    "gamma": ("gamma", 1.0, (0.01, 1), False, 0.5),
    "friction_gamma": ("gamma of friction", 1.0, (0.01, 1), False, 0.4),
    "p": ("p", 1.0, (1, 5), False, 1.5),
    "min_distance_m": ("Least distance of peaks [µm]", 1e-6, (0.1, 1e5), True, 1e-4),
    "q0_per_m": ("q0 of macro-asperities [1/m]", 1.0, (10, 1e6), True, 1e3),
}
_OF = {
    "scan-contact": ("tolerance",),
    "s-factor": ("gamma",),
    "nayak-s-factor": ("friction_gamma",),
    "affine-shift": ("p",),
    "local-peaks": ("min_distance_m",),
    "greenwood-williamson": ("min_distance_m", "q0_per_m"),
    "peaks-then-greenwood-williamson": ("min_distance_m", "q0_per_m"),
}
_Set = Callable[[str, str, float], Callable[[float], Awaitable[None]]]


class CorrectionFields:
    """A menu of those that the surface can give, and sliders for the arguments of the chosen."""

    def __init__(self, state: State, worker: Worker, setter: _Set) -> None:
        self._state, self._worker, self._set = state, worker, setter
        kind = self._kind
        self._menu = ui.select(
            self._named(tuple(PLAIN)), value=kind, label="Correction", on_change=self._chosen
        )
        self._menu.props("dense outlined").classes("w-full mt-2")
        self._fields = ui.element("div").classes("w-full flex flex-col gap-2")
        self._ask()

    @property
    def _kind(self) -> str:
        return str(self._state.correction["kind"]) if "correction" in self._state.used else "none"

    def _named(self, kinds: tuple[str, ...]) -> dict[str, str]:
        return {kind: _NAMES[kind] for kind in dict.fromkeys(("none", *kinds, self._kind))}

    def offer(self, scene: Scene) -> None:
        """Let the menu have what the scene's surface can give."""
        named = self._named(offered(scene))
        if named != self._menu.options:
            self._menu.set_options(named, value=self._kind)

    async def _chosen(self, event: Any) -> None:
        if event.value == self._kind:
            return
        found = self._worker.found
        self._state.choose_correction(event.value, None if found is None else found.scene)
        self._ask()
        await self._worker.changed()

    def _ask(self) -> None:
        table = self._state.correction
        self._fields.clear()
        with self._fields:
            for key in _OF.get(self._kind, ()):
                if "heights_m" in table and key == "min_distance_m":
                    continue  # of a scene that lists its peaks
                name, unit, ends, logarithmic, default = _ARGUMENTS[key]
                value = table.get(key, default) / unit
                changed = self._set("correction", key, unit)
                Quantity(name, value, ends, changed, logarithmic=logarithmic)


assert {*_NAMES} == {"none", *PLAIN, *OF_SCAN}
