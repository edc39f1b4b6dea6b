"""
A friction map
==============

A map for simulators holds mu over pressure and velocity to a certified error.
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
made = asperity.friction_map(
    road,
    rubber,
    pressure=(1e4, 1e6),
    velocity=(1e-6, 1),
    correction=asperity.PartialContact(),
    adhesion=asperity.Adhesion(shear_stress=5e6),
)
pressure = np.geomspace(1.01e4, 0.99e6, 80)[:, None]
velocity = np.geomspace(1.01e-6, 0.99, 120)

figure, axes = plt.subplots(layout="constrained")
axes.set(xscale="log", yscale="log", xlabel="sliding velocity [m/s]", ylabel="pressure [Pa]")
mu = made.mu(pressure, velocity)
filled = axes.contourf(velocity, pressure[:, 0], mu, 12, cmap="cividis")
lines = axes.contour(velocity, pressure[:, 0], mu, filled.levels[1:-1:2], colors="white")
axes.clabel(lines, fmt="%.2g")
figure.colorbar(filled, label="friction coefficient [-]")

# %%
# Cells, certified relative error, and how many of the random points were beyond it.

print(made.cells, f"{made.max_error:.1e}", made.exceeded)
