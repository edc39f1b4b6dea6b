"""The part of the conditions: pressure, temperature, velocities, direction, adhesion, heat."""

from collections.abc import Awaitable, Callable
from functools import partial
from typing import Any

from nicegui import ui

from asperity.app.loaded import PLAIN, offered
from asperity.app.parts import Changed, Quantity, controls, menu, part, slider
from asperity.app.state import State
from asperity.app.worker import Shows, Worker
from asperity.base.diagnostics import Error
from asperity.base.parameters import Parameter
from asperity.base.quantities import PRESSURE, ZERO_CELSIUS
from asperity.scene.model import Scene
from asperity.scene.parts import ADHESION, CORRECTIONS, HEATING, KINDS

_NONE = "none: Persson's theory alone"


class CorrectionFields:
    """A menu of those that the surface can give, and sliders for the arguments of the chosen."""

    def __init__(self, state: State, worker: Worker, setter: Callable[[str, str], Changed]) -> None:
        self._state, self._worker, self._set = state, worker, setter
        self._menu = menu("Correction", self._named(PLAIN), self._kind, self._chosen)
        self._menu.classes("mt-2")
        self._fields = ui.element("div").classes("w-full flex flex-col gap-2")
        self._ask()

    @property
    def _kind(self) -> str:
        return str(self._state.correction["kind"]) if "correction" in self._state.used else "none"

    def _named(self, kinds: tuple[str, ...]) -> dict[str, str]:
        named = dict.fromkeys(("none", *kinds, self._kind))
        return {kind: _NONE if kind == "none" else _title(kind) for kind in named}

    def offer(self, scene: Scene) -> None:
        named = self._named(offered(scene))
        if named != self._menu.options:
            self._menu.set_options(named, value=self._kind)

    async def _chosen(self, event: Any) -> None:
        if event.value == self._kind:
            return
        result = self._worker.found
        self._state.choose_correction(event.value, None if result is None else result.scene)
        self._ask()
        await self._worker.changed()

    def _ask(self) -> None:
        table = self._state.correction
        self._fields.clear()
        with self._fields:
            controls(CORRECTIONS.get(self._kind, {}), table, partial(self._set, "correction"))


def _title(kind: str) -> str:
    return KINDS[kind]._title or kind.replace("-", " ")


_UNFIT = (
    "Adhesion was switched off: its shear stress was fitted to the shipped scan and rubber. "
    "Fit yours to tests by asperity fit, or give one."
)


class ConditionsPart(Shows):
    """Sliders and switches; each changes one key of the scene."""

    def __init__(self, state: State, worker: Worker) -> None:
        self._state, self._worker = state, worker
        self._switches: dict[str, ui.switch] = {}
        with part("Conditions", "conditions-title"):
            self._inside = ui.element("div").classes("w-full flex flex-col gap-2")
        self.refresh()

    def refresh(self) -> None:
        self._inside.clear()
        with self._inside:
            slider(
                Parameter("pressure", float, 0.0, PRESSURE, usual=(1e3, 1e7), shown_unit="MPa"),
                self._state.conditions["pressure_pa"],
                self._set("conditions", "pressure_pa"),
            )
            self._temperature()
            self._velocities()
            degrees = self._state.conditions.get("direction_deg", 0.0)
            turn = self._set("conditions", "direction_deg")
            Quantity("Direction of sliding [°]", degrees, (-180, 180), turn, step=1)
            self._correction = CorrectionFields(self._state, self._worker, self._set)
            self._adhesion()
            self._heat()

    def _temperature(self) -> None:
        conditions = self._state.conditions
        if "temperature_k" in conditions:
            celsius = conditions["temperature_k"] - ZERO_CELSIUS
        elif "temperature_c" in conditions:
            celsius = conditions["temperature_c"]
        else:
            ui.label("This rubber is known at one temperature.").classes("soft")
            return

        async def changed(value: float) -> None:
            others = {k: v for k, v in self._state.conditions.items() if k != "temperature_k"}
            self._state.conditions = {**others, "temperature_c": value}
            await self._worker.changed()

        Quantity("Temperature [°C]", celsius, (-60, 120), changed, step=1)

    def _velocities(self) -> None:
        ends = list(self._state.velocities)

        def end(i: int) -> Callable[[float], Awaitable[None]]:
            async def changed(value: float) -> None:
                ends[i] = value
                if ends[0] != ends[1]:
                    self._state.set_velocities(*ends)
                await self._worker.changed()

            return changed

        for i, name in enumerate(("Slowest velocity [m/s]", "Fastest velocity [m/s]")):
            Quantity(name, ends[i], (1e-9, 100), end(i), logarithmic=True)

    def _adhesion(self) -> None:
        fields = self._switched("Adhesion", "adhesion")
        self._unfit = ui.label(_UNFIT).classes("soft")
        self._unfit.set_visibility(self._state.adhesion_left)
        with fields:
            controls(ADHESION, self._state.adhesion, partial(self._set, "adhesion"))

    def _heat(self) -> None:
        with self._switched("Heat of sliding", "heating"):
            controls(HEATING, self._state.heating, partial(self._set, "heating"))

    def _switched(self, name: str, table: str) -> ui.element:
        """A switch for a table of the scene, and the place of its fields."""

        async def changed(event: Any) -> None:
            if event.value == (table in self._state.used):
                return
            self._state.use(table, event.value)
            self._unfit.set_visibility(False)
            await self._worker.changed()

        switch = ui.switch(name, value=table in self._state.used, on_change=changed)
        self._switches[table] = switch.props('color="blue-9"').classes("mt-1")
        fields = ui.element("div").classes("w-full flex flex-col gap-2")
        return fields.bind_visibility_from(switch, "value")

    def _set(self, table: str, key: str) -> Changed:
        async def changed(value: Any) -> None:
            setattr(self._state, table, {**getattr(self._state, table), key: value})
            await self._worker.changed()

        return changed

    def show_scene(self, scene: Scene) -> None:
        self._correction.offer(scene)
        self._show_switches()

    def fail(self, error: Error) -> None:
        self._show_switches()

    def _show_switches(self) -> None:
        """Adhesion is left out where it does not fit files that were dropped."""
        for table, switch in self._switches.items():
            used = table in self._state.used
            if switch.value != used:
                switch.value = used
        self._unfit.set_visibility(self._state.adhesion_left)
