"""What every correction makes of mu and A/A0 where sliding contact was solved exactly.

    python tests/benchmarks/sliding_corrections.py [--output DIR]

Rows judge (Gaussian heights) and bent (skewed and otherwise) of
tests/reference/exact_sliding.csv, which no fit has seen, and the curves of three rubbers for a
picture. The theory is given the closed form of a Gaussian map's spectrum, scaled to its rms slope,
and the modes of a bent map. n is the mean of d ln(I1 / I2) / d ln omega over the band in ln q: +1
far below the rubber's times, 0 where the loss tangent is constant, -1 far above them;
p* = 1 / sqrt(8 G(q1)), at light load about half of A/A0.
"""

import sys
from collections.abc import Callable, Iterable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
import timing

import asperity
from asperity.correction import Correction
from asperity.draw.figure import new_figure, picture
from asperity.draw.style import colours

sys.path.insert(0, str(Path(__file__).parents[1] / "reference"))
import make_exact_sliding

Row = dict[str, str]
Maker = Callable[[asperity.HeightMap, float], Correction | None]


def peaks(map: asperity.HeightMap, distance: float) -> Any:
    return map.local_peaks(min_distance=distance, periodic=True)


def greenwood_williamson(reading: Any) -> Maker:
    return lambda map, k0: asperity.GreenwoodWilliamson(
        z_max=map.z_max,
        z_min=map.z_min,
        rms_height=map.rms_height,
        q0=2 * np.pi * k0,
        reading=reading,
    )


CORRECTIONS: dict[str, Maker] = {
    "none": lambda map, k0: None,
    "S, 0.40": lambda map, k0: asperity.SFactor(gamma=0.4),
    "S, 0.50": lambda map, k0: asperity.SFactor(gamma=0.5),
    "S in G, 5/9": lambda map, k0: asperity.SFactor(gamma=5 / 9, applies_to="area"),
    "Nayak S": lambda map, k0: asperity.NayakSFactor(),
    "peaks, lambda0": lambda map, k0: asperity.LocalPeaks(peaks(map, 1 / k0), z_max=map.z_max),
    "peaks, lambda0/2": lambda map, k0: asperity.LocalPeaks(peaks(map, 0.5 / k0), z_max=map.z_max),
    "IGW implicit": greenwood_williamson("implicit"),
    "IGW added": greenwood_williamson("added"),
    "peaks, then IGW": lambda map, k0: asperity.PeaksThenGreenwoodWilliamson(
        peaks(map, 0.5 / k0),
        z_max=map.z_max,
        z_min=map.z_min,
        rms_height=map.rms_height,
        q0=2 * np.pi * k0,
    ),
    "partial contact": lambda map, k0: asperity.PartialContact(),
}
SPEEDS = {"slow": (0.3, 2.0), "constant": (-0.3, 0.3), "fast": (-2.0, -0.3)}
LOADS = ((0.0, 0.02), (0.02, 0.06), (0.06, 0.2), (0.2, np.inf))
FEWEST = 4  # contacts for an entry of the table
BENT = {  # heights that are not Gaussian
    "skewness -1": ("skew", "-1"),
    "skewness +1": ("skew", "1"),
    "high peaks": ("exp", "0"),
    "tops cut or rounded": ("mexp cut softcut square atan", "0"),
}


@dataclass(frozen=True)
class Errors:
    """Of mu and A of one contact, by the correction's name; NaN where it cannot be made."""

    row: Row
    mu: dict[str, float]
    area: dict[str, float]


def spectrum_of(row: Row, map: asperity.HeightMap) -> Any:
    if row["kind"] in ("gauss", "skew"):
        made: Any = asperity.SelfAffineSpectrum(
            rms_height=1,
            hurst=float(row["hurst"]),
            q0=2 * np.pi * float(row["k0"]),
            q1=2 * np.pi * float(row["k1"]),
        )
    else:
        made = asperity.power_spectrum(map, window="none", detrend=None)
    return made.scaled(1 / made.rms_slope**2)


class Contacts:
    """Makes a map's spectrum and corrections once."""

    def __init__(self) -> None:
        self.key: tuple[str, ...] = ()

    def predicted(self, row: Row) -> dict[str, tuple[float, float]]:
        names = ("kind", "skewness", "points", "k0", "k1", "hurst", "seed")
        if (key := tuple(row[name] for name in names)) != self.key:
            self.key = key
            map = make_exact_sliding.surface(row)
            self.spectrum = spectrum_of(row, map)
            self.corrections = {}
            for name, make in CORRECTIONS.items():
                try:
                    self.corrections[name] = make(map, float(row["k0"]))
                except asperity.InvalidInput:  # fewer than 3 peaks
                    continue
        rubber = make_exact_sliding.rubber(row["rubber"])
        found = {}
        for name in CORRECTIONS:
            found[name] = (np.nan, np.nan)
            if name in self.corrections:
                result: Any = asperity.friction(
                    self.spectrum,
                    rubber,
                    pressure=float(row["pressure"]),
                    velocity=float(row["velocity"]) or 1e-12,
                    correction=self.corrections[name],
                )
                found[name] = (float(result.hysteresis), float(result.contact_area))
        return found


def judged(rows: Iterable[Row]) -> list[Errors]:
    contacts, result = Contacts(), []
    for row in rows:
        found = contacts.predicted(row)
        mu, area = float(row["mu"]), float(row["A"])
        result.append(
            Errors(
                row,
                {name: m / mu - 1 if row["rubber"] != "elastic" else np.nan
                 for name, (m, _) in found.items()},
                {name: a / area - 1 for name, (_, a) in found.items()},
            )
        )  # fmt: skip
    return result


def figures(errors: Iterable[float]) -> tuple[int, float, float, float, float]:
    """Number, root mean square, mean, lowest and highest, in %."""
    e = 100 * np.array([x for x in errors if np.isfinite(x)])
    if e.size < FEWEST:
        return (e.size, *[np.nan] * 4)
    return (e.size, np.sqrt(np.mean(e**2)), e.mean(), e.min(), e.max())


def groups(found: list[Errors]) -> dict[tuple[str, str, str], list[Errors]]:
    """By heights, speed and load."""
    result: dict[tuple[str, str, str], list[Errors]] = {}
    for heights, chosen in (("Gaussian", "judge"), ("bent", "bent")):
        of_set = [e for e in found if e.row["set"] == chosen]
        sliding = [e for e in of_set if e.row["rubber"] != "elastic"]
        result[heights, "all", "A > 0.02"] = [e for e in sliding if float(e.row["A"]) > 0.02]
        result[heights, "all", "A < 0.02"] = [e for e in sliding if float(e.row["A"]) <= 0.02]
        result[heights, "elastic", "all"] = [e for e in of_set if e.row["rubber"] == "elastic"]
        for speed, (low, high) in SPEEDS.items():
            for least, most in LOADS:
                result[heights, speed, f"p* {least:g} to {most:g}"] = [
                    e
                    for e in sliding
                    if low < float(e.row["n"]) <= high and least <= float(e.row["pstar"]) < most
                ]
    for heights, (kinds, skewness) in BENT.items():
        result[heights, "all", "A > 0.02"] = [
            e
            for e in found
            if e.row["kind"] in kinds.split() and float(e.row["skewness"]) == float(skewness)
        ]
    return {key: group for key, group in result.items() if group}


def text(header: tuple[str, ...], lines: list[tuple[Any, ...]]) -> str:
    def cell(x: Any) -> str:
        return x if isinstance(x, str) else "" if np.isnan(x) else f"{x:.0f}"

    return timing.markdown(header, [[cell(x) for x in line] for line in lines])


def curves_picture(rows: list[Row]) -> bytes:
    """mu and A over velocity of three rubbers: exact as marks, predicted as lines."""
    figure, panels = new_figure(2)
    shown = {"none": ":", "Nayak S": "--", "partial contact": "-"}
    names = list(dict.fromkeys(row["rubber"] for row in rows))
    contacts = Contacts()
    for name, colour in zip(names, colours(len(names)), strict=True):
        own = [row for row in rows if row["rubber"] == name]
        v = [float(row["velocity"]) for row in own]
        found = [contacts.predicted(row) for row in own]
        for axes, exact, which in ((panels[0], "mu", 0), (panels[1], "A", 1)):
            values = [float(row[exact]) for row in own]
            axes.plot(v, values, "o", color=colour, markersize=4, label=f"exact, {name}")
            for correction, dash in shown.items():
                line = [point[correction][which] for point in found]
                axes.plot(v, line, dash, color=colour)
    for correction, dash in shown.items():
        panels[0].plot([], [], dash, color="0.3", label=correction)
    for axes, label in zip(panels, ("$\\mu_H$ [-]", "$A/A_0$ [-]"), strict=True):
        axes.set_xscale("log")
        axes.set_ylim(bottom=0)
        axes.set_xlabel("$v / (L / \\tau_1)$ [-]")
        axes.set_ylabel(label)
    figure.legend(*panels[0].get_legend_handles_labels(), loc="outside right upper")
    return picture(figure, Path("sliding_curves.png"))


def make() -> timing.Report:
    rows = make_exact_sliding.rows()
    found = judged(row for row in rows if row["set"] in ("judge", "bent"))
    header = ("heights", "speed", "load", "correction", "contacts")
    header += tuple(f"{of} {what}" for of in ("mu", "A") for what in ("rms", "mean", "min", "max"))
    lines = []
    for key, group in groups(found).items():
        for name in CORRECTIONS:
            mu = figures(e.mu[name] for e in group)
            area = figures(e.area[name] for e in group)
            lines.append((*key, name, str(len(group)), *mu[1:], *area[1:]))
    columns = {
        name: [line[i] if isinstance(line[i], str) else f"{line[i]:.1f}" for line in lines]
        for i, name in enumerate(header)
    }
    curves = [row for row in rows if row["set"] == "curve"]
    files = {
        "sliding_corrections.csv": timing.table("sliding_corrections", columns),
        "sliding_curves.png": curves_picture(curves),
    }
    return timing.Report(text(header, lines), files)


if __name__ == "__main__":
    timing.run(make, __doc__)
