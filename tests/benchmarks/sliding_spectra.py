"""Where PartialContact errs: its stress spectrum against those of exact sliding contacts, by parts.

    python tests/benchmarks/sliding_spectra.py [--output DIR]

The contacts are those of tests/reference/exact_spectra.csv, maps that no fit has seen; the rule is
that of tests/reference/fit_partial_contact.py. R is |p_q|^2 over that of complete contact; exact mu
is the sum of q_x Im K |p_q|^2 / sigma0 over all waves, so that the rule's error of it adds up from
  direction  the R of a ring for all directions, less that of each wave;
  map        C(q) for the waves that the map has;
  first, middle, last   R of the rule for the exact one, by thirds of the band in ln q; T from q_e
             to q1 is in the last, and what exact contacts have below q0 in the first;
  beyond     T beyond q1.
Then one thing is made exact at a time. The area follows from the variance of the stress, so that
its error is parted too: with the exact variance, with and without the factor B.
"""

import sys
from pathlib import Path
from typing import Any

import numpy as np
import timing

from asperity.plot.curves import colours, new_figure, picture

sys.path.insert(0, str(Path(__file__).parents[1] / "reference"))
import fit_partial_contact as rule
import make_exact_sliding
import make_exact_spectra

Values = np.ndarray[Any, Any]
PARTS = ("direction", "map", "first", "middle", "last", "beyond")
SHOWN = {"slow": "jlow_23", "constant": "ja_28", "fast": "jlow_13"}


class Judged:
    """Contacts with their exact spectra and those of the rule."""

    def __init__(self) -> None:
        self.spectra = make_exact_spectra.rows()
        inputs = {row["case"]: row for row in make_exact_sliding.rows()}
        self.rows = [inputs[spectrum["case"]] for spectrum in self.spectra]
        names = ("hurst", "k0", "k1", "velocity", "pressure", "A", "mu")
        self.contacts = rule.Contacts(
            [(row["rubber"], *(float(row[n]) for n in names), 1.0, False) for row in self.rows]
        )
        self.numbers = [*rule.STATED.values()]
        self.stress = self.contacts.root(self.numbers)
        self.mu = np.array([float(spectrum["mu"]) for spectrum in self.spectra])
        self.variance = np.array([spectrum["stress"].sum() / 2 for spectrum in self.spectra])
        self.n = np.array([float(row["n"]) for row in self.rows])
        self.finest = np.array([float(row["points"]) / 2 for row in self.rows])  # of the grid
        nodes = self.contacts.dg.shape[1]
        self.place = (np.arange(nodes) + 0.5) / nodes  # in the band, of ln q

    def wavenumber(self, i: int) -> Values:
        """q / (2 pi) of the nodes of a contact."""
        c = self.contacts
        return c.k0[i] * (c.k1[i] / c.k0[i]) ** self.place

    def exact(self, i: int) -> tuple[Values, Values]:
        """R by rings, and at the nodes of the rule."""
        spectrum = self.spectra[i]
        complete = spectrum["complete"]
        share = np.where(complete > 0, spectrum["stress"] / np.where(complete > 0, complete, 1), 0)
        ring = np.searchsorted(spectrum["edges"], self.wavenumber(i)) - 1
        return share, share[ring]

    def parts(self, i: int) -> dict[str, float]:
        """The parts of the error of mu, over mu."""
        c, spectrum = self.contacts, self.spectra[i]
        loss, rough = spectrum["loss"], spectrum["complete"] > 0
        weight = 4 * (1 - rule.NU**2) * c.load[i] * c.i1[i] / c.i2[i] * c.dg[i]
        of_ring = self.exact(i)[1]
        edges = 4 * (1 - rule.NU**2) * c.load[i] * c.t1[i] / c.t2[i] * rule.TAIL_STEP
        edges = edges * self.stress.beyond[i]
        off_band = c.end[i] * np.exp(rule.TAIL) > c.k1[i]
        found = {
            "direction": spectrum["even"].sum() - loss[rough].sum(),
            "map": (of_ring * weight).sum() - spectrum["even"].sum(),
        }
        for third, name in enumerate(("first", "middle", "last")):
            here = (3 * self.place).astype(int) == third
            found[name] = ((self.stress.band[i] - of_ring) * weight)[here].sum()
        found["first"] -= loss[0]
        found["last"] += edges[~off_band].sum()
        found["beyond"] = edges[off_band].sum() - (self.mu[i] - loss[0] - loss[rough].sum())
        return {name: value / self.mu[i] for name, value in found.items()}


def figures(errors: Values) -> tuple[float, float, float, float]:
    """Root mean square, mean, lowest and highest, in %."""
    e = 100 * errors
    return float(np.sqrt(np.mean(e**2))), float(e.mean()), float(e.min()), float(e.max())


def table_of(judged: Judged) -> dict[str, Values]:
    """Errors of mu by parts and with one thing exact, and of A; NaN for elastic contacts' mu."""
    c, count = judged.contacts, len(judged.rows)
    moving = judged.mu > 0
    columns = {name: np.full(count, np.nan) for name in PARTS}
    for i in np.flatnonzero(moving):
        for name, value in judged.parts(i).items():
            columns[name][i] = value
    whole = sum(columns[name] for name in PARTS)
    exact_variance = c.root(judged.numbers, judged.variance)
    without_b = c.root([*judged.numbers[:3], 0.0, 0.0], judged.variance)
    with np.errstate(divide="ignore", invalid="ignore"):
        of_variance = c.hysteresis(exact_variance) / judged.mu - 1
    return {
        "mu": whole,
        **columns,
        "mu, exact directions": whole - columns["direction"],
        "mu, exact R": whole - sum(columns[name] for name in ("first", "middle", "last")),
        "mu, exact beyond": whole - columns["beyond"],
        "mu, exact R and beyond": columns["direction"] + columns["map"],
        "mu, exact variance": np.where(moving, of_variance, np.nan),
        "A": judged.stress.area / c.area - 1,
        "A, exact variance": exact_variance.area / c.area - 1,
        "A, exact variance, B = 1": without_b.area / c.area - 1,
    }


def groups(judged: Judged) -> dict[str, Values]:
    area, ratio = judged.contacts.area, judged.contacts.k1 / judged.contacts.k0
    moving, n, hurst = judged.mu > 0, judged.n, judged.contacts.hurst
    return {
        "all": moving,
        "A > 0.02": moving & (area > 0.02),
        "A < 0.02": moving & (area <= 0.02),
        "slow": moving & (n > 0.3),
        "constant": moving & (np.abs(n) <= 0.3),
        "fast": moving & (n < -0.3),
        "H < 0.5": moving & (hurst < 0.5),
        "H > 0.5": moving & (hurst > 0.5),
        "q1/q0 8": moving & (ratio < 12),
        "q1/q0 16 to 64": moving & (ratio > 12),
        "elastic": ~moving,
    }


def shapes(judged: Judged) -> list[tuple[str, list[float]]]:
    """Mean of ln(R of the rule / exact R) by the distance from q1 in ln q, of A < 0.1."""
    bands = ((0, 0.25), (0.25, 0.5), (0.5, 0.75), (0.75, 1), (1, 1.5), (1.5, 2), (2, 3))
    lines = []
    for name, low, high in (("H < 0.5", 0, 0.5), ("H 0.5 to 0.7", 0.5, 0.7), ("H > 0.7", 0.7, 1)):
        values: list[list[float]] = [[] for _ in bands]
        for i in np.flatnonzero((judged.contacts.area < 0.1) & (judged.mu > 0)):
            if not low < judged.contacts.hurst[i] <= high:
                continue
            of_ring, k = judged.exact(i)[1], judged.wavenumber(i)
            off = np.log(judged.contacts.k1[i] / k)
            with np.errstate(divide="ignore"):  # a ring without waves
                apart = np.log(judged.stress.band[i] / of_ring)
            for found, (nearest, farthest) in zip(values, bands, strict=True):
                here = (off >= nearest) & (off < farthest) & (of_ring > 0)
                here &= k > 1.3 * judged.contacts.k0[i]
                if here.any():
                    found.append(float(apart[here].mean()))
        lines.append((name, [float(np.mean(v)) if len(v) > 3 else np.nan for v in values]))
    return lines


def spectra_picture(judged: Judged) -> bytes:
    """R over q, and the friction per unit of ln q: exact by rings, predicted as lines."""
    figure, panels = new_figure(6)
    exact_colour, rule_colour = colours(2)
    cases = [row["case"] for row in judged.rows]
    for column, (speed, case) in enumerate(SHOWN.items()):
        i, c = cases.index(case), judged.contacts
        spectrum, k = judged.spectra[i], judged.wavenumber(i)
        edges = spectrum["edges"][1:]  # without what lies below k0
        middle, width = np.sqrt(edges[1:] * edges[:-1]), np.diff(np.log(edges))
        rough = spectrum["complete"][1:] > 0
        above, below = panels[column], panels[column + 3]
        above.plot(middle[rough], judged.exact(i)[0][1:][rough], "o", color=exact_colour,
                   markersize=4, label="exact")  # fmt: skip
        above.plot(k, judged.stress.band[i], color=rule_colour, label="rule")
        factor = 4 * (1 - rule.NU**2) * c.load[i]
        step = np.log(c.k1[i] / c.k0[i]) / k.size
        of_band = factor * c.i1[i] / c.i2[i] * judged.stress.band[i] * c.dg[i] / step
        x = c.end[i] * np.exp(rule.TAIL)
        of_edges = factor * c.t1[i] / c.t2[i] * judged.stress.beyond[i]
        below.plot(middle, spectrum["loss"][1:] / width, "o", color=exact_colour, markersize=4)
        # two curves, as both count between q_e and q1
        below.plot(k, of_band, color=rule_colour)
        below.plot(x, of_edges, "--", color=rule_colour, label="rule, edges (T)")
        below.axvline(c.k1[i], color="0.7", linewidth=0.8)
        row = judged.rows[i]
        above.set_title(f"{speed}: H {row['hurst']}, $A/A_0$ {c.area[i]:.3f}", fontsize=10)
        above.set_yscale("log")
        below.set_ylim(bottom=0)
        for axes in (above, below):
            axes.set_xscale("log")
            axes.set_xlim(0.9 * c.k0[i], 1.1 * judged.finest[i])
            axes.xaxis.set_minor_formatter("")
            axes.set_xlabel(r"$q L / 2 \pi$ [-]")
    panels[0].set_ylabel("$R$ [-]")
    panels[3].set_ylabel(r"$\mathrm{d}\mu_H / \mathrm{d} \ln q$ [-]")
    panels[0].legend()
    panels[3].legend()
    return picture(figure, Path("sliding_spectra.png"))


def make() -> timing.Report:
    judged = Judged()
    found = table_of(judged)
    header = ("contacts", "number", "error", "rms", "mean", "min", "max")
    lines: list[tuple[str, ...]] = []
    for group, members in groups(judged).items():
        for name, values in found.items():
            here = values[members]
            if np.isfinite(here).all():
                cells = [f"{x:.1f}" for x in figures(here)]
                lines.append((group, str(members.sum()), name, *cells))
    columns = {name: [line[i] for line in lines] for i, name in enumerate(header)}
    text = timing.markdown(header, lines)
    for name, values in shapes(judged):
        text += f"{name}: " + " ".join(f"{100 * x:+.0f}" for x in values) + "\n"
    files = {
        "sliding_spectra.csv": timing.table("sliding_spectra", columns),
        "sliding_spectra.png": spectra_picture(judged),
    }
    return timing.Report(text, files)


if __name__ == "__main__":
    timing.run(make, __doc__)
