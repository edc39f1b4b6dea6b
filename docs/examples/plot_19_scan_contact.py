"""
The contact of a scan itself
============================

The tops of this surface are worn, and no correction that knows it by its spectrum alone can tell.
``ScanContact`` solves the contact of the scan at some fifteen velocities and carries the theory
between them. Marks are exact contacts at velocities that it has not solved.
"""

import matplotlib.pyplot as plt
import numpy as np

import asperity
from asperity.validation import slide

law = asperity.SelfAffineSpectrum(rms_height=1e-4, hurst=0.8, q0=2513, q1=2e4)
rough = asperity.synthesize(law, shape=(128, 128), pixel_size=1e-2 / 128, seed=7).heights
worn = -np.logaddexp(0, -1.5e4 * rough)  # tops are flattened, valleys stay
k = 2 * np.pi * np.fft.fftfreq(128, 1e-2 / 128)
outside = abs(np.hypot(k, k[:, None]) - 11257) > 8744  # of the band that is compared
modes = np.fft.fft2(1e-4 * worn)
modes[outside] = 0
scan = asperity.HeightMap(np.fft.ifft2(modes).real, pixel_size=1e-2 / 128)
spectrum = asperity.power_spectrum(scan, window="none", detrend=None).truncated(q0=2513, q1=2e4)
rubber = asperity.PronySeries(
    equilibrium_modulus=1e6,
    moduli=np.geomspace(1e6, 1e8, 8),
    relaxation_times=np.geomspace(1e-1, 1e-7, 8),
)
exact = asperity.ScanContact(scan, periodic=True)  # a measured scan: leave periodic out
scene = {"pressure": 2e5, "velocity": np.geomspace(1e-5, 10, 61)}
of_scan = asperity.friction(spectrum, rubber, correction=exact, **scene)
of_spectrum = asperity.friction(spectrum, rubber, correction=asperity.PartialContact(), **scene)
print(exact.contacts)
print(*[note for note in of_spectrum.notes if "skewness" in note])

figure, (left, right) = plt.subplots(1, 2, figsize=(9.5, 3.7), layout="constrained")
v, low, high = of_scan.velocity, 1 - of_scan.model_error, 1 + of_scan.model_error
left.fill_between(v, of_scan.mu * low, of_scan.mu * high, alpha=0.25, linewidth=0)
left.semilogx(v, of_scan.mu, label="ScanContact, with its model_error")
left.semilogx(v, of_spectrum.mu, "--", label="PartialContact, from the spectrum")
for velocity in 1.7 * np.geomspace(1e-5, 1, 6):
    contact = slide(scan, rubber, pressure=2e5, velocity=velocity, periodic=True, rtol=1e-4)
    left.plot(velocity, contact.hysteresis, "ko", markersize=4)
left.plot([], [], "ko", markersize=4, label="exact contact")
left.set(xlabel="sliding velocity [m/s]", ylabel="hysteresis $\\mu$ [-]", ylim=(0, 0.26))
left.legend(fontsize="small", loc="upper left")
contact.plot(ax=right)
right.set_title(f"pressure at {velocity:.2g} m/s", fontsize="medium")
