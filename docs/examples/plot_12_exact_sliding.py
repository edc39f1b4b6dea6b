"""
Exact sliding contact
=====================

``asperity.validation.slide`` solves the contact of a small map that slides on the rubber, point by
point. On the left its pressure; on the right its hysteresis beside the theory's.
"""

import matplotlib.pyplot as plt
import numpy as np

import asperity

law = asperity.SelfAffineSpectrum(rms_height=1e-4, hurst=0.8, q0=2000, q1=16000)
surface = asperity.synthesize(law, shape=(96, 96), pixel_size=2 * np.pi / 500 / 96, seed=4)
rubber = asperity.PronySeries(
    equilibrium_modulus=3e6, moduli=[3e6, 1e7, 3e7], relaxation_times=[1e-3, 1e-4, 1e-5]
)
velocity = np.geomspace(1e-3, 10, 9)
exact = [
    asperity.validation.slide(surface, rubber, pressure=0.3e6, velocity=v, periodic=True)
    for v in velocity
]

figure, (left, right) = plt.subplots(1, 2, figsize=(9, 3.8), layout="constrained")
image = left.imshow(1e-6 * exact[4].pressure, cmap="cividis")
figure.colorbar(image, ax=left, label="pressure [MPa]")
left.set(xlabel="x [pixels]", ylabel="y [pixels]", title=f"{velocity[4]:.2g} m/s")
fine = np.geomspace(1e-3, 10, 80)
for name, correction in (
    ("PartialContact", asperity.PartialContact()),
    ("NayakSFactor", asperity.NayakSFactor()),
    ("no correction", None),
):
    theory = asperity.friction(law, rubber, pressure=0.3e6, velocity=fine, correction=correction)
    right.plot(fine, theory.hysteresis, label=name)
right.plot(velocity, [contact.hysteresis for contact in exact], "ko", label="exact, this map")
right.set(xscale="log", xlabel="sliding velocity [m/s]", ylabel="hysteresis [-]")
right.legend()
