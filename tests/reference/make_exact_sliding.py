"""Exact steady sliding contacts, by which corrections of friction are judged.

    python make_exact_sliding.py [CASE ...]

Solves the rows of exact_sliding.csv again with `asperity.validation.slide`, whose own reference is
sliding.csv, and writes the table; with names it solves these alone and prints how far they are from
it. All of it takes about half an hour of one core.

A map has box side 1, random phases, rms slope 1 and wavenumbers from 2 pi k0 to 2 pi k1
(`asperity.synthesize`); `kind` says how its heights, scaled to rms 1, were bent after that.
Speeds and loads were drawn from a Sobol sequence: the speed evenly in n, the mean slope of I1 / I2
over the band, from 0.85 to -0.85 or evenly in its logarithm between these, the load evenly in the
logarithm of p* = 1 / sqrt(8 G(q1)). Rows with `set` fit made the constants of PartialContact; rows
with judge and bent were first looked at when the rule stood: other seeds, H and rubbers. Rows curve
are for a picture. Contacts that did not converge (loss tangents of 5 and more) are not in it.
"""

from pathlib import Path

import contact_tables
import numpy as np
from contact_tables import Row

import asperity
from asperity.validation import SlidingContact, slide

TABLE = Path(__file__).with_name("exact_sliding.csv")
COMMENT = """\
# Exact steady sliding contacts of maps of box side 1 and rms slope 1, nu = 0.5; moduli of the
# rubbers over E_inf are in make_exact_sliding.py, which solves all of it again with
# asperity.validation.slide (rtol 1e-4). n: mean over ln q of d ln(I1 / I2) / d ln omega.
# pstar = 1 / sqrt(8 G(q1)). A is free of the perimeter's excess; where A_raw / A is large the spots
# are a few pixels wide: at 1.2 A is 1 to 5 % high, at 1.35 more than 10. mu by dissipation, work
# by the slopes.
"""
INPUTS = ("points", "k0", "k1", "seed")


def series(moduli: list[float], first: float, decades: float) -> tuple[list[float], list[float]]:
    """Return moduli and times that fall by equal factors."""
    return moduli, [first * 10 ** (-decades * i) for i in range(len(moduli))]


RUBBERS = {  # E_k over E_inf, and tau_k
    "elastic": ([1e-9], [1.0]),
    "sls10": ([9.0], [1.0]),
    "sls100": ([99.0], [1.0]),
    "sls1000": ([999.0], [1.0]),
    "sbr": series([0.4, 0.916347, 2.09923, 4.80906, 11.0169, 25.2383, 57.8176, 132.452], 10, 1),
    "broad20": series([0.35 * 10 ** (0.15 * i) for i in range(20)], 1, 0.5),
    # those that judge
    "sls30": ([29.0], [1.0]),
    "sls300": ([299.0], [1.0]),
    "two": ([8.0, 90.0], [1.0, 1e-2]),
    "tread12": series([0.3, 0.5, 0.8, 1.5, 3, 7, 18, 45, 110, 200, 160, 60], 1, 0.8),
    "soft6": series([0.5, 0.7, 1, 1.6, 2.4, 3.5], 1, 1),
}
BENT = {
    "gauss": lambda h: h,
    "skew": lambda h: h,  # `synthesize` itself bends the phases
    "exp": lambda h: np.exp(0.5 * h),  # high peaks
    "mexp": lambda h: -np.exp(-0.5 * h),  # worn, deep valleys
    "square": lambda h: -((h - 0.7) ** 2),  # rounded tops of one height
    "cut": lambda h: np.minimum(h, 1.0),  # plateaus
    "softcut": lambda h: -0.25 * np.logaddexp(0, (0.8 - h) / 0.25),
    "atan": lambda h: np.arctan(1.5 * h),
}


def rows() -> list[Row]:
    """Return the rows of the table."""
    return contact_tables.rows(TABLE)


def rubber(name: str) -> asperity.PronySeries:
    """Return one of RUBBERS, E_inf 1 Pa."""
    moduli, times = RUBBERS[name]
    return asperity.PronySeries(equilibrium_modulus=1.0, moduli=moduli, relaxation_times=times)


def surface(row: Row) -> asperity.HeightMap:
    """Return the map of a row."""
    points, k0, k1, seed = (int(row[name]) for name in INPUTS)
    spectrum = asperity.SelfAffineSpectrum(
        rms_height=1, hurst=float(row["hurst"]), q0=2 * np.pi * k0, q1=2 * np.pi * k1
    )
    shape = (points, points)
    made = asperity.synthesize(
        spectrum, shape=shape, pixel_size=1 / points, seed=seed, skewness=float(row["skewness"])
    )
    h = made.heights - made.heights.mean()
    h = BENT[row["kind"]](h / h.std())
    modes = np.fft.fft2(h - h.mean()) / h.size
    k = np.fft.fftfreq(points, 1 / points)
    slope = 2 * np.pi * np.sqrt(((k[:, None] ** 2 + k**2) * np.abs(modes) ** 2).sum())
    return asperity.HeightMap((h - h.mean()) / slope, pixel_size=1 / points)


def pressed(height_map: asperity.HeightMap, row: Row, rtol: float, **at: float) -> SlidingContact:
    """Return the contact of a map with the rubber of a row, at its load and speed or others."""
    at = {name: float(row[name]) for name in ("pressure", "velocity")} | at
    return slide(height_map, rubber(row["rubber"]), **at, periodic=True, rtol=rtol)


def figures(result: SlidingContact, **more: float) -> Row:
    """Return the figures of a contact."""
    return contact_tables.figures(
        A=result.contact_area,
        A_raw=result.contact_area_raw,
        mu=result.hysteresis,
        work=result.work_of_slopes,
        **more,
    )


def solved(row: Row) -> Row:
    """Return the row with what the solver says of its contact."""
    result = pressed(surface(row), row, 1e-4)
    return row | figures(result, energy=result.elastic_energy, error=result.error)


if __name__ == "__main__":
    contact_tables.solve_again(TABLE, COMMENT, solved, ("A", "mu"))
