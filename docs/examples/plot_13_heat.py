"""
The heat of sliding
===================

Rubber on asphalt from a creep to 10 m/s: friction with the heat that it makes and without, and how
warm the roughness of each wavenumber finds the rubber. The contacts are 1 mm wide.
"""

import matplotlib.pyplot as plt
import numpy as np

import asperity

times = np.geomspace(1e-10, 1e2, 25)
rubber = asperity.PronySeries(
    equilibrium_modulus=3e6,
    moduli=5e5 + 2.5e8 * np.exp(-((np.log10(times) + 8.5) ** 2) / 1.5),
    relaxation_times=times,
)
road = asperity.SelfAffineSpectrum(rms_height=266e-6, hurst=0.87, q0=2000, q1=2.3e4)
setting = {
    "pressure": 200e3,
    "temperature": 273.15,
    "shift": asperity.WLF(c1=8.86, c2=101.6, reference_temperature=293.15),
    "heating": asperity.Heating(
        density=1200, heat_capacity=1650, conductivity=0.23, contact_diameter=1e-3
    ),
}
velocity = np.geomspace(1e-5, 10, 61)
hot = asperity.friction(road, rubber, velocity=velocity, **setting)

figure, (left, right) = plt.subplots(1, 2, figsize=(8, 3.4), layout="constrained")
left.plot(velocity, hot.mu, label="with its heat")
left.plot(velocity, hot.cold.mu, "--", color="C0", label="without")
left.set(xscale="log", xlabel="sliding velocity [m/s]", ylabel="friction coefficient [-]")
left.set_ylim(bottom=0)
left.legend()

speeds = np.array([0.01, 0.1, 1.0, 10.0])
result = asperity.friction(road, rubber, velocity=speeds, contributions=True, **setting)
for speed, profile in zip(speeds, result.temperature_profile, strict=True):
    right.plot(result.wavenumber, profile - 273.15, label=f"{speed:g} m/s")
right.set(xscale="log", xlabel="wavenumber [1/m]", ylabel="temperature of the rubber [°C]")
right.set_xticks([2e3, 5e3, 1e4, 2e4], ["2000", "5000", "10000", "20000"])
right.minorticks_off()
right.legend()
