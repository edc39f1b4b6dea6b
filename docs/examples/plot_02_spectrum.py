"""
A scan and its spectrum
=======================

The shipped scan has tilt, curvature and missing points. The spectrum's rows carry flags: grey ones
are not to be trusted, because the window smears them or the pixels fold finer roughness back.
"""

import matplotlib.pyplot as plt
import numpy as np

import asperity
from asperity.demo import PIXEL_SIZE, scan

surface = asperity.HeightMap(scan(), pixel_size=PIXEL_SIZE).fill_dropouts()
spectrum = asperity.power_spectrum(surface, detrend="quadratic")
fit = asperity.fit_self_affine(spectrum)

figure, (left, right) = plt.subplots(1, 2, figsize=(9, 3.6), layout="constrained")
flat = surface.detrend("quadratic").heights
ny, nx = flat.shape
size = (0, 1e3 * nx * PIXEL_SIZE[1], 1e3 * ny * PIXEL_SIZE[0], 0)
image = left.imshow(1e6 * flat, extent=size, cmap="cividis")
figure.colorbar(image, ax=left, label="height [um]")
left.set(xlabel="x [mm]", ylabel="y [mm]")

good = spectrum.reliable
right.loglog(spectrum.wavenumber[~good], spectrum.density[~good], ".", color="0.7", label="flagged")
right.loglog(spectrum.wavenumber[good], spectrum.density[good], ".", label="reliable")
q = np.geomspace(fit.q0, fit.q1, 50)
right.loglog(q, fit.spectrum.at(q), label=f"fit, H = {fit.hurst:.3f}")
right.set(xlabel="wavenumber [1/m]", ylabel="C(q) [m$^4$]")
right.legend(loc="upper right")
