"""How far one scan of a surface is from others, and whether model_error and bands say so.

    python tests/benchmarks/scan_scatter.py

Sixteen scans of 256 x 256 points are cut from a map of 1024 x 1024 of each kind of heights of
scan_contact.py, four of its longest waves to a side. Truth for a scan is the mean of what the
others have. Prints Markdown.
"""

import numpy as np
import scan_contact as maps

import asperity

SIDE, SCANS, PIXEL = 256, 4, 0.01 / 256
VELOCITIES, PRESSURES = np.array([1e-3, 3e-1]), (3.7e4, 6.1e5)
LEVEL = 0.95
Array = np.ndarray


def scans(kind: str, seed: int) -> list[asperity.HeightMap]:
    n = SIDE * SCANS
    maps.POINTS, maps.LONGEST, maps.SHORTEST = n, 4 * SCANS, 32 * SCANS
    maps.LENGTH = n * PIXEL
    heights = maps.height_map(kind, seed).heights
    starts = range(0, n, SIDE)
    return [
        asperity.HeightMap(heights[y : y + SIDE, x : x + SIDE], pixel_size=PIXEL)
        for y in starts
        for x in starts
    ]


def judged(surfaces: list[asperity.HeightMap], rubber: asperity.PronySeries) -> list[Array]:
    """(mu, model_error, lower, upper) of each scan, of shape (scans, points), a row each."""
    q0, q1 = 2 * np.pi * np.array([maps.LONGEST, maps.SHORTEST]) / maps.LENGTH
    pressure, velocity = (a.ravel() for a in np.meshgrid(PRESSURES, VELOCITIES))
    rows = []
    for surface in surfaces:
        spectrum = asperity.power_spectrum(surface, window="none").truncated(q0=q0, q1=q1)
        exact = asperity.ScanContact(surface)
        scene = {"pressure": pressure, "velocity": velocity, "correction": exact}
        found = asperity.friction(spectrum, rubber, **scene)
        band = asperity.friction_band(spectrum, rubber, level=LEVEL, **scene)
        rows.append([found.mu, found.model_error, band.lower, band.upper])
    return list(np.array(rows).transpose(1, 0, 2))


def main() -> None:
    print(
        "| heights | scans differ in mu by [%] | `model_error` [%] | within 1 | within 2 "
        "| bands that hold it [%] | width [%] |\n| --- |" + " --- |" * 6
    )
    everything = []
    for kind in maps.KINDS:
        surfaces = scans(kind, 70 + len(kind))
        found = [judged(surfaces, maps.RUBBERS[name]) for name in ("1 term, 30", "8 terms, 300")]
        mu, stated, lower, upper = np.concatenate(found, axis=2)
        others = (mu.sum(axis=0) - mu) / (len(mu) - 1)
        off = np.abs(np.log(mu / others)) / stated
        held = (lower <= others) & (others <= upper)
        everything.append([off, held])
        scatter = 100 * np.log(mu).std(axis=0, ddof=1)
        print(
            f"| {kind} | {scatter.min():.1f} to {scatter.max():.1f} "
            f"| {100 * np.median(stated):.1f} | {np.mean(off < 1):.2f} | {np.mean(off < 2):.2f} "
            f"| {100 * held.mean():.0f} | {100 * np.median((upper - lower) / mu):.0f} |",
            flush=True,
        )
    off, held = np.array(everything).swapaxes(0, 1)
    print(
        f"| all | | | {np.mean(off < 1):.2f} | {np.mean(off < 2):.2f} | {100 * held.mean():.0f} | |"
    )


if __name__ == "__main__":
    main()
