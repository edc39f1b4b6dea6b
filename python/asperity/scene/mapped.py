"""What a friction map takes of a scene: its rubber, its heat and its sides."""

from collections.abc import Sequence
from typing import Any

from asperity.base.arguments import Array, known
from asperity.base.diagnostics import Argument, Note, must_be
from asperity.rubber import Rubber
from asperity.scene.model import Scene


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


def side_of_map(
    name: str, sides: Sequence[float] | None, swept: Array, notes: list[Note]
) -> tuple[float, float]:
    """The sides of the map: as asked for, else as the scene sweeps."""
    if sides is not None:
        return sides[0], sides[1]
    lowest, highest = float(swept.min()), float(swept.max())
    if lowest < highest:
        return lowest, highest
    text = ": the scene has one; the map goes from a tenth to ten times of it"
    notes.append(Note(Argument(name), text, code="side-of-map"))
    return lowest / 10, highest * 10
