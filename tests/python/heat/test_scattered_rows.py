"""Heat with a modulus as it was measured: rows that scatter, on a road of scattered rings."""

import numpy as np
import pytest

import asperity
from helpers.rubbers import prony, tread

HEAT = tread()
LAW = asperity.WLF(c1=8.86, c2=101.6, reference_temperature=293.15)
VELOCITY = np.geomspace(1e-4, 10, 13)


def scattered(seed):
    """Sixty rings off by a third, and 160 rows of a modulus anywhere, off by 3 %."""
    rng = np.random.default_rng(seed)
    wavenumber = np.geomspace(4e3, 3e6, 60)
    road = asperity.SelfAffineSpectrum(rms_height=3e-7, hurst=0.6, q0=4e3, q1=3e6)
    density = road.at(wavenumber) * np.exp(0.3 * rng.normal(size=wavenumber.size))
    frequency = np.sort(10 ** rng.uniform(-4, 9, 160))
    modulus = prony(3e6, np.geomspace(2e6, 3e8, 14), np.geomspace(1e3, 1e-9, 14)).modulus(frequency)
    curve = asperity.MasterCurve(
        angular_frequency=frequency,
        storage_modulus=modulus.real * np.exp(0.03 * rng.normal(size=frequency.size)),
        loss_modulus=modulus.imag * np.exp(0.03 * rng.normal(size=frequency.size)),
    )
    return asperity.TabulatedSpectrum(wavenumber=wavenumber, density=density), curve


def hot(seed, correction, rtol):
    road, curve = scattered(seed)
    return asperity.friction(
        road,
        curve,
        pressure=2e5,
        velocity=VELOCITY,
        temperature=300.0,
        shift=LAW,
        heating=HEAT,
        correction=correction,
        rtol=rtol,
    )


@pytest.mark.parametrize("correction", [None, asperity.NayakSFactor(), asperity.PartialContact()])
@pytest.mark.parametrize("seed", [0, 3])
def test_every_tolerance_is_met(seed, correction):
    """At 1e-6 and without a correction 11 of these 26 velocities were once not solved."""
    finest = hot(seed, correction, 1e-6)
    for rtol in (1e-3, 1e-4, 1e-5):
        result = hot(seed, correction, rtol)
        off = np.abs(result.mu - finest.mu)
        assert np.all(off <= result.error_estimate + finest.error_estimate)
        area = np.abs(result.contact_area / finest.contact_area - 1)
        assert np.all(area <= rtol + 1e-6)
