"""Time of a spectrum by tiles over that of the whole map, and its memory past memory (Linux).

    python tests/benchmarks/tiles.py [--output DIR]

Seconds of the processor in one process, by turns, the map in memory in single precision. Memory:
the spectrum of a .npy file of 32768 x 32768 heights (4 GiB, made here and removed), with two
threads, in a process of its own; the peak of its resident memory, the interpreter's included.
"""

import tempfile
from pathlib import Path

import numpy as np
import peaks
import timing

import asperity

SIDE, TILES, OVERLAPS = 8192, (1024, 2048, 4096), (0.0, 0.5)
LARGE, LARGE_TILE, RUNS = 32768, 4096, 7
CHILD = """
import sys, time
import numpy as np
import asperity

heights = np.load(sys.argv[1], mmap_mode="r")
start = time.process_time()
spectrum = asperity.power_spectrum(
    heights, pixel_size=1e-6, tiles=int(sys.argv[2]), overlap=float(sys.argv[3]), threads=2
)
seconds = time.process_time() - start
print(seconds, kilobytes("VmHWM") / 2**20)
"""


def heights(side: int, hurst: float, seed: int) -> np.ndarray:
    """A periodic self-affine map in single precision, by NumPy."""
    rng = np.random.default_rng(seed)
    modes = np.fft.rfft2(rng.standard_normal((side, side), dtype=np.float32))
    k = np.hypot(np.fft.fftfreq(side, 1 / side)[:, None], np.arange(side // 2 + 1))
    modes *= np.maximum(k, 1).astype(np.float32) ** -(1 + hurst)
    return np.fft.irfft2(modes, s=(side, side)).astype(np.float32) * 1e-3


def ratios() -> list[dict[str, float]]:
    """Time of each tile and overlap over that of the whole map: of its spectrum alone, and with the
    map made of the array, which tiles are taken from as it is."""
    z = heights(SIDE, 0.8, 1)
    scan = asperity.HeightMap(z, pixel_size=1e-6)
    calls = {
        "spectrum": lambda: asperity.power_spectrum(scan),
        "array": lambda: asperity.power_spectrum(asperity.HeightMap(z, pixel_size=1e-6)),
    }
    for tile in TILES:
        for overlap in OVERLAPS:
            calls[f"{tile} {overlap}"] = lambda tile=tile, overlap=overlap: asperity.power_spectrum(
                z, pixel_size=1e-6, tiles=tile, overlap=overlap
            )
    times: dict[str, list[float]] = {name: [] for name in calls}
    for _ in range(RUNS):
        for name, call in calls.items():
            times[name].append(timing.seconds(call))
    return [
        {"tile": tile, "overlap": overlap}
        | {
            f"over_{whole}": 1 / timing.ratio(times[whole], times[f"{tile} {overlap}"])
            for whole in ("spectrum", "array")
        }
        for tile in TILES
        for overlap in OVERLAPS
    ]


def write_large(path: Path) -> None:
    """A map made of one of 2048 points a side, turned over and tilted differently, row by row."""
    small = heights(2048, 0.8, 2)
    file = np.lib.format.open_memmap(path, "w+", np.float32, (LARGE, LARGE))
    times = LARGE // len(small)
    for y in range(times):
        for x in range(times):
            part = np.roll(small, (97 * y, 331 * x), (0, 1))[:: 1 - 2 * (y % 2)]
            box = slice(2048 * y, 2048 * (y + 1)), slice(2048 * x, 2048 * (x + 1))
            file[box] = part
        file.flush()


def memory() -> list[dict[str, float]]:
    """Peak memory and time of the large map."""
    result = []
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder, "large.npy")
        write_large(path)
        for overlap in OVERLAPS:
            seconds, peak = peaks.printed(CHILD, str(path), str(LARGE_TILE), str(overlap))
            result.append({"overlap": overlap, "seconds": seconds, "peak_gib": peak})
    return result


def make() -> timing.Report:
    speed, large = ratios(), memory()
    text = timing.markdown(
        ["tile", "overlap", "time / spectrum of the whole map", "the map made of the array too"],
        [
            [f"{row['tile']:.0f}", f"{row['overlap']:g}"]
            + [f"{row[f'over_{whole}']:.2f}" for whole in ("spectrum", "array")]
            for row in speed
        ],
    )
    text += "\n" + timing.markdown(
        ["32768 x 32768, tiles of 4096, overlap", "peak memory [GiB]", "processor [s]"],
        [[f"{r['overlap']:g}", f"{r['peak_gib']:.2f}", f"{r['seconds']:.0f}"] for r in large],
    )
    columns = {name: [row[name] for row in speed] for name in speed[0]}
    past = {name: [row[name] for row in large] for name in large[0]}
    files = {
        "tiles.csv": timing.table("benchmark tiles", columns, side=SIDE),
        "tiles_memory.csv": timing.table("benchmark tiles", past, side=LARGE, tile=LARGE_TILE),
    }
    return timing.Report(text, files)


if __name__ == "__main__":
    timing.run(make, __doc__)
