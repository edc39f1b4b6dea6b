"""
What a correction does to the hysteresis
========================================

The same road and rubber under different corrections. Which of them is near the truth is told by
exact contacts, see "What each correction is worth".
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
corrections = {
    "none": None,
    "PartialContact": asperity.PartialContact(),
    "NayakSFactor": asperity.NayakSFactor(),
    "S factor, 0.5": asperity.SFactor(gamma=0.5),
    "p_T = 2": asperity.AffineShift(2),
    "IGW, implicit": asperity.GreenwoodWilliamson(z_max=0.9e-3, z_min=-0.9e-3),
    "IGW, added": asperity.GreenwoodWilliamson(z_max=0.9e-3, z_min=-0.9e-3, reading="added"),
}

figure, axes = plt.subplots(layout="constrained")
for name, correction in corrections.items():
    result = asperity.friction(
        road, rubber, pressure=300e3, velocity=np.geomspace(1e-6, 1, 60), correction=correction
    )
    axes.plot(result.velocity, result.hysteresis, label=name)
axes.set(xscale="log", xlabel="sliding velocity [m/s]", ylabel="hysteresis [-]")
axes.set_ylim(0, 1)
axes.legend(loc="upper left", ncols=3)
