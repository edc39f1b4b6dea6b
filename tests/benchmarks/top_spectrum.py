"""The full spectrum and the top one on maps whose exact sliding contacts are known.

    python tests/benchmarks/top_spectrum.py

mu and A of `PartialContact` over exact ones, geometric mean (lowest to highest) of 12 contacts a
map: kinds of heights, rubbers and loads of scan_contact.py, three velocities. "top" is divided by
the share of points above the mean, as `power_spectrum(part="top")` is; "top, not divided" is what
others call top power spectrum. Prints Markdown.
"""

import numpy as np
import scan_contact

import asperity
from asperity.validation import slide

KINDS = ("Gaussian", "worn", "polished tops", "honed plateaus")
RUBBERS = ("1 term, 30", "8 terms, 300")
VELOCITIES = (1.7e-4, 5e-2, 3.0)
SEED = 9001


def spectra(surface: asperity.HeightMap) -> dict[str, asperity.TabulatedSpectrum]:
    whole = scan_contact.rings(surface)
    top = asperity.power_spectrum(surface, window="none", detrend=None, part="top")
    top = top.truncated(q0=whole.q0, q1=whole.q1)
    above = np.mean(surface.heights > surface.heights.mean())
    return {"full": whole, "top": top, "top, not divided": top.scaled(float(above))}


def of_exact(surface: asperity.HeightMap) -> dict[str, np.ndarray]:
    """mu and A by spectrum, over the exact ones; shape (2, contacts)."""
    result = {name: [] for name in spectra(surface)}
    for name in RUBBERS:
        for pressure in scan_contact.PRESSURES:
            for velocity in VELOCITIES:
                at = {"pressure": pressure, "velocity": velocity}
                exact = slide(surface, scan_contact.RUBBERS[name], **at, periodic=True, rtol=1e-3)
                for kind, spectrum in spectra(surface).items():
                    said = asperity.friction(
                        spectrum,
                        scan_contact.RUBBERS[name],
                        **at,
                        correction=asperity.PartialContact(),
                        rtol=1e-3,
                    )
                    row = said.mu / exact.hysteresis, said.contact_area / exact.contact_area
                    result[kind].append(row)
    return {kind: np.transpose(rows) for kind, rows in result.items()}


def main() -> None:
    names = ("full", "top", "top, not divided")
    print("| heights | skewness | slope variance of the top | " + " | ".join(names) + " |")
    print("| --- " * (3 + len(names)) + "|")
    for kind in KINDS:
        surface = scan_contact.height_map(kind, SEED)
        of = spectra(surface)
        variance = (of["top"].rms_slope / of["full"].rms_slope) ** 2
        cells = [
            "; ".join(
                f"{np.exp(np.log(x).mean()):.2f} ({x.min():.2f} to {x.max():.2f})" for x in rows
            )
            for rows in of_exact(surface).values()
        ]
        print(f"| {kind} | {surface.skewness:.2f} | {variance:.2f} | " + " | ".join(cells) + " |")


if __name__ == "__main__":
    main()
