"""Computes what was changed, the quick first, and drops what has been overtaken by a change."""

import asyncio
from collections.abc import Callable, Iterator
from contextlib import nullcontext
from dataclasses import dataclass
from typing import Any, Protocol, TypeVar

from asperity._core import Error
from asperity.app.state import State, with_band, without_heat
from asperity.scene.model import Curves, Progress, Scene

_Made = TypeVar("_Made")


class Shows(Protocol):
    """A part of the page that shows what was computed."""

    def show(self, found: "Found") -> None: ...

    def fail(self, problem: str) -> None: ...


@dataclass(frozen=True)
class Found:
    """What is known of the present scene by now."""

    scene: Scene
    cold: Curves | None  # without heat
    curves: Curves | None = None  # as the scene is: the digits of the shell
    banded: Curves | None = None

    @property
    def best(self) -> Curves:
        best = self.banded or self.curves or self.cold
        assert best is not None
        return best


class _OvertakenError(Exception):
    """What is computed is of a scene that has been changed since."""


class Worker:
    """One computation at a time for one session; a change meanwhile starts it again."""

    def __init__(self, state: State) -> None:
        self.state = state
        self.found: Found | None = None
        self._parts: tuple[Shows, ...] = ()
        self._wanted = self._done = 0
        self._running = False

    def shows(self, *parts: Shows) -> None:
        self._parts = parts

    async def changed(self) -> None:
        """Compute anew, unless that is under way: then it begins again when it next can."""
        self._wanted += 1
        if self._running:
            return
        self._running = True
        try:
            while self._done != self._wanted:
                await self._once(self._wanted)
        finally:
            self._running = False

    async def _once(self, mine: int) -> None:
        try:
            for step in (self._cold, self._whole, self._band):
                found = await step(self._unless_overtaken(mine))
                if self._wanted != mine:
                    return
                if found is not self.found:
                    self.found = found
                    for part in self._parts:
                        part.show(found)
                await asyncio.sleep(0)
            self._done = mine
        except _OvertakenError:
            return
        except Error as error:
            self._done = mine
            for part in self._parts:
                part.fail(self.state.said(error))

    def _unless_overtaken(self, mine: int) -> Progress:
        """Looks, between the chunks of a computation, whether it is still wanted."""

        def checked(chunks: list[slice]) -> Iterator[slice]:
            for chunk in chunks:
                if self._wanted != mine:
                    raise _OvertakenError
                yield chunk

        return lambda chunks: nullcontext(checked(chunks))

    async def _cold(self, progress: Progress) -> Found:
        scene = await in_thread(self.state.load)
        return Found(scene, await in_thread(lambda: without_heat(scene).friction(progress)))

    async def _whole(self, progress: Progress) -> Found:
        assert self.found is not None
        scene, cold = self.found.scene, self.found.cold
        if scene.heating is None:
            return Found(scene, cold, cold)
        return Found(scene, cold, await in_thread(lambda: scene.friction(progress)))

    async def _band(self, progress: Progress) -> Found:
        found = self.found
        assert found is not None
        assert found.curves is not None
        if not found.scene.has_errors:
            return found
        scene, curves = found.scene, found.curves
        banded = await in_thread(lambda: with_band(scene, curves, progress))
        return Found(scene, found.cold, curves, banded)


async def in_thread(compute: Callable[[], _Made]) -> _Made:
    """Run in a thread: the core lets other threads go on meanwhile."""
    loop: Any = asyncio.get_running_loop()
    made: _Made = await loop.run_in_executor(None, compute)
    return made
