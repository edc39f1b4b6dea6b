"""Friction of scenes as a table: one set of digits for the shell, the report and the app."""

from collections import Counter
from collections.abc import Callable, Sequence
from contextlib import nullcontext
from itertools import groupby
from pathlib import Path
from typing import Any

import numpy as np

from asperity.base.diagnostics import Note, fatal_first
from asperity.io.table import Table
from asperity.scene.model import COLUMNS, Progress, Scene, SceneFriction

Bar = Callable[[str], Progress]  # shows how far the work of that title is


def no_bar(_: str) -> Progress:
    return nullcontext


def with_temperatures(scene: Scene) -> list[Scene]:
    """The scene, and the same at the further temperatures and directions of its lists."""
    return [scene, *scene.others]


def friction_table(
    scenes: Sequence[Scene], *, bands: bool, bar: Bar = no_bar
) -> tuple[Table, list[SceneFriction]]:
    """mu of every scene. A band, where standard errors are known, is computed where `bands` are
    asked for and where a scene asks for it; it has columns where all scenes ask."""
    curves = [
        curve
        for _, group in groupby(scenes, key=lambda scene: scene.path)
        for curve in _curves_of(list(group), bands=bands, bar=bar)
    ]
    return table_of(scenes, curves), curves


def _curves_of(scenes: Sequence[Scene], *, bands: bool, bar: Bar) -> list[SceneFriction]:
    """Results of one file; of several places a step of the bar each."""
    if len(scenes) == 1:
        return [_curves(scenes[0], band=bands or scenes[0].asks_for_band, bar=bar)]
    with bar(f"{scenes[0].path}")([slice(i, i + 1) for i in range(len(scenes))]) as shown:
        return [
            _curves(scene, band=bands or scene.asks_for_band, bar=no_bar)
            for at in shown
            for scene in scenes[at]
        ]


def table_of(scenes: Sequence[Scene], curves: Sequence[SceneFriction]) -> Table:
    """Results of scenes as a table."""
    columns: dict[str, list[Any]] = {}
    asked = all(scene.asks_for_band for scene in scenes)
    at_temperatures = all(scene.temperature is not None for scene in scenes)
    directed = all(scene.knows_directions for scene in scenes)
    turned = all(scene.direction_deg is not None for scene in scenes) and (
        len({scene.direction_deg for scene in scenes}) > 1
    )
    heated = all(scene.heating is not None for scene in scenes)
    files = {scene.path: scene for scene in reversed(scenes)}
    for scene, result in zip(scenes, curves, strict=True):
        pressure, velocity = scene.points
        names = {"scene": [f"{scene.path}"] * pressure.size} if len(files) > 1 else {}
        points = {"pressure_pa": pressure, "velocity_m_s": velocity}
        values = {name: getattr(result, name).ravel() for name in COLUMNS}
        if asked and result.band is not None:
            values |= {"mu_low": result.band[0].ravel(), "mu_high": result.band[1].ravel()}
        if at_temperatures:
            values["temperature_k"] = [scene.temperature] * pressure.size
        if heated and result.cold is not None:
            values["hot_temperature_k"] = result.temperature.ravel()
            values["mu_cold"] = result.cold.mu.ravel()
        if turned:
            values["direction_deg"] = [scene.direction_deg] * pressure.size
        if directed:
            values["lateral"] = result.lateral.ravel()
        for name, column in {**names, **points, **values}.items():
            columns.setdefault(name, []).extend(column)
    inputs = []
    for path, scene in reversed(files.items()):
        of_file = [r for one, r in zip(scenes, curves, strict=True) if one.path == path]
        inputs.append(scene_inputs(scene) | {"model_error": _range_of_model_error(of_file)})
    return Table("friction", inputs, notes_of_all(scenes, curves), columns)


def _range_of_model_error(results: Sequence[SceneFriction]) -> list[float] | None:
    """The least and the largest of the points where it is known, None where it is nowhere."""
    errors = np.concatenate([result.model_error.ravel() for result in results])
    known = errors[np.isfinite(errors)]
    return [float(known.min()), float(known.max())] if known.size else None


def notes_of_all(scenes: Sequence[Scene], curves: Sequence[SceneFriction]) -> list[Note]:
    """Every note once, fatal ones first; of several scenes with the names of those it is about.

    A file's inputs have the same notes at every temperature, with other numbers. They are said with
    those of the first.
    """
    about: dict[Note, list[Scene]] = {}
    first: dict[tuple[Path, tuple[str, str]], Note] = {}
    alike: Counter[Note] = Counter()
    first_of = {scene.path: scene for scene in reversed(scenes)}
    for scene, result in zip(scenes, curves, strict=True):
        of_inputs = set(scene.notes)
        for note in dict.fromkeys(result.notes):
            same = first.setdefault((scene.path, note.identity), note)
            if note != same and note in of_inputs and scene is not first_of[scene.path]:
                alike[same] += 1
            else:
                about.setdefault(note, []).append(scene)
    named = ((_name_of(its, scenes, alike[note]), note) for note, its in about.items())
    return fatal_first(note.within(name, ": ") if name else note for name, note in named)


def _name_of(its: Sequence[Scene], scenes: Sequence[Scene], alike: int) -> str:
    """Which scenes a note is about: their files where there are several, and the temperatures of
    a file unless it is about all of them, with the number of those that have one alike."""
    files = {scene.path for scene in scenes}
    names = []
    for file in dict.fromkeys(scene.path for scene in its):
        at = [scene for scene in its if scene.path == file]
        every = sum(scene.path == file for scene in scenes)
        places = [one.place_text for one in at] if len(at) < every else []
        names.append(", ".join(([f"{file}"] if len(files) > 1 else []) + places))
    name = ", ".join(filter(None, names))
    if alike == 0:
        return name
    return f"{name} (alike at {alike} {'other' if alike == 1 else 'others'})"


def _curves(scene: Scene, *, band: bool, bar: Bar) -> SceneFriction:
    curves = scene.friction(bar(f"{scene.path}"))
    if not (band and scene.has_errors):
        return curves
    return curves.within(scene.band(curves.mu, bar(f"{scene.path}, band")))


def scene_inputs(scene: Scene) -> dict[str, Any]:
    """What a scene was computed from, for the head of a table."""
    return {"scene": str(scene.path), **scene.inputs, "derived": scene.derived}
