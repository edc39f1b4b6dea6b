"""What a report says of each scene, as texts for the page."""

import platform
from collections.abc import Sequence
from importlib import metadata
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

from asperity._core import __version__
from asperity.base.diagnostics import InvalidInput, html_items
from asperity.draw.figure import pressure_text
from asperity.io.files import sha256
from asperity.io.table import input_lines
from asperity.report.comparison import VERDICTS, Pair, shortened
from asperity.report.errors import errors_of, solved_contacts
from asperity.report.texts import number_text, printable
from asperity.scene.model import Scene, SceneFriction
from asperity.scene.results import notes_of_all, scene_inputs, table_of


class Source(NamedTuple):
    path: Path
    size: int  # bytes
    sha256: str


def digests(paths: Sequence[Path]) -> list[Source]:
    """Each file once, in the order in which they come."""
    return [Source(path, path.stat().st_size, sha256(path)) for path in dict.fromkeys(paths)]


def check_unchanged(sources: Sequence[Source]) -> None:
    """Refuse files that have changed since: the report would tell of others."""
    for source in sources:
        if digests([source.path]) != [source]:
            problem = "has changed while the report was made: start again"
            raise InvalidInput(problem, where=source.path)


MOST_ROWS = 400  # of a table on the page; the CSV beside it has all
_COLUMNS = {
    "pressure_pa": "p [Pa]",
    "velocity_m_s": "v [m/s]",
    "mu": "mu",
    "hysteresis": "hysteresis",
    "adhesion": "adhesion",
    "contact_area": "A/A0",
    "error_estimate": "numerical error",
    "hot_temperature_k": "T(q1) [K]",
    "mu_cold": "mu without heat",
    "direction_deg": "direction [°]",
    "lateral": "across",
}


class Fact(NamedTuple):
    """A number that a reader looks for first."""

    name: str
    value: str
    where: str = ""


def results_of(scenes: Sequence[Scene], results: Sequence[SceneFriction]) -> list[dict[str, Any]]:
    """The texts of a file's results, one for each of its temperatures."""
    of = dict(zip(scenes, results, strict=True))
    alike: dict[float | None, list[Scene]] = {}
    for scene in scenes:
        alike.setdefault(scene.temperature, []).append(scene)
    several = len(alike) > 1
    return [_result(ones, [of[one] for one in ones], several=several) for ones in alike.values()]


def _result(
    scenes: Sequence[Scene], results: Sequence[SceneFriction], *, several: bool
) -> dict[str, Any]:
    most = max(range(len(scenes)), key=lambda i: float(results[i].mu.max()))
    scene, result = scenes[most], results[most]
    at = f"{scene.temperature:.5g} K" if several else ""
    head, rows = numbers_of(scenes, results)
    shown, title = thinned(rows)
    return {
        "heading": f"At {at}" if several else "",
        "of": f" at {at}" if several else "",
        "facts": _facts(scene, result),
        "errors": errors_of(scene, result),
        "notes": html_items(notes_of_all(scenes, results)),
        "table_title": f"mu and its parts{f' at {at}' if several else ''}{title}",
        "head": head,
        "rows": shown,
    }


def thinned(rows: Sequence[Any]) -> tuple[Sequence[Any], str]:
    """At most so many rows as a page can show, and what to say where some are left out."""
    if len(rows) <= MOST_ROWS:
        return rows, ""
    kept = np.linspace(0, len(rows) - 1, MOST_ROWS).round().astype(int)
    return [rows[i] for i in kept], f", {MOST_ROWS} of {len(rows)} rows; the CSV has all"


def numbers_of(
    scenes: Sequence[Scene], results: Sequence[SceneFriction]
) -> tuple[list[str], list[list[str]]]:
    """The heads of the columns and the rows of a table for people."""
    table = table_of(scenes, results)
    columns: dict[str, Any] = {
        head: table.columns[name] for name, head in _COLUMNS.items() if name in table.columns
    }
    bands = [one.band for one in results if one.band is not None]
    if len(bands) == len(results):
        bounds = (np.concatenate([band[i].ravel() for band in bands]) for i in range(2))
        columns["mu from"], columns["mu to"] = bounds
    model_error = np.concatenate([one.model_error.ravel() for one in results])
    if np.isfinite(model_error).any():
        columns["model error of hysteresis"] = model_error
    cells = [[number_text(value) for value in column] for column in columns.values()]
    return list(columns), [list(line) for line in zip(*cells, strict=True)]


def _facts(scene: Scene, result: SceneFriction) -> list[Fact]:
    i, k = np.unravel_index(int(result.mu.argmax()), result.mu.shape)
    at = f"at {scene.velocity[k]:.3g} m/s, {pressure_text(float(scene.pressure[i]))}"
    at += "" if scene.direction_deg is None else f", towards {scene.direction_deg:.4g}°"
    facts = [Fact("largest mu", f"{result.mu[i, k]:.4g}", at)]
    facts.append(Fact("of which hysteresis", f"{result.hysteresis[i, k]:.4g}"))
    if scene.knows_directions:
        across = result.lateral[i, k]
        seen = abs(across) > result.error_estimate[i, k]
        facts.append(Fact("force across there, over load", f"{across:.4g}" if seen else "0"))
    area = float(result.contact_area[i, k])
    facts.append(Fact("contact there, A/A0", f"{100 * area:.3g} %"))
    if result.cold is not None and scene.temperature is not None:
        rise = result.temperature - scene.temperature
        i, k = np.unravel_index(int(rise.argmax()), rise.shape)
        at = f"at {scene.velocity[k]:.3g} m/s"
        facts.append(Fact("largest rise by heat", f"{rise[i, k]:.3g} K", at))
    solved = solved_contacts(scene)
    if solved is not None:
        facts.append(Fact("contacts of the scan", f"{solved[0]}", f"solved, {solved[1]}"))
    return [*facts, Fact("rms slope that is used", f"{scene.spectrum.rms_slope:.3g}")]


def input_rows(scene: Scene) -> list[tuple[str, str]]:
    """Keys and values, long lists by their beginning: the scene's own text has them whole."""
    lines = (line.partition(" = ") for line in input_lines(scene_inputs(scene)))
    return [(key, shortened(value)) for key, _, value in lines]


def source_rows(sources: Sequence[Source], folder: Path | None) -> list[tuple[str, str, str]]:
    paths = [one.path if folder is None else one.path.relative_to(folder) for one in sources]
    rows = zip(paths, sources, strict=True)
    return [(printable(path), f"{one.size}", one.sha256) for path, one in rows]


def pair_texts(pair: Pair) -> dict[str, Any]:
    numbers = ("pressure", "velocity", "first", "second")
    rows = [
        (*(number_text(getattr(one, name)) for name in numbers), one.percent, VERDICTS[one.verdict])
        for one in pair.differences
    ]
    shown, left_out = thinned(rows)
    named = {"first": pair.first, "second": pair.second, "summary": pair.summary}
    return {**named, "rows": shown, "left_out": left_out}


def versions() -> list[tuple[str, str]]:
    """Of what the digits and pictures depend on."""
    found = [("asperity", __version__), ("Python", platform.python_version())]
    for name in ("numpy", "matplotlib", "SurfaceTopography"):
        try:
            found.append((name, metadata.version(name)))
        except metadata.PackageNotFoundError:
            continue
    return [*found, ("system", f"{platform.system()} {platform.machine()}")]
