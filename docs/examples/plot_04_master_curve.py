"""
Isotherms become a master curve
===============================

Isotherms of a made-up rubber with 1 % of noise, measured over two and a half decades of frequency
at 19 temperatures, are shifted onto one another.
"""

import matplotlib.pyplot as plt
import numpy as np

import asperity

rubber = asperity.PronySeries(
    equilibrium_modulus=3e6,
    moduli=10 ** np.linspace(6, 9, 16),
    relaxation_times=10 ** np.linspace(2, -8, 16),
)
noise = np.random.default_rng(1)
isotherms = []
for celsius in range(-30, 61, 5):
    w = 2 * np.pi * np.geomspace(0.1, 30, 12)
    a_t = 10 ** (-8.06 * (celsius - 20) / (111.6 + celsius - 20))
    modulus = rubber.modulus(w * a_t)
    storage, loss = (
        part * (1 + 0.01 * noise.standard_normal(12)) for part in (modulus.real, modulus.imag)
    )
    isotherms.append(
        asperity.Isotherm(
            temperature=273.15 + celsius,
            angular_frequency=w,
            storage_modulus=storage,
            loss_modulus=loss,
        )
    )
build = asperity.build_master_curve(isotherms, reference_temperature=293.15)
series = asperity.fit_prony(build)

figure, (left, right) = plt.subplots(1, 2, figsize=(9, 3.6), layout="constrained")
celsius = plt.cm.ScalarMappable(plt.Normalize(-30, 60), "cividis")
for isotherm in isotherms:
    colour = celsius.to_rgba(isotherm.temperature - 273.15)
    left.loglog(isotherm.angular_frequency, isotherm.storage_modulus, ".-", color=colour)
left.set(xlabel="angular frequency [rad/s]", ylabel="E' [Pa]", title="isotherms")
figure.colorbar(celsius, ax=left, label="temperature [°C]")

points = build.points
right.loglog(points.angular_frequency, points.storage_modulus, ".", label="E'")
right.loglog(points.angular_frequency, points.loss_modulus, ".", label="E''")
w = np.geomspace(points.angular_frequency.min(), points.angular_frequency.max(), 300)
right.loglog(w, series.modulus(w).real, "k", linewidth=0.8, label="Prony series")
right.loglog(w, series.modulus(w).imag, "k", linewidth=0.8)
right.set(xlabel="reduced frequency [rad/s]", ylabel="modulus [Pa]", title="master curve at 20 °C")
right.legend()

# %%
# The constants of WLF that come out; 8.06 and 111.6 K went in.

wlf = build.fit_wlf()
print(f"c1 = {wlf.c1:.2f} +- {wlf.standard_errors['c1']:.2f}, c2 = {wlf.c2:.1f} K")
