"""Keys of a scene's own tables, and the names that errors on their arguments take."""

from asperity.io import plausible
from asperity.io.fields import Field, count, names_of, number, sweep, text
from asperity.scene.heat import TEMPERATURE

POINTS = {
    "pressure_pa": Field(sweep, "pressure", plausible.PRESSURE),
    "velocity_m_s": Field(sweep, "velocity", plausible.VELOCITY),
}
CONDITIONS = {**POINTS, **TEMPERATURE, "poisson_ratio": Field(number, "poisson_ratio")}
SOLVER = {"rtol": Field(number, "rtol")} | {name: Field(text, name) for name in ("form", "method")}
NAMES = {**names_of("conditions", CONDITIONS), **names_of("solver", SOLVER)}
UNCERTAINTY = {
    "samples": Field(count, "samples"),
    "seed": Field(count, "seed"),
    "level": Field(number, "level"),
}
