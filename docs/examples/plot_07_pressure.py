"""
The distribution of the local pressure
======================================

With magnification the pressure spreads: a smaller area carries the same load. The area under each
curve is the share of the surface that is in contact.
"""

import matplotlib.pyplot as plt
import numpy as np

import asperity

road = asperity.SelfAffineSpectrum(rms_height=76.6e-6, hurst=0.7, q0=2000, q1=1e6)
rubber = asperity.PronySeries(equilibrium_modulus=3e7, moduli=[], relaxation_times=[])
nominal = 300e3
stress = np.geomspace(1e-2, 3e3, 500) * nominal

figure, axes = plt.subplots(layout="constrained")
for magnification in (1.02, 3, 30, 500):
    density = asperity.pressure_distribution(
        stress,
        road,
        rubber,
        pressure=nominal,
        velocity=1e-3,
        wavenumber=2000 * magnification,
    )
    axes.plot(stress / nominal, stress * density, label=f"q / q0 = {magnification}")
axes.set(xscale="log", xlabel="local pressure / nominal [-]", ylabel=r"$\sigma\, P(\sigma)$ [-]")
axes.legend()
