"""Measured spectra: 60 velocities on hundreds and thousands of rings, over the closed form.

    python tests/benchmarks/rings.py [--output DIR]

A Prony series of 20 terms, NayakSFactor, 81 kPa, 1e-6 to 10 m/s, rtol 1e-6; one thread, by turns,
medians, as ratios to the self-affine surface of Table 1 with the same rubber. Rings are those of a
scan: equal steps of q, C = q^-3.6 with a scatter that falls as more modes are averaged. `once` is
what the first call on a new table takes beyond the others: all that depends on the rows alone. The
error is the worst of 20 of the velocities, against GSL's CQUAD at 1e-11.
"""

from functools import partial
from typing import Any

import numpy as np
import timing

import asperity

RUNS = 21
ROWS = {"392 rings": (392, 8), "392 rings from one period on": (392, 1), "5000 rings": (5000, 8)}
VELOCITY = np.geomspace(1e-6, 10, 60)
RUBBER = asperity.PronySeries(
    equilibrium_modulus=2e6,
    moduli=3e6 * 10 ** np.linspace(0, 2.3, 20),
    relaxation_times=np.geomspace(1e2, 1e-10, 20),
)


def rings(rows: int, first: int) -> asperity.TabulatedSpectrum:
    k = np.arange(first, first + rows)
    scatter = np.exp(0.1 * np.random.default_rng(rows).standard_normal(rows) * np.sqrt(first / k))
    density = 1e-13 * (k / first) ** -3.6 * scatter
    return asperity.TabulatedSpectrum(wavenumber=2000 / first * k, density=density)


def curve(surface: Any, velocity: Any = VELOCITY, **options: Any) -> Any:
    options = {"pressure": 81e3, "correction": asperity.NayakSFactor(), "rtol": 1e-6, **options}
    return asperity.friction(surface, RUBBER, velocity=velocity, **options).mu


def error(surface: Any) -> float:
    few = VELOCITY[::3]
    truth = curve(surface, few, rtol=1e-11, method="cquad")
    return float(np.abs(curve(surface, few) / truth - 1).max())


def make() -> timing.Report:
    closed = asperity.SelfAffineSpectrum(rms_height=265.7e-6, hurst=0.87, q0=2000, q1=1e6)
    surfaces: dict[str, Any] = {"closed form": closed} | {
        name: rings(*shape) for name, shape in ROWS.items()
    }
    calls = {name: partial(curve, surface) for name, surface in surfaces.items()}
    first = {
        name: [timing.seconds(partial(curve, rings(*shape))) for _ in range(RUNS)]
        for name, shape in ROWS.items()
    }
    times = timing.by_turns(calls, RUNS)
    columns: dict[str, list[object]] = {
        "surface": list(times),
        "time_s": [timing.median(found) for found in times.values()],
        "ratio": [timing.ratio(found, times["closed form"]) for found in times.values()],
        "once_s": [
            timing.median(first[name]) - timing.median(found) if name in first else 0.0
            for name, found in times.items()
        ],
        "error": [error(surface) for surface in surfaces.values()],
    }
    header = ["surface", "a velocity [us]", "over the closed form", "once [ms]", "worst error"]
    rows = [
        [
            str(name),
            timing.number(1e6 * t / VELOCITY.size),
            timing.number(ratio),
            timing.number(1e3 * once),
            f"{worst:.1e}",
        ]
        for name, t, ratio, once, worst in zip(*columns.values(), strict=True)
    ]
    files = {"rings.csv": timing.table("benchmark rings", columns)}
    return timing.Report(timing.markdown(header, rows), files)


if __name__ == "__main__":
    timing.run(make, __doc__)
