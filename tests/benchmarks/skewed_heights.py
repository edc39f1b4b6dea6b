"""How far `PartialContact` is off on maps by the skewness and kurtosis of their heights.

    python tests/benchmarks/skewed_heights.py

Exact over stated mu and A of periodic maps: 256 x 256 points with q1/q0 = 8, three of a kind, and
512 x 512 with q1/q0 = 32; two rubbers of scan_contact.py, two loads, three velocities. Groups are
those of the note (cpp/src/contact/heights.cpp); where the heights are as good as Gaussian, shorter
waves may yet be gathered in places, high or low ones or neither. Prints Markdown.
"""

from collections import defaultdict
from collections.abc import Callable, Iterator

import numpy as np
import scan_contact

import asperity
from asperity.validation import slide

Array = np.ndarray
LENGTH = 0.01
RUBBERS = [scan_contact.RUBBERS[name] for name in ("1 term, 30", "8 terms, 300")]
VELOCITIES = (1.7e-4, 5e-2, 3.0)


def worn(a: float) -> Callable[[Array], Array]:
    return lambda z: -np.logaddexp(0, -a * z)


def scaled(shape: Callable[[Array], Array], a: float) -> Callable[[Array], Array]:
    return lambda z: shape(a * z)


KINDS: list[Callable[[Array], Array]] = [lambda z: z]
KINDS += [worn(a) for a in (0.5, 1, 1.5, 3)]
KINDS += [scaled(np.exp, a) for a in (0.1, 0.2, 0.3, 0.45)]
KINDS += [scaled(np.sinh, a) for a in (0.3, 0.6, 1.0, 1.3)]
KINDS += [scaled(np.tanh, a) for a in (0.3, 0.6, 1.0, 2.0)]
SKEWNESS = (-1.2, -0.8, -0.5, -0.3, 0.3, 0.5, 0.8, 1.2)  # by phases alone
GROUPS = (
    "Gaussian",
    "skewness -0.4 to -0.8",
    "skewness below -0.8",
    "kurtosis below 2.3",
    "skewness 0.4 to 0.8",
    "skewness above 0.8",
    "high peaks and deep pits",
    "Gaussian heights, waves gathered in places",
)


def group(skewness: float, kurtosis: float, curvature_kurtosis: float) -> str:
    if abs(skewness) <= 0.4:
        if 2.3 <= kurtosis <= 4 and curvature_kurtosis > 3.5:
            return GROUPS[7]
        return GROUPS[0 if 2.3 <= kurtosis <= 4 else 3 if kurtosis < 2.3 else 6]
    if kurtosis > 3 * (1 + skewness**2):
        return GROUPS[6]
    return GROUPS[(1 if skewness < 0 else 4) + (abs(skewness) > 0.8)]


def curvature_kurtosis(heights: Array) -> float:
    second = heights[:, 4:] - 2 * heights[:, 2:-2] + heights[:, :-4]
    return float((second**4).mean() / (second**2).mean() ** 2)


def maps(points: int, band: tuple[int, int], seed: int) -> Iterator[asperity.HeightMap]:
    k = np.fft.fftfreq(points, 1 / points)
    q = np.hypot(k, k[:, None])
    inside = (q >= band[0]) & (q <= band[1])
    amplitude = np.where(inside, np.where(inside, q, 1) ** -1.8, 0)
    noise = np.random.default_rng(seed).normal(size=q.shape)
    heights = scan_contact.unit(np.fft.ifft2(amplitude * np.fft.fft2(noise)).real)
    for shape in KINDS:
        filtered = np.fft.ifft2(np.where(inside, np.fft.fft2(shape(heights)), 0)).real
        yield asperity.HeightMap(1e-4 * scan_contact.unit(filtered), pixel_size=LENGTH / points)
    long = np.where(q <= 2 * band[0], np.fft.fft2(heights), 0)
    longest = scan_contact.unit(np.fft.ifft2(long).real)
    other = np.where((q >= band[0]) & (q <= 2 * band[0]), np.fft.fft2(np.roll(noise, 77, 1)), 0)
    for place in (longest, -longest, scan_contact.unit(np.fft.ifft2(other).real)):
        for strength in (0.3, 0.5, 0.7):
            gathered = longest + (heights - longest) * np.exp(strength * place)
            filtered = np.fft.ifft2(np.where(inside, np.fft.fft2(gathered), 0)).real
            yield asperity.HeightMap(1e-4 * scan_contact.unit(filtered), pixel_size=LENGTH / points)
    q0, q1 = (2 * np.pi / LENGTH * end for end in band)
    road = asperity.SelfAffineSpectrum(rms_height=1e-4, hurst=0.8, q0=q0, q1=q1)
    grid = {"shape": (points, points), "pixel_size": LENGTH / points, "seed": seed}
    for skewness in SKEWNESS:
        yield asperity.synthesize(road, **grid, skewness=skewness)


def ratios(surface: asperity.HeightMap, band: tuple[int, int]) -> Iterator[tuple[float, float]]:
    """Exact over stated mu and A."""
    spectrum = asperity.power_spectrum(surface, window="none", detrend=None)
    spectrum = spectrum.truncated(q0=2 * np.pi * band[0] / LENGTH, q1=2 * np.pi * band[1] / LENGTH)
    for rubber in RUBBERS:
        for pressure in scan_contact.PRESSURES:
            said = asperity.friction(
                spectrum,
                rubber,
                pressure=pressure,
                velocity=VELOCITIES,
                correction=asperity.PartialContact(),
            )
            for velocity, mu, area in zip(VELOCITIES, said.mu, said.contact_area, strict=True):
                at = {"pressure": pressure, "velocity": velocity}
                exact = slide(surface, rubber, **at, periodic=True, rtol=1e-4)
                yield exact.hysteresis / mu, exact.contact_area / area


def main() -> None:
    result: dict[str, list[tuple[float, float]]] = defaultdict(list)
    counts: dict[str, int] = defaultdict(int)
    for points, band, seed in ((256, (4, 32), 11), (256, (4, 32), 12), (512, (2, 64), 13)):
        for surface in maps(points, band, seed):
            name = group(surface.skewness, surface.kurtosis, curvature_kurtosis(surface.heights))
            counts[name] += 1
            result[name] += ratios(surface, band)
    print("| heights | maps | mu | A |\n| --- | --- | --- | --- |")
    for name in GROUPS:
        of_mu, of_area = np.transpose(result[name])
        cells = (
            f"{np.exp(np.log(r).mean()):.2f} ({r.min():.2f} to {r.max():.2f})"
            for r in (of_mu, of_area)
        )
        print(f"| {name} | {counts[name]} | " + " | ".join(cells) + " |")


if __name__ == "__main__":
    main()
