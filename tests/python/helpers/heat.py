"""A tread on asphalt that heats itself: the scene of tests/reference/flash.csv."""

from functools import cache
from pathlib import Path

import asperity
from helpers.examples import TREAD

REFERENCE = Path(__file__).parents[2] / "reference"
LAW = asperity.WLF(c1=8.86, c2=101.6, reference_temperature=293.15)
HEATING = asperity.Heating(**TREAD)
STICKY = asperity.Adhesion(shear_stress=8.3e6, reference_velocity=6e-3, width=0.1)
ASPHALT = asperity.SelfAffineSpectrum(rms_height=265.7e-6, hurst=0.87, q0=2000, q1=1e6)
CUT = ASPHALT.truncated(q1=23339.76848083597)


@cache
def rubber():
    """The rubber that the comments of the table have."""
    text = (REFERENCE / "flash.csv").read_text(encoding="utf-8").splitlines()
    columns = {
        line.split()[1]: [float(x) for x in line.split()[2:]]
        for line in text
        if line.startswith(("# moduli", "# relaxation_times"))
    }
    return asperity.PronySeries(equilibrium_modulus=2e6, **columns)


def hot(spectrum=CUT, *, velocity, pressure=2e5, temperature=293.15, shift=LAW, **more):
    given = {"heating": HEATING, "rtol": 1e-9} | more
    compound = given.pop("rubber", None) or rubber()
    return asperity.friction(
        spectrum,
        compound,
        pressure=pressure,
        velocity=velocity,
        temperature=temperature,
        shift=shift,
        **given,
    )
