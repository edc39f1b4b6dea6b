"""Standard errors of self-affine fits over their scatter, under each window.

    python tests/stability/standard_errors.py [WINDOW...] [--trials 800] [--seed 1]

Each trial draws H from 0.4 to 0.95, a crop of 96 to 288 points a side, square or not, of a map
twice as long, which does not repeat; every second crop is a mirror image, every fourth has 2 % of
drop-outs that are filled. Printed: the stated error over the scatter of (fit - truth) / stated, the
mean taken out, of H and of the rms height, and that mean. Exit status 1 where a ratio is outside of
0.93 to 1.07.
"""

import sys
from typing import Any

import numpy as np
from options import options

import asperity

WINDOWS = ("split-cosine-bell", "hann", "blackman")
PIXEL = 1e-6


def trial(seed: int, number: int, window: Any) -> tuple[float, float]:
    """(fit - truth) / stated error of H and of the logarithm of the rms height."""
    rng = np.random.default_rng([seed, number])
    ny, nx = rng.integers(96, 289, 2)
    if rng.random() < 0.5:
        ny = nx
    law = asperity.SelfAffineSpectrum(
        rms_height=1e-6,
        hurst=rng.uniform(0.4, 0.95),
        q0=2 * np.pi / (2 * max(nx, ny) * PIXEL),
        q1=np.pi / PIXEL * 0.999,
    )
    start = int(rng.integers(2**32))
    shape = (2 * int(ny), 2 * int(nx))
    whole = asperity.synthesize(law, shape=shape, pixel_size=PIXEL, seed=start)
    heights = np.asarray(whole.heights)[:ny, :nx].copy()
    if rng.random() < 0.5:
        heights = heights[:, ::-1]
    if rng.random() < 0.25:
        heights[rng.random(heights.shape) < 0.02] = np.nan
    surface = asperity.HeightMap(heights=heights, pixel_size=PIXEL).fill_dropouts()
    fit = asperity.fit_self_affine(asperity.power_spectrum(surface, window=window), rolloff="none")
    true = law.truncated(q0=fit.q0, q1=fit.q1).rms_height
    stated = fit.standard_errors
    return (
        (fit.hurst - law.hurst) / stated["hurst"],
        np.log(fit.rms_height / true) * fit.rms_height / stated["rms_height"],
    )


def main() -> int:
    asked = options(__doc__, WINDOWS, trials=800, seed=1)
    print("| window | stated / scatter of H | of h_rms | mean of H [errors] | of h_rms |")
    print("| --- | --- | --- | --- | --- |")
    wrong = False
    for window in asked.kinds:
        off = np.array([trial(asked.seed, k, window) for k in range(asked.trials)])
        ratio, mean = 1 / off.std(axis=0), off.mean(axis=0)
        wrong |= bool(((ratio < 0.93) | (ratio > 1.07)).any())
        cells = " | ".join(f"{number:.2f}" for number in (*ratio, *mean))
        print(f"| {window} | {cells} |", flush=True)
    return int(wrong)


if __name__ == "__main__":
    sys.exit(main())
