"""The part of the rubber: the shipped surrogate, or sweeps whose columns are named by menus."""

from functools import partial
from typing import Any

from nicegui import ui

from asperity.app.alternatives import AlternativesPart
from asperity.app.guess import QUANTITIES, UNITS
from asperity.app.parts import menu
from asperity.app.upload import Upload
from asperity.base.quantities import temperature_text
from asperity.plot.scene import rubber_figure
from asperity.scene.model import Scene

_SAID = {
    "frequency": "Frequency is column",
    "storage": "Storage is column",
    "loss": "Loss is column",
    "temperature": "Temp. is column",
}
_UNIT_OF = {
    "frequency": "Frequency in",
    "modulus": "Moduli in",
    "temperature": "Temperature in",
}
_CELSIUS = {"C": "°C"}
_DROP = "Drop DMA sweeps or a master curve here, or choose files"
_NO_TEMPERATURE = "none: a master curve"


class RubberPart(AlternativesPart):
    table = "rubber"

    def _add_fields(self) -> None:
        Upload(_DROP, self._taken, self._say, multiple=True)
        self._menus = ui.element("div").classes("w-full")

    async def _taken(self, files: list[tuple[str, bytes]]) -> None:
        kept = []
        for name, content in files:
            keep = partial(self._state.keep_dma, name, content)
            kept.append(await self._worker.attempt(keep, self._say))
            if kept[-1] is None:
                for useless in kept[:-1]:
                    self._state.folder.forget(useless)
                return
        self._ask(kept)
        self._say("")

    def _ask(self, files: list[str]) -> None:
        guess = self._state.guesses[files[0]]
        chosen: dict[str, ui.select] = {}
        units: dict[str, ui.select] = {}
        self._menus.clear()
        with self._menus:
            shown = ", ".join(self._state.folder.shown[name] for name in files)
            ui.label(f"Of {shown}: is this right?").classes("soft")
            with ui.element("div").classes("grid grid-cols-1 sm:grid-cols-2 gap-2 w-full"):
                for quantity in QUANTITIES:
                    value = guess.columns.get(quantity)
                    names = {name: name for name in guess.names}
                    if quantity == "temperature":
                        names, value = {"": _NO_TEMPERATURE, **names}, value or ""
                    chosen[quantity] = menu(_SAID[quantity], names, value)
                for kind, unit in guess.units.items():
                    named = {one: _CELSIUS.get(one, one) for one in UNITS[kind]}
                    units[kind] = menu(_UNIT_OF[kind], named, unit)
                kinds = {"E": "E, Young's", "G": "G, shear"}
                modulus = menu("The moduli are", kinds, guess.modulus)
            prony = ui.checkbox("Fit a Prony series to sweeps").classes("mr-3")
            beyond = ui.checkbox("Go on beyond what was measured").classes("mr-3")

            async def take() -> None:
                columns = {name: one.value or None for name, one in chosen.items()}
                said = {"units": {name: one.value for name, one in units.items()}}
                said |= {"modulus": modulus.value, "prony": prony.value, "beyond": beyond.value}
                await self._use(files, {"columns": columns, **said})

            ui.button("Make the master curve", on_click=take).props('no-caps color="blue-9"')

    async def _use(self, files: list[str], settings: dict[str, Any]) -> None:
        for name, column in settings["columns"].items():
            if column is None and name != "temperature":
                self._say(f"which column is the {name}? None is chosen")
                return
        read = partial(self._state.use_dma, files, settings)
        await self._take_up(read, "making the master curve ...")

    def show_scene(self, scene: Scene) -> None:
        built = scene.built_rubber
        asked = scene.velocity.min(), scene.velocity.max(), scene.spectrum.q0, scene.spectrum.q1
        if (built, *asked) == self._drawn:
            return
        self._drawn = built, *asked
        at = built.temperature
        facts = "as it was given" if at is None else f"at {temperature_text(at, celsius=True)}"
        if built.build is not None:
            n, residual = len(built.isotherms), built.build.residual
            facts += f", of {n} isotherms that overlap to {100 * residual:.2g} %"
        self._facts.set_text(facts)
        name = f"Storage and loss modulus over the angular frequency, {facts}"
        if built.build is not None:
            name += "; Shift factors log10 a_T over the temperature"
        self._picture.show(partial(rubber_figure, scene), name)
