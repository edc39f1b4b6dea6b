"""The choice of a correction, and its arguments."""

from collections.abc import Callable
from functools import partial
from typing import Any

from nicegui import ui

from asperity.app.controls import Changed, controls
from asperity.app.corrections import PLAIN, offered
from asperity.app.state import State
from asperity.app.worker import Worker
from asperity.scene.model import Scene
from asperity.scene.parts import CORRECTIONS, KINDS

_NONE = "none: Persson's theory alone"


class CorrectionFields:
    """A menu of those that the surface can give, and sliders for the arguments of the chosen."""

    def __init__(self, state: State, worker: Worker, setter: Callable[[str, str], Changed]) -> None:
        self._state, self._worker, self._set = state, worker, setter
        kind = self._kind
        self._menu = ui.select(
            self._named(PLAIN), value=kind, label="Correction", on_change=self._chosen
        )
        self._menu.props("dense outlined").classes("w-full mt-2")
        self._fields = ui.element("div").classes("w-full flex flex-col gap-2")
        self._ask()

    @property
    def _kind(self) -> str:
        return str(self._state.correction["kind"]) if "correction" in self._state.used else "none"

    def _named(self, kinds: tuple[str, ...]) -> dict[str, str]:
        named = dict.fromkeys(("none", *kinds, self._kind))
        return {kind: _NONE if kind == "none" else _title(kind) for kind in named}

    def offer(self, scene: Scene) -> None:
        """Let the menu have what the scene's surface can give."""
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
