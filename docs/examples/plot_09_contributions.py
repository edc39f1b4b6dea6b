"""
Which wavelengths and frequencies make the friction
===================================================

``contributions=True`` tells how much of the hysteresis each wavenumber makes, and how much each
decade of frequency. Here the spectrum is not cut at a slope, so that many decades take part.
"""

import matplotlib.pyplot as plt
import numpy as np

import asperity

road = asperity.SelfAffineSpectrum(rms_height=265.7e-6, hurst=0.87, q0=2000, q1=1e6)
rubber = asperity.PronySeries(
    equilibrium_modulus=3e6,
    moduli=10 ** np.linspace(6, 9, 16),
    relaxation_times=10 ** np.linspace(2, -8, 16),
)
result = asperity.friction(
    road,
    rubber,
    pressure=300e3,
    velocity=[1e-5, 1e-3, 1e-1],
    correction=asperity.PartialContact(),
    contributions=True,
)

figure, (left, right) = plt.subplots(1, 2, figsize=(9, 3.6), layout="constrained")
for velocity, density, share in zip(
    result.velocity, result.dmu_dlnq, result.decade_share, strict=True
):
    (curve,) = left.plot(result.wavenumber, density)
    edges = np.log10(result.decade_edges)
    right.stairs(100 * share, edges, color=curve.get_color())
    most = np.argmax(share)
    name = f"{velocity:g} m/s"
    right.text(edges[most], 100 * share[most] + 1, name, color=curve.get_color())
left.set(xscale="log", yscale="log", xlabel="wavenumber [1/m]", ylabel="d mu / d ln q [-]")
right.set(xlabel="log10 of angular frequency [rad/s]", ylabel="share of the hysteresis [%]")
right.set_ylim(0, 56)
