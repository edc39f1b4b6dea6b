"""Threads share points, and change no number, no note and no error."""

import pickle

import numpy as np
import pytest

import asperity
from helpers.rubbers import curve_of, prony

ROAD = asperity.SelfAffineSpectrum(rms_height=1e-4, hurst=0.8, q0=1e3, q1=1e5, rolloff=2e3)
RUBBER = prony(1e6, np.geomspace(1e6, 1e8, 8), 10.0 ** -np.arange(8))
RINGS = 1e3 * np.arange(1, 101)
SCATTER = 1 + 0.3 * np.random.default_rng(1).uniform(-1, 1, 100)
SCAN = asperity.TabulatedSpectrum(wavenumber=RINGS, density=1e-12 * (RINGS / 1e3) ** -3.6 * SCATTER)
FREQUENCY = np.geomspace(1e-4, 1e8, 60)
MEASURED = curve_of(FREQUENCY, RUBBER.modulus(FREQUENCY))
VELOCITY = np.random.default_rng(2).permutation(np.geomspace(1e-5, 10, 1001))
PEAKS = asperity.GreenwoodWilliamson(z_max=4e-4, z_min=-4e-4, rms_height=1e-4, q0=1e3)
STICKY = asperity.Adhesion(shear_stress=5e6)


@pytest.mark.parametrize(
    ("spectrum", "rubber", "options"),
    [
        (ROAD, RUBBER, {"correction": asperity.NayakSFactor(), "adhesion": STICKY}),
        (ROAD, RUBBER, {"contributions": True, "pressure": 1e5}),
        (SCAN, RUBBER, {"correction": asperity.PartialContact(), "adhesion": STICKY}),
        (ROAD, MEASURED, {"correction": asperity.PartialContact()}),
        (SCAN, RUBBER, {"correction": asperity.SFactor(), "form": "interpolated"}),
        (SCAN, MEASURED, {"adhesion": STICKY}),
        (ROAD, MEASURED, {"correction": PEAKS}),
    ],
)
def test_any_number_of_threads_gives_the_same_bits(spectrum, rubber, options):
    scene = {"pressure": np.geomspace(1e4, 1e6, VELOCITY.size), "velocity": VELOCITY, **options}
    alone = asperity.friction(spectrum, rubber, **scene)
    assert alone.notes
    for threads in (2, 3, 8, 1000):
        assert asperity.friction(spectrum, rubber, threads=threads, **scene) == alone, threads
    pressure = np.broadcast_to(scene["pressure"], VELOCITY.shape)
    fresh = pickle.loads(pickle.dumps(spectrum))  # which keeps nothing of its rings yet
    for k, surface in ((5, fresh), (0, fresh), (-1, spectrum)):
        point = {**scene, "pressure": pressure[k], "velocity": VELOCITY[k]}
        assert asperity.friction(surface, rubber, **point).mu == alone.mu[k]


def test_a_map_is_the_same_with_any_number_of_threads():
    box = {"pressure": (5e4, 5e5), "velocity": (1e-4, 1), "rtol": 1e-3, "checked": 50_000}
    maps = [asperity.friction_map(ROAD, RUBBER, threads=n, **box).content for n in (1, 2, 5, None)]
    assert len(set(maps)) == 1


def test_a_band_is_the_same_with_any_number_of_threads():
    noisy = asperity.TabulatedSpectrum(
        wavenumber=SCAN.wavenumber, density=SCAN.density, standard_error=0.1 * SCAN.density
    )
    scene = {"pressure": 1e5, "velocity": VELOCITY[:20], "samples": 60}
    alone = asperity.friction_band(noisy, RUBBER, **scene)
    for threads in (2, 7):
        assert asperity.friction_band(noisy, RUBBER, threads=threads, **scene) == alone


def test_an_error_is_that_of_the_slowest_point_that_fails():
    velocity = np.geomspace(1e-5, 10, 400)
    pressure = np.full(400, 1e5)
    pressure[[150, 250, 390]] = 1e-180, 2e-180, 3e-180
    said = set()
    for threads in (1, 4):
        with pytest.raises(asperity.InvalidInput, match="pressure = 1e-180: leads to G") as caught:
            asperity.friction(ROAD, RUBBER, pressure=pressure, velocity=velocity, threads=threads)
        said.add(str(caught.value))
    assert len(said) == 1
