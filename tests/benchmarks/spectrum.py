"""Time and memory of a map's spectrum: ours, bare FFTW, NumPy, SurfaceTopography, in one process.

    python tests/benchmarks/spectrum.py [--sides 1000,1024,...] [--runs 7] [--output DIR]

The yardstick is one out-of-place two-dimensional r2c transform by FFTW (FFTW_ESTIMATE, one thread,
planned and its memory touched beforehand): the least that anyone needs. Ours is the whole way from
the heights: plane, split cosine bell, transform, rings. All runs alternate; medians of ratios.
"""

import argparse
import ctypes
import ctypes.util
import time
from collections.abc import Callable
from typing import Any

import numpy as np

import asperity

SIDES = (1000, 1024, 2048, 4096, 8192)
SLOW = 4096  # NumPy and SurfaceTopography are timed up to here: the rest would be waiting


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
        plan.argtypes = [
            ctypes.c_int,
            ctypes.c_int,
            ctypes.c_void_p,
            ctypes.c_void_p,
            ctypes.c_uint,
        ]
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


def measure(side: int, dtype: Any, runs: int) -> dict[str, float]:
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
    for _ in range(runs + 1):
        for name, run in methods.items():
            if name == "SurfaceTopography" and len(ratios[name]) > 3:
                continue
            yardstick = seconds(bare)
            times.append(yardstick)
            ratios[name].append(seconds(run) / yardstick)
    result = {name: float(np.median(values[1:])) for name, values in ratios.items()}
    result["bare [ms]"] = float(np.median(times)) * 1e3
    return result


if __name__ == "__main__":
    parser = argparse.ArgumentParser()
    parser.add_argument("--sides", default=",".join(map(str, SIDES)))
    parser.add_argument("--runs", type=int, default=7)
    arguments = parser.parse_args()
    for side in map(int, arguments.sides.split(",")):
        for dtype in (np.float64, np.float32):
            r = measure(side, dtype, arguments.runs)
            print(side, np.dtype(dtype).name, {k: round(v, 3) for k, v in r.items()}, flush=True)
