"""What a thread reads is not the state before it is whole, and takes no edit of meanwhile away."""

import re
import threading
from collections.abc import Callable, Iterator
from concurrent.futures import Future, ThreadPoolExecutor
from contextlib import contextmanager
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import pytest

import asperity
from asperity.app import guess as guessed
from asperity.app.downloads import scene_archive
from asperity.app.opened import _unpacked
from asperity.app.state import State
from asperity.scene import kept, surface
from helpers.dropped import dma_bytes, scan_bytes

OURS, THEIRS, EDITED = 81e3, 2e5, 9e4  # Pa


class Held:
    """A function that waits, once it was called, until it is let go."""

    def __init__(self, call: Callable[..., Any]) -> None:
        self.call, self.begun, self.go_on = call, threading.Event(), threading.Event()

    def __call__(self, *arguments: Any, **named: Any) -> Any:
        self.begun.set()
        assert self.go_on.wait(60)
        return self.call(*arguments, **named)

    @contextmanager
    def during(self, call: Callable[[], Any]) -> Iterator["Future[Any]"]:
        """Meanwhile another thread calls this, and is held."""
        with ThreadPoolExecutor(1) as threads:
            waited = threads.submit(call)
            try:
                assert self.begun.wait(60)
                yield waited
            finally:
                self.go_on.set()


def dropped(state: State, *changes: tuple[str, str]) -> list[tuple[str, bytes]]:
    """The present scene at another pressure, and with another scan."""
    pairs = dict(_unpacked("scene.zip", scene_archive(state)()))
    text = pairs.pop("scene.toml").decode()
    text = re.sub("file-1.npy", "theirs.npy", text)
    for old, new in ((f"pressure_pa = {OURS}", f"pressure_pa = {THEIRS}"), *changes):
        assert old in text
        text = text.replace(old, new)
    return [("theirs.toml", text.encode()), ("theirs.npy", *pairs.values())]


@pytest.mark.parametrize("right", [True, False])
def test_a_scene_that_is_opened_is_shown_when_it_is_whole(
    right: bool, state: State, monkeypatch: pytest.MonkeyPatch
) -> None:
    state.load()
    wrong = [] if right else [("shear_stress_pa", "shear_stress_pb")]
    files, before = dropped(state, *wrong), state.text
    held = Held(surface.read_filled)
    monkeypatch.setattr(surface, "read_filled", held)
    with held.during(lambda: state.open_scene(files)) as opening:
        assert state.text == before
        assert state.load().pressure == OURS
        state.conditions = {**state.conditions, "pressure_pa": EDITED}
        later = state.keep_dma("dma.csv", dma_bytes())
    if right:
        assert state.load().pressure == EDITED
        assert opening.result()() == "theirs.toml"
        assert state.load().pressure == THEIRS
    else:
        with pytest.raises(asperity.InvalidInput, match="shear_stress_pb: unknown key"):
            opening.result()
        assert state.load().pressure == EDITED
        assert set(state.folder.shown.values()) == {"scan.npy", "dma.csv"}
    assert (state.folder.path / later).exists()


def test_what_is_edited_while_files_are_read_is_kept(
    state: State, monkeypatch: pytest.MonkeyPatch
) -> None:
    name = state.keep_dma("dma.csv", dma_bytes())
    guess = state.guesses[name]
    chosen = {"columns": guess.columns, "units": guess.units, "modulus": guess.modulus}
    held, before = Held(guessed.read_isotherms), state.rubber
    monkeypatch.setattr(guessed, "read_isotherms", held)
    with held.during(lambda: state.use_dma([name], chosen)) as reading:
        state.conditions = {**state.conditions, "pressure_pa": EDITED, "temperature_c": 33.0}
    assert state.rubber == before
    reading.result()()
    assert state.rubber == "your sweeps"
    assert state.load().pressure == EDITED
    assert state.load().temperature == 33 + 273.15


def test_a_scan_is_the_surface_when_it_is_taken(state: State) -> None:
    state.keep_scan("scan.npy", scan_bytes())
    take = state.use_scan({"pixel_size_m": 5e-6, "unit": "um"})
    assert state.surface == "shipped scan"
    take()
    assert state.surface == "your scan"


def test_to_load_writes_no_file_that_others_may_read_half(state: State) -> None:
    before = set(state.folder.path.iterdir())
    with pytest.raises(asperity.Error):
        state.load({**state.tables, "solver": {"rtool": 1.0}})
    assert state.load({**state.tables, "solver": {"rtol": 1e-5}}).options["rtol"] == 1e-5
    assert set(state.folder.path.iterdir()) == before


def test_a_correction_is_that_of_its_own_spectrum(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(kept, "build_correction", lambda path, table, one: (one.name, {}))
    first, second = SimpleNamespace(name="first"), SimpleNamespace(name="second")
    builders = kept.KeptBuilders(2)
    for one in (first, second, first):
        assert builders.correction(Path(), {}, one)[0] == one.name
