"""The friction map of a scene: its rubber, its heat, its sides, and the text that it carries."""

from collections.abc import Sequence
from typing import Any

from asperity.base.arguments import Array, known
from asperity.base.diagnostics import Argument, Note, must_be
from asperity.friction_map.build import friction_map
from asperity.friction_map.look_up import FrictionMap
from asperity.io.table import input_lines
from asperity.rubber import Rubber
from asperity.scene.model import Scene
from asperity.scene.results import scene_inputs

Sides = Sequence[float] | None


def map_of_scene(
    scene: Scene,
    rtol: float,
    *,
    pressure: Sides = None,
    velocity: Sides = None,
    unusual: Sequence[Note] = (),
    **how: Any,
) -> FrictionMap:
    """The map between the sides that are asked for, or those of the scene. `unusual` has notes on
    what was asked for; `how` goes to `friction_map`."""
    notes = [*scene.notes, *unusual]
    sides: dict[str, Any] = {
        "pressure": _side("pressure", pressure, scene.pressure, notes),
        "velocity": _side("velocity", velocity, scene.velocity, notes),
    }
    inputs = scene_inputs(scene) | {"solver": {**scene.inputs["solver"], "rtol": rtol}}
    lines = [*(f"note: {note.line}" for note in notes), *input_lines(inputs)]
    text = "".join(f"{line}\n" for line in lines)
    return friction_map(
        scene.spectrum,
        rubber_of_map(scene),
        correction=scene.correction,
        adhesion=scene.adhesion,
        words=scene.said,
        text=text.encode(errors="backslashreplace").decode(),  # names of files need be no text
        **sides,
        **{**scene.options, "rtol": rtol},
        **heat_of_map(scene),
        **how,
    )


def heat_of_map(scene: Scene) -> dict[str, Any]:
    """What a map takes of a scene's heat: a list of temperatures is the range of the map's."""
    all_places = (scene, *scene.others)
    if len({one.direction_deg for one in all_places}) > 1:
        allowed = "one: it is where look-ups begin to count, and these take all others"
        raise must_be("[conditions] direction_deg", allowed, where=scene.path)
    temperatures = [one.temperature for one in all_places]
    if scene.heating is None:
        if len(temperatures) > 1:
            allowed = "one temperature where no [heating] is given; a_T leads to others"
            raise must_be("[conditions] temperature", allowed, where=scene.path)
        return {}
    lowest, highest = min(map(known, temperatures)), max(map(known, temperatures))
    law = scene.built_rubber.shift
    return {"temperature": (lowest, highest), "shift": law, "heating": scene.heating}


def rubber_of_map(scene: Scene) -> Rubber:
    """The one that a map is made of: with heat that at the reference of its shift."""
    at_reference = scene.built_rubber.at_reference
    if scene.heating is None or at_reference is None:
        return scene.rubber
    return at_reference


def _side(name: str, sides: Sides, swept: Array, notes: list[Note]) -> tuple[float, float]:
    """The sides of the map: as asked for, else as the scene sweeps."""
    if sides is not None:
        return sides[0], sides[1]
    lowest, highest = float(swept.min()), float(swept.max())
    if lowest < highest:
        return lowest, highest
    text = ": the scene has one; the map goes from a tenth to ten times of it"
    notes.append(Note(Argument(name), text, code="side-of-map"))
    return lowest / 10, highest * 10
