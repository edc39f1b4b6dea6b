"""Peak memory of each step from a scan and isotherms to friction, above that of its inputs (Linux).

    python tests/benchmarks/memory.py [--output DIR]

Each step runs in a process of its own, after a small one of its kind, so that its code is in memory
already. The peak is the kernel's high-water mark, forgotten before the step.
"""

import peaks
import timing

SETUP = """
import numpy as np
import asperity
from rings import VELOCITY, rings, rubber

rng = np.random.default_rng(1)
def scan(side):
    heights = rng.standard_normal((side, side))
    heights[rng.random((side, side)) < 0.03] = np.nan
    return asperity.HeightMap(heights, pixel_size=1e-6)
def isotherms(count):
    terms, w = rubber(), np.geomspace(0.1, 100, 16)
    return [
        asperity.Isotherm(
            temperature=t, angular_frequency=w, storage_modulus=e.real, loss_modulus=e.imag
        )
        for t in np.linspace(253, 293, count)
        for e in [terms.modulus(w * 10 ** (-0.15 * (t - 293)))]
    ]
def curve(rows):
    terms, w = rubber(), np.geomspace(1e-3, 1e9, rows)
    e = terms.modulus(w)
    return asperity.MasterCurve(
        angular_frequency=w, storage_modulus=e.real, loss_modulus=e.imag
    )
"""
CONDITIONS = "pressure=81e3, velocity=VELOCITY, correction=asperity.NayakSFactor()"
# name, what the step needs (small or not), the step
STEPS = {
    "drop-outs of a scan, 4096 x 4096": (
        "[scan(64 if small else 4096)]",
        "lambda z: z.fill_dropouts()",
    ),
    "spectrum of a scan, 4096 x 4096": (
        "[scan(64 if small else 4096).fill_dropouts()]",
        "asperity.power_spectrum",
    ),
    "master curve of 22 isotherms of 16 points": (
        "[isotherms(8 if small else 22)]",
        "lambda sweeps: asperity.build_master_curve(sweeps, reference_temperature=293.0)",
    ),
    "Prony series of 140 rows": ("[curve(40 if small else 140)]", "asperity.fit_prony"),
    "60 velocities, 392 rings, 20 terms": (
        "[rings(40 if small else 392, 8), rubber()]",
        f"lambda c, e: asperity.friction(c, e, {CONDITIONS})",
    ),
    "60 velocities, 392 rings, master curve of 140 rows": (
        "[rings(40 if small else 392, 8), curve(40 if small else 140)]",
        f"lambda c, e: asperity.friction(c, e, {CONDITIONS})",
    ),
    "a grid of 1000 x 1000 points, 392 rings": (
        "[rings(392, 8), rubber(), np.geomspace(1e4, 1e6, 10 if small else 1000)[:, None],"
        " np.geomspace(1e-6, 10, 10 if small else 1000)]",
        "lambda c, e, p, v: asperity.friction(c, e, pressure=p, velocity=v)",
    ),
    "a map, 392 rings, a million points checked": (
        "[rings(392, 8), rubber(), 1000 if small else 1_000_000]",
        "lambda c, e, n: asperity.friction_map("
        "c, e, pressure=(5e4, 5e5), velocity=(1e-6, 10), rtol=1e-3, checked=n, threads=1)",
    ),
    "a million points of a map": (
        "[asperity.friction_map(rings(392, 8), rubber(), pressure=(5e4, 5e5), velocity=(1e-6, 10),"
        " rtol=1e-3), rng.uniform(5e4, 5e5, 10 if small else 1_000_000)]",
        "lambda of, p: of.mu(p, 0.1)",
    ),
}


def megabytes(make: str, step: str) -> float:
    code = f"{SETUP}\nmake, step = lambda small: {make}, {step}\nstep(*make(True))\n"
    return peaks.printed(code + "print(peak(step, *make(False)))")[0] / 1024


def make() -> timing.Report:
    result = {name: megabytes(*step) for name, step in STEPS.items()}
    text = timing.markdown(
        ["step", "peak above its inputs [MB]"],
        [[name, f"{peak:.1f}"] for name, peak in result.items()],
    )
    columns = {"step": list(result), "peak_mb": list(result.values())}
    return timing.Report(text, {"memory.csv": timing.table("benchmark memory", columns)})


if __name__ == "__main__":
    timing.run(make, __doc__)
