"""Exact sliding contacts of wide bands, which judge PartialContact there: q1/q0 of 128 and more.

    python make_exact_sliding_wide.py [CASE ...]

Solves the rows of exact_sliding_wide.csv again with `asperity.validation.slide` (rtol 1e-3) and
writes the table; with names it solves these alone and prints how far they are from it. All of it
takes a quarter of an hour of one core, and 5 GB.

Maps have box side 1, rms slope 1, random phases and wavenumbers from 2 pi k0 to 2 pi k1, on
points x points; n and p* were drawn from Sobol sequences, H from 0.5 to 0.9, the rubbers in turn.

No grid holds q1/q0 of some thousands, so a row has nested contacts, too: `splits` part its band.
The first part is solved as a map of its own. Its pressure without waves beyond the first split is
the mean pressure of patches, which have the waves of the next part, four of the longest to a side.
Patches are solved at 10 mean pressures, and what lies between is interpolated:
    A = <A_patch(p)>,  mu = mu of the first part's waves below the split + <p mu_patch(p)> / sigma0.
Nothing says that it is exact: the long waves do not feel the finer ones. Rows with `points` have
both (but for the largest), and the first part of their nested contact has the waves of the same
map, which tells the error; the others have nested contacts alone, the first part of four maps in
the mean. Rows w, x and e are those of 30 drawn that were solved in the time there was.
"""

from pathlib import Path

import contact_tables
import make_exact_sliding
import numpy as np

import asperity

TABLE = Path(__file__).with_name("exact_sliding_wide.csv")
COMMENT = """\
# Exact steady sliding contacts of maps of box side 1 and rms slope 1, nu = 0.5, with wide bands;
# make_exact_sliding_wide.py says what the columns are and solves all of it again. Rubbers and
# columns of the same names as in exact_sliding.csv.
"""
NU = 0.5
PIXELS = 8  # to the shortest wave
WAVES = 4  # of the longest wave to the side of a patch
PRESSURES = 8
MAPS = (1, 4)  # of patches, and of the first part


def rows():
    """Return the rows of the table."""
    return contact_tables.rows(TABLE)


def excess(rows, name):
    """Return nested over one grid, of mu or A, where both are known."""
    both = [row for row in rows if float(row[name] or 0) and row["splits"]]
    return np.array([float(row[f"{name}_nested"]) / float(row[name]) for row in both])


def truths(rows):
    """Return mu and A of all rows, by one grid, else nested without the mean excess."""
    mean = {name: np.exp(np.log(excess(rows, name)).mean()) for name in ("mu", "A")}
    return [
        tuple(
            float(row[name]) if row[name] else float(row[f"{name}_nested"]) / mean[name]
            for name in ("mu", "A")
        )
        for row in rows
    ]


def surface(points, k0, k1, hurst, seed, slope=1.0):
    """Return a map; that of make_exact_sliding takes more memory."""
    spectrum = asperity.SelfAffineSpectrum(
        rms_height=1, hurst=hurst, q0=2 * np.pi * k0, q1=2 * np.pi * k1
    )
    h = asperity.synthesize(
        spectrum, shape=(points, points), pixel_size=1 / points, seed=seed
    ).heights
    h = h - h.mean()
    power = np.abs(np.fft.rfft2(h)) ** 2
    power[:, 1:-1] *= 2  # with their mirror images
    k = np.fft.fftfreq(points, 1 / points) ** 2
    variance = k @ power.sum(1) + k[: points // 2 + 1] @ power.sum(0)
    del power
    h *= slope / (2 * np.pi * np.sqrt(variance) / points**2)
    return asperity.HeightMap(h, pixel_size=1 / points)


def without_short_waves(map, last):
    """Return the waves of up to `last` to a side, on as many points as a map of them has."""
    many, points = len(map.heights), round(PIXELS * last)
    k = np.fft.fftfreq(points, 1 / points).astype(int)
    modes = np.fft.rfft2(map.heights)[k, : points // 2 + 1] * (points / many) ** 2
    modes[np.hypot(k[:, None], np.arange(points // 2 + 1)) > last * (1 + 1e-9)] = 0
    return asperity.HeightMap(np.fft.irfft2(modes, s=(points, points)), pixel_size=1 / points)


def pressed(map, row, pressure, velocity):
    """Return the contact of a map with the rubber of a row."""
    return make_exact_sliding.pressed(map, row, 1e-3, pressure=pressure, velocity=velocity)


def compliance(rubber, velocity, points):
    """Return 1 / conj E(v q_x) by k_x, its mean over the band at 0, and the loss of that band."""
    if velocity == 0:
        return np.ones(points // 2 + 1, complex), 0.0
    k = np.arange(points // 2 + 1)
    inverse = 1 / np.conj(rubber.modulus(np.maximum(2 * np.pi * k, 1e-9) * velocity))
    inverse[-1] = inverse[-1].real
    node, weight = np.polynomial.legendre.leggauss(16)
    upper = np.pi * 0.5 ** np.arange(60)[:, None]
    q, weight = upper / 4 * (3 + node), upper / 4 * weight / np.pi
    of_band = 1 / np.conj(rubber.modulus(velocity * q.ravel())).reshape(q.shape)
    inverse[0] = (weight * of_band.real).sum()
    return inverse, (weight * q * of_band.imag).sum()


def long_waves(pressure, last, row, velocity):
    """Return a pressure without waves beyond `last` to a side, and mu of those below it."""
    points, load = len(pressure), pressure.mean()
    kx, ky = np.arange(points // 2 + 1), np.fft.fftfreq(points, 1 / points)[:, None]
    k = np.hypot(kx, ky)
    modes = np.where(k <= last, np.fft.rfft2(pressure) / points**2, 0)
    inverse, band_loss = compliance(make_exact_sliding.rubber(row["rubber"]), velocity, points)
    loss = 2 * np.pi * kx * inverse.imag
    loss[0] = band_loss
    many = np.where(kx > 0, 2.0, 1.0)  # with their mirror images
    factor = (1 - NU**2) / (np.pi * np.where(k > 0, k, np.inf))
    mu = (many * loss * factor * np.abs(modes) ** 2).sum() / load
    smooth = np.maximum(np.fft.irfft2(modes * points**2, s=pressure.shape), 0)
    return smooth * (load / smooth.mean()), mu


def nested(row, edges, pressures, side=1.0, map=None):
    """Return A and mu of the waves from edges[0] to edges[-1] at mean pressures; of this map."""
    k0, k1, hurst = (float(row[name]) for name in ("k0", "k1", "hurst"))
    first, last = edges[0] * side, edges[1] * side

    def roughness(low, high):  # has this part of the slope variance, but for a factor
        return high ** (2 - 2 * hurst) - low ** (2 - 2 * hurst)

    if map is None:
        slope = np.sqrt(roughness(*edges[:2]) / roughness(k0, k1))
        seeds = int(row["seed"]) + 1000 * len(edges) + np.arange(MAPS[side == 1.0])
        maps = [surface(round(PIXELS * last), first, last, hurst, s, slope) for s in seeds]
    else:
        maps = [without_short_waves(map, last)]
    velocity = float(row["velocity"]) / side
    contacts = [[pressed(map, row, p, velocity) for map in maps] for p in pressures]
    if len(edges) == 2:
        return np.mean([[(c.contact_area, c.hysteresis) for c in of] for of in contacts], 1)
    smooth = [
        [long_waves(np.array(c.pressure), last, row, velocity) for c in of] for of in contacts
    ]
    highest = max(p.max() for of in smooth for p, _ in of)
    grid = np.geomspace(0.3 * min(pressures), highest, PRESSURES)
    area, mu = nested(row, edges[1:], grid, WAVES / edges[1]).T

    def of_patches(pressure, mu_of_long_waves):
        known = np.maximum(pressure, grid[0])
        at = np.log(known)
        a = np.exp(np.interp(at, np.log(grid), np.log(area))) * pressure / known
        m = np.interp(at, np.log(grid), mu)
        return a.mean(), mu_of_long_waves + (pressure * m).mean() / pressure.mean()

    return np.mean([[of_patches(*one) for one in of] for of in smooth], 1)


def solved(row):
    """Return the row with what the solver says of its contacts."""
    k0, k1 = float(row["k0"]), float(row["k1"])
    load, velocity = float(row["pressure"]), float(row["velocity"])
    map, figures = None, {}
    if row["points"]:
        map = surface(int(row["points"]), k0, k1, float(row["hurst"]), int(row["seed"]))
    if row["splits"]:
        edges = [k0, *(float(k) for k in row["splits"].split(";")), k1]
        ((area, mu),) = nested(row, edges, [load], map=map)
        figures |= {"A_nested": area, "mu_nested": mu}
    if map:
        row = row | make_exact_sliding.figures(pressed(map, row, load, velocity))
    return row | contact_tables.figures(**figures)


if __name__ == "__main__":
    contact_tables.solve_again(TABLE, COMMENT, solved, ("A", "mu", "A_nested", "mu_nested"))
