"""
Friction by direction on measured striae
========================================

What a barrel cuts into a bullet is as good a lay as grinding leaves: striae along y, over which
sliding along x is steeper. The scan is one of x3ptools (Iowa State University; MIT licence), made
with a Sensofar S neox, 2.58 um a pixel. It does not come with asperity: clone
https://github.com/heike/x3ptools and name the folder,

    python striated_metal.py x3ptools

which wrote this picture.

.. image:: /notes/striated_metal.png
   :alt: The striae, their spectra along and across, and mu over the direction of sliding

The land is cut out of its grooves and its broken end, and its curvature taken off. Notes say what
such a small scan cannot tell: its longest waves, and by its spectrum that its heights are skewed.
The marks are the contact of the scan itself.
"""

import sys
from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np

import asperity

# sphinx_gallery_thumbnail_path = 'notes/striated_metal.png'

whole = asperity.read_surface(Path(sys.argv[1]) / "inst" / "sample-land.x3p")
cut = asperity.HeightMap(whole.heights[35:195, 110:560], pixel_size=whole.pixel_size)
land = cut.fill_dropouts().detrend("quadratic")
lay = asperity.anisotropy(land)
print(f"{lay.ratio:.2g} times as steep across the striae, {np.degrees(lay.direction):.0f} degrees")

kept = asperity.power_spectrum(land, detrend=None, directional=True)
kept = kept.truncated(q1=6e5)  # half of what its pixels end at
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
for note in by_theory.notes:
    print(note)
angles = np.radians(np.arange(0, 180, 22.5))
of_scan = asperity.friction(
    kept, rubber, **scene, direction=angles, correction=asperity.ScanContact(land)
)

figure = plt.figure(figsize=(9.5, 7.5), layout="constrained")
grid = figure.add_gridspec(2, 2, height_ratios=(1.1, 1.3))
top = figure.add_subplot(grid[0, :])
height, width = (
    1e3 * n * pixel for n, pixel in zip(land.heights.shape, land.pixel_size, strict=True)
)
picture = top.imshow(1e6 * land.heights, extent=(0, width, height, 0), cmap="cividis")
middle = np.array([width, height]) / 2
toward = np.array([np.cos(lay.direction), np.sin(lay.direction)])
top.plot(*(middle + 0.4 * height * np.array([[-1], [1]]) * toward).T, "C1", linewidth=2)
top.set(xlabel="x [mm]", ylabel="y [mm]", title=f"lay at {np.degrees(lay.direction):.0f}°")
figure.colorbar(picture, cax=top.inset_axes((1.02, 0, 0.02, 1)), label="Height [µm]")

left = figure.add_subplot(grid[1, 0])
q = kept.wavenumber[kept.wavenumber <= kept.q1]
for name, angle in (("across the striae", lay.direction + np.pi / 2), ("along", lay.direction)):
    density = kept.toward(q, angle)
    known = density > 0  # harmonics of few waves leave it below 0
    left.loglog(q[known], density[known], ".", markersize=3, label=f"C(q) {name}")
left.loglog(q, kept.at(q), "k--", linewidth=1, label="mean over directions")
left.set(xlabel="Wavenumber q [1/m]", ylabel="C(q) [m$^4$]", ylim=(1e-27, None))
left.legend()

right = figure.add_subplot(grid[1, 1], projection="polar")
by_theory.plot(right)
both = np.concatenate((angles, angles + np.pi))
right.plot(both, np.tile(of_scan.mu, 2), "ko", markersize=4, label="contact of the scan, along")
across = np.tile(np.abs(of_scan.lateral), 2)
right.plot(both, across, "kd", markersize=4, fillstyle="none", label="across")
right.legend(loc="upper left", bbox_to_anchor=(1.1, 1), fontsize="small")
for name, mu in (("theory", np.interp(angles, around, by_theory.mu)), ("scan", of_scan.mu)):
    print(f"mu by the {name}: {mu[0]:.4f} along x, {mu[4]:.4f} along the striae")
figure.savefig("striated_metal.png", dpi=100)
