"""Friction at several directions of sliding, which the core solves one at a time."""

import math
from collections.abc import Callable, Mapping
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from asperity._core import InvalidInput
from asperity.base.arguments import broadcast, frozen
from asperity.base.diagnostics import Argument, Must, Note, Value, fatal_first, refusal
from asperity.results.friction import Friction, joined
from asperity.spectrum import Spectrum

LAY = 1.5  # ratio of the principal slopes above which directions matter: |C| differs by its square
_STEPS = 64  # of wavenumbers and of angles


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
    if not np.size(direction):
        raise InvalidInput(
            Argument("direction"), " has 0 entries", Must(": must have "), "1 or more"
        )
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


def along_x_notes(spectrum: Spectrum) -> tuple[Note, ...]:
    """Return a note where a spectrum with a lay is slid along x as no direction was given.

    The lay is that of the mean square slopes <dh/dx_i dh/dx_j> = int q_i q_j C d^2q.
    """
    if not spectrum.is_directional:
        return ()
    q = np.geomspace(spectrum.q0, spectrum.q1, _STEPS)
    phi = np.pi * np.arange(_STEPS) / _STEPS
    # q_i q_j d^2q ~ q^4 dln q dphi
    of_angle = np.sum(q[:, None] ** 4 * spectrum.toward(q[:, None], phi), axis=0)
    second = np.sum(of_angle * np.exp(2j * phi)) / np.sum(of_angle)
    ratio = math.sqrt((1 + abs(second)) / (1 - abs(second)))
    if not ratio > LAY:
        return ()
    # the slope is largest where C is, and least along the ridges
    degrees = math.degrees(np.angle(-second) / 2)
    return (
        Note(
            Argument("direction"),
            ": none is given, so that x is slid along, at ",
            Value(f"{abs(degrees):.0f}", (abs(degrees),)),
            f" degrees to the ridges, across which the surface is {ratio:.3g} times as steep",
            code="along-x",
        ),
    )
