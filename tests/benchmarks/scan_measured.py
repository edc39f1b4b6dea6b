"""ScanContact and PartialContact on measured scans with measured rubbers, against exact contact.

    ASPERITY_DATA=... python tests/benchmarks/scan_measured.py [docs/benchmarks/scan_measured.png]

Truth is `asperity.validation.slide` on the scan filled, levelled, closed and filtered here, on
twice its points along a side, at velocities that are no nodes and all of whose frequencies were
measured. Prints Markdown, and draws the curves where a picture is named.
"""

import os
import sys
from pathlib import Path
from typing import Any

import matplotlib.pyplot as plt
import measured
import numpy as np

import asperity
from asperity.draw.style import COLOURS
from asperity.validation import slide

FINER = 2
PRESSURES = (5e4, 1e6)
Array = np.ndarray


def levelled(heights: Array) -> Array:
    y, x = np.indices(heights.shape).reshape(2, -1)
    basis = np.stack([np.ones_like(x), x, y], axis=1).astype(float)
    plane = basis @ np.linalg.lstsq(basis, heights.ravel(), rcond=None)[0]
    return heights - plane.reshape(heights.shape)


def closed(heights: Array, margin: int) -> Array:
    """The last `margin` points of both axes blended into the first ones."""
    for _ in range(2):
        weight = np.sin(np.pi / 2 * (np.arange(margin) + 0.5) / margin)[:, None] ** 2
        begin, end = heights[:margin], heights[-margin:]
        heights = np.concatenate([weight * begin + (1 - weight) * end, heights[margin:-margin]]).T
    return heights - heights.mean()


def filtered(heights: Array, pixel: float, q0: float, q1: float) -> Array:
    """Waves of the band alone, on FINER times the points."""
    modes = np.fft.fft2(heights)
    q = np.hypot(*np.meshgrid(*(2 * np.pi * np.fft.fftfreq(n, pixel) for n in heights.shape[::-1])))
    modes[(q < q0 * (1 - 1e-9)) | (q > q1 * (1 + 1e-9))] = 0
    finer = np.zeros([FINER * n for n in heights.shape], complex)
    rows, columns = (np.r_[: (n + 1) // 2, -((n - 1) // 2) : 0] for n in heights.shape)
    finer[np.ix_(rows, columns)] = modes[np.ix_(rows, columns)]
    return np.fft.ifft2(finer).real * FINER**2


def prepared(path: Path, q0: float, q1: float) -> asperity.HeightMap:
    scan = asperity.read_surface(path).fill_dropouts()
    assert isinstance(scan, asperity.HeightMap)
    pixel = scan.pixel_size[0]
    heights = closed(levelled(scan.heights), int(np.ceil(2 * 2 * np.pi / q1 / pixel)))
    return asperity.HeightMap(filtered(heights, pixel, q0, q1), pixel_size=pixel / FINER)


def percent(found: Array, exact: Array) -> str:
    return ", ".join(f"{error:+.1f}" for error in 100 * (found / exact - 1))


def draw(axes: Any, curves: list[tuple[Any, Any, Array, Array]]) -> None:
    """ScanContact with its model error, PartialContact and the exact contacts, by pressure."""
    for colour, (found, rule, velocity, exact) in zip(COLOURS, curves, strict=False):
        v, low, high = found.velocity, 1 - found.model_error, 1 + found.model_error
        axes.fill_between(v, found.mu * low, found.mu * high, color=colour, alpha=0.2, linewidth=0)
        axes.plot(v, found.mu, color=colour, label=f"ScanContact, {found.pressure[0] / 1e6:g} MPa")
        axes.plot(v, rule.mu, "--", color=colour, linewidth=1, label="PartialContact")
        axes.plot(velocity, exact, "o", color=colour, markeredgecolor="k", label="exact contact")
    axes.set(xscale="log", ylim=(0, None))
    axes.tick_params(which="both", direction="in", top=True, right=True)


def main() -> None:
    figure, panels = plt.subplots(2, 2, figsize=(8.5, 6.2), layout="constrained")
    data = os.environ["ASPERITY_DATA"]
    print("| scan | rubber | p | A/A0 | mu | A | mu by the rule | A by the rule | model error |")
    print("| --- |" + " --- |" * 8)
    for row, (name, spectrum) in zip(panels, measured.spectra().items(), strict=True):
        path = Path(data) / "topography" / name
        exact_map = prepared(path, spectrum.q0, spectrum.q1)
        pixel, side = exact_map.pixel_size[0], max(exact_map.heights.shape)
        for axes, (rubber, build) in zip(row, measured.rubbers().items(), strict=True):
            curve = build.master_curve
            slowest, fastest = curve.angular_frequency[[0, -1]] * (
                side * pixel / (2 * np.pi),
                pixel / np.pi,
            )
            velocity = slowest * (fastest / slowest) ** np.array([0.05, 0.5, 0.93])
            scan = asperity.ScanContact(asperity.read_surface(path))
            curves = []
            for pressure in PRESSURES:
                scene = {"pressure": pressure, "velocity": velocity}
                found, rule = (
                    asperity.friction(spectrum, curve, correction=one, **scene)
                    for one in (scan, asperity.PartialContact())
                )
                contacts = [
                    slide(exact_map, curve, pressure=pressure, velocity=v, periodic=True)
                    for v in velocity
                ]
                mu = np.array([c.hysteresis for c in contacts])
                area = np.array([c.contact_area for c in contacts])
                stated = 100 * found.model_error
                print(
                    f"| {name} | {rubber} | {pressure:.3g} | {area.max():.2f} to {area.min():.2f} "
                    f"| {percent(found.mu, mu)} | {percent(found.contact_area, area)} "
                    f"| {percent(rule.mu, mu)} | {percent(rule.contact_area, area)} "
                    f"| {stated.min():.1f} to {stated.max():.1f} |",
                    flush=True,
                )
                dense = np.geomspace(velocity[0], velocity[-1], 41)
                scene = {"pressure": pressure, "velocity": dense}
                drawn = (
                    asperity.friction(spectrum, curve, correction=one, **scene)
                    for one in (scan, asperity.PartialContact())
                )
                curves.append((*drawn, velocity, mu))
            draw(axes, curves)
            title = f"{name.partition('.')[0]}, {rubber.replace('_', ' ')}"
            axes.set_title(title, loc="left", fontsize="medium")
    for axes in panels[1]:
        axes.set_xlabel("Sliding velocity $v$ [m/s]")
    for axes in panels[:, 0]:
        axes.set_ylabel("Hysteresis $\\mu_\\mathrm{H}$ [-]")
    entries = panels[0, 0].get_legend_handles_labels()
    figure.legend(*entries, loc="outside upper center", ncols=2, fontsize="small")
    if len(sys.argv) > 1:
        figure.savefig(sys.argv[1], dpi=120)


if __name__ == "__main__":
    main()
