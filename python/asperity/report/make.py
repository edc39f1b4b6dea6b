"""Scenes computed, drawn and written as one page."""

import base64
import os
import time
from collections.abc import Sequence
from dataclasses import replace
from datetime import UTC, datetime
from functools import partial
from importlib.resources import files
from pathlib import Path

from asperity._core import __version__
from asperity.base.arguments import brief
from asperity.base.codes import FATAL
from asperity.base.diagnostics import must_be, must_have
from asperity.base.table import imported
from asperity.io.files import check_output, refuse_overwrite, write_whole
from asperity.report.comparison import compared, differing_inputs
from asperity.report.contents import (
    check_unchanged,
    digests,
    input_rows,
    pair_texts,
    results_of,
    source_rows,
    versions,
)
from asperity.report.drawings import Draw, Drawings
from asperity.report.texts import printable
from asperity.scene.model import Scene, SceneFriction
from asperity.scene.results import Bar, friction_table, no_bar, table_of, with_temperatures
from asperity.scene.scene import load_scene

_MOST_SCENES = 20  # of a report: each adds pictures, and a line to that of all


def write_report(
    paths: Sequence[Path], output: Path, title: str | None = None, bar: Bar = no_bar
) -> None:
    """Write the report of scenes; `bar` shows how far it is."""
    check_output(output)
    write_whole(output, report_page(paths, title, bar, output=output))


def report_page(
    paths: Sequence[Path],
    title: str | None = None,
    bar: Bar = no_bar,
    folder: Path | None = None,
    output: Path | None = None,
) -> str:
    """The page; none of the files that it is made from may be the `output`.

    A `folder` that all are in is left unsaid.
    """
    jinja = imported("jinja2", "plot")
    imported("matplotlib", "plot")
    if not 1 <= len(paths) <= _MOST_SCENES:
        raise must_have("scenes", f"1 to {_MOST_SCENES}", f" has {len(paths)} entries")
    if len({os.path.realpath(path) for path in paths}) < len(paths):
        raise must_be("scenes", "different files")
    # their names are known once they are read; what is computed is read after the digests
    sources = [digests(load_scene(path, for_friction=True).sources) for path in paths]
    all_sources = [source for of_one in sources for source in of_one]
    if output is not None:
        refuse_overwrite([output], [one.path for one in all_sources])
    loaded = [load_scene(path, for_friction=True) for path in paths]
    results: list[list[SceneFriction]] = []
    for file in loaded:
        results.append(friction_table(with_temperatures(file), bands=True, bar=bar)[1])
    if folder is not None:
        loaded = [_without_folder(one, folder) for one in loaded]
    names = _names(paths)
    texts = [path.read_text(encoding="utf-8") for path in paths]
    check_unchanged(all_sources)
    scenes = [scene for file in loaded for scene in with_temperatures(file)]
    curves = [result for of_file in results for result in of_file]
    table = table_of(scenes, curves)
    first = _first(scenes)
    how = {"autoescape": True, "trim_blocks": True, "lstrip_blocks": True}
    environment = jinja.Environment(**how, undefined=jinja.StrictUndefined)
    date, drawn = _now(), Drawings(environment)
    draw: list[Draw] = [partial(drawn.friction, scenes, curves)]
    for name, file, of_file in zip(names, loaded, results, strict=True):
        draw += drawn.of_file(file, of_file[0], name)
    with bar("pictures")([slice(i, i + 1) for i in range(len(draw))]) as each:
        overview, *pictures = [draw[one.start]() for one in each]
    pages = []
    for i, file in enumerate(loaded):
        surface, rubber, design = pictures[3 * i : 3 * i + 3]
        one = {
            "name": names[i],
            "results": results_of(with_temperatures(file), results[i]),
            "surface": surface,
            "rubber": rubber,
            "design": design,
            "sources": source_rows(sources[i], folder),
            "inputs": input_rows(file),
            "text": texts[i],
            "link": _link(texts[i], "application/toml"),
        }
        pages.append(one)
    variants = compared(
        _variants(names, loaded), [scenes[i] for i in first], [curves[i] for i in first]
    )
    page: str = environment.from_string(_shipped("page.html")).render(
        title=title or f"Friction of {', '.join(names)}",
        version=__version__,
        date=date,
        style=drawn.plain(_shipped("style.css")),
        fatal=[note for note in table.notes if note.severity == FATAL],
        overview=overview,
        table_link=_link(table.csv(), "text/csv"),
        points=len(table.columns["mu"]),
        files=pages,
        file_names=names,
        differing=[[key, *values] for key, values in differing_inputs(loaded)],
        pairs=[pair_texts(one) for one in variants],
        versions=versions(),
    )
    return page


def _without_folder(scene: Scene, folder: Path) -> Scene:
    others = [_without_folder(one, folder) for one in scene.others]
    return replace(scene, path=scene.path.relative_to(folder), others=others)


def _first(scenes: Sequence[Scene]) -> list[int]:
    """Of the directions of a file the first at each temperature: the tables have the others."""
    first = {(s.path, s.temperature): i for i, s in reversed([*enumerate(scenes)])}
    return sorted(first.values())


def _variants(names: Sequence[str], loaded: Sequence[Scene]) -> list[str]:
    return [
        f"{name} at {scenes[i].temperature:.5g} K" if len(kept) > 1 else name
        for name, file in zip(names, loaded, strict=True)
        for scenes in [with_temperatures(file)]
        for kept in [_first(scenes)]
        for i in kept
    ]


def _names(paths: Sequence[Path]) -> list[str]:
    """The files' names, with their folders where these alone tell them apart."""
    short = len({path.name for path in paths}) == len(paths)
    return [printable(Path(path.name) if short else path) for path in paths]


def _shipped(name: str) -> str:
    return files(__package__).joinpath(name).read_text(encoding="utf-8")


def _link(text: str, kind: str) -> str:
    """The text as an address that a browser saves."""
    content = base64.b64encode(text.encode(errors="backslashreplace")).decode()
    return f"data:{kind};base64,{content}"


def _now() -> str:
    """The day in UTC; that of SOURCE_DATE_EPOCH, for whoever wants the same bytes again."""
    stated = os.environ.get("SOURCE_DATE_EPOCH", f"{int(time.time())}")
    try:
        return f"{datetime.fromtimestamp(int(stated), UTC):%Y-%m-%d}"
    except (ValueError, OverflowError, OSError):
        raise must_be("", "seconds since 1970", f"SOURCE_DATE_EPOCH = {brief(stated)}") from None
