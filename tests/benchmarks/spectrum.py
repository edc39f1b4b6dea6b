"""Time and memory of a map's spectrum: ours, bare FFTW, NumPy, SurfaceTopography, in one process.

    python tests/benchmarks/spectrum.py [--output DIR]

The yardstick is one out-of-place two-dimensional r2c transform by FFTW (FFTW_ESTIMATE, one thread,
planned and its memory touched beforehand): the least that anyone needs. Ours is the whole way from
the heights: plane, split cosine bell, transform, rings. All runs alternate; medians of ratios, by
the clock on the wall, as two threads spend the processor's time twice.
"""

import ctypes
import ctypes.util
import sys
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import peaks
import timing

import asperity
from asperity.draw.figure import new_figure, picture
from asperity.draw.style import COLOURS

SIDES = (1000, 1024, 2048, 4096, 8192)
RUNS = 9
SLOW = 4096  # NumPy and SurfaceTopography are timed up to here: the rest would be waiting
METHODS = ("ours", "ours, 2 threads", "numpy", "SurfaceTopography")


class BareFftw:
    """One planned r2c transform of a map of doubles or floats."""

    ESTIMATE = 1 << 6

    def __init__(self, heights: np.ndarray) -> None:
        name, letter = ("fftw3", "") if heights.dtype == np.float64 else ("fftw3f", "f")
        found = ctypes.util.find_library(name)
        if found is None:
            raise SystemExit(f"the yardstick needs lib{name} (Debian: libfftw3-dev)")
        library = ctypes.CDLL(found)
        plan = getattr(library, f"fftw{letter}_plan_dft_r2c_2d")
        plan.restype = ctypes.c_void_p
        plan.argtypes = [ctypes.c_int] * 2 + [ctypes.c_void_p] * 2 + [ctypes.c_uint]
        self._execute = getattr(library, f"fftw{letter}_execute")
        self._execute.argtypes = [ctypes.c_void_p]
        ny, nx = heights.shape
        self._in = aligned(heights.shape, heights.dtype)
        self._in[:] = heights
        complex_type = np.result_type(heights.dtype, np.complex64)
        self.out = aligned((ny, nx // 2 + 1), complex_type)
        self._plan = plan(ny, nx, self._in.ctypes.data, self.out.ctypes.data, self.ESTIMATE)

    def __call__(self) -> None:
        self._execute(self._plan)


def aligned(shape: tuple[int, ...], dtype: Any) -> np.ndarray:
    """Zeros that begin at a multiple of 64 bytes, as FFTW's own memory does."""
    size = int(np.prod(shape)) * np.dtype(dtype).itemsize
    raw = np.zeros(size + 64, np.uint8)
    start = -raw.ctypes.data % 64
    return raw[start : start + size].view(dtype).reshape(shape)


def numpy_spectrum(z: np.ndarray, pixel: float) -> np.ndarray:
    """The same result as a careful user of NumPy would write it (square maps and pixels)."""
    n = z.shape[0]
    u = np.linspace(-1, 1, n)
    spread = n * np.sum(u * u)
    tilt_x, tilt_y = np.sum(z @ u) / spread, np.sum(u @ z) / spread
    flat = z - z.mean() - tilt_x * u - tilt_y * u[:, None]
    x = np.arange(n) / n
    w = np.where((x < 0.1) | (x > 0.9), np.sin(5 * np.pi * x) ** 2, 1.0)
    power = np.abs(np.fft.rfft2(flat * w * w[:, None])) ** 2
    k = np.hypot(np.fft.fftfreq(n, 1 / n)[:, None], np.arange(n // 2 + 1))
    ring = np.floor(k + 0.5).astype(int).ravel()
    twice = np.full(power.shape, 2.0)
    twice[:, 0] = 1
    if n % 2 == 0:
        twice[:, -1] = 1
    count = np.bincount(ring, twice.ravel())
    scale = (n * pixel) ** 2 / (4 * np.pi**2 * n**4) / np.mean(w * w) ** 2
    return (scale * np.bincount(ring, (twice * power).ravel()) / count)[1:]


def surface_topography(z: np.ndarray, pixel: float) -> Callable[[], object] | None:
    """SurfaceTopography's detrended, windowed radial spectrum, where it is installed."""
    try:
        from SurfaceTopography import Topography
    except ModuleNotFoundError:
        return None
    sizes = (z.shape[1] * pixel, z.shape[0] * pixel)
    return lambda: Topography(z.T, sizes).detrend("height").power_spectrum_from_area(window="hann")


def seconds(run: Callable[[], object]) -> float:
    start = time.perf_counter()
    run()
    return time.perf_counter() - start


def measure(side: int, dtype: Any) -> dict[str, float]:
    """Median over the runs of each method's time over the bare transform's."""
    rng = np.random.default_rng(side)
    z = rng.standard_normal((side, side)).astype(dtype)
    pixel = 1e-6
    scan = asperity.HeightMap(z, pixel_size=pixel)
    bare = BareFftw(z)
    methods: dict[str, Callable[[], object]] = {
        "ours": lambda: asperity.power_spectrum(scan),
        "ours, 2 threads": lambda: asperity.power_spectrum(scan, threads=2),
    }
    if side <= SLOW and dtype == np.float64:
        methods["numpy"] = lambda: numpy_spectrum(z, pixel)
        if (run := surface_topography(z, pixel)) is not None:
            methods["SurfaceTopography"] = run
    ratios: dict[str, list[float]] = {name: [] for name in methods}
    times: list[float] = []
    for _ in range(RUNS + 1):
        for name, run in methods.items():
            if name == "SurfaceTopography" and len(ratios[name]) > 3:
                continue
            yardstick = seconds(bare)
            times.append(yardstick)
            ratios[name].append(seconds(run) / yardstick)
    result = {name: float(np.median(values[1:])) for name, values in ratios.items()}
    result["bare [ms]"] = float(np.median(times)) * 1e3
    return result


def extra_maps(side: int) -> float:
    """Peak memory above that of the map itself, in maps, of one call in a process of its own."""
    child = f"""
import numpy as np, asperity
z = np.random.default_rng(1).standard_normal(({side}, {side}))
scan = asperity.HeightMap(z, pixel_size=1e-6)
asperity.power_spectrum(asperity.HeightMap(z[:64, :64], pixel_size=1e-6))  # its code is in memory
print(peak(asperity.power_spectrum, scan) * 1024 / z.nbytes)
"""
    return peaks.printed(child)[0]


def draw(results: dict[tuple[int, str], dict[str, float]]) -> bytes:
    figure, (axes,) = new_figure(1)
    lines = [(name, "float64", "o-") for name in METHODS] + [("ours", "float32", "o:")]
    for (name, kind, style), colour in zip(reversed(lines), COLOURS, strict=False):
        points = [(side, r[name]) for (side, k), r in results.items() if k == kind and name in r]
        label = name if kind == "float64" else f"{name}, {kind}"
        if points:
            x, y = zip(*points, strict=True)
            axes.plot(x, y, style, color=colour, label=label, markersize=4)
    axes.axhline(1, color="0.4", linewidth=0.8)
    axes.annotate("a bare FFTW transform", (2300, 1.06), fontsize="small", color="0.3")
    axes.set_xscale("log", base=2)
    axes.set_yscale("log")
    axes.set_xlabel("Points a side of the map")
    axes.set_ylabel("Time / bare transform [-]")
    figure.legend(loc="outside right upper")
    return picture(figure, Path("spectrum.png"))


def make() -> timing.Report:
    results: dict[tuple[int, str], dict[str, float]] = {}
    rows = []
    for side in SIDES:
        for dtype in (np.float64, np.float32):
            kind = np.dtype(dtype).name
            r = results[side, kind] = measure(side, dtype)
            extra = f"{extra_maps(side):.2f}" if kind == "float64" else "-"
            cells = [f"{r[name]:.2f}" if name in r else "-" for name in METHODS]
            rows.append([f"{side}^2, {kind}", f"{r['bare [ms]']:.3g}", *cells, extra])
        print(side, "done", file=sys.stderr, flush=True)
    text = timing.markdown(["map", "bare transform [ms]", *METHODS, "extra memory [maps]"], rows)
    return timing.Report(text, {"spectrum.md": text.encode(), "spectrum.png": draw(results)})


if __name__ == "__main__":
    timing.run(make, __doc__)
