"""A change is shown at once, whatever is still computed of the one before."""

import asyncio
import re
import threading
from typing import Any

import numpy as np
import pytest

import asperity
from asperity import Error
from asperity.app import worker as app_worker
from asperity.app.state import State
from asperity.app.worker import Found, Shows, Worker, with_band
from asperity.scene.progress import with_contacts


class Page(Shows):
    """Keeps what it is shown."""

    def __init__(self) -> None:
        self.curves: list[Found] = []
        self.shown: list[Found] = []
        self.problems: list[Error] = []

    def show_curve(self, result: Found) -> None:
        self.curves.append(result)

    def show(self, result: Found) -> None:
        self.shown.append(result)

    def fail(self, problem: Error) -> None:
        self.problems.append(problem)


async def until(holds: Any) -> None:
    for _ in range(6000):
        if holds():
            return
        await asyncio.sleep(0.01)
    raise AssertionError("waited for a minute")


def test_contacts_of_a_scan_are_counted_and_end_where_a_change_overtakes_them(
    state: State,
) -> None:
    road = asperity.SelfAffineSpectrum(rms_height=1e-4, hurst=0.8, q0=2500, q1=1e4)
    scan = asperity.synthesize(road, shape=(64, 64), pixel_size=1e-2 / 64, seed=1)
    rubber = asperity.PronySeries(equilibrium_modulus=1e6, moduli=[9e6], relaxation_times=[1e-3])
    exact = asperity.ScanContact(scan)
    said: list[str] = []

    def solve(progress: Any, pressure: float) -> None:
        with with_contacts(progress, exact)([slice(0, 1)]):
            asperity.friction(
                road, rubber, pressure=pressure, velocity=[0.01, 1.0], correction=exact
            )

    async def run() -> None:
        worker = Worker(state)
        worker.shows(say=said.append)
        worker._wanted = 1
        progress = worker._unless_overtaken(1)
        await app_worker.in_thread(lambda: solve(progress, 1e5))
        await asyncio.sleep(0)

    asyncio.run(run())
    assert re.fullmatch(r"0 of \d+ contacts solved \.\.\.", said[0])
    count = len(exact.contacts)
    assert count > 5

    async def overtaken() -> None:
        progress = Worker(state)._unless_overtaken(1)
        await app_worker.in_thread(lambda: solve(progress, 2e5))

    with pytest.raises(app_worker._OvertakenError):
        asyncio.run(overtaken())
    assert len(exact.contacts) == count


@pytest.mark.parametrize("heat", [False, True])
def test_curve_then_heat_then_band(state: State, heat: bool) -> None:
    state.use("heating", heat)
    page = Page()

    async def run() -> None:
        worker = Worker(state)
        worker.shows(page)
        await worker.changed()
        assert [one.whole for one in page.curves] == [False]
        await until(lambda: page.shown and page.shown[-1].whole)
        assert worker.found is page.shown[-1]

    asyncio.run(run())
    kinds = [(one.curves is not None, one.banded is not None) for one in page.shown]
    hot = [(False, False), (True, False), (True, True)]
    assert kinds == (hot if heat else hot[1:])
    scene = state.load()
    assert np.array_equal(page.shown[-1].best.mu, scene.friction().mu)
    assert (page.curves[0].curves is None) == heat


def test_a_band_does_not_keep_the_next_change_waiting(
    state: State, monkeypatch: pytest.MonkeyPatch
) -> None:
    begun, go_on = threading.Event(), threading.Event()
    computed = []

    def held(scene: Any, curves: Any, progress: Any) -> Any:
        computed.append(scene)
        begun.set()
        assert go_on.wait(60)
        return with_band(scene, curves, progress)

    monkeypatch.setattr(app_worker, "with_band", held)
    page = Page()

    async def run() -> None:
        worker = Worker(state)
        worker.shows(page)
        await worker.changed()
        await until(begun.is_set)
        for celsius in (30, 40):
            state.conditions["temperature_c"] = celsius
            await worker.changed()
            assert page.curves[-1].scene.temperature == celsius + 273.15
        go_on.set()
        await until(lambda: page.shown[-1].whole)

    asyncio.run(run())
    assert [one.temperature for one in computed] == [293.15, 313.15]  # that of 30 C was overtaken
    assert [one.scene.temperature for one in page.shown if one.whole] == [313.15]
    assert page.problems == []


def test_changes_that_never_pause_are_shown_all_the_same(state: State) -> None:
    page = Page()

    async def run() -> None:
        worker = Worker(state)
        worker.shows(page)
        waiting = []
        for i in range(40):
            state.conditions["temperature_c"] = 20 + i
            waiting.append(asyncio.create_task(worker.changed()))
            await asyncio.sleep(0.002)
        await asyncio.gather(*waiting)
        await until(lambda: page.shown and page.shown[-1].whole)

    asyncio.run(run())
    assert len(page.curves) > 2
    assert page.shown[-1].scene.temperature == 59 + 273.15


def test_an_error_is_told_and_the_next_change_is_computed(state: State) -> None:
    page = Page()

    async def run() -> None:
        worker = Worker(state)
        worker.shows(page)
        state.conditions["pressure_pa"] = -1.0
        await worker.changed()
        assert len(page.problems) == 1
        assert "pressure_pa" in str(page.problems[0])
        state.conditions["pressure_pa"] = 81e3
        await worker.changed()
        await until(lambda: page.shown and page.shown[-1].whole)

    asyncio.run(run())
    assert len(page.problems) == 1


def test_a_variant_is_the_scene_of_its_curve_whatever_was_edited_since(state: State) -> None:
    async def run() -> Found:
        worker, page = Worker(state), Page()
        worker.shows(page)
        await worker.changed()
        state.conditions = {**state.conditions, "pressure_pa": 243e3}
        state.use("heating", True)
        result = page.curves[-1]
        state.keep_variant("before", result.tables, result.scene, result.best)
        await until(lambda: page.shown and page.shown[-1].whole)
        return result

    result = asyncio.run(run())
    kept = state.variants[0]
    assert kept.tables["conditions"]["pressure_pa"] == 81e3 == result.scene.pressure
    assert "heating" not in kept.tables
    assert np.array_equal(state.load(kept.tables).friction().mu, kept.curves.mu)
    assert state.load().pressure == 243e3
