"""What 10 % more of each part of the scene is worth, on the page."""

from typing import Any

from nicegui import background_tasks, ui

from asperity.app.charts import worth_chart
from asperity.app.parts import chart, redraw
from asperity.app.worker import Found, Worker, in_thread
from asperity.scene.design import Design, design_at_largest, worth_text

_NONE = "There are no slopes for this scene: with heat, strain, directions or the contact of a scan"


class DesignPart:
    """Bars by decade of the modulus and of the wavelength; computed once they are looked at."""

    def __init__(self, worker: Worker) -> None:
        self._worker = worker
        self._told: Any = None  # the scene that is shown
        opened = ui.expansion("What makes the friction: 10 % more", on_value_change=self._seen)
        with opened.classes("w-full").props("dense") as self._opened:
            self._modulus = chart({}, "What 10 % more of the modulus is worth")
            self._waves = chart({}, "What 10 % more roughness is worth")
            self._others = ui.label("").classes("soft")

    def show(self) -> None:
        """Follow the scene, where this is open."""
        background_tasks.create(self._compute())

    async def _seen(self, event: Any) -> None:
        if event.value:
            await self._compute()

    async def _compute(self) -> None:
        found: Found | None = self._worker.found
        if found is None or not self._opened.value or found.scene is self._told:
            return
        scene, mu = found.scene, found.best.mu
        made = await in_thread(lambda: design_at_largest(scene, mu))
        self._told = scene
        for one in (self._modulus, self._waves):
            one.set_visibility(made is not None)
        self._others.set_text(_NONE if made is None else f"More of the others: {worth_text(made)}")
        if made is not None:
            self._draw(made)

    def _draw(self, made: Design) -> None:
        at = f"at {float(made.result.velocity[0, 0]):.3g} m/s, where mu is largest"
        parts = {"E' storage": "storage", "E'' loss": "loss"}
        rows = {name: [w for w in made.worths if w.part == part] for name, part in parts.items()}
        redraw(
            self._modulus,
            worth_chart(rows, "decade of reduced frequency [rad/s], and of a DMA at 10 Hz"),
            f"What 10 % more of the modulus is worth in mu, by decade of frequency, {at}",
        )
        waves = {"C(q)": [w for w in made.worths if w.part == "spectrum"]}
        redraw(
            self._waves,
            worth_chart(waves, "decade of wavelength [m]"),
            f"What 10 % more roughness is worth in mu, by decade of wavelength, {at}",
        )
