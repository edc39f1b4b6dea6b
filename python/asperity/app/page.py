"""The page: four parts over one state, each session with a state of its own."""

import secrets
from collections import OrderedDict
from collections.abc import Sequence
from functools import partial
from importlib.resources import files

from nicegui import ui

from asperity.app.alternatives import TakesFiles
from asperity.app.conditions import ConditionsPart
from asperity.app.parts import heading
from asperity.app.result import ResultPart
from asperity.app.rubber import RubberPart
from asperity.app.state import State
from asperity.app.surface import SurfacePart
from asperity.app.upload import Upload
from asperity.app.worker import Shows, Worker


class OpenPart(TakesFiles):
    def __init__(self, state: State, worker: Worker, parts: Sequence[Shows]) -> None:
        super().__init__(state, worker)
        self._parts = parts
        text = "Drop a scene file with the files it names, or its ZIP"
        with ui.expansion("Open a scene").classes("w-full").props("dense"):
            Upload(text, self._taken, self._say, multiple=True)
            self._add_problem()

    async def _taken(self, files: list[tuple[str, bytes]]) -> None:
        await self._take_up(partial(self._state.open_scene, files))

    def refresh(self) -> None:
        for part in self._parts:
            part.refresh()


_MOST_SESSIONS = 16  # the one that was not used for longest goes
_states: "OrderedDict[str, State]" = OrderedDict()

_STYLE = files(__package__).joinpath("page.css").read_text(encoding="utf-8")


def show_page(session: str = "") -> None:
    """The page of a session; a new one opens on the demo's scene. A reload finds it again."""
    state = _states.get(session)
    if state is None:
        session, state = secrets.token_urlsafe(12), State()
        _states[session] = state
        while len(_states) > _MOST_SESSIONS:
            _states.popitem(last=False)[1].close()
    _states.move_to_end(session)
    ui.add_css(_STYLE)
    # a reload asks for the session; the token stays in the cookie and out of the history
    ui.run_javascript(f"history.replaceState(null, '', '/?session={session}')")
    worker = Worker(state)
    with ui.element("div").classes("app"):
        with ui.element("header").classes("flex items-baseline gap-3 py-3"):
            heading("asperity", "h1")
            ui.label("friction of rubber on rough surfaces").classes("soft")
        opening = ui.element("div")
        with ui.element("div").classes("columns"):
            with ui.element("div"):
                surface = SurfacePart(state, worker)
                rubber = RubberPart(state, worker)
                conditions = ConditionsPart(state, worker)
            with ui.element("div").classes("result"):
                result = ResultPart(state, worker, conditions.refresh)
    with opening:
        OpenPart(state, worker, (surface, rubber, conditions))
    worker.shows(result, surface, rubber, conditions, say=result.wait)
    ui.timer(0.01, worker.changed, once=True)


def close_all() -> None:
    while _states:
        _states.popitem()[1].close()
