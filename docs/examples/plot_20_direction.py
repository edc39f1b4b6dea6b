"""
Friction by direction
=====================

A ground surface is rougher across its lay than along it. Its spectrum keeps the directions
(``directional=True``), so that ``friction`` takes the direction of sliding: over directions it is
a polar picture, and the force across steers what slides. Marks are the contact of the scan itself
in these directions.

The scan is synthesized, with ridges three times as long as wide, at 30 degrees from x.
"""

import matplotlib.pyplot as plt
import numpy as np

import asperity

side, pixels = 1e-3, 128
law = asperity.SelfAffineSpectrum(
    rms_height=8e-6,
    hurst=0.8,
    q0=8 * np.pi / side,
    q1=32 * np.pi / side,
    axis_ratio=3.0,
    lay=np.radians(30),
)
scan = asperity.synthesize(law, shape=(pixels, pixels), pixel_size=side / pixels, seed=3)
kept = asperity.power_spectrum(scan, window="none", detrend=None, directional=True)
kept = kept.truncated(q0=law.q0, q1=law.q1)
lay = asperity.anisotropy(scan)
print(f"{lay.ratio:.2g} times as steep across the ridges, {np.degrees(lay.direction):.0f} degrees")

rubber = asperity.PronySeries(
    equilibrium_modulus=1e6,
    moduli=np.geomspace(1e6, 3e7, 5),
    relaxation_times=np.geomspace(1e-2, 1e-6, 5),
)
scene = {"pressure": 2e5, "velocity": 1e-2}
around = np.radians(np.linspace(0, 360, 121))
by_theory = asperity.friction(
    kept, rubber, **scene, direction=around, correction=asperity.PartialContact(), rtol=1e-4
)
exact = asperity.ScanContact(scan, periodic=True)  # a measured scan: leave periodic out
angles = np.radians(np.arange(0, 360, 30))
of_scan = asperity.friction(kept, rubber, **scene, direction=angles, correction=exact)

figure = plt.figure(figsize=(9.5, 4), layout="constrained")
left, right = figure.add_subplot(121), figure.add_subplot(122, projection="polar")
millimetres = 1e3 * side
left.imshow(1e6 * scan.heights, extent=(0, millimetres, millimetres, 0), cmap="cividis")
along = millimetres * (
    0.5 + 0.3 * np.array([-1, 1])[:, None] * [np.cos(lay.direction), np.sin(lay.direction)]
)
left.plot(*along.T, "C1", linewidth=2)
left.set(xlabel="x [mm]", ylabel="y [mm]", title=f"lay at {np.degrees(lay.direction):.0f}°")
by_theory.plot(right)
right.plot(angles, of_scan.mu, "ko", markersize=4, label="contact of the scan, along")
right.plot(angles, np.abs(of_scan.lateral), "kd", markersize=4, fillstyle="none", label="across")
right.legend(loc="upper left", bbox_to_anchor=(1.1, 1), fontsize="small")
