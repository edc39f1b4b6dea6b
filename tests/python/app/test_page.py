"""Parts of the page without a browser: events that are no number, files while others are read."""

import asyncio
import threading
from collections.abc import Callable, Mapping
from types import SimpleNamespace
from typing import Any

import pytest

from asperity.app.state import State, Take
from helpers.dropped import scan_bytes

testing = pytest.importorskip("nicegui.testing", reason="the app needs asperity[app]")
parts = pytest.importorskip("asperity.app.parts", reason="the app needs asperity[app]")
surface = pytest.importorskip("asperity.app.surface", reason="the app needs asperity[app]")
worker = pytest.importorskip("asperity.app.worker", reason="the app needs asperity[app]")


def test_slider_events_that_are_no_number_change_nothing() -> None:
    changes: list[float] = []

    async def changed(value: float) -> None:
        changes.append(value)

    async def slide() -> None:
        made: list[Any] = []

        def show() -> None:
            made.append(
                parts.Quantity("Pressure [MPa]", 0.1, (0.01, 10), changed, logarithmic=True)
            )

        async with testing.user_simulation(root=show) as user:
            await user.open("/")
            for args in (None, "x", "nan", "inf", [], {}, "0"):
                await made[0]._slid(SimpleNamespace(args=args))

    asyncio.run(slide())
    assert changes == [1.0]


def test_a_scan_that_is_dropped_while_one_is_read_follows_it(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    begun, may_end = threading.Event(), threading.Event()
    read: list[str] = []
    use_scan = State.use_scan

    def slow(state: State, settings: Mapping[str, Any]) -> Take:
        assert state.scan is not None
        read.append(state.folder.shown[state.scan])
        begun.set()
        assert may_end.wait(60)
        return use_scan(state, {**settings, "pixel_size_m": 5e-6, "unit": "um"})

    monkeypatch.setattr(State, "use_scan", slow)
    state = State()
    made: list[Any] = []

    async def until(true: Callable[[], bool]) -> None:
        while not true():
            await asyncio.sleep(0.01)

    async def drop_two() -> None:
        def show() -> None:
            made.append(surface.SurfacePart(state, worker.Worker(state)))

        async with testing.user_simulation(root=show) as user:
            await user.open("/")
            (part,) = made
            part._upload.arrived([("first.npy", scan_bytes())])
            await until(begun.is_set)
            part._upload.arrived([("second.npy", scan_bytes())])
            await asyncio.sleep(0.1)
            assert read == ["first.npy"]
            may_end.set()
            await until(lambda: len(read) == 2 and not part._upload.turn.locked())
            assert part._problem.text == ""

    asyncio.run(asyncio.wait_for(drop_two(), 120))
    assert state.folder.shown[state.surfaces["your scan"]["file"]] == "second.npy"
    state.close()
