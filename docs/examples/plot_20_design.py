"""
A rubber of three terms for grip and rolling loss
=================================================

A tread is to hold mu = 0.3 at 0.1 m/s and 0.35 at 1 m/s, and to lose little in rolling, where its
loss tangent at 10 Hz counts. SciPy moves the moduli and relaxation times of three Prony terms;
slopes of mu come with mu itself, so that one evaluation tells where to go in all six numbers.
"""

import matplotlib.pyplot as plt
import numpy as np
from scipy.optimize import minimize

import asperity

road = asperity.SelfAffineSpectrum(rms_height=265e-6, hurst=0.87, q0=300, q1=2e5)
points = {"pressure": 2e5, "velocity": [0.1, 1.0], "correction": asperity.PartialContact()}
GRIP = np.array([0.3, 0.35])
STIFF, ROLLING = 3e6, 2 * np.pi * 10  # E' [Pa] at an angular frequency [rad/s]


def rubber(x):
    """Logarithms of three moduli [Pa] and three relaxation times [s]."""
    moduli, times = np.exp(x).reshape(2, 3)
    return asperity.PronySeries(equilibrium_modulus=2e6, moduli=moduli, relaxation_times=times)


def grip(x):
    """mu at both speeds, and d mu over all six logarithms."""
    result = asperity.friction(road, rubber(x), gradients=True, **points)
    of = result.gradients
    return result.mu, np.hstack([of.moduli, of.relaxation_times])


def rolling(x):
    """E' and E'' at 10 Hz, and their slopes: E = E_inf + sum E_i i w t_i / (1 + i w t_i)."""
    moduli, times = np.exp(x).reshape(2, 3)
    wt = ROLLING * times
    term = moduli * 1j * wt / (1 + 1j * wt)
    slopes = np.append(term, term / (1 + 1j * wt))
    return 2e6 + term.sum(), slopes


def loss_tangent(x):
    e, slopes = rolling(x)
    tangent = e.imag / e.real
    return tangent, slopes.imag / e.real - tangent * slopes.real / e.real


start = np.log([1e7, 3e7, 1e8, 1e-3, 1e-5, 1e-7])
limits = {
    "bounds": [(np.log(1e5), np.log(3e8))] * 3 + [(np.log(1e-8), np.log(0.1))] * 3,
    "constraints": [
        {"type": "ineq", "fun": lambda x: grip(x)[0] - GRIP, "jac": lambda x: grip(x)[1]},
        {
            "type": "ineq",
            "fun": lambda x: rolling(x)[0].real / STIFF - 1,
            "jac": lambda x: rolling(x)[1].real / STIFF,
        },
    ],
}
result = minimize(loss_tangent, start, jac=True, method="SLSQP", **limits)
assert result.success

# %%
# Grip is made at the frequencies of the road's waves and rolling loss at 10 Hz: the terms move to
# where the one needs them and the other sees little of them.

figure, (left, right) = plt.subplots(1, 2, figsize=(9, 3.6), layout="constrained")
w = np.geomspace(1, 1e9, 200)
for name, x, colour in (("start", start, "0.6"), ("design", result.x, "C0")):
    modulus = rubber(x).modulus(w)
    left.plot(w, modulus.imag / modulus.real, color=colour, label=name)
left.axvline(ROLLING, color="C3", lw=0.8, label="10 Hz")
left.axvspan(0.1 * road.q0, road.q1, color="0.9", zorder=0, label="waves of the road")
left.set(xscale="log", xlabel="angular frequency [rad/s]", ylabel="loss tangent [-]")
left.legend(fontsize="small")
velocity = np.geomspace(1e-2, 10, 40)
for name, x, colour in (("start", start, "0.6"), ("design", result.x, "C0")):
    mu = asperity.friction(road, rubber(x), **{**points, "velocity": velocity}).mu
    right.plot(velocity, mu, color=colour, label=name)
right.plot(points["velocity"], GRIP, "o", color="C3", label="asked for")
right.set(xscale="log", xlabel="sliding velocity [m/s]", ylabel="friction coefficient [-]")
right.legend(fontsize="small")

# %%
for name, x in (("start", start), ("design", result.x)):
    slow, fast = grip(x)[0]
    print(f"{name}: mu {slow:.3f} and {fast:.3f}, loss tangent {loss_tangent(x)[0]:.4f} at 10 Hz")
for modulus, time in np.exp(result.x).reshape(2, 3).T:
    print(f"  {modulus / 1e6:.3g} MPa at {time:.2g} s")
