"""The variables of the FMU for both standards, with the numbers of `cpp/fmu/model.hpp`."""

import math
from collections.abc import Iterator
from dataclasses import dataclass
from typing import Literal

from asperity.friction_map.look_up import FrictionMap

STRIDE = 32  # from point to point, where there are no arrays
TIME = 0

Causality = Literal["input", "output", "parameter", "calculatedParameter"]


@dataclass(frozen=True)
class Variable:
    """One variable, of each contact point or of the whole."""

    name: str
    reference: int
    kind: Literal["real", "integer", "boolean"]
    causality: Causality
    description: str
    unit: str | None = None
    start: float | bool | None = None
    each_point: bool = True
    depends_on: tuple[str, ...] = ()


def variables(friction_map: FrictionMap) -> tuple[Variable, ...]:
    """Those of a map; a point starts at the middle of its box, on logarithmic axes."""
    middle = [math.sqrt(lo * hi) for lo, hi in (friction_map.pressure, friction_map.velocity)]
    of_point = [
        _input("pressure", 1, "nominal contact pressure", "Pa", middle[0]),
        _input("velocity", 2, "sliding velocity, of either sign", "m/s", middle[1]),
    ]
    heated = friction_map.temperature is not None
    lowest, highest = friction_map.temperature or (0.0, 0.0)
    if lowest < highest:
        told = "temperature of the background, T0"
        of_point.append(_input("temperature", 3, told, "K", (lowest + highest) / 2))
    if friction_map.turns:
        told = "of sliding, from the axis of the map towards the next; half a turn changes nothing"
        of_point.append(_input("direction", 5, told, "rad", 0.0))
    outputs = [
        ("mu", 8, "friction coefficient, hysteresis and adhesion", None),
        ("mu_hysteresis", 9, "hysteretic part of mu", None),
        ("mu_adhesion", 10, "adhesive part of mu", None),
        ("contact_area", 11, "real contact area over the nominal one", None),
        ("traction", 12, "shear stress with the sign of the velocity, 0 at rest", "Pa"),
        ("dmu_dlnp", 13, "slope of mu over the logarithm of the pressure", None),
        ("dmu_dlnv", 14, "slope of mu over the logarithm of the speed", None),
    ]
    if friction_map.directional:
        outputs += [
            ("lateral", 17, "force across the sliding over the load", None),
            ("lateral_traction", 18, "shear stress across, with the sign of the velocity", "Pa"),
        ]
    inputs = tuple(variable.name for variable in of_point)
    if heated:
        told = "true: sliding begins anew, cold"
        of_point.append(Variable("reset", 4, "boolean", "input", told, start=False))
    for name, reference, told, unit in outputs:
        of_point.append(Variable(name, reference, "real", "output", told, unit, depends_on=inputs))
    told = "1 inside of the map's box, 0 outside"
    of_point.append(Variable("inside", 15, "integer", "output", told, depends_on=inputs))
    whole = [
        _whole("max_error", 25, "real", "relative error of mu that the map was certified for"),
        _whole(
            "clamp",
            26,
            "boolean",
            "outside of the box: true takes the nearest point of the box, false gives NaN",
            start=True,
        ),
    ]
    if heated:
        told = "slid since rest, since the velocity's last change of sign or since a reset"
        of_point.append(Variable("slid_distance", 16, "real", "output", told, "m"))
        told = "true: friction heats up over the map's sliding length; false: it is always hot"
        whole.append(_whole("memory", 27, "boolean", told, start=True))
    else:
        told = "shift factor of the temperature, 1 at that of the map"
        whole.append(_whole("a_T", 24, "real", told, start=1.0))
    return (*of_point, *whole)


def _input(name: str, reference: int, told: str, unit: str, start: float) -> Variable:
    return Variable(name, reference, "real", "input", told, unit, start)


def _whole(
    name: str,
    reference: int,
    kind: Literal["real", "boolean"],
    told: str,
    start: float | bool | None = None,
) -> Variable:
    causality: Causality = "calculatedParameter" if start is None else "parameter"
    return Variable(name, reference, kind, causality, told, start=start, each_point=False)


def scalars(
    of: tuple[Variable, ...], points: int | None
) -> Iterator[tuple[Variable, str, int, int]]:
    """Each with its name, value reference and point, where there are no arrays: FMI 2.0.

    `points` None is one point, whose variables have plain names.
    """
    for point in range(points or 1):
        for variable in of:
            if variable.each_point:
                name = variable.name if points is None else f"{variable.name}[{point + 1}]"
                yield variable, name, variable.reference + STRIDE * point, point
    for variable in of:
        if not variable.each_point:
            yield variable, variable.name, variable.reference, 0
