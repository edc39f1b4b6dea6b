"""Stress spectra of exact sliding contacts, ring by ring: which part of a rule's error is whose.

    python make_exact_spectra.py [CASE ...]

Solves the rows `judge` of exact_sliding.csv again and writes exact_spectra.csv, a row a contact;
with names it solves these alone and prints how far they are from it. All of it takes about a
quarter of an hour of one core.

Rings of wavenumbers k = q / (2 pi) are a quarter of an octave wide, from k0 to k1 and on to half
the points; the first has those below k0, the corners of the grid are in none. Of each ring:
  complete  sum of |h_q / K_q|^2 / sigma0^2, the stress of complete contact;
  stress    sum of |p_q|^2 / sigma0^2;
  loss      sum of q_x Im K_q |p_q|^2 / sigma0, whose sum, with the corners, is mu;
  even      the same with |p_q|^2 = R |h_q / K_q|^2, R = stress / complete for all directions.
"""

import sys
from pathlib import Path

import contact_tables
import make_exact_sliding
import numpy as np

from asperity.validation import slide

TABLE = Path(__file__).with_name("exact_spectra.csv")
COMMENT = """\
# Stress spectra of exact sliding contacts of exact_sliding.csv, box side 1, nu = 0.5, by rings;
# make_exact_spectra.py says what the lists are and makes it again.
"""
LISTS = ("edges", "complete", "stress", "loss", "even")
NU = 0.5


def rings(k0, k1, last):
    """Return edges of rings, just below waves of the map and just above k1."""
    many = round(4 * np.log2(k1 / k0))
    step = np.log(k1 / k0) / many
    edges = k0 * np.exp(step * np.arange(many + np.ceil(np.log(last / k1) / step - 1e-9) + 1))
    edges *= np.where(edges < 0.999 * k1, 1 - 1e-9, 1 + 1e-9)
    return np.concatenate([[0.5], edges])


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


def solved(row):
    """Return the contact of a row of exact_sliding.csv."""
    map, rubber = make_exact_sliding.surface(row), make_exact_sliding.rubber(row["rubber"])
    load, velocity, points = float(row["pressure"]), float(row["velocity"]), int(row["points"])
    result = slide(map, rubber, pressure=load, velocity=velocity, periodic=True, rtol=1e-4)
    inverse, band_loss = compliance(rubber, velocity, points)
    kx, ky = np.arange(points // 2 + 1), np.fft.fftfreq(points, 1 / points)[:, None]
    k = np.hypot(kx, ky)
    many = np.where((k > 0) & (kx > 0) & (kx < points // 2), 2.0, 1.0)  # with its mirror image
    many[0, 0] = 0  # the mean is not a wave
    factor = (1 - NU**2) / (np.pi * np.where(k > 0, k, 1))
    stress = many * np.abs(np.fft.rfft2(result.pressure) / points**2 / load) ** 2
    height = np.abs(np.fft.rfft2(map.heights) / points**2) ** 2
    complete = many * height / (factor * np.abs(inverse) * load) ** 2
    of_loss = load * factor * 2 * np.pi * kx * inverse.imag
    of_loss[:, 0] = load * factor[:, 0] * band_loss
    of_loss[:, -1] = 0
    if abs((of_loss * stress).sum() - result.hysteresis) > 1e-9 * result.hysteresis:
        raise AssertionError(("the waves do not dissipate mu", row["case"]))
    edges = rings(float(row["k0"]), float(row["k1"]), points / 2)

    def by_ring(modes):
        return np.histogram(k, edges, weights=modes)[0]

    sums = {"complete": by_ring(complete), "stress": by_ring(stress)}
    sums |= {"loss": by_ring(of_loss * stress), "even": by_ring(of_loss * complete)}
    rough = (edges[:-1] > 0.5) & (edges[:-1] < 0.999 * float(row["k1"]))
    sums["complete"] = np.where(rough, sums["complete"], 0)
    sums["even"] *= sums["stress"] / np.where(rough, sums["complete"], np.inf)
    return (
        {"case": row["case"]}
        | contact_tables.figures(A=result.contact_area, mu=result.hysteresis)
        | {
            name: ";".join(f"{x:.5g}" for x in values)
            for name, values in ({"edges": edges} | sums).items()
        }
    )


def rows():
    """Return the rows of the table, lists as arrays."""
    return [
        row | {name: np.array([float(x) for x in row[name].split(";")]) for name in LISTS}
        for row in contact_tables.rows(TABLE)
    ]


def main():
    """Write exact_spectra.csv, or compare the rows that are named."""
    chosen = [row for row in make_exact_sliding.rows() if row["set"] == "judge"]
    if named := sys.argv[1:]:
        old = {row["case"]: row for row in rows()}
        for row in chosen:
            if row["case"] in named:
                new, known = solved(row), old[row["case"]]
                apart = {}
                for name in LISTS[1:]:
                    result = np.array([float(x) for x in new[name].split(";")])
                    apart[name] = np.abs(result - known[name]).max() / (
                        np.abs(known[name]).max() or 1
                    )
                print(row["case"], {name: f"{value:.1e}" for name, value in apart.items()})
        return
    contact_tables.write(TABLE, COMMENT, [solved(row) for row in chosen])


if __name__ == "__main__":
    main()
