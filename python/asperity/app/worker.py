"""Computes what was changed: the curve at once, heat and band when changes have paused."""

import asyncio
from collections.abc import Callable, Iterable, Iterator
from contextlib import nullcontext
from dataclasses import dataclass, replace
from typing import Any, TypeVar

import numpy as np
from numpy.typing import NDArray

from asperity._core import Error
from asperity.app.opened import Tables
from asperity.app.state import State
from asperity.app.words import in_one_line
from asperity.base.arguments import known
from asperity.scene.model import Progress, Scene, SceneFriction

_Made = TypeVar("_Made")
_QUIET = 0.05  # s without a change, after which all that is slower follows


class Shows:
    """A part of the page that shows what was computed, or some of it."""

    def refresh(self) -> None:
        """Show the choices of another scene."""

    def show_curve(self, result: "Found") -> None:
        """The curve alone, at once."""

    def show_scene(self, scene: Scene) -> None:
        """What was read, whether a curve follows from it or not."""

    def show(self, result: "Found") -> None:
        """All that is known by now."""

    def fail(self, error: Error) -> None:
        """Why there is no curve."""


@dataclass(frozen=True)
class Found:
    tables: Tables  # that the scene was made of
    scene: Scene
    cold: SceneFriction  # without heat
    curves: SceneFriction | None = None  # as the scene is: the digits of the shell
    banded: SceneFriction | None = None

    @property
    def best(self) -> SceneFriction:
        return self.banded or self.curves or self.cold

    @property
    def whole(self) -> bool:
        return self.curves is not None and (self.banded is not None or not self.scene.has_errors)


class _OvertakenError(Exception):
    """What is computed is of a scene that has been changed since."""


class Worker:
    """The computations of one session: a curve for each change, and one at a time of the rest."""

    def __init__(self, state: State) -> None:
        self.state = state
        self.found: Found | None = None
        self._parts: tuple[Shows, ...] = ()
        self._say: Callable[[str], object] = lambda said: None
        self._wanted = self._done = 0
        self._running = False
        self._slow = asyncio.Lock()
        self._following: set[asyncio.Task[None]] = set()

    def shows(self, *parts: Shows, say: Callable[[str], object] | None = None) -> None:
        """`say` is called with how far a computation is that takes longer."""
        self._parts, self._say = parts, say or self._say

    async def changed(self) -> None:
        """Show the curve of the scene as it is now; of changes meanwhile, that of the last."""
        self._wanted += 1
        if self._running:
            return
        self._running = True
        try:
            while self._done != self._wanted:
                mine = self._wanted
                await self._curve(mine)
                self._done = mine
        finally:
            self._running = False

    async def _curve(self, mine: int) -> None:
        checked, tables = self._unless_overtaken(mine), self.state.tables

        scene: Scene | None = None

        def compute() -> Found:
            nonlocal scene
            scene = self.state.load(tables)
            cold = replace(scene, heating=None).friction(checked)
            return Found(tables, scene, cold, cold if scene.heating is None else None)

        try:
            self.found = await in_thread(compute)
        except _OvertakenError:
            return
        except Error as error:
            self._fail(error)
            if scene is not None:
                self._show_scene(scene)
            return
        for part in self._parts:
            part.show_curve(self.found)
        following = asyncio.create_task(self._follow(mine, self.found))
        self._following.add(following)  # else it might be collected while it runs
        following.add_done_callback(self._following.discard)

    async def _follow(self, mine: int, result: Found) -> None:
        """What takes longer, and the parts of the page that are not the curve."""
        await asyncio.sleep(_QUIET)
        progress = self._unless_overtaken(mine)
        async with self._slow:  # what was overtaken ends within a chunk
            try:
                self._show(mine, result)
                if result.curves is None:
                    hot = await in_thread(lambda: result.scene.friction(progress))
                    result = replace(result, curves=hot)
                    self._show(mine, result)
                if not result.whole:
                    scene, curves = result.scene, result.best
                    banded = await in_thread(lambda: with_band(scene, curves, progress))
                    self._show(mine, replace(result, banded=banded))
            except _OvertakenError:
                return
            except Error as error:
                if self._wanted == mine:
                    self._fail(error)

    async def attempt(self, compute: Callable[[], _Made], say: Callable[[str], object]) -> Any:
        """What is computed in a thread; None where it fails, of which `say` is given the error."""
        try:
            return await in_thread(compute)
        except Error as error:
            say(in_one_line(self.state.said(error)))
            return None

    def _show(self, mine: int, result: Found) -> None:
        if self._wanted != mine:
            raise _OvertakenError
        self.found = result
        self._show_scene(result.scene)
        for part in self._parts:
            part.show(result)

    def _show_scene(self, scene: Scene) -> None:
        for part in self._parts:
            part.show_scene(scene)

    def _fail(self, error: Error) -> None:
        for part in self._parts:
            part.fail(self.state.said(error))

    def _unless_overtaken(self, mine: int) -> Progress:
        """Ends a computation that was overtaken: `_Chunks` say where."""
        loop = asyncio.get_running_loop()

        def overtaken() -> bool:
            return self._wanted != mine

        def say(line: str) -> None:
            loop.call_soon_threadsafe(self._say, f"{line} ...")

        return lambda chunks: nullcontext(_Chunks(chunks, overtaken, say))


class _Chunks:
    """Chunks of a computation that ends between them where it is no longer wanted. The first is
    always finished, so that a slider that is moved for long shows some curves, unless there is more
    to say of it: contacts that were solved are kept. It has what bars have."""

    start_t = delay = 0.0

    def __init__(
        self, chunks: Iterable[slice], overtaken: Callable[[], bool], say: Callable[[str], None]
    ) -> None:
        self._chunks, self._overtaken, self._say = chunks, overtaken, say

    def __iter__(self) -> Iterator[slice]:
        for i, chunk in enumerate(self._chunks):
            if i > 0 and self._overtaken():
                raise _OvertakenError
            yield chunk

    def set_postfix_str(self, line: str) -> None:
        if self._overtaken():
            raise _OvertakenError
        self._say(line)

    def clear(self) -> None:
        """The line goes with the next one."""


async def in_thread(compute: Callable[[], _Made]) -> _Made:
    """Run in a thread: the core lets other threads go on meanwhile."""
    loop: Any = asyncio.get_running_loop()
    made: _Made = await loop.run_in_executor(None, compute)
    return made


def with_band(
    scene: Scene, curves: SceneFriction, progress: Progress = nullcontext
) -> SceneFriction:
    """The curves with the band of the measured inputs, where their errors are known."""
    return curves.within(scene.band(curves.mu, progress)) if scene.has_errors else curves


def contributions(scene: Scene, velocity: float) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Wavenumbers [1/m], and dmu / d ln q there, at the first pressure and one velocity [m/s]."""
    at = scene.pressure[:1], np.array([velocity])
    result = scene.friction_at(*at, contributions=True)
    return known(result.wavenumber), np.ravel(known(result.dmu_dlnq))
