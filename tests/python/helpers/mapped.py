"""What friction maps and FMUs are made of: a road, rubbers, heat, points of a box."""

import numpy as np

from asperity import MasterCurve, PronySeries, SelfAffineSpectrum
from helpers.heat import HEATING, LAW

ROAD = SelfAffineSpectrum(rms_height=265.7e-6, hurst=0.87, q0=2e3, q1=2e4)
WARM_RUBBER = PronySeries(
    equilibrium_modulus=3e6,
    moduli=[4e8, 3e8, 1e8, 3e7, 1e7],
    relaxation_times=[1e-8, 1e-7, 1e-6, 1e-4, 1e-2],
)
HEAT = {"shift": LAW, "heating": HEATING}


def measured(rubber, last, rows):
    """The rubber as a table from 1e-3 rad/s on."""
    w = np.geomspace(1e-3, last, rows)
    e = rubber.modulus(w)
    return MasterCurve(angular_frequency=w, storage_modulus=e.real, loss_modulus=e.imag)


def drawn(count, box, third=None, seed=1):
    """Pressures and velocities, evenly in their logarithms, and of a third what is between two."""
    draws = np.random.default_rng(seed)
    two = [np.exp(draws.uniform(*np.log(box[name]), count)) for name in ("pressure", "velocity")]
    return two if third is None else [*two, draws.uniform(*third, count)]
