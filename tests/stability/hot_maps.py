"""Friction maps with heat over a range of temperatures, of measured scans, on a million points.

    python tests/stability/hot_maps.py [--points 1000000] [--curve]

ASPERITY_DATA names the folder of the scans. The rubber is the series that fits its measured master
curve; with --curve the curve itself. Tells what each took of the processor. Exit
status 1 where a map is off by more than its certified error, or that by more than its tolerance.
"""

import argparse
import sys
import time
from pathlib import Path
from typing import Any

import numpy as np

import asperity

sys.path.insert(0, str(Path(__file__).parents[1] / "benchmarks"))
import measured

RANGE = (283.15, 303.15)


def scene(name: str, curve: bool) -> dict[str, Any]:
    """Up to the fastest that the modulus was measured for at the lowest temperature."""
    spectrum, build = measured.spectra()[name], measured.rubbers()["epdm_70"]
    law = build.fit_arrhenius()
    [decades] = law.log10_a_T(np.array(RANGE[:1]))
    fastest = 0.99 * measured.velocities(spectrum, build.master_curve)[1] / 10**decades
    return {
        "spectrum": spectrum,
        "rubber": build.master_curve if curve else asperity.fit_prony(build),
        "pressure": (1e5, 4e5),
        "velocity": (1e-3, float(fastest)),
        "shift": law,
        # macro-contacts are wider than the scans
        "heating": asperity.Heating(
            density=1200,
            heat_capacity=1650,
            conductivity=0.23,
            contact_diameter=1e-3,
            macro_area=0.1,
        ),
        "rtol": 1e-3,
    }


def main() -> int:
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("--points", type=int, default=1_000_000)
    parser.add_argument("--curve", action="store_true")
    asked = parser.parse_args()
    if measured.folder() is None:
        print("measured scans: set ASPERITY_DATA to their folder")
        return 0
    failed = False
    for name in measured.SCANS:
        start = time.process_time()
        made = asperity.friction_map(
            **scene(name, asked.curve), temperature=RANGE, checked=asked.points
        )
        spent = time.process_time() - start
        kept = made.exceeded == 0 and made.max_error <= made.rtol
        failed = failed or not kept
        print(
            f"{name}: {made.cells} cells, {len(made.to_bytes()) / 1e6:.2f} MB, {spent:.0f} s, "
            f"certified {made.max_error:.1e}, {made.largest_checked_error:.1e} on "
            f"{made.checked} points, {made.exceeded} beyond: {'kept' if kept else 'FAILED'}",
            flush=True,
        )
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
