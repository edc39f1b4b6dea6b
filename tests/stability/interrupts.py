"""Ctrl-C in the middle of one long call: how long until it ends.

python tests/stability/interrupts.py [--seconds 1] [CALL...]

The signal waits --wait seconds, halved for calls that end sooner. Fails where one takes more than
--seconds of processor time from the signal to KeyboardInterrupt; where the machine has little else
to do that is the time which passes, and both are told. Wants 8 GB of memory.
"""

import contextlib
import os
import signal
import sys
import time
from collections.abc import Callable

import numpy as np
from options import options

import asperity

ROAD = asperity.SelfAffineSpectrum(rms_height=1e-5, hurst=0.8, q0=2e3, q1=1e5)
RUBBER = asperity.PronySeries(
    equilibrium_modulus=3e6, moduli=[1e7, 1e8], relaxation_times=[1e-2, 1e-5]
)
BOX = {"pressure": (1e4, 1e6), "velocity": (1e-3, 1.0)}
GRID = {"shape": (8192, 8192), "pixel_size": 1e-5}


def points() -> np.ndarray:
    return np.geomspace(2e-3, 0.5, 100_000_000)


def look_up(name: str) -> Callable[[], object]:
    fmap = asperity.friction_map(ROAD, RUBBER, **BOX, rtol=0.1, checked=0)
    velocity = points()
    return lambda: getattr(fmap, name)(1e5, velocity)


def modulus() -> Callable[[], object]:
    frequency = points()
    return lambda: RUBBER.modulus(frequency)


def integrals() -> Callable[[], object]:
    frequency = points()
    return lambda: RUBBER.angular_integrals(frequency)


def friction() -> Callable[[], object]:
    velocity = points()
    return lambda: asperity.friction(ROAD, RUBBER, pressure=1e5, velocity=velocity)


def sliding() -> Callable[[], object]:
    box = {"shape": (2048, 2048), "pixel_size": 1e-5}
    surface = asperity.synthesize(ROAD, **box, seed=1)
    return lambda: asperity.validation.slide(
        surface, RUBBER, pressure=1e5, velocity=0.1, periodic=True
    )


def measured(function: Callable[..., object]) -> Callable[[], object]:
    heights = np.random.default_rng(1).normal(size=GRID["shape"])
    surface = asperity.HeightMap(heights=heights, pixel_size=GRID["pixel_size"])
    return lambda: function(surface)


def band() -> Callable[[], object]:
    heights = asperity.synthesize(ROAD, shape=(256, 256), pixel_size=1e-5, seed=1)
    result = asperity.power_spectrum(heights)
    spectrum = result.truncated(q1=result.q1 / 3)
    velocity = np.geomspace(1e-3, 1, 50)
    return lambda: asperity.friction_band(
        spectrum, RUBBER, pressure=1e5, velocity=velocity, samples=100_000, seed=1
    )


CALLS: dict[str, Callable[[], Callable[[], object]]] = {
    "mu": lambda: look_up("mu"),
    "derivatives": lambda: look_up("derivatives"),
    "modulus": modulus,
    "angular_integrals": integrals,
    "friction": friction,
    "synthesize": lambda: lambda: asperity.synthesize(ROAD, **GRID, seed=1),
    "skewed": lambda: lambda: asperity.synthesize(ROAD, **GRID, seed=1, skewness=-0.5),
    "power_spectrum": lambda: measured(asperity.power_spectrum),
    "line_spectrum": lambda: measured(asperity.line_spectrum),
    "spectral_density": lambda: measured(asperity.spectral_density),
    "friction_map": lambda: lambda: asperity.friction_map(ROAD, RUBBER, **BOX, rtol=1e-7),
    "friction_band": band,
    "slide": sliding,
}


def used(process: int) -> float:
    """Seconds of processor time that a process has had."""
    with open(f"/proc/{process}/stat", encoding="utf-8") as file:
        columns = file.read().rpartition(")")[2].split()
    return (int(columns[11]) + int(columns[12])) / os.sysconf("SC_CLK_TCK")


def interrupted(run: Callable[[], object], wait: float) -> tuple[float, float] | None:
    """Seconds from a signal, sent after `wait`, to the end, passed and of the processor.

    None where the call ended before.
    """
    parent = os.getpid()
    reading, writing = os.pipe()
    child = os.fork()
    if child == 0:
        time.sleep(wait)
        os.write(writing, f"{time.monotonic()!r} {used(parent)!r}".encode())
        os.kill(parent, signal.SIGINT)
        os._exit(0)
    try:
        run()
    except KeyboardInterrupt:
        now, processor = time.monotonic(), used(parent)
        sent, before = map(float, os.read(reading, 100).split())
        return now - sent, processor - before
    finally:
        os.waitpid(child, 0)
    return None


def main() -> int:
    args = options(__doc__, CALLS, seconds=1.0, wait=1.0)
    signal.signal(signal.SIGINT, signal.default_int_handler)
    failed = False
    for name in args.kinds:
        child = os.fork()  # gives back its memory
        if child == 0:
            run, wait, took = CALLS[name](), args.wait, None
            while took is None and wait > 1e-3:  # some end sooner than that
                with contextlib.suppress(KeyboardInterrupt):  # after the end
                    took = interrupted(run, wait)
                wait /= 2
            shown = "ended before the signal"
            if took is not None:
                shown = f"ended {took[0]:.2f} s after the signal, {took[1]:.2f} s of processor time"
            print(f"{name}: {shown}", flush=True)
            os._exit(took is None or took[1] > args.seconds)
        failed = os.waitpid(child, 0)[1] != 0 or failed
    return int(failed)


if __name__ == "__main__":
    sys.exit(main())
