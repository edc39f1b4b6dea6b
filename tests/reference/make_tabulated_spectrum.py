"""Density and moments of tabulated spectra, from their definitions.

Between rows ln C is linear in ln q; a segment with a zero at either end is linear in q instead.
h_rms^2 = 2 pi int q C dq, h'^2 = 2 pi int q^3 C dq; slope_cutoff as in make_spectrum.py. First
evaluation: mpmath quadrature segment by segment. Second: closed forms.
"""

from itertools import pairwise

import mpmath as mp
import tables

mp.mp.dps = 40
SLOPE = mp.mpf("1.3")


def density(segment, q):
    """Return C(q) inside a segment ((qa, qb), (Ca, Cb))."""
    (qa, qb), (ca, cb) = segment
    if ca == 0 or cb == 0:
        return ca + (cb - ca) * (q - qa) / (qb - qa)
    return ca * (q / qa) ** (mp.log(cb / ca) / mp.log(qb / qa))


def moment(segment, power, upper):
    """Return 2 pi int_qa^upper q^(power - 1) C dq by quadrature, split for steep segments."""
    edges = mp.linspace(mp.log(segment[0][0]), mp.log(upper), 9)
    return 2 * mp.pi * mp.quad(lambda y: mp.exp(power * y) * density(segment, mp.exp(y)), edges)


def moment_closed(segment, power, upper):
    """Return the same in closed form."""
    (qa, qb), (ca, cb) = segment
    if ca == 0 or cb == 0:
        slope = (cb - ca) / (qb - qa)
        total = (ca - slope * qa) * (upper**power - qa**power) / power
        total += slope * (upper ** (power + 1) - qa ** (power + 1)) / (power + 1)
        return 2 * mp.pi * total
    rest = power + mp.log(cb / ca) / mp.log(qb / qa)
    log = mp.log(upper / qa)
    return 2 * mp.pi * ca * qa**power * (mp.expm1(rest * log) / rest if rest else log)


def cutoff(segments, integral):
    """Return the q at which the rms slope reaches SLOPE, or the last wavenumber."""
    before = mp.mpf(0)
    for segment in segments:
        (qa, qb), _ = segment
        whole = integral(segment, 4, qb)
        if before + whole >= SLOPE**2:
            low, high = qa, qb  # bisect to bracket, then the secant rule inside it

            def miss(q, segment=segment, before=before, qa=qa):
                return (before + (integral(segment, 4, q) if q > qa else 0)) / SLOPE**2 - 1

            for _ in range(12):
                middle = (low + high) / 2
                low, high = (low, middle) if miss(middle) > 0 else (middle, high)
            return mp.findroot(miss, (low, high), solver="anderson", tol=1e-50, maxsteps=200)
        before += whole
    return segments[-1][0][1]


def rows_of(name, wavenumber, densities, places):
    """Return one row for every wavenumber in `places`, both evaluations compared."""
    q, c = ([mp.mpf(v) for v in column] for column in (wavenumber, densities))
    segments = list(zip(pairwise(q), pairwise(c), strict=True))
    results = []
    for integral in (moment, moment_closed):
        results.append([mp.sqrt(sum(integral(s, p, s[0][1]) for s in segments)) for p in (2, 4)])
        results[-1].append(cutoff(segments, integral))
    for first, second in zip(*results, strict=True):
        tables.agree("tabulated_spectrum", first, second, 1e-16)
    height, slope, end = results[0]
    for place in places:
        segment = next(s for s in segments if s[0][0] <= place <= s[0][1])
        yield {
            "case": f"{name} at {place:.6g}",
            "table_wavenumber": wavenumber,
            "table_density": densities,
            "wavenumber": place,
            "density": density(segment, mp.mpf(place)),
            "rms_height": height,
            "rms_slope": slope,
            "slope_cutoff": end,
            "rtol": 1e-12,
        }


def power_law(level, exponent, wavenumber):
    """Return densities level (q / q[0])^exponent, rounded to doubles."""
    return [level * (q / wavenumber[0]) ** exponent for q in wavenumber]


def main():
    """Write tabulated_spectrum.csv."""
    decades = [1e3, 1e4, 1e5, 1e6]
    uneven = [2e3, 2.1e3, 5e3, 5.5e3, 1e5]
    cases = [
        ("two rows", [1e3, 1e6], [1e-12, 1e-23], [1e3, 3e4, 1e6]),
        ("two rows rising", [1e3, 2e3], [1e-16, 1e-15], [1.5e3]),
        ("flat", [1e3, 1e5], [1e-18, 1e-18], [2e4]),
        ("exponent -2", decades, power_law(1e-15, -2, decades), [5e4]),
        ("exponent -4", decades, power_law(1e-14, -4, decades), [5e4]),
        ("exponent -4 over all", [1e3, 1e6], [1e-13, 1e-25], [5e4]),
        ("exponent nearly -4", [1e3, 1e6], [1e-13, 1.00001e-25], [5e4]),
        ("five uneven rows", uneven, [1e-14, 9e-15, 2e-15, 1e-17, 1e-20], [2e3, 3e3, 5.2e3, 5e4]),
        ("five rows steep", uneven, [1e-14, 1e-30, 1e-13, 1e-40, 1e-38], [2.05e3, 4e3, 5.4e3]),
        ("zero in the middle", uneven, [1e-13, 5e-14, 0.0, 1e-15, 1e-19], [3e3, 5e3, 5.3e3, 5e4]),
        ("zeros at the ends", uneven, [0.0, 1e-13, 1e-14, 1e-15, 0.0], [2e3, 2.04e3, 4e4, 1e5]),
        ("zero segment", uneven, [1e-13, 0.0, 0.0, 1e-15, 1e-17], [2.09e3, 3e3, 5.2e3]),
        ("cut-off in a linear segment", uneven, [0.0, 0.0, 1e-13, 1e-13, 0.0], [4e3, 5.2e3]),
        ("close rows", [1e4, 1e4 * (1 + 1e-9), 2e4], [1e-16, 2e-16, 1e-17], [1e4, 1.5e4]),
    ]
    rows = [row for case in cases for row in rows_of(*case)]
    comments = [
        "Tabulated spectrum: log-log linear between rows, linear in q where an end is zero.",
        "h_rms^2 = 2 pi int q C dq, h'^2 = 2 pi int q^3 C dq (THEORY.md section 1).",
        "slope_cutoff: q at which the cumulative rms slope reaches 1.3, the last row if never.",
        "Generated by make_tabulated_spectrum.py with 40 digits from the definition.",
        "Units: wavenumbers, slope_cutoff 1/m; densities m^4; rms_height m; rms_slope none.",
    ]
    tables.write("tabulated_spectrum", comments, rows)


if __name__ == "__main__":
    main()
