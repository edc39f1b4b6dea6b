"""
Compounds, pressures and corrections at once
============================================

A sweep over any keys of a scene is an `xarray.Dataset`. Here keys of the rubber move together under
the name "compound". The same by the shell: `asperity sweep`, with `--plot` and `--rank` (see
"Compute many scenes at once").
"""

import matplotlib.pyplot as plt
import numpy as np

import asperity

scene = {
    "surface": {"rms_height_m": 2e-4, "hurst": 0.85, "q0_per_m": 2e3, "q1_per_m": 5e4},
    "rubber": {"relaxation_times_s": (10.0 ** np.arange(-9, 0)).tolist()},
    "conditions": {"velocity_m_s": {"from": 1e-6, "to": 1, "points": 60}},
}
soft, hard = (10 ** np.linspace(low, 6, 9) for low in (8.6, 9.0))
result = asperity.sweep(
    scene,
    {
        "correction.kind": ["none", "partial-contact"],
        "conditions.pressure_pa": [5e4, 2e5, 8e5],
        "compound": {
            "rubber.equilibrium_modulus_pa": [1.5e6, 3e6],
            "rubber.moduli_pa": [soft.tolist(), hard.tolist()],
        },
    },
)
panels = result.sizes["conditions.pressure_pa"]
figure, all_axes = plt.subplots(1, panels, sharey=True, figsize=(9, 3.2), layout="constrained")
velocity = result["conditions.velocity_m_s"]
by_pressure = result.mu.transpose("conditions.pressure_pa", "compound", "correction.kind", ...)
for axes, at_pressure in zip(all_axes, by_pressure, strict=True):
    for colour, name, mu in zip(("C0", "C1"), ("soft", "hard"), at_pressure, strict=True):
        plain, corrected = mu
        axes.semilogx(velocity, corrected, colour, label=name)
        axes.semilogx(velocity, plain, colour, linestyle=":", label=f"{name}, plain Persson")
    pressure = float(at_pressure["conditions.pressure_pa"])
    axes.set(title=f"{pressure / 1e3:.0f} kPa", xlabel="sliding velocity [m/s]")
all_axes[0].set_ylabel("friction coefficient [-]")
entries = all_axes[0].get_legend_handles_labels()
figure.legend(*entries, loc="outside right upper", fontsize="small")
