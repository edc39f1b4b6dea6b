"""Friction by direction against exact sliding contacts of ridged maps.

It prints how far area, friction and the force across by the rule of PartialContact are from
`asperity.validation.slide`, and writes no table: python judge_direction.py 2 3.
"""

import sys

import numpy as np

import asperity
from asperity.validation import slide

SIDE, POINTS = 0.01, 256
RUBBER = asperity.PronySeries(equilibrium_modulus=1e6, moduli=[9e6], relaxation_times=[1e-3])


def exact(spectrum, seeds=(1, 2), **conditions):
    """Return area, friction and the force across in the mean of some maps."""
    found = []
    for seed in seeds:
        road = asperity.synthesize(
            spectrum, shape=(POINTS, POINTS), pixel_size=SIDE / POINTS, seed=seed
        )
        contact = slide(road, RUBBER, **conditions, periodic=True, rtol=1e-4)
        found.append((contact.contact_area, contact.hysteresis, contact.lateral))
    return np.mean(found, axis=0)


def main():
    """Print a line a contact, then the errors of each axis ratio."""
    for ratio in map(float, sys.argv[1:]):
        spectrum = asperity.SelfAffineSpectrum(
            rms_height=1e-4,
            hurst=0.8,
            q0=8 * np.pi / SIDE,
            q1=64 * np.pi / SIDE,
            axis_ratio=ratio,
            lay=np.pi / 2,
        )
        off = []
        for pressure in (2e4, 1.5e5):
            for velocity in (0.02, 1.0):
                for angle in (0, 30, 60, 90):
                    at = {
                        "pressure": pressure,
                        "velocity": velocity,
                        "direction": np.radians(angle),
                    }
                    area, mu, lateral = exact(spectrum, **at)
                    rule = asperity.friction(
                        spectrum, RUBBER, **at, correction=asperity.PartialContact(), rtol=1e-5
                    )
                    plain = asperity.friction(spectrum, RUBBER, **at, rtol=1e-5).mu
                    across = rule.lateral / rule.mu - lateral / mu
                    off.append((rule.contact_area / area - 1, rule.mu / mu - 1, across))
                    print(f"{ratio:g} {velocity:g} m/s {pressure:g} Pa {angle} deg:", end=" ")
                    print(f"A {area:.3f} mu {mu:.3f} across/along {lateral / mu:+.3f}", end=" ")
                    print(*(f"{one:+.3f}" for one in off[-1]), f"none {plain / mu - 1:+.2f}")
        print(ratio, "rms", np.sqrt(np.mean(np.square(off), axis=0)).round(3))


if __name__ == "__main__":
    main()
