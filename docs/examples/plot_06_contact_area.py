"""
The contact area over magnification
===================================

Seen coarsely, contact looks complete; the more closely one looks, the less of it is left.
Corrections for partial contact make the area larger.
"""

import matplotlib.pyplot as plt
import numpy as np

import asperity

road = asperity.SelfAffineSpectrum(rms_height=76.6e-6, hurst=0.7, q0=2000, q1=1e6)
rubber = asperity.PronySeries(equilibrium_modulus=3e7, moduli=[], relaxation_times=[])
wavenumber = np.geomspace(2000, 1e6, 200)
corrections = {
    "none": None,
    "PartialContact": asperity.PartialContact(),
    "NayakSFactor": asperity.NayakSFactor(),
    "S inside G, 0.5": asperity.SFactor(gamma=0.5, applies_to="area"),
    "p_T = 2": asperity.AffineShift(2),
}

figure, axes = plt.subplots(layout="constrained")
for name, correction in corrections.items():
    area = asperity.contact_area(
        road, rubber, pressure=300e3, velocity=1e-3, correction=correction, wavenumber=wavenumber
    )
    axes.loglog(wavenumber / 2000, area, label=name)
axes.set(xlabel="magnification q / q0 [-]", ylabel="A / A0 [-]")
axes.legend()
