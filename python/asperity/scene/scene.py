"""A scene: a TOML file that names the parts of a computation, read into objects of the core."""

import os
from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from glob import glob
from pathlib import Path
from typing import Any

from asperity.adhesion import Adhesion
from asperity.base.arguments import path_of, reading
from asperity.base.diagnostics import valued
from asperity.correction import Correction
from asperity.heating import Heating
from asperity.io import plausible
from asperity.io.fields import (
    MOST_ROWS,
    arguments,
    defaults_of,
    nearest,
    read_table,
    refuse,
)
from asperity.io.files import check_file
from asperity.io.toml import read_toml_text, toml_value
from asperity.io.typed import Typed, typed_in
from asperity.scene.celsius import celsius_in_errors
from asperity.scene.keys import (
    CONDITIONS,
    KEYS,
    LISTED,
    POINTS,
    SOLVER,
    UNCERTAINTY,
    check_heated,
    directions_of,
    temperatures_of,
)
from asperity.scene.model import Scene
from asperity.scene.parts import build_correction, build_part
from asperity.scene.rubber import BuiltRubber, build_rubber
from asperity.scene.section import Section, Values
from asperity.scene.surface import Surface, build_surface


@dataclass
class Builders:
    """What builds the parts of a scene: the functions here, or others that keep what they built."""

    surface: Callable[[Path, object], Surface] = build_surface
    rubber: Callable[[Path, object, float | None], BuiltRubber] = build_rubber
    correction: Callable[..., tuple[Correction, Values]] = build_correction


_PLAIN = Builders()


def read_scene(path: str | os.PathLike[str]) -> Scene:
    """Return the scene of a file as `asperity friction` computes it.

    What a scene leaves out has the defaults of the functions that are called for it: the trend and
    the window those of `power_spectrum`, the band that of the map, the master curve that of
    `build_master_curve`, as it was measured: no Prony series, nothing beyond what was measured.

    Parameters
    ----------
    path : path-like
        A TOML file.

    Returns
    -------
    Scene
        `.friction()` has the digits of the shell, of shape (pressures, velocities) [-]. Its parts
        are `.spectrum` and `.rubber` as `friction` takes them, `.correction`, ``.adhesion`` and
        `.heating`, or None, and `.conditions`, the arguments that say where: `pressure` [Pa],
        `velocity` [m/s], `poisson_ratio` and, with heating, `temperature` [K]. `.surface` has the
        scan and what was made of it, `.inputs` all that was used, `.notes` what the inputs give to
        note. `.others` are the same at further temperatures of a list.

    Raises
    ------
    InvalidInput, OutOfRange
        In one line: file, table and key, the value found and what is allowed.

    Examples
    --------
    >>> scene = read_scene("scene.toml")  # doctest: +SKIP
    >>> scene.friction().mu  # doctest: +SKIP
    """
    return load_scene(path, for_friction=True)


def load_scene(path: str | os.PathLike[str], *, for_friction: bool = False) -> Scene:
    """Read a scene file and build the parts that it names.

    `for_friction`: it may ask for heat and for several temperatures, which only friction and its
    map know.

    Raises
    ------
    InvalidInput, OutOfRange
        In one line: file, table and key, the value found and what is allowed.
    """
    where = path_of(path, "path")
    return scene_of(where, read_tables(where), for_friction=for_friction)


def scene_of(
    path: Path, tables: dict[str, Any], *, for_friction: bool, builders: Builders = _PLAIN
) -> Scene:
    """Build a scene as `build_scene` does, with a note of each number that is unusual."""
    typed = typed_in(tables)
    with plausible.collected(typed) as notes, celsius_in_errors(typed):
        scene = build_scene(path, tables, for_friction=for_friction, builders=builders)
    return replace(scene, unusual=tuple(notes))


def build_scene(
    path: Path, tables: dict[str, Any], *, for_friction: bool, builders: Builders = _PLAIN
) -> Scene:
    """Build a scene of its tables; `path` is whose errors they are, and where its files lie."""
    section = Section.read(path, "conditions", tables["conditions"], CONDITIONS)
    section.require(*POINTS)
    conditions = section.values
    solver = read_table(path, "solver", tables.get("solver", {}), SOLVER)
    points = {key: conditions.pop(key) for key in POINTS}
    conditions = {**defaults_of(CONDITIONS), **conditions}
    stated_rtol = solver.get("rtol")
    solver = {**defaults_of(SOLVER), **solver}

    rows = points["pressure_pa"].size * points["velocity_m_s"].size
    if rows > MOST_ROWS:
        problem = f"pressure_pa times velocity_m_s are {rows} points: must be at most {MOST_ROWS}"
        refuse(path, "[conditions]", problem)

    surface = builders.surface(path, tables["surface"])
    temperatures, directions = temperatures_of(path, conditions), directions_of(path, conditions)
    if not for_friction:
        if len(directions) > 1:
            problem = "several are for asperity friction alone: must be one"
            refuse(path, "[conditions] direction_deg", problem)
        if len(temperatures) > 1:
            problem = "several are for asperity friction and map alone: must be one"
            refuse(path, "[conditions] temperature_k", problem)
        if "heating" in tables:
            refuse(
                path, "[heating]", "is known to asperity friction and map alone: must be left out"
            )
    rubbers = [builders.rubber(path, tables["rubber"], t) for t in temperatures]
    rubber = rubbers[0]
    hardest = rubber.rubber._stiffest
    plausible.check_load("[conditions] pressure_pa", points["pressure_pa"], hardest, path=path)
    inputs = {
        "surface": surface.values,
        "rubber": rubber.values,
        "conditions": {
            **{key: tables["conditions"][key] for key in POINTS},
            **{key: tables["conditions"][key] for key in LISTED if key in tables["conditions"]},
            **conditions,
        },
    }
    options = {**arguments(conditions, CONDITIONS), **arguments(solver, SOLVER)}
    if rubber.strain_factors:
        options["strain_factors"] = rubber.strain_factors
    correction = adhesion = None
    inputs["correction"] = {"kind": "none"}
    if "correction" in tables:
        correction, inputs["correction"] = builders.correction(
            path, tables["correction"], surface.spectrum, surface.scan, surface.values
        )
    if "adhesion" in tables:
        adhesion, inputs["adhesion"] = build_part(path, "adhesion", tables["adhesion"], Adhesion)
    heating = None
    if "heating" in tables:
        heating, inputs["heating"] = build_part(path, "heating", tables["heating"], Heating)
        if temperatures == [None]:  # it may stand in [rubber]
            temperatures = [rubber.temperature]
        check_heated(path, temperatures[0], rubber)
    inputs["solver"] = solver
    sampling = defaults_of(UNCERTAINTY)
    if "uncertainty" in tables:
        sampling |= read_table(path, "uncertainty", tables["uncertainty"], UNCERTAINTY)
        inputs["uncertainty"] = sampling
        if surface.drawn.draw is None and rubber.drawn.draw is None:
            problem = (
                "no standard errors are known: the surface must be a file, or the rubber isotherms"
            )
            refuse(path, "[uncertainty]", problem)
    first = Scene(
        path=path,
        surface=surface,
        built_rubber=rubber,
        pressure=points["pressure_pa"],
        velocity=points["velocity_m_s"],
        correction=correction,
        adhesion=adhesion,
        options=options,
        inputs=inputs,
        sampling=sampling,
        stated_rtol=stated_rtol,
        unusual=(),
        typed=typed_in(tables),
        temperature=temperatures[0],
        heating=heating,
        tables=tables,
    )
    first, *others = (
        replace(first, built_rubber=one, temperature=t).toward(direction)
        for one, t in zip(rubbers, temperatures, strict=True)
        for direction in directions
    )
    return replace(first, others=others)


def read_tables(path: Path) -> dict[str, Any]:
    """Tables of a scene file, of which the three that every scene needs are there."""
    tables = read_toml(path)
    check_tables(path, tables)
    _list_isotherms(path, tables["rubber"])
    return tables


def _list_isotherms(path: Path, rubber: Any) -> None:
    if not isinstance(rubber, dict) or not isinstance(rubber.get("isotherms"), list):
        return
    names = []
    for name in rubber["isotherms"]:
        if not _is_pattern(path, name):
            names.append(name)
        elif "temperatures" in rubber:
            problem = "must name its files one by one, as temperatures gives one to each"
            refuse(path, "[rubber] isotherms", problem, valued(name))
        elif files := sorted(glob(name.replace("[", "[[]"), root_dir=path.parent)):
            names += files
        else:
            refuse(path, "[rubber] isotherms", "no file has such a name", valued(name))
    rubber["isotherms"] = names


def _is_pattern(path: Path, name: object) -> bool:
    return (
        isinstance(name, str)
        and "\0" not in name
        and not set(name).isdisjoint("*?")
        and not (path.parent / name).exists()
    )


def read_toml(path: Path) -> dict[str, Any]:
    """Tables of a TOML file, whatever they are."""
    with reading(path):
        check_file(path)
        return read_toml_text(path.read_bytes(), parse_float=Typed)


def check_tables(path: Path, tables: Mapping[str, Any]) -> None:
    """Refuse tables that no scene has, and a scene without those that it needs."""
    for name, table in tables.items():
        if name not in KEYS:
            hint = nearest(name, KEYS, "[{}]")
            kind, field = ("table", f"[{name}]") if isinstance(table, dict) else ("key", name)
            refuse(path, field, f"unknown {kind}, {hint}")
    for name in ("surface", "rubber", "conditions"):
        if name not in tables:
            refuse(path, f"[{name}]", "missing: a scene needs this table")


def scene_text(tables: Mapping[str, Mapping[str, Any]]) -> str:
    """TOML that reads back as the same tables; numbers have the shortest digits that do."""
    return "\n".join(f"[{name}]\n{_lines(table)}" for name, table in tables.items())


def _lines(table: Mapping[str, Any]) -> str:
    return "".join(f"{key} = {toml_value(value)}\n" for key, value in table.items())
