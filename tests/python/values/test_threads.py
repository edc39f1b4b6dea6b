"""The same call from many threads at once: the same bits as from one, and no deadlock."""

from concurrent.futures import ThreadPoolExecutor
from threading import Barrier

import numpy as np
import pytest

import asperity
from helpers.rubbers import curve_of, prony

THREADS = 80
SURFACE = asperity.SelfAffineSpectrum(rms_height=1e-4, hurst=0.8, q0=2e3, q1=1e5)
PRONY = prony(1e6, np.geomspace(1e9, 1e6, 12), 10.0 ** -np.arange(12))
CONDITIONS = {"pressure": 1e5, "velocity": np.geomspace(1e-4, 1, 5)}
MAP = asperity.HeightMap(np.random.default_rng(0).normal(size=(120, 90)), pixel_size=(2e-6, 1e-6))
HOLED = asperity.HeightMap(np.where(np.abs(MAP.heights) > 2, np.nan, MAP.heights), pixel_size=1e-6)


def master_curve():
    """A new one each time: its angular integrals are worked out when first asked for."""
    w = np.geomspace(1e-3, 1e7, 40)
    modulus = PRONY.modulus(w)
    return curve_of(w, modulus)


def mu(rubber, **more):
    result = asperity.friction(SURFACE, rubber, **CONDITIONS, **more)
    return np.concatenate([result.mu, result.contact_area, result.error_estimate])


CALLS = {
    "friction, Prony": lambda shared: mu(PRONY),
    "friction, master curve": lambda shared: mu(shared),
    "friction, S in G": lambda shared: mu(PRONY, correction=asperity.SFactor(applies_to="both")),
    "angular integrals": lambda shared: np.stack(
        shared.angular_integrals(np.geomspace(1, 1e5, 99))
    ),
    "contact area": lambda shared: asperity.contact_area(SURFACE, shared, **CONDITIONS),
    "autocorrelation": lambda shared: SURFACE.autocorrelation(np.linspace(0, 1e-2, 9)),
    "power spectrum": lambda shared: asperity.power_spectrum(MAP).density,
    "synthesize": lambda shared: (
        asperity.synthesize(SURFACE, shape=(96, 70), pixel_size=3e-5, seed=5).heights
    ),
    "drop-outs": lambda shared: HOLED.fill_dropouts().heights,
    "local peaks": lambda shared: MAP.local_peaks(min_distance=3e-6),
}


def from_threads(call, shared):
    """The results of THREADS threads that start together."""
    start = Barrier(THREADS)

    def run(_):
        start.wait(timeout=30)
        return call(shared)

    with ThreadPoolExecutor(THREADS) as pool:
        return list(pool.map(run, range(THREADS), timeout=120))


@pytest.mark.parametrize("name", CALLS)
def test_many_threads_get_the_bits_that_one_gets(name):
    expected = CALLS[name](master_curve())
    for result in from_threads(CALLS[name], master_curve()):
        np.testing.assert_array_equal(result, expected)


def test_transforms_of_new_sizes_are_planned_at_once_in_many_threads():
    sizes = [(32 + i, 88 - i) for i in range(THREADS)]
    maps = [asperity.HeightMap(MAP.heights[:y, :x], pixel_size=1e-6) for y, x in sizes]
    start = Barrier(THREADS)

    def run(surface):
        start.wait(timeout=30)
        return asperity.power_spectrum(surface).density

    with ThreadPoolExecutor(THREADS) as pool:
        together = list(pool.map(run, maps, timeout=120))
    for surface, density in zip(maps, together, strict=True):
        np.testing.assert_array_equal(density, asperity.power_spectrum(surface).density)


def test_an_error_in_one_thread_leaves_the_others_alone():
    def run(i):
        if i % 2:
            with pytest.raises(asperity.InvalidInput, match="velocity = -1"):
                asperity.friction(SURFACE, PRONY, pressure=1e5, velocity=-1)
            return None
        return asperity.friction(SURFACE, PRONY, pressure=1e5, velocity=1e-2).mu

    with ThreadPoolExecutor(THREADS) as pool:
        results = list(pool.map(run, range(64), timeout=120))
    assert len({value for value in results if value is not None}) == 1
