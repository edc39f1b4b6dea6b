"""A road's profile: its full spectrum, its top one, and those that programs made of it.

    python tests/benchmarks/outside/road_profile.py PSD PRESETS

PSD is a clone of k100kan35-dotcom/psd, which has the profile; PRESETS one of
k100kan35-dotcom/psfinal_hysteresis_redesign, which has the C(q) that the field's commercial program
computed with and the rubber. What the choice is worth in mu: S100 at 0.3 MPa and 20 C by
`PartialContact`, up to the same q1.
"""

import sys
from pathlib import Path

import clone
import numpy as np

import asperity

PROFILE = "IDADA_road_profile.csv"
WAVENUMBERS = (50, 100, 200, 500, 1e3, 2e3, 5e3, 1e4, 2e4, 5e4, 1e5)
VELOCITIES = (1e-4, 1e-2, 1.0)


def spectra(root: Path, presets: clone.Presets) -> dict[str, asperity.TabulatedSpectrum]:
    with (root / PROFILE).open() as file:
        spacing = float([next(file) for _ in range(5)][3])
        heights = np.loadtxt(file, usecols=1) * 1e-6
    scan = asperity.LineScan(heights, spacing=spacing)
    flat = np.asarray(scan.detrend("offset").heights)
    above = float(np.mean(flat > flat.mean()))
    print(
        f"{heights.size} points, {spacing * 1e6:.3f} um: rms height {scan.rms_height * 1e3:.2f} mm,"
        f" skewness {scan.skewness:.2f}, {above:.2f} of it above the mean\n"
    )
    how = {"detrend": "offset"}
    top = asperity.line_spectrum(scan, part="top", **how).isotropic()
    of_program = presets.root / "preset_data"
    assert of_program.exists()
    found = {
        "full": asperity.line_spectrum(scan, **how).isotropic(),
        "top": top,
        "top, not divided": top.scaled(above),
        "commercial program": presets.road(),
    }
    rows = np.genfromtxt(root / "program_psd.csv", delimiter=",", skip_header=1).T
    found["`program_psd.csv`"] = asperity.TabulatedSpectrum(wavenumber=rows[0], density=rows[1])
    rows = 10 ** np.loadtxt(root / "persson_real_program_psd.csv", delimiter=",").T
    found["`persson_real_...csv`"] = asperity.TabulatedSpectrum(wavenumber=rows[0], density=rows[1])
    q0 = max(spectrum.q0 for spectrum in found.values())
    return {name: one.truncated(q0=q0, q1=min(clone.Q1, one.q1)) for name, one in found.items()}


def main() -> None:
    root = clone.given("k100kan35-dotcom/psd", PROFILE)
    if len(sys.argv) < 3:
        raise SystemExit("skipped: name the clone of psfinal_hysteresis_redesign too")
    presets = clone.Presets(Path(sys.argv[2]))
    found = spectra(root, presets)
    full = found["full"]
    known = [q for q in WAVENUMBERS if full.q0 < q < full.q1]
    print("C(q) over the full one:\n\n| q [1/m] | " + " | ".join(list(found)[1:]) + " |")
    print("| --- " * len(found) + "|")
    for q in known:
        cells = (f"{one.at(q) / full.at(q):.2f}" for one in list(found.values())[1:])
        print(f"| {q:g} | " + " | ".join(cells) + " |")
    print("\n| spectrum | rms slope | mu, A at 1e-4 m/s | at 0.01 | at 1 |\n" + "| --- " * 5 + "|")
    for name, spectrum in found.items():
        result = asperity.friction(
            spectrum,
            presets.rubber("S100"),
            pressure=clone.PRESSURE,
            velocity=VELOCITIES,
            temperature=clone.TEMPERATURE,
            shift=presets.shift("S100"),
            correction=asperity.PartialContact(),
            strain_factors=presets.factors(clone.ONE_FOR_ALL),
            rtol=1e-3,
        )
        cells = (f"{m:.3f}, {a:.3f}" for m, a in zip(result.mu, result.contact_area, strict=True))
        print(f"| {name} | {spectrum.rms_slope:.2f} | " + " | ".join(cells) + " |")


if __name__ == "__main__":
    main()
