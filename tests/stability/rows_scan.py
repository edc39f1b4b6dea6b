"""Rows of the contact of a scan itself: where a spectrum does not know enough, or there is no scan.

Maps are periodic, 128 x 128 points, 8 to the shortest wave, q1/q0 = 8, so that what is solved is
the map as it stands. What is allowed between solved velocities is twice the tolerance, 0.02.
"""

from collections.abc import Iterator
from functools import partial
from typing import Any

import numpy as np
from rows import Case, row

import asperity
from asperity.validation import slide

LENGTH, POINTS = 0.01, 128
Q0, Q1 = 4 * np.pi / LENGTH, 32 * np.pi / LENGTH
SLID = "the contact at that velocity (slide, which the rows on exact sliding hold)"
THEORY = "PartialContact of the map's own spectrum"


def modes() -> tuple[Any, Any]:
    k = 2 * np.pi * np.fft.fftfreq(POINTS, LENGTH / POINTS)
    return k, np.hypot(k, k[:, None])


def within_band(heights: Any) -> asperity.HeightMap:
    _, q = modes()
    inside = (q > Q0 * (1 - 1e-9)) & (q < Q1 * (1 + 1e-9))
    heights = np.fft.ifft2(np.where(inside, np.fft.fft2(heights), 0)).real
    return asperity.HeightMap(1e-4 * heights / heights.std(), pixel_size=LENGTH / POINTS)


def worn_map() -> asperity.HeightMap:
    """Tops flattened, skewness -1.3."""
    road = asperity.SelfAffineSpectrum(rms_height=1, hurst=0.8, q0=Q0, q1=Q1)
    grid = {"shape": (POINTS, POINTS), "pixel_size": LENGTH / POINTS}
    return within_band(-np.logaddexp(0, -2 * asperity.synthesize(road, **grid, seed=1).heights))


def ridged_map() -> asperity.HeightMap:
    """Gaussian heights whose waves along y are three times as long."""
    k, _ = modes()
    along, across = k[:, None] * np.sqrt(3), k / np.sqrt(3)
    amplitude = (np.hypot(along, across) + Q0 / 9) ** -1.8
    noise = np.random.default_rng(1).normal(size=amplitude.shape)
    return within_band(np.fft.ifft2(amplitude * np.fft.fft2(noise)).real)


def spectrum(scan: asperity.HeightMap) -> asperity.TabulatedSpectrum:
    return asperity.power_spectrum(scan, window="none", detrend=None).truncated(q0=Q0, q1=Q1)


def series(ratio: float) -> asperity.PronySeries:
    moduli = np.geomspace(1, 100, 8)
    return asperity.PronySeries(
        equilibrium_modulus=1e6,
        moduli=1e6 * (ratio - 1) * moduli / moduli.sum(),
        relaxation_times=np.geomspace(1e-1, 1e-7, 8),
    )


def friction(scan: asperity.HeightMap, rubber: Any, correction: Any, **scene: Any) -> Any:
    return asperity.friction(spectrum(scan), rubber, correction=correction, **scene)


def against_slide(
    name: str, scan: asperity.HeightMap, rubber: Any, pressure: float, velocities: Any
) -> Iterator[Case]:
    exact = asperity.ScanContact(scan, periodic=True)
    for velocity in velocities:
        at = {"pressure": pressure, "velocity": velocity}
        truth = slide(scan, rubber, **at, periodic=True, rtol=1e-9)

        def result(correction: Any, at: Any = at) -> float:
            return float(getattr(friction(scan, rubber, correction, **at), name))

        usual = partial(result, asperity.PartialContact())
        yield usual, partial(result, exact), getattr(truth, name)


@row(
    "a worn scan: mu over six decades",
    "the same spectrum is that of a surface with peaks and of one without",
    naive=THEORY,
    truth=SLID,
    allowed=0.04,
    fails=0.5,
)
def worn() -> Iterator[Case]:
    yield from against_slide(
        "hysteresis", worn_map(), series(300), 2e5, 1.7 * np.geomspace(1e-4, 1e2, 7)
    )


@row(
    "a scan under almost no load, sigma0/(E* h') = 1e-6: A/A0",
    "a map has one highest top, a spectrum has none",
    naive=THEORY,
    truth=SLID,
    allowed=0.04,
    fails=0.3,
)
def tiny_load() -> Iterator[Case]:
    yield from against_slide("contact_area", worn_map(), series(300), 0.1, (1.7e-3, 1.7e-1))


@row(
    "a scan of ridges in full contact: mu",
    "a spectrum averages over directions: all waves lie across the way as often as along it",
    naive=THEORY,
    truth="closed form, sum of q_x Im K |h / K|^2 / sigma0 over the map's waves",
    allowed=0.01,
    fails=0.1,
)
def full_contact() -> Iterator[Case]:
    scan, rubber, pressure = ridged_map(), series(30), 1e10
    exact = asperity.ScanContact(scan, periodic=True)
    k, q = modes()
    along = abs(k) * np.ones_like(q)
    moving = along > 0
    power = abs(np.fft.fft2(scan.heights) / POINTS**2)[moving] ** 2
    for velocity in (1.7e-2, 1.7):
        # K = 2 (1 - nu^2) / (|q| conj E), so that Im K / |K|^2 = |q| Im E / (2 (1 - nu^2))
        loss = along[moving] * q[moving] * rubber.modulus(along[moving] * velocity).imag / 1.5
        mu = float((power * loss).sum() / pressure)
        at = {"pressure": pressure, "velocity": velocity}

        def result(correction: Any, at: Any = at) -> float:
            return float(friction(scan, rubber, correction, **at).hysteresis)

        yield partial(result, asperity.PartialContact()), partial(result, exact), mu
