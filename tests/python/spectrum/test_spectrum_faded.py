"""Rows of a spectrum that have faded to nothing."""

import numpy as np
import pytest

import asperity


def test_a_faded_tail_is_zero():
    q = np.geomspace(1e3, 1e5, 41)
    faded = 1e-5 * q**-3.6 * np.exp(-((q / 4e3) ** 2))
    rubber = asperity.PronySeries(equilibrium_modulus=1e6, moduli=[1e8], relaxation_times=[1e-4])
    assert 0 < faded[faded > 0].min() < 1e-280
    for correction in (None, asperity.PartialContact()):
        scene = {"pressure": 1e5, "velocity": 0.01, "correction": correction}
        result = asperity.friction(
            asperity.TabulatedSpectrum(wavenumber=q, density=faded), rubber, **scene
        )
        zero = np.where(faded < 1e-280, 0, faded)
        same = asperity.friction(
            asperity.TabulatedSpectrum(wavenumber=q, density=zero), rubber, **scene
        )
        assert result.mu == same.mu > 0
    tiny = asperity.TabulatedSpectrum(wavenumber=q, density=np.full(41, 1e-300))
    with pytest.raises(asperity.InvalidInput, match="density = 1e-300"):
        asperity.friction(tiny, rubber, pressure=1e5, velocity=0.01)
