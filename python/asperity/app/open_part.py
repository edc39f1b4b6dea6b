"""Where a scene file is opened."""

from collections.abc import Sequence
from typing import Protocol

from nicegui import ui

from asperity._core import Error
from asperity.app.state import State
from asperity.app.upload import Upload
from asperity.app.words import in_one_line
from asperity.app.worker import Worker, in_thread


class Refreshes(Protocol):
    """A part of the page that shows what is edited."""

    def refresh(self) -> None: ...


class OpenPart:
    """A place to drop a scene with its files."""

    def __init__(self, state: State, worker: Worker, parts: Sequence[Refreshes]) -> None:
        self._state, self._worker, self._parts = state, worker, parts
        with ui.expansion("Open a scene").classes("w-full").props("dense"):
            Upload(
                "Drop a scene file with the files it names, or its ZIP",
                self._taken,
                self._say,
                multiple=True,
            )
            self._problem = ui.label("").classes("problem").props('role="alert"')

    async def _taken(self, files: list[tuple[str, bytes]]) -> None:
        self._say("")
        try:
            take = await in_thread(lambda: self._state.open_scene(files))
        except Error as error:
            self._say(in_one_line(self._state.said(error)))
            return
        take()
        for part in self._parts:
            part.refresh()
        await self._worker.changed()

    def _say(self, problem: str) -> None:
        self._problem.set_text(problem)
