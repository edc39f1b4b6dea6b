"""The verb `map`: a friction map for simulators from a scene, or what a map's file says."""

import json
from argparse import Namespace
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np

from asperity.adhesion import Adhesion
from asperity.base import quantities
from asperity.base.arguments import Array, FilePath, reading
from asperity.base.diagnostics import Argument, InvalidInput, Note, must_be
from asperity.base.parameters import parameters
from asperity.cli.friction_commands import check_outputs, progress
from asperity.cli.options import flags, list_used, typed_options
from asperity.cli.streams import print_stderr, print_stdout, printable, tell_notes
from asperity.draw.style import drawn_in
from asperity.fmu.export import PLATFORMS, export_fmu, platforms
from asperity.friction import friction
from asperity.friction_map.grid import check_export, grid_file
from asperity.friction_map.look_up import NOTE_LINE, FrictionMap
from asperity.io import plausible
from asperity.io.fields import rename_in_errors
from asperity.io.files import check_output, refuse_overwrite, write_files
from asperity.plot import friction_map as plot_map
from asperity.scene.keys import NAMES
from asperity.scene.mapped import heat_of_map, map_of_scene, rubber_of_map
from asperity.scene.model import Scene
from asperity.scene.progress import with_contacts
from asperity.scene.scene import load_scene

_RTOL = 1e-4
_TRUTH = 1e-9  # rtol of what a picture compares the map with


def friction_map_of(args: Namespace) -> None:
    """Build, certify, write and draw the map of a scene, or tell what a file holds."""
    if (args.scene is None) == (args.info is None):
        raise must_be("map", "given a SCENE.toml, or --info FILE")
    exported = None if args.export is None else FilePath(args.export)
    if exported is not None:
        check_export(exported)
    outputs = check_outputs(args, export=args.export)
    if args.info is None:
        _make(args, outputs, exported)
        return
    for flag in list_used(args, "pressure velocity rtol checked output plot style"):
        raise InvalidInput(Argument(flag), ": goes with a SCENE.toml, not with --info")
    source = FilePath(args.info)
    refuse_overwrite(outputs, [source])
    loaded = read_map(source)
    write_files(_export(loaded, exported))
    _tell(args, loaded)


def _make(args: Namespace, outputs: list[Path], exported: Path | None) -> None:
    scene = load_scene(args.scene, for_friction=True)
    refuse_overwrite(outputs, scene.sources)
    with plausible.collected(typed_options(args)) as unusual:
        _check_sides(args, scene)
    how = {} if args.checked is None else {"checked": args.checked}
    how |= {"pressure": args.pressure, "velocity": args.velocity, "unusual": unusual}
    options = ("pressure", "velocity", "checked", "rtol")
    used = [name for name in options if getattr(args, name) is not None]
    with rename_in_errors(scene.path, NAMES | flags(*used), scene.typed):
        made = _shown_while_built(scene, args.rtol or scene.stated_rtol or _RTOL, **how)
    files = _export(made, exported)
    if args.output is not None:
        files[FilePath(args.output)] = made.to_bytes()
    if args.plot is not None:
        path = FilePath(args.plot)
        with drawn_in(args.style, made.notes):
            files[path] = plot_map.map_figure(made, partial(_errors, made, scene), path)
    write_files(files)
    _tell(args, made)


def _export(made: FrictionMap, path: Path | None) -> dict[Path, bytes | str]:
    """The grid that was asked for, and a line with what interpolation in it costs."""
    if path is None:
        return {}
    content, error = grid_file(made, path)
    off = f"mu is off by up to {error:.2g}"
    print_stderr(f"{path}: interpolated linearly over ln p and ln v, {off}\n")
    return {path: content}


def _shown_while_built(scene: Scene, rtol: float, **how: Any) -> FrictionMap:
    """The map of a scene, with a bar on a terminal where it takes long."""
    steps = [slice(i, i + 1) for i in range(100)]
    with with_contacts(progress(f"{scene.path}, map"), scene.correction)(steps) as shown:
        left, done = iter(shown), 0

        def tell(share: float) -> None:
            nonlocal done
            while done < int(share * len(steps)):
                done = next(left).stop

        return map_of_scene(scene, rtol, progress=tell, **how)


def _check_sides(args: Namespace, scene: Scene) -> None:
    if args.pressure is not None:
        plausible.check("--pressure", args.pressure, quantities.PRESSURE)
        plausible.check_load("--pressure", args.pressure, scene.rubber._stiffest)
    if args.velocity is not None:
        plausible.check("--velocity", args.velocity, quantities.VELOCITY)


def _errors(made: FrictionMap, scene: Scene, pressure: Array, velocity: Array) -> Array:
    """|mu of the map / mu of the solver - 1| at pressures in a column and velocities in a row."""
    options = {**scene.options, "rtol": _TRUTH, **heat_of_map(scene)}
    at = {}
    if "heating" in options:  # of several temperatures the lowest, as the picture of mu
        at["temperature"] = options["temperature"] = options["temperature"][0]
    options |= {"correction": scene.correction, "adhesion": scene.adhesion, "velocity": velocity}
    compute = partial(friction, scene.spectrum, rubber_of_map(scene), **options)
    rows = [slice(i, i + 1) for i in range(pressure.size)]
    bar = with_contacts(progress(f"{scene.path}, errors of the map"), scene.correction)
    with bar(rows) as each:
        truth = np.concatenate([compute(pressure=pressure[row]).mu for row in each])
    mu: Array = made.mu(pressure, velocity, **at)
    # a rubber without loss and without adhesion has no friction to be off by
    ratio = np.divide(mu, truth, out=np.ones_like(mu), where=truth > 0)
    return np.asarray(np.abs(ratio - 1))


def read_map(path: Path) -> FrictionMap:
    with reading(path):
        return FrictionMap.load(path)


def _tell(args: Namespace, made: FrictionMap) -> None:
    facts: dict[str, Any] = {"pressure_pa": made.pressure, "velocity_m_s": made.velocity}
    names = ("rtol", "max_error", "checked", "exceeded", "largest_checked_error", "cells")
    facts |= {name: getattr(made, name) for name in names}
    facts["bytes"] = len(made.to_bytes())
    if made.temperature is not None:
        facts |= {"temperature_k": made.temperature, "memory_error": made.memory_error}
    if made.adhesion_law is not None:
        facts |= {one.key: getattr(made.adhesion_law, one.name) for one in parameters(Adhesion)}
    if args.json:
        print_stdout(json.dumps({**facts, "notes": made.notes, "text": made.text}, indent=1) + "\n")
        return
    lines = [f"{name} = {_short(value)}" for name, value in facts.items()]
    if args.info is not None:
        text = made.text.removesuffix("\n").split("\n") if made.text else []
        lines += [printable(line) for line in text if not line.startswith(NOTE_LINE)]
    print_stdout("".join(f"{line}\n" for line in lines))
    notes = [*made.notes]
    if made.exceeded > 0:
        beyond = f"{made.exceeded} of {made.checked} random points are beyond max_error"
        notes.append(Note(beyond, code="map-error-exceeded"))
    tell_notes(notes, args.notes)


def _short(value: Any) -> str:
    if isinstance(value, tuple):
        return f"{value[0]:.6g} to {value[1]:.6g}"
    return f"{value:.6g}" if isinstance(value, float) else str(value)


def fmu(args: Namespace) -> None:
    source, output = FilePath(args.map), FilePath(args.output)
    check_output(output)
    refuse_overwrite([output], [source])
    read = read_map(source)
    with rename_in_errors(None, {one: f"--{one}" for one in ("name", "points")}):
        export_fmu(read, output, name=args.name, fmi=args.fmi, points=args.points)
    missing = [one for one in PLATFORMS if one not in platforms()]
    lines = [f"binaries = {', '.join(platforms()) or 'none'}"]
    if missing:
        lines.append(f"from source alone = {', '.join(missing)}")
    print_stdout("".join(f"{line}\n" for line in lines))
