"""How often the 95 % interval of H of a self-affine fit holds the truth, by roll-off and window.

    python tests/stability/fit_coverage.py [GENERATOR...] [--crops 400] [--points 256] [--seed 1]

A map four times as long as a scan has H from 0.5 to 0.95 and a roll-off at some periods a scan (0:
none); nine crops of it that hardly touch are scans. Maps are those of `synthesize` (densities
exact, phases random), white noise that is filtered (moduli random too), the latter worn (heights
above 0.5 rms are pressed to a third: not Gaussian), or with a gradual knee, a density
~ (1 + (q / q_r)^4)^(-(1 + H) / 2), which no fit with a sharp one is made for. Printed as a table:
the share of the intervals hurst +- 1.96 standard errors that hold H, the mean error, its rms, the
median standard error, and the shares of fits with a roll-off and of scans without a fit. Exit
status 1 where a share of the first two is outside of 90 to 98 %.
"""

import sys
from collections.abc import Callable
from typing import Any

import numpy as np
from options import options

import asperity

PERIODS = (0, 10, 14, 18, 22, 30)
WINDOWS = ("split-cosine-bell", "hann", "blackman")
TIMES = 4  # as long as a scan is a map


def synthesized(hurst: float, knee: float, side: int, rng: Any) -> Any:
    dq = 2 * np.pi / side
    law = asperity.SelfAffineSpectrum(
        rms_height=1, hurst=hurst, q0=dq, q1=np.pi * 0.999, rolloff=dq * knee if knee else None
    )
    seed = int(rng.integers(2**32))
    return asperity.synthesize(law, shape=(side, side), pixel_size=1, seed=seed).heights


def filtered(hurst: float, knee: float, side: int, rng: Any, *, gradual: bool = False) -> Any:
    k = np.fft.fftfreq(side) * side
    k = np.hypot(k[:, None], k[: side // 2 + 1])
    k = (k**4 + knee**4) ** 0.25 if gradual and knee else np.maximum(k, max(knee, 1))
    noise = np.fft.rfft2(rng.standard_normal((side, side)))
    return np.fft.irfft2(noise * np.maximum(k, 1) ** -(1 + hurst), s=(side, side))


def worn(hurst: float, knee: float, side: int, rng: Any) -> Any:
    z = filtered(hurst, knee, side, rng)
    top = 0.5 * z.std()
    return np.where(z > top, top + (z - top) / 3, z)


def gradual(hurst: float, knee: float, side: int, rng: Any) -> Any:
    return filtered(hurst, knee, side, rng, gradual=True)


GENERATORS: dict[str, Callable[[float, float, int, Any], Any]] = {
    "synthesized": synthesized,
    "filtered": filtered,
    "worn": worn,
    "gradual": gradual,
}


def scans(generator: str, periods: int, points: int, count: int, seed: int) -> Any:
    """H and the scan, `count` times."""
    side = TIMES * points
    for number in range(-(-count // 9)):
        rng = np.random.default_rng([seed, periods, points, number])
        hurst = rng.uniform(0.5, 0.95)
        z = GENERATORS[generator](hurst, TIMES * periods, side, rng)
        for place in range(min(9, count - 9 * number)):
            y, x = (side // 3 * k for k in divmod(place, 3))
            crop = np.ascontiguousarray(z[y : y + points, x : x + points])
            yield hurst, asperity.HeightMap(heights=crop, pixel_size=1)


def fitted(scan: Any, window: Any, **band: float) -> tuple[float, float, bool]:
    """H, its standard error, and whether there is a roll-off; NaN where there is no fit."""
    try:
        fit = asperity.fit_self_affine(asperity.power_spectrum(scan, window=window), **band)
    except asperity.InvalidInput:
        return np.nan, np.nan, False
    return fit.hurst, fit.standard_errors["hurst"], fit.rolloff is not None


def main() -> int:
    asked = options(__doc__, GENERATORS, crops=400, points=256, seed=1)
    print("| map | window | periods | holds [%] | mean error | rms | stated | roll-off | no fit |")
    print("| --- | --- | --- | --- | --- | --- | --- | --- | --- |")
    wrong = False
    for generator in asked.kinds:
        for periods in PERIODS:
            result: dict[str, list[Any]] = {window: [] for window in WINDOWS}
            for hurst, scan in scans(generator, periods, asked.points, asked.crops, asked.seed):
                for window in WINDOWS:
                    result[window].append((hurst, *fitted(scan, window)))
            for window in WINDOWS:
                truth, hurst, error, rolled = np.array(result[window]).T
                known = np.isfinite(hurst)
                off = (hurst - truth)[known]
                share = float(np.mean(np.abs(off) < 1.96 * error[known]))
                wrong |= generator in ("synthesized", "filtered") and not 0.9 <= share <= 0.98
                print(
                    f"| {generator} | {window} | {periods} | {100 * share:.1f} | {off.mean():.3f} "
                    f"| {np.sqrt(np.mean(off**2)):.3f} | {np.median(error[known]):.3f} "
                    f"| {rolled.mean():.2f} | {1 - known.mean():.2f} |",
                    flush=True,
                )
    return int(wrong)


if __name__ == "__main__":
    sys.exit(main())
