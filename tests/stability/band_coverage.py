"""How often a band on mu holds the true mu, for each kind of measured input.

    python tests/stability/band_coverage.py [KIND...] [--trials 200] [--seed 1] [--samples 100]

A self-affine road and a Prony series are drawn at random, so that the true mu is known on any band.
A trial scans the road, a crop of a map twice as long that does not repeat, takes its spectrum under
a window, and asks for the band of level 0.95 at five velocities: from the rings themselves, from
the self-affine fit through them, from isotherms of the rubber with noise, or from both. Printed as
a table: the share of bands that hold the truth at the worst velocity on either side and over all,
their median width over the truth, and by how much the ends move with the seed, in widths. Exit
status 1 where a share is outside of 90 to 98 %.
"""

import sys
from collections.abc import Callable
from functools import partial
from typing import Any

import numpy as np
from coverage_isotherms import SCENE, T_REF, Found, compare, measured, rubber_of
from coverage_isotherms import trial as isotherms_trial
from options import options

import asperity


def road_of(rng: Any, side: float, pixel: float) -> Any:
    """A road whose longest waves are `side`; every third has a roll-off within a scan of it."""
    q0, q1 = 2 * np.pi / side, np.pi / pixel * 0.999
    return asperity.SelfAffineSpectrum(
        rms_height=10 ** rng.uniform(-4.3, -3.7),
        hurst=rng.uniform(0.5, 0.95),
        q0=q0,
        q1=q1,
        rolloff=q0 * rng.uniform(30, 44) if rng.random() < 1 / 3 else None,
    )


def scanned(road: Any, points: int, pixel: float, window: str, rng: Any) -> Any:
    """Spectrum of a crop of the road, which does not repeat."""
    seed = int(rng.integers(2**32))
    whole = asperity.synthesize(road, shape=(2 * points,) * 2, pixel_size=pixel, seed=seed)
    crop = np.asarray(whole.heights)[:points, :points]
    surface = asperity.HeightMap(heights=crop, pixel_size=pixel)
    return asperity.power_spectrum(surface, window=window)


def surface_trial(
    seed: int, number: int, samples: int, *, window: str, fitted: bool, both: bool = False
) -> Found:
    """A band from a scan's rings or from the fit through them, and isotherms where `both`."""
    rng = np.random.default_rng([seed, number, 7])
    points, pixel = int(rng.integers(200, 289)), 2e-5
    road, rubber = road_of(rng, 2 * points * pixel, pixel), rubber_of(rng)
    rings = scanned(road, points, pixel, window, rng)
    known = np.flatnonzero(rings.reliable)
    table = rings.truncated(q0=rings.wavenumber[known[0]], q1=rings.wavenumber[known[-1]])
    spectrum = asperity.fit_self_affine(rings) if fitted else table
    given = rubber
    if both:
        noise = 10 ** rng.uniform(np.log10(0.003), np.log10(0.05))
        given = asperity.build_master_curve(
            measured(rubber, noise, rng),
            reference_temperature=T_REF,
            smooth=True,
            extrapolation="power-law",
        )
    true = road.truncated(q0=spectrum.q0, q1=spectrum.q1)
    truth = asperity.friction(true, rubber, **SCENE).mu
    return compare(spectrum, given, truth, number, samples)


KINDS: dict[str, Callable[[int, int, int], Found]] = {
    "isotherms": isotherms_trial,
    "rings": partial(surface_trial, window="split-cosine-bell", fitted=False),
    "rings-hann": partial(surface_trial, window="hann", fitted=False),
    "rings-blackman": partial(surface_trial, window="blackman", fitted=False),
    "fit": partial(surface_trial, window="split-cosine-bell", fitted=True),
    "fit-hann": partial(surface_trial, window="hann", fitted=True),
    "fit-blackman": partial(surface_trial, window="blackman", fitted=True),
    "rings+isotherms": partial(surface_trial, window="hann", fitted=False, both=True),
    "fit+isotherms": partial(surface_trial, window="split-cosine-bell", fitted=True, both=True),
}


def main() -> int:
    asked = options(__doc__, KINDS, trials=200, seed=1, samples=100)
    print("| input | lowest, highest share [%] | all [%] | width [%] | ends move [widths] |")
    print("| --- | --- | --- | --- | --- |")
    wrong = False
    for kind in asked.kinds:
        trial = KINDS[kind]
        result = [trial(asked.seed, k, asked.samples) for k in range(asked.trials)]
        held, width, moved = (np.array(column) for column in zip(*result, strict=True))
        share = 100 * held.mean(axis=0)
        wrong |= bool(((share < 90) | (share > 98)).any())
        print(
            f"| {kind} | {share.min():.1f}, {share.max():.1f} | {share.mean():.1f} | "
            f"{100 * np.median(width):.1f} | {np.median(moved):.2f} |",
            flush=True,
        )
    return int(wrong)


if __name__ == "__main__":
    sys.exit(main())
