"""What a curve and a map of friction with ScanContact cost, on grids of 512 x 512 points.

    python tests/benchmarks/scan_cost.py [--maps]

Twenty curves over six decades of velocity, of four kinds of heights and 1 to 20 relaxation times;
with --maps three maps, over two decades of pressure too, against `friction`. Seconds of the
processor, on one thread, nothing solved before.
"""

import sys
from functools import partial
from itertools import product

import numpy as np
import scan_contact as maps
from timing import on_one_thread, timed

import asperity

maps.POINTS, maps.SHORTEST = 512, 64
CURVE_KINDS = ("Gaussian", "worn", "peaks", "honed plateaus")
TERMS = ((1, 100), (3, 30), (8, 300), (12, 100), (20, 1000))  # and E0 / E_inf
MAPS = (("worn", "8 terms, 300"), ("Gaussian", "1 term, 30"), ("peaks", "20 terms, 1000"))
VELOCITIES, PRESSURES = (1e-5, 10.0), (2e4, 2e6)


def prepared(kind: str, seed: int) -> tuple[asperity.TabulatedSpectrum, asperity.ScanContact]:
    surface = maps.height_map(kind, seed)
    return maps.rings(surface), asperity.ScanContact(surface, periodic=True)


def curves() -> None:
    print("| heights | terms | seconds | contacts | of the whole scan |\n| --- |" + " --- |" * 4)
    spent = []
    for seed, (kind, (terms, ratio)) in enumerate(product(CURVE_KINDS, TERMS), start=100):
        longest = 1e-4 if terms == 1 else 10 ** (-3 + terms / 5)
        shortest = 1e-4 if terms == 1 else 10 ** -(3 + terms / 4)
        rubber = maps.series(ratio, terms, shortest, longest)
        spectrum, scan = prepared(kind, seed)
        velocity = np.geomspace(*VELOCITIES, 25)
        scene = {"pressure": 2e5, "velocity": velocity, "correction": scan}
        seconds, _ = timed(partial(asperity.friction, spectrum, rubber, **scene))
        rows = scan.contacts.to_dataframe()
        whole = int(((rows.part == -1) & (rows.coarse == 0)).sum())
        spent.append(seconds)
        print(f"| {kind} | {terms} | {seconds:.1f} | {len(rows)} | {whole} |", flush=True)
    print(f"\nmedian {np.median(spent):.1f} s, {min(spent):.1f} to {max(spent):.1f}")


def whole_maps() -> None:
    print("| heights, rubber | seconds | contacts | rtol | off `friction` | look-up [ns] |")
    print("| --- |" + " --- |" * 5)
    rng = np.random.default_rng(3)
    for kind, name in MAPS:
        rubber, (spectrum, scan) = maps.RUBBERS[name], prepared(kind, 100)
        scene = {"pressure": PRESSURES, "velocity": VELOCITIES, "correction": scan}
        seconds, fmap = timed(
            partial(asperity.friction_map, spectrum, rubber, rtol=1e-2, checked=1000, **scene)
        )
        p = PRESSURES[0] * (PRESSURES[1] / PRESSURES[0]) ** rng.random(100_000)
        v = VELOCITIES[0] * (VELOCITIES[1] / VELOCITIES[0]) ** rng.random(100_000)
        few = {"pressure": p[:3000], "velocity": v[:3000], "correction": scan}
        found = asperity.friction(spectrum, rubber, **few)
        off = np.abs(fmap.mu(p[:3000], v[:3000]) / found.mu - 1).max()
        look_up = min(timed(partial(fmap.mu, p, v))[0] for _ in range(7)) / p.size
        print(
            f"| {kind}, {name} | {seconds:.0f} | {len(scan.contacts)} | 0.01 | {off:.4f} "
            f"| {1e9 * look_up:.1f} |",
            flush=True,
        )


if __name__ == "__main__":
    on_one_thread()
    whole_maps() if "--maps" in sys.argv else curves()
