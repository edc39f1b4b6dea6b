"""The verb `design`: what 10 % more of each part of a scene is worth in mu."""

from argparse import Namespace
from typing import Any

from asperity.cli.friction_commands import check_outputs, refuse_overwrite, write_outputs
from asperity.io.fields import refuse
from asperity.io.table import Table
from asperity.plot.design import design_figure
from asperity.scene.design import design as designed
from asperity.scene.results import scene_inputs
from asperity.scene.scene import load_scene


def design(args: Namespace) -> None:
    """Print or write the table, a row a part of the inputs and a point, and its picture."""
    outputs = check_outputs(args)
    scene = load_scene(args.scene, for_friction=True)
    if scene.others:
        problem = "several temperatures or directions are for asperity friction alone: must be one"
        refuse(scene.path, "[conditions]", problem)
    refuse_overwrite(outputs, scene.sources)
    found = designed(scene)
    rows = found.worths
    columns: dict[str, list[Any]] = {
        "pressure_pa": [row.pressure for row in rows],
        "velocity_m_s": [row.velocity for row in rows],
        "part": [row.part for row in rows],
        "change": [row.change for row in rows],
        "from": [_cell(row.lower) for row in rows],
        "to": [_cell(row.upper) for row in rows],
        "dma_temperature_k": [_cell(row.temperature) for row in rows],
        "mu_change": [float(row.mu) for row in rows],
    }
    table = Table("design", [scene_inputs(scene)], found.result.notes, columns)
    write_outputs(args, table, lambda picture: design_figure(found, picture))


def _cell(found: float | None) -> float | str:
    return "" if found is None else found
