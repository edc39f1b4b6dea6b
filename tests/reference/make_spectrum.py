"""Density, rms slope and slope cut-off of self-affine spectra, from their definitions.

2 pi int q C dq = h_rms^2 fixes the amplitude, h'^2 = 2 pi int q^3 C dq; slope_cutoff is the upper
limit at which the rms slope reaches 1.3. First evaluation: mpmath quadrature in ln q, the cut-off
by a root search over it. Second: closed forms.
"""

from itertools import pairwise

import mpmath as mp
import tables

mp.mp.dps = 30
SLOPE = mp.mpf("1.3")


class Spectrum:
    """Power law on [rolloff, q1], flat on [q0, rolloff]."""

    def __init__(self, rms_height, hurst, q0, q1, rolloff):
        """Fix the amplitude by both evaluations."""
        self.h, self.q0, self.q1 = (mp.mpf(v) for v in (hurst, q0, q1))
        self.qr = mp.mpf(rolloff) if rolloff else self.q0
        self.level = mp.mpf(1)
        self.level = mp.mpf(rms_height) ** 2 / self.moment(2, self.q1)
        closed = self.level / self.moment_closed(2, self.q1) * self.moment(2, self.q1)
        tables.agree("spectrum", self.level, closed, 1e-18)

    def density(self, q):
        """Return C(q)."""
        return self.level * (max(q, self.qr) / self.qr) ** (-2 * (self.h + 1))

    def moment(self, power, upper):
        """Return 2 pi int_q0^upper q^(power - 1) C dq by quadrature."""
        ends = [self.q0, *([self.qr] if self.q0 < self.qr < upper else []), upper]
        edges = []
        for low, high in pairwise(ends):
            pieces = int(mp.ceil(mp.log(high / low)))
            edges += mp.linspace(mp.log(low), mp.log(high), pieces + 1)[:-1]
        edges.append(mp.log(upper))
        return 2 * mp.pi * mp.quad(lambda y: mp.exp(power * y) * self.density(mp.exp(y)), edges)

    def moment_closed(self, power, upper):
        """Return the same in closed form."""
        flat = (min(self.qr, upper) ** power - self.q0**power) / power
        if upper <= self.qr:
            return 2 * mp.pi * self.level * flat
        rest = power - 2 * (self.h + 1)
        log = mp.log(upper / self.qr)
        tail = self.qr**power * (mp.expm1(rest * log) / rest if rest else log)
        return 2 * mp.pi * self.level * (flat + tail)

    def cutoff(self, moment, near=None):
        """Return the q at which the rms slope reaches SLOPE, or q1; sought close to `near`."""
        if moment(4, self.q1) < SLOPE**2:
            return self.q1
        low, high = self.q0, self.q1
        if near:
            low, high = near * (1 - mp.mpf(10) ** -9), near * (1 + mp.mpf(10) ** -9)
        elif self.qr > self.q0:  # one side of the kink
            low, high = (low, self.qr) if moment(4, self.qr) > SLOPE**2 else (self.qr, high)

        def miss(y):
            return moment(4, mp.exp(y)) / SLOPE**2 - 1

        bracket = (mp.log(low), mp.log(high))
        return mp.exp(mp.findroot(miss, bracket, solver="anderson", tol=1e-44, maxsteps=200))


def row(case, rms_height, hurst, q0, q1, rolloff, wavenumber):
    """Return one row, both evaluations compared."""
    surface = Spectrum(rms_height, hurst, q0, q1, rolloff)
    slope = mp.sqrt(surface.moment(4, surface.q1))
    tables.agree("spectrum", slope, mp.sqrt(surface.moment_closed(4, surface.q1)), 1e-18)
    closed = surface.cutoff(surface.moment_closed)
    cutoff = surface.cutoff(surface.moment, closed)
    tables.agree("spectrum", cutoff, closed, 1e-16)
    return {
        "case": case,
        "rms_height": rms_height,
        "hurst": hurst,
        "q0": q0,
        "q1": q1,
        "rolloff": rolloff,
        "wavenumber": wavenumber,
        "density": surface.density(mp.mpf(wavenumber)),
        "rms_slope": slope,
        "slope_cutoff": cutoff,
        "rtol": 1e-12 if q1 > 1.01 * q0 else 1e-11,  # q1 / q0 rounded costs 1e-12 there
    }


def main():
    """Write spectrum.csv."""
    asphalt, sandpaper = (265.7e-6, 0.87, 2000.0, 1e6), (76.572e-6, 0.7, 2000.0, 1e6)
    rows = [
        row("asphalt", *asphalt, None, 2e4),
        row("sandpaper", *sandpaper, None, 2e4),
        row("sandpaper at q0", *sandpaper, None, 2000.0),
        row("sandpaper at q1", *sandpaper, None, 1e6),
        row("asphalt rolled off in the flat part", *asphalt, 9000.0, 5000.0),
        row("asphalt rolled off at the kink", *asphalt, 9000.0, 9000.0),
        row("asphalt rolled off on the power law", *asphalt, 9000.0, 5e5),
        row("steep inside the flat part", 1e-3, 0.8, 100.0, 1e6, 1e4, 1e3),
        row("cut-off close to the roll-off", 1e-3, 0.8, 100.0, 1e6, 1.6e3, 2e3),
        row("hurst 1", 1e-4, 1.0, 2000.0, 1e6, None, 3e5),
        row("hurst 1 steep", 1e-3, 1.0, 2000.0, 1e6, None, 3e5),
        row("hurst 1 rolled off", 1e-4, 1.0, 2000.0, 1e6, 3e3, 3e5),
        row("hurst nearly 1", 3e-4, 1 - 1e-12, 2000.0, 1e6, None, 3e5),
        row("hurst 0.01", 1e-6, 0.01, 2000.0, 1e6, None, 3e5),
        row("hurst 1e-9", 1e-7, 1e-9, 2000.0, 1e6, None, 3e5),
        row("bandwidth 1.0001", 1e-4, 0.8, 2000.0, 2000.2, None, 2000.1),
        row("bandwidth 1.0001 steep", 1e-3, 0.8, 2000.0, 2000.2, None, 2000.1),
        row("bandwidth 1e6", 1e-6, 0.8, 200.0, 2e8, None, 1e7),
        row("bandwidth 1e12", 1e-9, 0.5, 1.0, 1e12, None, 1e7),
        row("nanoscale", 1e-9, 0.8, 1e6, 1e10, None, 1e8),
    ]
    for answer, slope, ratio in ((rows[0], 2.76, 11.7), (rows[1], 1.49, 320)):
        result = answer["slope_cutoff"] / answer["q0"]
        print(f"{answer['case']}: slope {float(answer['rms_slope']):.4f}, cut {float(result):.2f}")
        assert abs(answer["rms_slope"] - slope) < 0.005
        assert abs(result / ratio - 1) < 0.005
    comments = [
        "Self-affine spectrum, rms height exact on its band: THEORY.md section 1 (article Eq. 12).",
        "slope_cutoff: q at which the cumulative rms slope reaches 1.3, q1 if never.",
        "Generated by make_spectrum.py with 30 digits from the definition.",
        "Units: rms_height m; q0, q1, rolloff, wavenumber, slope_cutoff 1/m; density m^4.",
    ]
    tables.write("spectrum", comments, rows)


if __name__ == "__main__":
    main()
