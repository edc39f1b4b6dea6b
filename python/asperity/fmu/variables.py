"""The variables of the FMU for both standards, with the numbers of `cpp/fmu/model.hpp`."""

import math
from collections.abc import Iterator
from dataclasses import dataclass
from typing import Literal

from asperity.friction_map import FrictionMap

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
    pressure, velocity = (
        math.sqrt(lo * hi) for lo, hi in (friction_map.pressure, friction_map.velocity)
    )

    def output(name: str, reference: int, description: str, unit: str | None = None) -> Variable:
        inputs = ("pressure", "velocity")
        return Variable(name, reference, "real", "output", description, unit, depends_on=inputs)

    return (
        Variable("pressure", 1, "real", "input", "nominal contact pressure", "Pa", pressure),
        Variable(
            "velocity", 2, "real", "input", "sliding velocity, of either sign", "m/s", velocity
        ),
        output("mu", 8, "friction coefficient, hysteresis and adhesion"),
        output("mu_hysteresis", 9, "hysteretic part of mu"),
        output("mu_adhesion", 10, "adhesive part of mu"),
        output("contact_area", 11, "real contact area over the nominal one"),
        output("traction", 12, "shear stress with the sign of the velocity, 0 at rest", "Pa"),
        output("dmu_dlnp", 13, "slope of mu over the logarithm of the pressure"),
        output("dmu_dlnv", 14, "slope of mu over the logarithm of the speed"),
        Variable(
            "inside",
            15,
            "integer",
            "output",
            "1 inside of the map's box, 0 outside",
            depends_on=("pressure", "velocity"),
        ),
        Variable(
            "a_T",
            24,
            "real",
            "parameter",
            "shift factor of the temperature, 1 at that of the map",
            start=1.0,
            each_point=False,
        ),
        Variable(
            "max_error",
            25,
            "real",
            "calculatedParameter",
            "relative error of mu that the map was certified for",
            each_point=False,
        ),
        Variable(
            "clamp",
            26,
            "boolean",
            "parameter",
            "outside of the box: true takes the nearest point of the box, false gives NaN",
            start=True,
            each_point=False,
        ),
    )


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
