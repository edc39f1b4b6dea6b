"""Friction at several directions of sliding, which the core solves one at a time."""

from collections.abc import Callable, Mapping
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from asperity.base.arguments import broadcast, frozen
from asperity.base.diagnostics import fatal_first, refusal
from asperity.results.friction import Friction, joined


def over_directions(
    solve: Callable[..., Friction],
    points: Mapping[str, Any],
    direction: ArrayLike,
    alone: Mapping[str, Any],
) -> Friction:
    """Return the results of `solve` at points and directions, which broadcast.

    `alone` are arguments that take one direction, with what was given for them.
    """
    for name, given in alone.items():
        if given:
            raise refusal("direction", direction, f"one number with {name}")
    given = {name: one for name, one in points.items() if one is not None}
    shape, (angle, *columns) = broadcast(direction=direction, **given)
    if not angle.size:
        return solve(**points)  # which refuses no points
    angles, which = np.unique(angle, return_inverse=True)
    parts, places = [], []
    for i, one in enumerate(angles.tolist()):
        places.append(np.flatnonzero(which == i))
        place = {name: column[places[-1]] for name, column in zip(given, columns, strict=True)}
        parts.append(solve(**place, direction=one))
    found = joined(parts, shape, np.concatenate(places))
    of_all = {note.identity: note for part in reversed(parts) for note in reversed(part.notes)}
    notes = tuple(fatal_first(reversed(of_all.values())))
    return Friction._made(vars(found), direction=frozen(angle.reshape(shape)), notes=notes)
