"""Linear bands on mu beside drawn ones, of the trials of band_coverage.py.

    python tests/stability/linear_bands.py [KIND...] [--trials 100] [--seed 1] [--samples 100]

Printed as a table: the share of bands that hold the true mu, of draws and of slopes, the median
width of linear bands over that of draws, the share of points where a note says that slopes are not
good enough, and how many times as fast linear bands are, in processor time, taken in turns.
"""

import sys
import time
from typing import Any

import band_coverage
import coverage_isotherms
import numpy as np
from coverage_isotherms import SCENE
from options import options

import asperity


def compared(spectrum: Any, rubber: Any, truth: Any, number: int, samples: int) -> Any:
    """Of draws and of slopes whether they hold the truth; widths, whether noted, and seconds."""
    held, width, seconds, noted = [], [], [], False
    for how in ({"samples": samples, "seed": number}, {"method": "linear"}):
        begun = time.process_time()
        band = asperity.friction_band(spectrum, rubber, **SCENE, **how)
        seconds.append(time.process_time() - begun)
        held.append((band.lower <= truth) & (truth <= band.upper))
        width.append(np.log(band.upper / band.lower))
        noted = any(note.code == "linear-band-off" for note in band.notes)
    return held, width, seconds, noted


def main() -> int:
    asked = options(__doc__, band_coverage.KINDS, trials=100, seed=1, samples=100)
    band_coverage.compare = coverage_isotherms.compare = compared
    print("| input | held by draws [%] | by slopes [%] | width over width | noted [%] | times |")
    print("| --- | --- | --- | --- | --- | --- |")
    for kind in asked.kinds:
        trial = band_coverage.KINDS[kind]
        result = [trial(asked.seed, k, asked.samples) for k in range(asked.trials)]
        held, width, seconds, noted = (np.array(column) for column in zip(*result, strict=True))
        of_draws, of_slopes = 100 * held.mean(axis=(0, 2))
        low, middle, high = np.quantile(width[:, 1] / width[:, 0], [0.05, 0.5, 0.95])
        print(
            f"| {kind} | {of_draws:.1f} | {of_slopes:.1f} | {middle:.2f} ({low:.2f} to {high:.2f}) "
            f"| {100 * noted.mean():.0f} | {np.median(seconds[:, 0] / seconds[:, 1]):.0f} |",
            flush=True,
        )
    return 0


if __name__ == "__main__":
    sys.exit(main())
