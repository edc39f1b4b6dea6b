"""A signal's handler is heard within one call of the core, and what it raises ends the call.

What is compared is processor time, of which a busy machine takes none away.
"""

import signal
import time
from collections.abc import Callable

import numpy as np
import pytest

import asperity

ROAD = asperity.SelfAffineSpectrum(rms_height=1e-5, hurst=0.8, q0=2e3, q1=1e5)

RUBBER = asperity.PronySeries(
    equilibrium_modulus=3e6, moduli=[1e7, 1e9], relaxation_times=[1e-2, 1e-6]
)


class Enough(Exception):
    """What the handler raises."""


def raise_enough(*_: object) -> None:
    raise Enough


def line_density(size: int) -> object:
    return ROAD.line_density(np.full(size, 2.5e3))


def synthesize(size: int) -> object:
    return asperity.synthesize(ROAD, shape=(size, 512), pixel_size=1e-5, seed=1, skewness=-0.5)


def fit_adhesion(size: int) -> object:
    v = np.geomspace(1e-4, 1, size)
    mu = 1.5 * np.exp(-0.1 * np.log10(v / 6e-3) ** 2) * (1 + 0.05 * np.sin(17 * np.arange(size)))
    return asperity.fit_adhesion(ROAD, RUBBER, velocity=v, mu=mu, pressure=2e5)


@pytest.mark.parametrize(
    ("call", "small", "times"),
    [(line_density, 10_000, 50), (synthesize, 64, 250), (fit_adhesion, 60, 50)],
)
def test_a_call_ends_long_before_its_end(
    call: Callable[[int], object], small: int, times: int
) -> None:
    begun = time.process_time()
    call(small)
    part = time.process_time() - begun
    before = signal.signal(signal.SIGPROF, raise_enough)
    try:
        begun = time.process_time()
        signal.setitimer(signal.ITIMER_PROF, part)
        with pytest.raises(Enough):
            call(small * times)
        took = time.process_time() - begun
    finally:
        signal.setitimer(signal.ITIMER_PROF, 0)
        signal.signal(signal.SIGPROF, before)
    assert took < part * times / 2
