"""Keys of a scene's own tables, and the names that errors on their arguments take."""

from asperity.base import quantities
from asperity.friction import friction
from asperity.io.fields import Field, angles, fields_of, names_of, sweep
from asperity.scene.heat import TEMPERATURE
from asperity.uncertainty.band import friction_band

POINTS = {
    "pressure_pa": Field(
        sweep,
        "pressure",
        quantities.PRESSURE,
        meaning="required: a number, a list, or `{ from = 1e4, to = 1e6, points = 5 }`, which is "
        "logarithmic",
    ),
    "velocity_m_s": Field(sweep, "velocity", quantities.VELOCITY, meaning="the same"),
}
CONDITIONS = {
    **POINTS,
    **TEMPERATURE,
    **fields_of(friction, "poisson_ratio"),
    "direction_deg": Field(
        angles,
        "direction",
        meaning="of sliding, from x (a scan's second axis) towards y, on a surface that knows "
        "directions and with `scan-contact`: a number, a list or "
        "`{from = 0, to = 360, points = 73}`, in equal steps. A column `lateral` at the end of the "
        "table has the force across over the load, one before it `direction_deg` where there are "
        "several; the picture of several is polar. With `scan-contact` each is a contact to solve: "
        "13 or 25 serve",
    ),
}
SOLVER = fields_of(friction, "rtol", "form", "method")
NAMES = {**names_of("conditions", CONDITIONS), **names_of("solver", SOLVER)}
UNCERTAINTY = fields_of(friction_band, "samples", "seed", "level")
NOTED = {"heating": "[heating]", "strain_factors": "[rubber] strain"}  # arguments that notes name
