"""
A first friction curve
======================

The surface is a self-affine asphalt that ends where its rms slope reaches 1.3; the rubber is a
Prony series. Hysteresis, adhesion and their sum are drawn over the sliding velocity.
"""

import matplotlib.pyplot as plt
import numpy as np

import asperity

road = asperity.SelfAffineSpectrum(rms_height=265.7e-6, hurst=0.87, q0=2000, q1=1e6)
road = road.truncated(q1=road.cutoff_for_slope(1.3))
rubber = asperity.PronySeries(
    equilibrium_modulus=3e6,
    moduli=10 ** np.linspace(6, 9, 16),
    relaxation_times=10 ** np.linspace(2, -8, 16),
)
result = asperity.friction(
    road,
    rubber,
    pressure=300e3,
    velocity=np.geomspace(1e-6, 1, 60),
    correction=asperity.PartialContact(),
    adhesion=asperity.Adhesion(shear_stress=5e6),
)

figure, axes = plt.subplots(layout="constrained")
for name, line in (("mu", "-"), ("hysteresis", "--"), ("adhesion", ":")):
    values = getattr(result, name)
    (curve,) = axes.plot(result.velocity, values, line)
    place, above = {"mu": (35, 6), "hysteresis": (35, -16), "adhesion": (30, 6)}[name]
    axes.annotate(
        name,
        (result.velocity[place], values[place]),
        xytext=(4, above),  # where there is room
        textcoords="offset points",
        color=curve.get_color(),
    )
axes.set(xscale="log", xlabel="sliding velocity [m/s]", ylabel="friction coefficient [-]")
axes.set_ylim(bottom=0)

# %%
# The result tells its largest numerical error, and where the theory leaves its range.

print(f"{result.error_estimate.max():.0e}", *result.notes, sep="\n")
