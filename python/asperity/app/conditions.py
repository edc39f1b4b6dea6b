"""The part of the conditions: pressure, temperature, velocities, correction, adhesion, heat."""

import math
from collections.abc import Awaitable, Callable
from typing import Any

from nicegui import ui

from asperity.app.parts import Quantity, part
from asperity.app.state import CORRECTIONS, State
from asperity.app.worker import Worker

_CORRECTIONS = {
    "none": "none: Persson's theory alone",
    "partial-contact": "partial contact (recommended)",
    "s-factor": "S-factor, gamma 0.5",
    "nayak-s-factor": "S-factor after Nayak",
    "affine-shift": "affine shift, p 1.5",
}


class ConditionsPart:
    """Sliders and switches; each changes one key of the scene."""

    def __init__(self, state: State, worker: Worker) -> None:
        self._state, self._worker = state, worker
        self._fields: dict[str, Any] = {}  # of a table, shown while it is used
        conditions = state.conditions
        with part("Conditions", "conditions-title"):
            Quantity(
                "Pressure [MPa]",
                conditions["pressure_pa"] / 1e6,
                (0.001, 10),
                self._set(conditions, "pressure_pa", 1e6),
                logarithmic=True,
            )
            Quantity(
                "Temperature [°C]",
                conditions["temperature_c"],
                (-60, 120),
                self._set(conditions, "temperature_c", 1.0),
                step=1,
            )
            self._velocities()
            kind = state.correction["kind"] if "correction" in state.used else "none"
            ui.select(
                _CORRECTIONS, value=kind, label="Correction", on_change=self._correction
            ).props("dense outlined").classes("w-full mt-2")
            self._adhesion()
            self._heat()

    def _velocities(self) -> None:
        sweep = self._state.conditions["velocity_m_s"]

        def end(key: str) -> Callable[[float], Awaitable[None]]:
            async def changed(value: float) -> None:
                ends = {**self._state.conditions["velocity_m_s"], key: value}
                decades = abs(math.log10(ends["to"] / ends["from"]))
                ends["points"] = max(round(4 * decades) + 1, 9)
                self._state.conditions["velocity_m_s"] = ends
                await self._worker.changed()

            return changed

        for name, key in (("Slowest velocity [m/s]", "from"), ("Fastest velocity [m/s]", "to")):
            Quantity(name, sweep[key], (1e-9, 100), end(key), logarithmic=True)

    def _adhesion(self) -> None:
        table = self._state.adhesion
        self._switch("Adhesion", "adhesion")
        with ui.element("div").classes("w-full") as fields:
            stress = self._set(table, "shear_stress_pa", 1e6)
            Quantity(
                "Shear stress [MPa]",
                table["shear_stress_pa"] / 1e6,
                (0.01, 100),
                stress,
                logarithmic=True,
            )
            velocity = self._set(table, "reference_velocity_m_s", 1e-3)
            Quantity(
                "Reference velocity [mm/s]",
                1e3 * table["reference_velocity_m_s"],
                (1e-3, 1e3),
                velocity,
                logarithmic=True,
            )
            Quantity("Width", table["width"], (0.01, 1), self._set(table, "width", 1.0))
        self._fields["adhesion"] = fields

    def _heat(self) -> None:
        table = self._state.heating
        self._switch("Heat of sliding", "heating")
        with ui.element("div").classes("w-full") as fields:
            diameter = self._set(table, "contact_diameter_m", 1e-3)
            Quantity(
                "Contact diameter [mm]",
                1e3 * table["contact_diameter_m"],
                (0.01, 20),
                diameter,
                logarithmic=True,
            )
            conductivity = self._set(table, "conductivity_w_m_k", 1.0)
            Quantity("Conductivity [W/(m K)]", table["conductivity_w_m_k"], (0.05, 2), conductivity)
        fields.set_visibility(False)
        self._fields["heating"] = fields

    def _switch(self, name: str, table: str) -> None:
        async def changed(event: Any) -> None:
            self._state.use(table, event.value)
            self._fields[table].set_visibility(event.value)
            await self._worker.changed()

        switch = ui.switch(name, value=table in self._state.used, on_change=changed)
        switch.props('color="blue-9"').classes("mt-1")

    async def _correction(self, event: Any) -> None:
        self._state.choose_correction(event.value)
        await self._worker.changed()

    def _set(
        self, table: dict[str, Any], key: str, unit: float
    ) -> Callable[[float], Awaitable[None]]:
        async def changed(value: float) -> None:
            table[key] = float(f"{value * unit:.12g}")
            await self._worker.changed()

        return changed


assert {*_CORRECTIONS} == {"none", *CORRECTIONS}
