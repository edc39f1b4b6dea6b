"""Angular integrals of tabulated moduli: preparation, evaluation and error against the rows.

    python tests/benchmarks/master_curve.py [--runs 7] [--points 100000] [--checked 40]

A rubber (Cole-Cole glass transition, a slow process) in 4 to 3000 rows over 15 decades. Prepare: a
new table, and what its first use at every frequency costs beyond the second. Evaluate: a frequency
of an array over the 15 decades, rising and shuffled; beside it the closed form of a Prony series of
20 terms. Medians, all in one process. Error: the worst of I1 and I2 at random frequencies, relative
to the definition by brute force (tests/python/helpers/by_definition.py).
"""

import argparse
import sys
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np

import asperity

sys.path.append(str(Path(__file__).parents[1] / "python"))
from helpers.by_definition import Definition

LOW, HIGH = 1e-5, 1e10
ROWS = (4, 10, 30, 100, 300, 1000, 3000)


def table(rows: int) -> dict[str, Any]:
    """The arguments of a master curve."""
    w = np.geomspace(LOW, HIGH, rows)
    modulus = 3e6 + 2e9 / (1 + (1e-7j * w) ** -0.45) + 5e6 / (1 + (1e-2j * w) ** -0.3)
    return {"angular_frequency": w, "storage_modulus": modulus.real, "loss_modulus": modulus.imag}


def timed(function: Callable[[], object]) -> float:
    """Seconds."""
    start = time.perf_counter()
    function()
    return time.perf_counter() - start


def preparation(columns: dict[str, Any], everywhere: Any) -> float:
    """Seconds."""
    start = time.perf_counter()
    curve = asperity.MasterCurve(**columns)
    curve.angular_integrals(everywhere)
    first = time.perf_counter() - start
    return first - timed(lambda: curve.angular_integrals(everywhere))


def worst_error(columns: dict[str, Any], checked: int) -> float:
    """Of I1 and I2, relative."""
    at = np.exp(np.random.default_rng(0).uniform(np.log(LOW), np.log(HIGH), checked))
    definition = Definition(**columns)
    expected = np.array([definition(w)[:2] for w in at]).T
    found = asperity.MasterCurve(**columns).angular_integrals(at)
    return float(np.abs(found / expected - 1).max())


def main() -> None:
    """Print the table."""
    parser = argparse.ArgumentParser()
    parser.add_argument("--runs", type=int, default=7)
    parser.add_argument("--points", type=int, default=100_000)
    parser.add_argument("--checked", type=int, default=40)
    args = parser.parse_args()
    rising = np.geomspace(LOW, HIGH, args.points)[1:-1]
    shuffled = np.random.default_rng(0).permutation(rising)
    series = asperity.PronySeries(
        equilibrium_modulus=3e6, moduli=[1e8] * 20, relaxation_times=np.geomspace(1e-9, 1e2, 20)
    )
    print("| rows | prepare, ms | us a row | evaluate, ns, rising | shuffled | Prony, 20 | error |")
    print("| --- | --- | --- | --- | --- | --- | --- |")
    prepared = []
    for rows in ROWS:
        columns = table(rows)
        prepare = float(np.median([preparation(columns, rising) for _ in range(args.runs)]))
        prepared.append(prepare)
        curve = asperity.MasterCurve(**columns)
        curve.angular_integrals(rising)
        times = [
            [timed(lambda r=r, w=w: r.angular_integrals(w)) for r, w in pairs]
            for pairs in [[(curve, rising), (curve, shuffled), (series, rising)]] * args.runs
        ]
        each = 1e9 * np.median(times, axis=0) / rising.size
        cells = [
            f"{1e3 * prepare:.1f}",
            f"{1e6 * prepare / rows:.0f}",
            *(f"{ns:.0f}" for ns in each),
        ]
        print(f"| {rows} | {' | '.join(cells)} | {worst_error(columns, args.checked):.0e} |")
    growth = np.log10(prepared[-1] / prepared[ROWS.index(300)])
    print(f"\nFrom 300 to 3000 rows preparation grows as rows^{growth:.1f}: 1 is linear.")


if __name__ == "__main__":
    main()
