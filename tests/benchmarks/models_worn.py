"""Error of mu on worn surfaces, of each model that `models` times, and the cost of `ScanContact`.

Contacts are those of scan_contact.py: three kinds of worn heights (rounded, polished, honed),
periodic maps of 256 x 256 points, three rubbers, two loads, nine velocities that are no nodes.
"""

from collections import defaultdict
from collections.abc import Iterator, Sequence
from functools import cache
from typing import Any

import models_sliding
import numpy as np
import scan_contact
import timing
from models_sliding import MuError

import asperity

WORN = ("worn", "polished tops", "honed plateaus")
SCAN = "ScanContact"
CURVE = np.geomspace(1e-5, 10, 60)


NAMES = {  # of scan_contact, by the name that the chart gives them
    "Persson, exact": "none",
    "S on the integrand, 0.40": "S on the integrand, 0.40",
    "S on the integrand, 0.50": "S on the integrand, 0.50",
    "S inside G, 5/9": "S inside G, 5/9",
    "S by bandwidth (Nayak)": "`NayakSFactor`",
    "$p_T$ from peaks, $\\lambda_0$": "local peaks, lambda0",
    "$p_T$ from peaks, $\\lambda_0/2$": "local peaks, lambda0 / 2",
    "$p_T$ from IGW, implicit": "IGW, measured peaks",
    "$p_T$ from IGW, added": "IGW, added",
    "PartialContact": "`PartialContact`",
    SCAN: "`ScanContact`",
}


@cache
def errors(kinds: Sequence[str]) -> dict[str, MuError]:
    """By the chart's names; of the single scale too."""
    found: dict[str, list[float]] = defaultdict(list)
    for of in scan_contact.cases(kinds):
        for name, key in NAMES.items():
            found[name] += [*scan_contact.errors(of, key, "mu")]
        modulus = of.rubber.modulus(scan_contact.VELOCITIES * of.spectrum.q1) / (1 - 0.5**2)
        single = models_sliding.friction_of_a_single_scale(
            of.spectrum.rms_slope, modulus, of.pressure
        )
        found["single scale at $q_1$"] += [*(single / of.mu - 1)]
    return {name: models_sliding.of(values) for name, values in found.items()}


def large_maps(points: int, longest: int, shortest: int) -> Iterator[asperity.HeightMap]:
    """Gaussian, worn and peaked heights; both ends in waves to the side of 1 cm."""
    k = np.fft.fftfreq(points, 1 / points)
    q = np.hypot(k, k[:, None])
    inside = (q >= longest) & (q <= shortest)
    amplitude = np.where(inside, np.where(inside, q, 1) ** -1.8, 0)
    noise = np.random.default_rng(1).normal(size=q.shape)
    z = scan_contact.unit(np.fft.ifft2(amplitude * np.fft.fft2(noise)).real)
    for bent in (z, -np.logaddexp(0, -1.5 * z), np.exp(0.45 * z)):
        filtered = np.fft.ifft2(np.where(inside, np.fft.fft2(bent), 0)).real
        yield asperity.HeightMap(5e-5 * scan_contact.unit(filtered), pixel_size=0.01 / points)


def seconds() -> float:
    """Of a velocity in a first curve of 60 over six decades: median of three kinds, 512 x 512."""
    band = (8, 64)
    q0, q1 = (2 * np.pi * end / 0.01 for end in band)
    rubber = scan_contact.RUBBERS["8 terms, 300"]
    times = []
    for surface in large_maps(512, *band):
        spectrum = asperity.power_spectrum(surface, window="none", detrend=None)
        spectrum = spectrum.truncated(q0=q0, q1=q1)
        scan = asperity.ScanContact(surface, periodic=True)

        def curve(spectrum: Any = spectrum, scan: Any = scan) -> None:
            asperity.friction(spectrum, rubber, pressure=2e5, velocity=CURVE, correction=scan)

        times.append(timing.seconds(curve))
    return timing.median(times) / CURVE.size
