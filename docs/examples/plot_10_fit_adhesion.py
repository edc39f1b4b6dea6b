"""
Adhesion from a friction test
=============================

The points are made here, with a scatter of 4 % and two gross outliers. The fit puts the outliers
aside and returns the shear stress with its standard error.
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
setting = {"pressure": 300e3, "correction": asperity.PartialContact()}
velocity = np.geomspace(1e-6, 1e-2, 24)
truth = asperity.friction(
    road, rubber, velocity=velocity, adhesion=asperity.Adhesion(shear_stress=5e6), **setting
)
measured = truth.mu * (1 + 0.04 * np.random.default_rng(3).standard_normal(24))
measured[[5, 17]] *= [1.6, 0.5]

held = {"width": 0.1}
fit = asperity.fit_adhesion(road, rubber, velocity=velocity, mu=measured, fixed=held, **setting)
curve = np.geomspace(1e-6, 1e-2, 100)
fitted = asperity.friction(road, rubber, velocity=curve, adhesion=fit, **setting)

figure, axes = plt.subplots(layout="constrained")
axes.plot(velocity[~fit.outliers], measured[~fit.outliers], "o", label="measured")
axes.plot(velocity[fit.outliers], measured[fit.outliers], "x", label="put aside")
axes.plot(curve, fitted.mu, label="fit")
axes.plot(curve, fitted.hysteresis, "--", label="hysteresis")
axes.set(xscale="log", xlabel="sliding velocity [m/s]", ylabel="friction coefficient [-]")
axes.set_ylim(bottom=0)
axes.legend()

# %%
# 5 MPa and 6 mm/s went in; the width was held.

for name, error in fit.standard_errors.items():
    print(f"{name} = {getattr(fit, name):.3g} +- {error:.1g}")
