"""
A scan by tiles
===============

A map too large for memory is transformed tile by tile. Rows that a tile is too short for come from
the coarsened map: together they are the spectrum of the whole.
"""

import tempfile
from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np

import asperity

law = asperity.SelfAffineSpectrum(rms_height=2e-5, hurst=0.8, q0=3e3, q1=3e6, rolloff=1.5e4)
scan = asperity.synthesize(law, shape=(2048, 2048), pixel_size=1e-6, seed=1)
with tempfile.TemporaryDirectory() as folder:
    np.save(Path(folder, "road.npy"), scan.heights)
    heights = np.load(Path(folder, "road.npy"), mmap_mode="r")  # read a tile at a time
    tiled = asperity.power_spectrum(heights, pixel_size=1e-6, tiles=512, window="hann")
whole = asperity.power_spectrum(scan, window="hann")

figure, (left, right) = plt.subplots(1, 2, figsize=(9, 3.6), layout="constrained")
left.loglog(whole.wavenumber, whole.density, ".", color="0.7", markersize=2, label="whole map")
left.loglog(tiled.wavenumber, tiled.density, linewidth=1, label="tiles of 512 x 512")
left.set(xlabel="wavenumber [1/m]", ylabel="C(q) [m$^4$]", xlim=(3e3, 3e6), ylim=(1e-28, 1e-18))
left.legend(loc="lower left")

takes_over = 20 * 2 * np.pi / 512e-6
for spectrum, colour, name in ((whole, "0.7", "whole map"), (tiled, "C0", "tiles")):
    ratio = spectrum.density / law.at(np.clip(spectrum.wavenumber, law.q0, law.q1))
    right.semilogx(spectrum.wavenumber, ratio, ".", color=colour, markersize=2, label=name)
right.axvline(takes_over, color="C1", linestyle="--", label="tiles take over")
right.set(xlabel="wavenumber [1/m]", ylabel="found / true [-]", ylim=(0.7, 1.3), xlim=(1e4, 3e6))
right.legend(loc="lower left")
