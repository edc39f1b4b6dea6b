"""
Hot and cold, with a band
=========================

The same rubber at 0 and 40 °C. The bands are what the noise of the DMA sweeps and of the scan make of
mu, drawn at random 100 times. They are narrow: what is uncertain is the theory and its cut-off, not
the measurement.
"""

import matplotlib.pyplot as plt
import numpy as np

import asperity
from asperity.demo import PIXEL_SIZE, scan

truth = asperity.PronySeries(
    equilibrium_modulus=3e6,
    moduli=10 ** np.linspace(6, 9, 16),
    relaxation_times=10 ** np.linspace(2, -8, 16),
)
noise = np.random.default_rng(1)
isotherms = []
for celsius in range(-30, 61, 5):
    w = 2 * np.pi * np.geomspace(0.1, 30, 12)
    modulus = truth.modulus(w * 10 ** (-8.06 * (celsius - 20) / (111.6 + celsius - 20)))
    storage, loss = (
        part * (1 + 0.03 * noise.standard_normal(12)) for part in (modulus.real, modulus.imag)
    )
    isotherms.append(
        asperity.Isotherm(
            temperature=273.15 + celsius,
            angular_frequency=w,
            storage_modulus=storage,
            loss_modulus=loss,
        )
    )

surface = asperity.HeightMap(scan(), pixel_size=PIXEL_SIZE).fill_dropouts()
spectrum = asperity.power_spectrum(surface, detrend="quadratic")
road = spectrum.truncated(q0=2000, q1=spectrum.truncated(q1=2.8e4).cutoff_for_slope(1.3))
velocity = np.geomspace(1e-4, 1, 31)

figure, axes = plt.subplots(layout="constrained")
for celsius, colour in ((0, "#0072B2"), (40, "#D55E00")):
    build = asperity.build_master_curve(isotherms, reference_temperature=273.15 + celsius)
    setting = {
        "pressure": 300e3,
        "velocity": velocity,
        "correction": asperity.NayakSFactor(),
        "adhesion": asperity.Adhesion(shear_stress=5e6),
    }
    band = asperity.friction_band(road, build, seed=1, **setting)
    mu = asperity.friction(road, build.master_curve, **setting).mu
    axes.fill_between(velocity, band.lower, band.upper, color=colour, alpha=0.3, linewidth=0)
    axes.plot(velocity, mu, color=colour, label=f"{celsius} °C")
axes.set(xscale="log", xlabel="sliding velocity [m/s]", ylabel="friction coefficient [-]")
axes.set_ylim(bottom=0)
axes.legend()
