"""ScanContact and the other corrections on surfaces of many kinds, against exact sliding contact.

    python tests/benchmarks/scan_contact.py [docs/benchmarks/scan_contact.png]
    python tests/benchmarks/scan_contact.py --picture docs/benchmarks/scan_contact.png
    python tests/benchmarks/scan_contact.py --large

Periodic maps of 256 x 256 points, 8 to the shortest wave, q1/q0 = 8, kinds and seeds that nothing
was fitted to; --large: of 1280 x 1280, q1/q0 = 40, which are not solved whole, and a third of the
velocities. Truth is `asperity.validation.slide` at velocities and pressures that are no nodes.
Prints Markdown.
"""

import sys
import time
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

import asperity
from asperity.draw.style import COLOURS
from asperity.validation import slide

LARGE, PICTURE = "--large" in sys.argv, "--picture" in sys.argv
LENGTH, LONGEST = 0.01, 4
POINTS = 1280 if LARGE else 256
SHORTEST = POINTS // 8
Array = np.ndarray


def gaussian(seed: int, ratio: float = 1.0) -> Array:
    """Heights of rms 1 with H = 0.8; `ratio` of the axes of C's ellipse, ridges along y."""
    rng = np.random.default_rng(seed)
    k = np.fft.fftfreq(POINTS, 1 / POINTS)
    q = np.hypot(k / np.sqrt(ratio), k[:, None] * np.sqrt(ratio))
    with np.errstate(divide="ignore"):
        amplitude = np.where((q >= LONGEST) & (q <= SHORTEST), q**-1.8, 0)
    return unit(np.fft.ifft2(amplitude * np.fft.fft2(rng.normal(size=(POINTS, POINTS)))).real)


def unit(heights: Array) -> Array:
    return (heights - heights.mean()) / heights.std()


def honed(seed: int) -> Array:
    """A smooth plateau with grooves of another scale."""
    plateau, deep = 0.25 * gaussian(seed), gaussian(seed + 500)
    return plateau - 1.5 * np.logaddexp(0, -4 * (deep + 0.8)) / 4


KINDS: dict[str, Callable[[int], Array]] = {
    "Gaussian": gaussian,
    "worn": lambda seed: -np.logaddexp(0, -1.5 * gaussian(seed)),
    "polished tops": lambda seed: np.minimum(z := gaussian(seed), 0.3 + 0.15 * np.tanh(z - 0.3)),
    "honed plateaus": honed,
    "peaks": lambda seed: np.exp(0.45 * gaussian(seed)),
    "ridges 3 : 1": lambda seed: gaussian(seed, 3.0),
}


def height_map(kind: str, seed: int) -> asperity.HeightMap:
    """Filtered to the band after the transform, of rms height 0.1 mm."""
    k = np.fft.fftfreq(POINTS, 1 / POINTS)
    q = np.hypot(k, k[:, None])
    inside = (q >= LONGEST) & (q <= SHORTEST)
    heights = np.fft.ifft2(np.where(inside, np.fft.fft2(KINDS[kind](seed)), 0)).real
    return asperity.HeightMap(1e-4 * unit(heights), pixel_size=LENGTH / POINTS)


def series(ratio: float, terms: int, shortest: float, longest: float) -> asperity.PronySeries:
    moduli = np.geomspace(1, 100, terms)
    return asperity.PronySeries(
        equilibrium_modulus=1e6,
        moduli=1e6 * (ratio - 1) * moduli / moduli.sum(),
        relaxation_times=np.geomspace(longest, shortest, terms) if terms > 1 else [longest],
    )


RUBBERS = {
    "1 term, 30": series(30, 1, 1e-4, 1e-4),
    "8 terms, 300": series(300, 8, 1e-7, 1e-1),
    "20 terms, 1000": series(1000, 20, 1e-9, 1e1),
}
PRESSURES = (3.7e4, 6.1e5)
VELOCITIES = 1.73 * np.geomspace(1e-5, 7, 9)
if LARGE:
    VELOCITIES = VELOCITIES[1::3]


def corrections(surface: asperity.HeightMap, scan: asperity.ScanContact) -> dict[str, Any]:
    q0 = 2 * np.pi * LONGEST / LENGTH
    ends: dict[str, Any] = {"z_max": surface.z_max, "z_min": surface.z_min, "q0": q0}
    far, near = (
        surface.local_peaks(min_distance=waves * 2 * np.pi / q0, periodic=True)
        for waves in (1, 0.5)
    )
    igw = asperity.GreenwoodWilliamson
    return {
        "none": None,
        "S on the integrand, 0.40": asperity.SFactor(gamma=0.4),
        "S on the integrand, 0.50": asperity.SFactor(gamma=0.5),
        "S inside G, 5/9": asperity.SFactor(gamma=5 / 9, applies_to="area"),
        "`NayakSFactor`": asperity.NayakSFactor(),
        "local peaks, lambda0": asperity.LocalPeaks(far),
        "local peaks, lambda0 / 2": asperity.LocalPeaks(near),
        "IGW, measured peaks": igw(peaks=near, **ends),
        "IGW, added": igw(peaks=near, reading="added", **ends),
        "peaks, then IGW": asperity.PeaksThenGreenwoodWilliamson(near, **ends),
        "`PartialContact`": asperity.PartialContact(),
        "`ScanContact`": scan,
    }


@dataclass(frozen=True)
class Contacts:
    """A map under a pressure, at all velocities: exact, and by correction."""

    kind: str
    spectrum: asperity.TabulatedSpectrum
    rubber: asperity.PronySeries
    pressure: float
    mu: Array
    area: Array
    found: dict[str, asperity.Friction]
    seconds: dict[str, float]


def rings(surface: asperity.HeightMap) -> asperity.TabulatedSpectrum:
    q0, q1 = (2 * np.pi * end / LENGTH for end in (LONGEST, SHORTEST))
    spectrum = asperity.power_spectrum(surface, window="none", detrend=None)
    return spectrum.truncated(q0=q0, q1=q1)


def exact(
    surface: asperity.HeightMap, rubber: asperity.PronySeries, pressure: float
) -> tuple[Array, Array]:
    """mu and A at all velocities."""
    contacts = [
        slide(surface, rubber, pressure=pressure, velocity=v, periodic=True, rtol=1e-5)
        for v in VELOCITIES
    ]
    mu, area = zip(*((c.hysteresis, c.contact_area) for c in contacts), strict=True)
    return np.array(mu), np.array(area)


def cases(kinds: Sequence[str] = tuple(KINDS)) -> Iterator[Contacts]:
    for kind in kinds:
        surface = height_map(kind, (7000 if LARGE else 9000) + [*KINDS].index(kind))
        spectrum = rings(surface)
        for rubber in RUBBERS.values():
            models = corrections(surface, asperity.ScanContact(surface, periodic=True))
            for pressure in PRESSURES:
                scene = {"pressure": pressure, "velocity": VELOCITIES}
                found, seconds = {}, {}
                for name, correction in models.items():
                    begin = time.process_time()
                    found[name] = asperity.friction(
                        spectrum, rubber, correction=correction, **scene
                    )
                    seconds[name] = time.process_time() - begin
                truth = exact(surface, rubber, pressure)
                yield Contacts(kind, spectrum, rubber, pressure, *truth, found, seconds)


def shown(error: Array) -> str:
    rms = 100 * np.sqrt(np.mean(error**2))
    digits = 1 if rms < 10 else 0
    return f"{rms:.{digits}f} ({100 * error.min():+.{digits}f} / {100 * error.max():+.{digits}f})"


def errors(of: Contacts, name: str, what: str) -> Array:
    result = of.found[name]
    return result.mu / of.mu - 1 if what == "mu" else result.contact_area / of.area - 1


def main() -> None:
    solved = [*cases()]
    for what in ("mu", "A"):
        print(f"\n{what}, errors in %, rms (lowest / highest):\n")
        print("| correction | " + " | ".join(KINDS) + " |\n| --- |" + " --- |" * len(KINDS))
        for name in solved[0].found:
            row = [
                shown(np.concatenate([errors(of, name, what) for of in solved if of.kind == kind]))
                for kind in KINDS
            ]
            print(f"| {name} | " + " | ".join(row) + " |")
    print(
        "\nShare of mu within one and two `model_error`, and seconds of processor time a curve:\n"
    )
    for name in ("`PartialContact`", "`ScanContact`"):
        error = np.concatenate([errors(of, name, "mu") for of in solved])
        stated = np.concatenate([of.found[name].model_error for of in solved])
        known = ~np.isnan(stated)
        shares = [np.mean(np.abs(error[known]) <= k * stated[known]) for k in (1, 2)]
        seconds = np.median([of.seconds[name] for of in solved])
        print(f"- {name}: {shares[0]:.2f}, {shares[1]:.2f}; median {seconds:.3f} s")
    if len(sys.argv) > 1 and not LARGE:
        draw(sys.argv[1])


LOOKS: dict[str, dict[str, Any]] = {  # the article's methods dashed
    "none": {"color": "0.6", "linewidth": 3, "label": "Persson, no correction"},
    "S on the integrand, 0.50": {"linestyle": "--", "color": COLOURS[1]},
    "local peaks, lambda0 / 2": {
        "linestyle": "--",
        "color": COLOURS[2],
        "label": "$p_T$ from local peaks, $\\lambda_0/2$",
    },
    "IGW, measured peaks": {
        "linestyle": "--",
        "color": COLOURS[3],
        "label": "$p_T$ from IGW, measured peaks",
    },
    "`PartialContact`": {"color": COLOURS[0], "label": "PartialContact"},
    "`ScanContact`": {"color": "k", "linewidth": 2, "zorder": 3, "label": "ScanContact"},
}


def draw(path: str) -> None:
    """mu(v) of a worn map: exact points and curves of the corrections."""
    import matplotlib.pyplot as plt

    surface, rubber, pressure = height_map("worn", 9001), RUBBERS["8 terms, 300"], 2e5
    spectrum = rings(surface)
    scan = asperity.ScanContact(surface, periodic=True)
    dense = np.geomspace(1e-5, 10, 91)
    figure, axes = plt.subplots(1, 2, figsize=(9, 3.9), layout="constrained", sharex=True)
    models = corrections(surface, scan)
    for name, look in LOOKS.items():
        curve = asperity.friction(
            spectrum, rubber, pressure=pressure, velocity=dense, correction=models[name]
        )
        for ax, values in zip(axes, (curve.mu, curve.contact_area), strict=True):
            ax.plot(dense, values, **{"label": name, "linewidth": 1.3} | look)
    for ax, values in zip(axes, exact(surface, rubber, pressure), strict=True):
        ax.plot(VELOCITIES, values, "ko", markersize=5, zorder=4, label="exact contact")
        ax.set(xscale="log", xlabel="Sliding velocity $v$ [m/s]", ylim=(0, None))
        ax.tick_params(which="both", direction="in", top=True, right=True)
    axes[0].set_ylabel("Hysteresis $\\mu_\\mathrm{H}$ [-]")
    axes[1].set_ylabel("Contact area $A/A_0$ [-]")
    for letter, ax in zip("ab", axes, strict=True):
        ax.set_title(f"({letter})", loc="left", fontsize="medium")
    labels = axes[0].get_legend_handles_labels()
    figure.legend(*labels, loc="outside upper center", ncols=3, fontsize="small")
    figure.savefig(path, dpi=130)


if __name__ == "__main__":
    if PICTURE:
        draw(sys.argv[-1])
    else:
        main()
