"""Every key that a scene may have, by table: for those who change one of them."""

from asperity.io.fields import Field
from asperity.scene.keys import CONDITIONS, SOLVER, UNCERTAINTY
from asperity.scene.parts import ADHESION, CORRECTIONS, HEATING
from asperity.scene.rubber import RUBBER
from asperity.scene.surface import SURFACE

KEYS: dict[str, dict[str, Field]] = {
    "surface": SURFACE,
    "rubber": RUBBER,
    "conditions": CONDITIONS,
    "correction": {key: one for kind in CORRECTIONS.values() for key, one in kind.items()},
    "adhesion": ADHESION,
    "heating": HEATING,
    "solver": SOLVER,
    "uncertainty": UNCERTAINTY,
}
KEYS_OF_KIND = CORRECTIONS  # the keys of [correction] that go with each kind
FILES = (
    "surface.file",
    "rubber.master_curve",
    "rubber.shift",
    "rubber.isotherms",
    "rubber.strain_sweeps",
)
