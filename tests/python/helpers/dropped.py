"""Two files as a user drops them: a scan in micrometres, and sweeps of a rubber that is known."""

import io

import numpy as np

import asperity
from helpers.rubbers import prony


def scan_bytes() -> bytes:
    """128 x 128 heights in um, 5 um between them."""
    spectrum = asperity.SelfAffineSpectrum(rms_height=20e-6, hurst=0.8, q0=1e4, q1=1e6)
    scan = asperity.synthesize(spectrum, shape=(128, 128), pixel_size=5e-6, seed=1)
    out = io.BytesIO()
    np.save(out, scan.heights * 1e6)
    return out.getvalue()


def dma_bytes() -> bytes:
    """Shear moduli in MPa at seven temperatures, with units below the names."""
    rubber = prony(3e6, 10 ** np.linspace(6, 9, 16), 10 ** np.linspace(2, -8, 16))
    lines = ["Temperature;Freq;G';G\"", "°C;Hz;MPa;MPa"]
    for celsius in range(0, 61, 10):
        for hertz in np.geomspace(0.1, 30, 12):
            e = rubber.modulus(2 * np.pi * hertz * 10 ** (-0.1 * (celsius - 20)))
            lines.append(f"{celsius};{hertz};{e.real / 3e6};{e.imag / 3e6}")
    return "\n".join(lines).encode()
