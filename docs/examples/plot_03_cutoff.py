"""
How much q1 decides
===================

Every decade of roughness that is added makes the contact area smaller and the hysteresis larger.
The dashed line is where the rms slope reaches 1.3, the rule of thumb for the end of the spectrum.
"""

import matplotlib.pyplot as plt
import numpy as np

import asperity

road = asperity.SelfAffineSpectrum(rms_height=265.7e-6, hurst=0.87, q0=2000, q1=1e6)
rubber = asperity.PronySeries(
    equilibrium_modulus=3e6,
    moduli=10 ** np.linspace(6, 9, 16),
    relaxation_times=10 ** np.linspace(2, -8, 16),
)
cutoffs = np.geomspace(4e3, 1e6, 30)
results = [
    asperity.friction(
        road.truncated(q1=q1),
        rubber,
        pressure=300e3,
        velocity=1e-3,
        correction=asperity.PartialContact(),
    )
    for q1 in cutoffs
]

figure, axes = plt.subplots(layout="constrained")
axes.plot(cutoffs, [result.hysteresis for result in results])
axes.plot(cutoffs, [result.contact_area for result in results])
axes.axvline(road.cutoff_for_slope(1.3), color="0.4", linestyle="--")
axes.text(2e5, 0.45, "hysteresis", color="C0")
axes.text(2e5, 0.011, "contact area A/A0", color="C1")
axes.text(road.cutoff_for_slope(1.3) * 1.05, 0.09, "rms slope 1.3", color="0.4")
axes.set(xscale="log", yscale="log", xlabel="end of the spectrum q1 [1/m]", ylabel="value [-]")
