"""A band on mu from noisy isotherms beside the true mu: a kind of tests/stability/band_coverage.py.

A Prony series is the rubber, and its mu on a self-affine road is known. Each trial draws a series
and a noise of 0.3 to 5 %, measures isotherms, builds a master curve, smooth or of points, and asks
for the band of level 0.95 at five velocities.
"""

from typing import Any

import numpy as np

import asperity

T_REF = 293.0
TEMPERATURES = np.arange(253.0, 334.0, 8.0)
ROAD = asperity.SelfAffineSpectrum(rms_height=1e-4, hurst=0.8, q0=2e3, q1=1e5)
SCENE = {"pressure": 3e5, "velocity": np.geomspace(1e-5, 1e-1, 5)}


def rubber_of(rng: Any) -> Any:
    """A series whose strengths wander."""
    times = np.geomspace(1e-11, 1e3, 29)
    wander = np.cumsum(rng.normal(0, 0.08, times.size))
    strengths = 10.0**wander * times**-0.25
    return asperity.PronySeries(
        equilibrium_modulus=2e6,
        moduli=strengths / strengths.sum() * 1e9,
        relaxation_times=times,
    )


def measured(rubber: Any, noise: float, rng: Any) -> list[Any]:
    frequency = np.geomspace(0.3, 300, 16)
    isotherms = []
    for t in TEMPERATURES:
        a_t = 10 ** (-8.86 * (t - T_REF) / (101.6 + t - T_REF))
        modulus = rubber.modulus(a_t * frequency)
        scatter = np.exp(noise * rng.standard_normal((2, frequency.size)))
        isotherms.append(
            asperity.Isotherm(
                temperature=t,
                angular_frequency=frequency,
                storage_modulus=modulus.real * scatter[0],
                loss_modulus=modulus.imag * scatter[1],
            )
        )
    return isotherms


Found = tuple[Any, Any, Any]


def compare(spectrum: Any, rubber: Any, truth: Any, number: int, samples: int) -> Found:
    """Whether the band holds the true mu, its width over mu, and how far a second seed moves its
    ends, in widths."""
    one, two = (
        asperity.friction_band(spectrum, rubber, **SCENE, samples=samples, seed=2 * number + k)
        for k in (0, 1)
    )
    width = one.upper - one.lower
    moved = np.maximum(np.abs(one.lower - two.lower), np.abs(one.upper - two.upper)) / width
    return (one.lower <= truth) & (truth <= one.upper), width / truth, moved


def trial(seed: int, number: int, samples: int) -> Found:
    """A band from isotherms of a rubber with noise."""
    rng = np.random.default_rng([seed, number])
    rubber = rubber_of(rng)
    noise = 10 ** rng.uniform(np.log10(0.003), np.log10(0.05))
    build = asperity.build_master_curve(
        measured(rubber, noise, rng),
        reference_temperature=T_REF,
        smooth=bool(rng.random() < 0.5),
        extrapolation="power-law",
    )
    truth = asperity.friction(ROAD, rubber, **SCENE).mu
    return compare(ROAD, build, truth, number, samples)
