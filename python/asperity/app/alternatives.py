"""What parts of the page that take files have in common, and those of the surface and the rubber: a
choice among tables of a scene, and a picture of the one that is chosen."""

from collections.abc import Callable
from typing import Any

from nicegui import ui

from asperity.app.parts import Picture, menu, part
from asperity.app.state import State, Take
from asperity.app.worker import Shows, Worker


class TakesFiles(Shows):
    """A part of the page where files are dropped, with a place to say what is wrong with them."""

    def __init__(self, state: State, worker: Worker) -> None:
        self._state, self._worker = state, worker

    def _add_problem(self) -> None:
        self._problem = ui.label("").classes("problem").props('role="alert"')
        self._remark = ui.label("").classes("soft")

    def _say(self, said: str) -> None:
        self._problem.set_text(said)

    async def _take_up(self, read: Callable[[], Take], meanwhile: str = "") -> None:
        """Take what is read into the scene, unless it cannot be read."""
        self._say(meanwhile)
        take = await self._worker.attempt(read, self._say)
        if take is not None:
            self._say("")
            self._remark.set_text(take())
            self.refresh()
            await self._worker.changed()


class AlternativesPart(TakesFiles):
    """A part of the page for one table of the scene."""

    table = ""  # "surface" or "rubber", whose alternatives the state has in the plural

    def __init__(self, state: State, worker: Worker) -> None:
        super().__init__(state, worker)
        self._drawn: object = None
        title = self.table.capitalize()
        with part(title, f"{self.table}-title"):
            self._choice = menu(title, self._names, self._chosen, self._choose)
            self._add_fields()
            self._add_problem()
            self._facts = ui.label("").classes("soft")
            self._picture = Picture()
        self.refresh()

    def _add_fields(self) -> None:
        """What stands between the choice and the picture."""
        raise NotImplementedError

    @property
    def _names(self) -> list[str]:
        return list(getattr(self._state, f"{self.table}s"))

    @property
    def _chosen(self) -> str:
        return str(getattr(self._state, self.table))

    async def _choose(self, event: Any) -> None:
        if event.value != self._chosen:
            setattr(self._state, self.table, event.value)
            self.refresh()
            await self._worker.changed()

    def refresh(self) -> None:
        self._choice.set_options(self._names, value=self._chosen)
