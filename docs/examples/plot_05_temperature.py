"""
Two temperatures, with bands
============================

The same rubber at 10 and 50 °C. The bands show what the errors of the measurement make of mu, drawn
at random 100 times: 5 % of noise on the DMA sweeps, and a scan only four of the longest waves wide.
"""

import matplotlib.pyplot as plt
import numpy as np

import asperity
from asperity.demo import PIXEL_SIZE, scan

times = np.geomspace(1e-10, 1e2, 25)
truth = asperity.PronySeries(
    equilibrium_modulus=3e6,
    moduli=5e5 + 2.5e8 * np.exp(-((np.log10(times) + 8.5) ** 2) / 1.5),
    relaxation_times=times,
)
noise = np.random.default_rng(1)
isotherms = []
for celsius in range(-30, 91, 5):
    w = 2 * np.pi * np.geomspace(0.1, 30, 12)
    modulus = truth.modulus(w * 10 ** (-8.06 * (celsius - 20) / (111.6 + celsius - 20)))
    storage, loss = (
        part * (1 + 0.05 * noise.standard_normal(12)) for part in (modulus.real, modulus.imag)
    )
    isotherms.append(
        asperity.Isotherm(
            temperature=273.15 + celsius,
            angular_frequency=w,
            storage_modulus=storage,
            loss_modulus=loss,
        )
    )

surface = asperity.HeightMap(scan()[:120, :150], pixel_size=PIXEL_SIZE).fill_dropouts()
spectrum = asperity.power_spectrum(surface, detrend="quadratic")
road = spectrum.truncated(q0=1900, q1=spectrum.truncated(q1=2.8e4).cutoff_for_slope(1.3))
velocity = np.geomspace(2e-5, 10, 37)

figure, axes = plt.subplots(layout="constrained")
for celsius, colour in ((10, "#0072B2"), (50, "#D55E00")):
    build = asperity.build_master_curve(isotherms, reference_temperature=273.15 + celsius)
    setting = {
        "pressure": 300e3,
        "velocity": velocity,
        "correction": asperity.PartialContact(),
        "adhesion": asperity.Adhesion(shear_stress=5e6),
    }
    band = asperity.friction_band(road, build, seed=1, **setting)
    mu = asperity.friction(road, build.master_curve, **setting).mu
    axes.fill_between(velocity, band.lower, band.upper, color=colour, alpha=0.3, linewidth=0)
    axes.plot(velocity, mu, color=colour)
    axes.text(velocity[5], mu[5] + 0.07, f"{celsius} °C", color=colour, ha="right")
axes.set(xscale="log", xlabel="sliding velocity [m/s]", ylabel="friction coefficient [-]")
axes.set_ylim(bottom=0)
