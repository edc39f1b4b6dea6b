"""Spectra with a lay, and a rubber that slides over them."""

import numpy as np

from asperity import SelfAffineSpectrum, TabulatedSpectrum
from helpers.rubbers import prony

RUBBER = prony(3e6, [1e9, 3e8, 1e8, 1e7], [1e-8, 1e-6, 1e-4, 1e-2])
Q = np.geomspace(2e3, 2e5, 60)
C = 1e-16 * (Q / 2e3) ** -3.6


def ridges(axis_ratio=2.5, lay=0.2):
    return SelfAffineSpectrum(
        rms_height=1e-4, hurst=0.8, q0=2e3, q1=2e5, axis_ratio=axis_ratio, lay=lay
    )


def rows(a=0.0, b=0.0, *more):
    """A table whose rows have these harmonics a_1, b_1, a_2, b_2 and so on."""
    columns = np.array([a, b, *more])
    return TabulatedSpectrum(
        wavenumber=Q,
        density=C,
        cosine=np.tile(columns[::2], (Q.size, 1)),
        sine=np.tile(columns[1::2], (Q.size, 1)),
    )
