"""Friction at several directions of sliding, which the core solves one at a time."""

import math
from collections.abc import Callable, Mapping, Sequence
from functools import partial, wraps
from typing import Any, ParamSpec

import numpy as np
from numpy.typing import ArrayLike

from asperity.base.arguments import Shape, broadcast, frozen, real_array
from asperity.base.diagnostics import Argument, Note, Value, fatal_first, must_have, refusal
from asperity.results.friction import Friction, joined
from asperity.spectrum import Spectrum

P = ParamSpec("P")
LAY = 1.5  # ratio of the principal slopes above which directions matter: |C| differs by its square
_POINTS = ("pressure", "velocity", "temperature")
_OF_ONE = ("heating", "contributions", "gradients")  # arguments that go with one direction
_ALONG_X = "along-x"
_STEPS = 64  # of wavenumbers and of angles


def toward_each(
    direction: ArrayLike, points: Mapping[str, ArrayLike]
) -> tuple[Shape, list[tuple[float, Any, dict[str, Any]]]]:
    """Return the shape that directions and points have together; of each direction its angle [rad],
    which of the points are its own, and those."""
    angle = real_array(direction, "direction")
    if not angle.ndim:
        shape, columns = broadcast(**points)
        return shape, [(angle.item(), slice(None), dict(zip(points, columns, strict=True)))]
    if not angle.size:
        raise must_have("direction", "1 or more", " has 0 entries")
    shape, (angle, *columns) = broadcast(direction=angle, **points)
    angles, which = np.unique(angle, return_inverse=True)
    each = []
    for i, one in enumerate(angles.tolist()):
        where = np.flatnonzero(which == i)
        each.append((one, where, {k: c[where] for k, c in zip(points, columns, strict=True)}))
    return shape, each


def over_directions(solve: Callable[P, Friction]) -> Callable[P, Friction]:
    """Let a function of points take several directions of sliding, which broadcast with them."""

    @wraps(solve)
    def solved(*parts: P.args, **options: P.kwargs) -> Friction:
        how: dict[str, Any] = {**options}
        direction = how.get("direction", 0.0)
        if not real_array(direction, "direction").ndim:
            return solve(*parts, **options)
        del how["direction"]
        for name in _OF_ONE:
            if how.get(name):
                raise refusal("direction", direction, f"one number with {name}")
        points = {name: how[name] for name in _POINTS if how.get(name) is not None}
        shape, each = toward_each(direction, points)
        call: Callable[..., Friction] = partial(solve, *parts)
        if not each:
            return call(**how)  # which refuses no points
        results = [call(**{**how, **place}, direction=angle) for angle, _, place in each]
        whole = joined(results, shape, np.concatenate([where for _, where, _ in each]))
        angles = np.broadcast_to(direction, shape)
        notes = once([one for of in results for one in of.notes if one.code != _ALONG_X])
        more = {"direction": frozen(np.array(angles)), "notes": tuple(fatal_first(notes))}
        return Friction._made(vars(whole), **more)

    return solved


def once(notes: Sequence[Note]) -> list[Note]:
    """Return the notes, of those alike the first."""
    return [*{note.identity: note for note in reversed(notes)}.values()][::-1]


def along_x_notes(spectrum: Spectrum, direction: ArrayLike) -> tuple[Note, ...]:
    """Return a note where a spectrum with a lay is slid along x, as without a direction.

    The lay is that of the mean square slopes <dh/dx_i dh/dx_j> = int q_i q_j C d^2q.
    """
    if np.ndim(direction) or direction or not spectrum.is_directional:
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
            " = 0: slides along x, at ",
            Value(f"{abs(degrees):.0f}", (abs(degrees),)),
            f" degrees to the ridges, across which the surface is {ratio:.3g} times as steep",
            code=_ALONG_X,
        ),
    )
