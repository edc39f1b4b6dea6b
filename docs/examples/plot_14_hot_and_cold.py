"""
Hot and cold, with their bands
==============================

Friction heats the rubber in the contact spots. Cold is the friction of a rubber that stays at
20 °C, hot that of the same rubber as it heats itself: softer, with more friction below 0.2 m/s and
less above. The bands show what the errors of the scan, only four of its longest waves wide, make of
mu.
"""

import tomllib

import matplotlib.pyplot as plt
import numpy as np

import asperity
from asperity.demo import PIXEL_SIZE, scan, scene_text

surface = asperity.HeightMap(scan()[:120, :150], pixel_size=PIXEL_SIZE).fill_dropouts()
spectrum = asperity.power_spectrum(surface, detrend="quadratic")
road = spectrum.truncated(q0=1900, q1=spectrum.truncated(q1=2.8e4).cutoff_for_slope(1.3))

shipped = tomllib.loads(scene_text())["rubber"]
rubber = asperity.PronySeries(
    equilibrium_modulus=shipped["equilibrium_modulus_pa"],
    moduli=shipped["moduli_pa"],
    relaxation_times=shipped["relaxation_times_s"],
)
warmed = {
    "temperature": 293.15,
    "shift": asperity.WLF(c1=8.86, c2=101.6, reference_temperature=293.15),
    "heating": asperity.Heating(
        density=1200, heat_capacity=1650, conductivity=0.23, contact_diameter=1e-3
    ),
}
setting = {
    "pressure": 300e3,
    "velocity": np.geomspace(1e-5, 10, 37),
    "correction": asperity.PartialContact(),
    "adhesion": asperity.Adhesion(shear_stress=5e6),
}

figure, axes = plt.subplots(layout="constrained")
for name, heat, colour, place in (("cold", {}, "#0072B2", 33), ("hot", warmed, "#D55E00", 24)):
    result = asperity.friction(road, rubber, **setting, **heat)
    band = asperity.friction_band(road, rubber, seed=1, **setting, **heat)
    axes.fill_between(result.velocity, band.lower, band.upper, color=colour, alpha=0.3, linewidth=0)
    axes.plot(result.velocity, result.mu, color=colour)
    axes.text(result.velocity[place], band.upper[place] + 0.04, name, color=colour)
axes.set(xscale="log", xlabel="sliding velocity [m/s]", ylabel="friction coefficient [-]")
axes.set_ylim(bottom=0)
