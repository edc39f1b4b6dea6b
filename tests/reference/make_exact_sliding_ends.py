"""Exact sliding contacts of spectra that do not end sharply, and of narrow ones.

    python make_exact_sliding_ends.py [CASE ...]

Solves the rows of exact_sliding_ends.csv again with `asperity.validation.slide` and writes the
table; with names it solves these alone and prints how far they are from it. All of it takes about
half an hour of one core.

Maps have box side 1, rms slope 1 and random phases from k0 waves to a side on. Rows with `set` fit
said where PartialContact should take the end of a spectrum (the last tenth of the slope variance
among tails of 1 to 40 %; its constants stayed), those with judge were looked at once after that.
`end` is what stands on the power law k^(-2 (H + 1)): x = k / k1,
    blur exp(-x^2), fade exp(-2 x), steep x^-4 and mild x^-3 beyond x = 1, step 0.01 from x = 1 to 3
    and 0 from there on, slope 1 / (1 + exp((x - 1) / 0.15)); sharp: it ends at k1.
All but the sharp ones go to a fifth of the points. Rows with narrow have k1/k0 from 3 to 8 and say
what `model_error` is there. Speeds and loads were drawn evenly in their logarithms.
"""

from pathlib import Path

import contact_tables
import make_exact_sliding
import numpy as np
from contact_tables import Row

import asperity

TABLE = Path(__file__).with_name("exact_sliding_ends.csv")
COMMENT = """\
# Exact steady sliding contacts of maps of box side 1 and rms slope 1, nu = 0.5: spectra with all
# kinds of upper ends, and narrow ones; make_exact_sliding_ends.py says what the columns are and
# solves all of it again (rtol 1e-3). Rubbers as in exact_sliding.csv.
"""
ENDS = {
    "sharp": lambda x: x <= 1,
    "blur": lambda x: np.exp(-(x**2)),
    "fade": lambda x: np.exp(-2 * x),
    "steep": lambda x: np.minimum(1, x**-4.0),
    "mild": lambda x: np.minimum(1, x**-3.0),
    "step": lambda x: np.where(x < 1, 1, np.where(x < 3, 0.01, 0)),
    "slope": lambda x: 1 / (1 + np.exp((x - 1) / 0.15)),
}


def rows() -> list[Row]:
    """Return the rows of the table."""
    return contact_tables.rows(TABLE)


def density(row: Row, k: np.ndarray) -> np.ndarray:
    """Return C at k waves to a side, but for a factor."""
    k0, k1 = float(row["k0"]), float(row["k1"])
    highest = k1 if row["end"] == "sharp" else int(row["points"]) / 5
    known = (k >= 0.999 * k0) & (k <= highest * (1 + 1e-9))
    k = np.maximum(k, 1e-9)
    return np.where(known, k ** (-2 - 2 * float(row["hurst"])) * ENDS[row["end"]](k / k1), 0)


def surface(row: Row) -> asperity.HeightMap:
    """Return the map of a row."""
    if row["set"] == "narrow":
        return make_exact_sliding.surface(row | {"skewness": "0", "kind": "gauss"})
    points = int(row["points"])
    k = np.hypot(*np.meshgrid(*[np.fft.fftfreq(points, 1 / points)] * 2, indexing="ij"))
    phases = np.random.default_rng(int(row["seed"])).uniform(0, 2 * np.pi, k.shape)
    h = np.fft.ifft2(np.sqrt(density(row, k)) * np.exp(1j * phases)).real
    modes = np.abs(np.fft.fft2(h) / h.size) ** 2
    slope = 2 * np.pi * np.sqrt((k**2 * modes).sum())
    return asperity.HeightMap((h - h.mean()) / slope, pixel_size=1 / points)


def spectrum(row: Row) -> asperity.TabulatedSpectrum:
    """Return what the map was drawn from, at rms slope 1."""
    last = float(row["k1"]) if row["end"] == "sharp" else int(row["points"]) / 5
    k = np.geomspace(float(row["k0"]), last, 400)
    if row["end"] == "step":  # the steps as steep as rows can be
        edges = float(row["k1"]) * np.array([1 - 1e-6, 1 + 1e-6, 3 - 1e-6, 3 + 1e-6])
        k = np.unique(np.append(k, edges[edges < last]))
    made = asperity.TabulatedSpectrum(wavenumber=2 * np.pi * k, density=density(row, k))
    return made.scaled(1 / made.rms_slope**2)


def solved(row: Row) -> Row:
    """Return the row with what the solver says of its contact."""
    return row | make_exact_sliding.figures(make_exact_sliding.pressed(surface(row), row, 1e-3))


if __name__ == "__main__":
    contact_tables.solve_again(TABLE, COMMENT, solved, ("A", "mu"))
