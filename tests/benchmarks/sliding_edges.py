"""What closing a map costs: quarters of periodic maps, closed in three ways, against the whole.

    python tests/benchmarks/sliding_edges.py

Maps of 512 x 512 points, 8 to 64 waves to a side, of three kinds of heights (scan_contact.py), five
of each; a rubber of 8 terms at three speeds, A/A0 about 0.1. Prints Markdown: the mean of the
quarters over the whole, its standard error, and how far single quarters scatter.
"""

import numpy as np
import scan_contact

import asperity
from asperity.validation import slide

POINTS, BAND = 512, (8, 64)
MAPS = 5
KINDS = ("Gaussian", "worn", "peaks")
RUBBER = scan_contact.RUBBERS["8 terms, 300"]
VELOCITIES = (1e-4, 3e-2, 1e1)
PRESSURE = 3e5
CLOSED = ("blend", "fade", "mirror")


def height_map(kind: str, seed: int) -> asperity.HeightMap:
    k = np.fft.fftfreq(POINTS, 1 / POINTS)
    q = np.hypot(k, k[:, None])
    inside = (q >= BAND[0]) & (q <= BAND[1])
    amplitude = np.where(inside, np.where(inside, q, 1) ** -1.8, 0)
    noise = np.random.default_rng(seed).normal(size=q.shape)
    z = scan_contact.unit(np.fft.ifft2(amplitude * np.fft.fft2(noise)).real)
    bent = {
        "Gaussian": lambda: z,
        "worn": lambda: -np.logaddexp(0, -1.5 * z),
        "peaks": lambda: np.exp(0.45 * z),
    }[kind]()
    filtered = np.fft.ifft2(np.where(inside, np.fft.fft2(bent), 0)).real
    return asperity.HeightMap(5e-5 * scan_contact.unit(filtered), pixel_size=0.01 / POINTS)


def results(surface: asperity.HeightMap, velocity: float, periodic: object) -> tuple[float, float]:
    found = slide(
        surface, RUBBER, pressure=PRESSURE, velocity=velocity, periodic=periodic, rtol=1e-4
    )
    return found.hysteresis, found.contact_area


def main() -> None:
    half = POINTS // 2
    print("| heights | closed | mu | A | single quarters, mu | A/A0 |")
    print("| --- | --- | --- | --- | --- | --- |")
    for kind in KINDS:
        wholes, quarters = [], {way: [] for way in CLOSED}
        for seed in range(MAPS):
            surface = height_map(kind, 700 + seed)
            parts = [
                asperity.HeightMap(
                    surface.heights[i : i + half, j : j + half], pixel_size=surface.pixel_size
                )
                for i in (0, half)
                for j in (0, half)
            ]
            wholes.append([results(surface, v, True) for v in VELOCITIES])
            for way in CLOSED:
                quarters[way].append([[results(p, v, way) for p in parts] for v in VELOCITIES])
        whole = np.array(wholes)  # maps, velocities, (mu, A)
        for way in CLOSED:
            ratio = np.array(quarters[way]) / whole[:, :, None]  # maps, velocities, quarters, ...
            of_maps = ratio.mean(axis=2)
            cells = []
            for i in range(2):
                means = 100 * (of_maps[..., i].mean(axis=0) - 1)
                error = 100 * of_maps[..., i].std(axis=0, ddof=1).mean() / np.sqrt(MAPS)
                cells.append(", ".join(f"{mean:+.1f}" for mean in means) + f" (+-{error:.1f})")
            scatter = 100 * ratio[..., 0].std(axis=2, ddof=1).mean()
            area = whole[..., 1].mean(axis=0)
            print(
                f"| {kind} | {way} | {cells[0]} | {cells[1]} | {scatter:.1f} | "
                + ", ".join(f"{a:.2f}" for a in area)
                + " |",
                flush=True,
            )


if __name__ == "__main__":
    main()
