"""Corrections on maps that no fit has seen: Hurst exponents and bandwidths beyond the shipped rows.

Ten random-phase maps of 512 x 512 points, H 0.3, 0.5 and 0.9, pressed by boundary elements at
p / (E* h') = 0.02, 0.1 and 0.3. Takes some minutes:

    python tests/benchmarks/held_out.py
"""

import dataclasses
import math

import numpy as np

import asperity
from asperity.validation.own import own_contacts
from asperity.validation.predictions import MODELS, predict

POINTS = 512
MAPS = [(0.5, 6, 8), (0.9, 6, 8), (0.5, 16, 4), (0.9, 16, 4), (0.3, 12, 4)]  # H, q1/q0, waves
LOADS = [0.02, 0.1, 0.3]
SEEDS = (101, 102)
SHOWN = [model for model in MODELS if not model.asperities]


def contacts(hurst, band, waves, seed):
    """The contacts of one map, with the continuous spectrum it was made from at its slope."""
    q0 = 2 * math.pi * waves
    spectrum = asperity.SelfAffineSpectrum(rms_height=0.01, hurst=hurst, q0=q0, q1=band * q0)
    surface = asperity.synthesize(
        spectrum, shape=(POINTS, POINTS), pixel_size=1 / POINTS, seed=seed
    )
    found, _ = own_contacts(surface, f"H {hurst} q1/q0 {band}", loads=LOADS, periodic=True)
    return [
        dataclasses.replace(
            contact,
            spectrum=spectrum.scaled((contact.spectrum.rms_slope / spectrum.rms_slope) ** 2),
        )
        for contact in found
    ]


def main():
    found = [c for case in MAPS for seed in SEEDS for c in contacts(*case, seed)]
    print(f"{len(found)} contacts; area: mean, worst; elastic energy: mean, worst [%]")
    for model in SHOWN:
        predictions = [predict(contact, model) for contact in found]
        cells = []
        for quantity in ("area", "energy"):
            error = 100 * np.array([p.error(quantity) for p in predictions])
            cells += [f"{np.abs(error).mean():6.1f}", f"{error[np.abs(error).argmax()]:+7.1f}"]
        print(f"{model.name:20s}", *cells)


if __name__ == "__main__":
    main()
