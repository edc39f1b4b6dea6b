"""Drop-outs: error and time of ours, of rows alone, of Delaunay triangles, in one process.

    python tests/benchmarks/dropouts.py [--side 1024] [--seeds 3] [--runs 7]

Holes are cut into synthetic self-affine maps (H = 0.8, `q0` in units of 2 pi over the side) and
measured ones, and filled. Error: rms over the points filled, over the map's rms height. Time: over
that of `detrend("plane")`, one thread, runs alternating, median of the ratios; triangles are timed
once. They are built of the points within two pixels of a hole, not of all: that favours them.
"""

import argparse
import time
from collections.abc import Callable, Iterator
from pathlib import Path

import numpy as np
from scipy.interpolate import LinearNDInterpolator, NearestNDInterpolator
from scipy.ndimage import binary_dilation

import asperity

MEASURED = Path(__file__).parents[3] / "shared/data/topography"
SCANS = ("opd-1.opd", "al3d-1.al3d")
PIXEL = 1e-6


def holes(pattern: str, shape: tuple[int, int], rng: np.random.Generator) -> np.ndarray:
    """True at a tenth of the points, at most."""
    missing = np.zeros(shape, bool)
    count, (ny, nx) = missing.size // 10, shape
    side = int(np.sqrt(count))
    left = (nx - side) // 2
    if pattern == "random":
        missing.flat[rng.choice(missing.size, count, replace=False)] = True
    elif pattern == "square":
        missing[(ny - side) // 2 :, left : left + side][:side] = True
    elif pattern == "edge":
        missing[:side, left : left + side] = True
    else:  # discs
        y, x = np.ogrid[:ny, :nx]
        while missing.sum() < 0.98 * count:
            radius, cy, cx = rng.uniform((1, 0, 0), (12, ny, nx))
            disc = (y - cy) ** 2 + (x - cx) ** 2 < radius**2
            if (missing | disc).sum() <= count:
                missing |= disc
    return missing


def along_rows(z: np.ndarray) -> np.ndarray:
    """Linear in each row, nearest beyond its ends."""
    filled, x = z.copy(), np.arange(z.shape[1])
    for row in filled:
        gap = np.isnan(row)
        row[gap] = np.interp(x[gap], x[~gap], row[~gap])
    return filled


def on_triangles(z: np.ndarray) -> np.ndarray:
    """Linear on Delaunay's triangles, nearest outside of them."""
    filled, missing = z.copy(), np.isnan(z)
    around = binary_dilation(missing, np.ones((3, 3)), iterations=2) & ~missing
    points = np.argwhere(around)
    filled[missing] = LinearNDInterpolator(points, z[around])(np.argwhere(missing))
    rest = np.isnan(filled)
    if rest.any():
        filled[rest] = NearestNDInterpolator(points, z[around])(np.argwhere(rest))
    return filled


def maps(side: int, seeds: int) -> Iterator[tuple[str, asperity.HeightMap, np.ndarray]]:
    """Name, complete map, and where its heights are the truth."""
    for q0 in (4, 16, 64):
        for seed in range(seeds):
            spectrum = asperity.SelfAffineSpectrum(
                rms_height=1e-6, hurst=0.8, q0=2 * np.pi * q0 / (side * PIXEL), q1=np.pi / PIXEL
            )
            surface = asperity.synthesize(
                spectrum, shape=(side, side), pixel_size=PIXEL, seed=seed + 1
            )
            yield f"q0 = {q0}", surface, np.ones((side, side), bool)
    for name in SCANS:
        if not (MEASURED / name).exists():
            print(f"{name}: skipped, there is no {MEASURED / name}")
            continue
        scan = asperity.read_surface(MEASURED / name)
        yield name, scan.fill_dropouts().detrend("plane"), ~np.isnan(scan.heights)


def seconds(run: Callable[[], object]) -> float:
    start = time.perf_counter()
    run()
    return time.perf_counter() - start


def measure(
    surface: asperity.HeightMap, true: np.ndarray, missing: np.ndarray, runs: int
) -> list[float]:
    """Errors of ours, rows, triangles; then their times over the detrend's."""
    z = np.where(missing, np.nan, surface.heights)
    given = asperity.HeightMap(z, pixel_size=surface.pixel_size)
    methods: list[tuple[int, Callable[[], np.ndarray]]] = [
        (runs, lambda: given.fill_dropouts().heights),
        (runs, lambda: along_rows(z)),
        (1, lambda: on_triangles(z)),
    ]
    scored = missing & true
    errors = [(fill() - surface.heights)[scored] for _, fill in methods]
    ratios: list[list[float]] = [[] for _ in methods]
    for i in range(runs):
        for (most, fill), found in zip(methods, ratios, strict=True):
            if i < most:
                yardstick = seconds(lambda: surface.detrend("plane"))
                found.append(seconds(fill) / yardstick)
    shares = [float(np.sqrt(np.mean(error**2))) / surface.rms_height for error in errors]
    return shares + [float(np.median(found)) for found in ratios]


if __name__ == "__main__":
    parser = argparse.ArgumentParser()
    parser.add_argument("--side", type=int, default=1024)
    parser.add_argument("--seeds", type=int, default=3)
    parser.add_argument("--runs", type=int, default=7)
    arguments = parser.parse_args()
    rows: dict[tuple[str, str], list[list[float]]] = {}
    for name, surface, true in maps(arguments.side, arguments.seeds):
        for pattern in ("random", "square", "edge", "discs"):
            missing = holes(pattern, true.shape, np.random.default_rng(1))
            result = measure(surface, true, missing, arguments.runs)
            rows.setdefault((name, pattern), []).append(result)
    print(f"{'':20}{'rms error / rms height':^30}{'time / plane detrend':^30}")
    print(f"{'map':12}{'holes':8}" + 2 * f"{'ours':>10}{'rows':>10}{'triangles':>10}")
    for (name, pattern), results in rows.items():
        numbers = np.mean(results, axis=0)
        print(f"{name:12}{pattern:8}", *(f"{n:9.4f}" for n in numbers[:3]), end=" ")
        print(*(f"{n:9.1f}" for n in numbers[3:]))
