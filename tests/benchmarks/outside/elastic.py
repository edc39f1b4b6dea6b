"""Elastic contacts of another group beside every correction, their gaps beside those of `slide`.

    python tests/benchmarks/outside/elastic.py CLONE

CLONE is one of xylcsi/PerssonModelFudgeFactor: Green's function molecular dynamics of Y. Zhou,
areas in the mean of maps (Data/Area_GFMD_Zhou.mat) and gaps of a set (GFMD_final_results_*.mat).
The maps' law is that of its Fig_2_program.m: H 0.8, q0 1e4 and q1 1e6 1/m, h_rms 6e-6 m, E* 1.
Their areas count whole pixels. What that adds is not in the files, nor how many pixels there are;
here it is what it adds on a map of that law with 10 and with 5 pixels to the shortest wave.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import clone
import numpy as np
from scipy.io import loadmat

import asperity
from asperity.validation import slide
from asperity_scripts.validate.contacts import Contact
from asperity_scripts.validate.predictions import Model, models_for, predict

Array = np.ndarray
LAW = asperity.SelfAffineSpectrum(rms_height=6e-6, hurst=0.8, q0=1e4, q1=1e6)
LIGHT = (5e-3, 0.113)  # E*, where pixels are worth most and maps scatter little
SEEDS, POINTS = (1, 2), (1024, 512)
SOLID = asperity.PronySeries(equilibrium_modulus=1.0, moduli=[], relaxation_times=[])
MORE = (
    Model("S of A, 0.42", "", lambda _: asperity.ImplicitSFactor(gamma=0.42)),
    Model("`PartialContact`", "", lambda _: asperity.PartialContact()),
)


def map_of(seed: int, points: int, longest: int = 1) -> asperity.HeightMap:
    """With so many of the longest waves along a side."""
    pixel = longest * 2 * np.pi / LAW.q0 / points
    return asperity.synthesize(LAW, shape=(points, points), pixel_size=pixel, seed=seed)


def excess(pressure: Array, points: int) -> Array:
    """Whole pixels over the area without the perimeter's excess."""
    surface, at = map_of(SEEDS[0], points), {"velocity": 0.0, "poisson_ratio": 0.0}
    solved = [slide(surface, SOLID, pressure=p, **at, periodic=True, rtol=1e-8) for p in pressure]
    return np.array([one.contact_area_raw / one.contact_area for one in solved])


def contacts(pressure: Array, area: Array) -> list[Contact]:
    """As `asperity validate` takes them, without heights: of peaks the files say nothing."""
    unknown: dict[str, Any] = {"z_max": np.nan, "z_min": np.nan, "peaks": {}, "energy": np.nan}
    return [
        Contact(
            case=f"{p:g}",
            spectrum=LAW,
            hurst=0.8,
            q0=None,
            rms_height=LAW.rms_height,
            effective_modulus=1.0,
            pressure=float(p),
            area=float(a),
            **unknown,
        )
        for p, a in zip(pressure, area, strict=True)
    ]


def errors(model: Model, of: Sequence[Contact]) -> Array:
    return np.array([predict(one, model).area_error for one in of])


@dataclass(frozen=True)
class Gaps:
    """Shares of the surface beyond gaps [h_rms], and those of maps of ours."""

    pressure: float
    area: float
    gap: Array
    beyond: Array
    own: Array  # (maps, gaps)

    @property
    def off(self) -> Array:
        return self.own.mean(axis=0) - self.beyond

    @property
    def scatter(self) -> float:
        return float(abs(self.own - self.own.mean(axis=0)).max())


def gaps(root: Path) -> list[Gaps]:
    """The distributions as counts up to the edges of bins: the first one, half as wide beside
    contact, has contact too. Maps of ours have four of the longest waves to a side."""
    result = []
    maps = [map_of(seed, POINTS[0], longest=4) for seed in SEEDS]
    for name in ("low", "high"):
        data = loadmat(root / f"Data/GFMD_final_results_{name}_from_Zhou.mat")
        columns = (data[f"{key}_{name}"].T for key in ("p_bar", "CR", "gap_GFMD", "PDF_GFMD"))
        pressures, areas, gap, density = columns
        for p, area, g, d in zip(pressures.ravel(), areas.ravel(), gap, density, strict=True):
            width = g[2] - g[1]
            edges = g + width / 2
            own = []
            for surface in maps:
                at = {"pressure": float(p), "velocity": 0.0, "poisson_ratio": 0.0}
                solved = np.sort(slide(surface, SOLID, **at, periodic=True, rtol=1e-4).gap.ravel())
                own.append(1 - np.searchsorted(solved, edges * surface.rms_height) / solved.size)
            result.append(
                Gaps(float(p), float(area), edges, 1 - np.cumsum(d) * width, np.array(own))
            )
    return result


def main() -> None:
    root = clone.given("xylcsi/PerssonModelFudgeFactor", "Data/Area_GFMD_Zhou.mat")
    data = loadmat(root / "Data/Area_GFMD_Zhou.mat")
    pressure, printed = data["p_bar"].ravel(), data["area_mean"].ravel()
    areas = {"as printed": printed}
    for points in POINTS:
        areas[f"for {points // 100} pixels a wave"] = printed / excess(pressure, points)
    print(f"rms slope of the law {LAW.rms_slope:.4f}\n\n| p / E* | " + " | ".join(areas) + " |")
    print("| --- " * (1 + len(areas)) + "|")
    for row in zip(pressure, *areas.values(), strict=True):
        print("| " + " | ".join(f"{cell:.4g}" for cell in row) + " |")
    sets = {name: contacts(pressure, area) for name, area in areas.items()}
    light = (pressure >= LIGHT[0]) & (pressure <= LIGHT[1])
    print("\nrms (mean, worst) in %; mean of loads from 0.005 to 0.113:\n")
    print("| correction | " + " | ".join(sets) + " |\n" + "| --- " * (1 + len(sets)) + "|")
    for model in (*models_for(sets["as printed"]), *MORE):
        cells = []
        for of in sets.values():
            off = 100 * errors(model, of)
            worst = off[np.argmax(abs(off))]
            rms = np.sqrt(np.mean(off**2))
            cells.append(f"{rms:.1f} ({off.mean():+.1f}, {worst:+.0f}); {off[light].mean():+.1f}")
        print(f"| {model.name} | " + " | ".join(cells) + " |")
    distributions = gaps(root)
    print("\nshare of the surface beyond a gap, largest difference:\n")
    print("| p / E* | A | to the mean of our maps | among these | mean gap over theirs |")
    print("| --- " * 5 + "|")
    for one in distributions:
        ratio = np.trapezoid(one.own.mean(axis=0), one.gap) / np.trapezoid(one.beyond, one.gap)
        row = (one.pressure, one.area, abs(one.off).max(), one.scatter, ratio)
        print("| " + " | ".join(f"{cell:.3g}" for cell in row) + " |")


if __name__ == "__main__":
    main()
