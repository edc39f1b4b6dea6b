"""Contact area and hysteretic friction of Prony rubbers on self-affine surfaces.

The definitions are article Eqs 5 to 8 and 22 as fixed by THEORY.md sections 3 to 5; each row is
computed by both methods of friction_scene.py. Method one takes the angular integrals from their
definition (trapezoidal rule in z, cos(phi) = sech(z)), method two from the closed forms.
"""

import numpy as np
import tables
from friction_scene import area_law, columns, solve
from scipy.integrate import cumulative_simpson, simpson

Z = np.arange(0, 45, 0.2)
SECH = 1 / np.cosh(Z)
TRAPEZOID = 0.8 * np.where(Z == 0, 0.5, 1.0)

TIMES = [10.0 ** (-12 + 14 * k / 19) for k in range(20)]
SHARE = [np.exp(-(((np.log10(t) + 6.5) / 3.0) ** 2)) for t in TIMES]
SBR = {
    "equilibrium_modulus": 3e6,
    "moduli": [float(f"{1.5e9 * s / sum(SHARE):.6g}") for s in SHARE],
    "relaxation_times": TIMES,
}
ONE_TERM = {"equilibrium_modulus": 1e6, "moduli": [1e9], "relaxation_times": [1e-5]}
ELASTIC = {"equilibrium_modulus": 1e7, "moduli": [], "relaxation_times": []}
ASPHALT = {"rms_height": 265.7e-6, "hurst": 0.87, "q0": 2000.0, "q1": 1e6, "pressure": 81e3}
SANDPAPER = {**ASPHALT, "rms_height": 76.572e-6, "hurst": 0.7}
USUAL = {**ASPHALT, **SBR, "rolloff": None, "velocity": 1e-2, "poisson_ratio": 0.5}
USUAL |= {"shift_factor": 1.0, "gamma": 0.5, "form": "exact"}

SCENES = {
    f"asphalt v {v:g}": {"velocity": v} for v in (1e-6, 1e-5, 1e-4, 1e-3, 1e-2, 0.1, 1.0, 10.0)
}
SCENES |= {f"sandpaper v {v:g}": {**SANDPAPER, "velocity": v} for v in (1e-5, 1e-2, 1.0)}
SCENES |= {
    "front 1e-5": {"pressure": 3.7e3, "velocity": 1e-4},
    "front 1e-7": {"pressure": 370.0, "velocity": 1e-4},
    "full contact": {"rms_height": 1e-6, "pressure": 1e9},
    "beyond full contact": {"rms_height": 1e-7, "pressure": 1e10},
    "weak contact": {"pressure": 900.0, "velocity": 1.0},
    "near full contact": {"rms_height": 2e-6, "pressure": 7.5e5, "q1": 1e5},
    "elastic": ELASTIC,
    "elastic soft": {**ELASTIC, "equilibrium_modulus": 1e5, "pressure": 1e6},
    "one term": ONE_TERM,
    "one term glassy": {**ONE_TERM, "velocity": 10.0},
    "no equilibrium modulus": {**ONE_TERM, "equilibrium_modulus": 0.0},
    "hurst 0.01": {"hurst": 0.01},
    "hurst 1": {"hurst": 1.0},
    "bandwidth 1.0001": {"q1": 2000.2, "pressure": 3e6},
    "bandwidth 1e6": {"q0": 200.0, "q1": 2e8},
    "rolloff": {"rolloff": 6000.0},
    "rolloff near the end": {"q0": 100.0, "rolloff": 5e4, "q1": 1e5, "velocity": 0.3},
    "poisson 0": {"poisson_ratio": 0.0},
    "poisson 0.49": {"poisson_ratio": 0.49},
    "interpolated form": {"form": "interpolated"},
    "interpolated form near full contact": {
        "form": "interpolated",
        "rms_height": 2e-6,
        "pressure": 7.5e5,
        "q1": 1e5,
    },
    "shift factor 2": {"shift_factor": 2.0},
    "shift factor 2 rolloff": {"shift_factor": 2.0, "rolloff": 4000.0, "gamma": 0.4},
    "gamma 0": {"gamma": 0.0},
    "gamma 0.4": {"gamma": 0.4},
    "gamma 1": {"gamma": 1.0},
}


def row(case, changes):
    """Return one row, both methods compared."""
    scene = {"case": case, **USUAL, **changes}
    rubber = [scene[key] for key in SBR]

    def brute(w):
        storage, loss = tables.prony(w[:, None] * SECH, *rubber)
        weight = SECH * TRAPEZOID
        return (SECH * loss) @ weight, (storage**2 + loss**2) @ weight

    def closed(w):
        return tables.prony_integrals(w, *rubber, sqrt=np.sqrt)

    first, second = solve(scene, brute, closed)
    for a, b in zip(first, second, strict=True):
        tables.agree("friction", a, b, 1e-8)
    print(f"{case:36s}", " ".join(f"{x:.10g}" for x in first))
    keys = ["case", "rms_height", "hurst", "q0", "q1", "rolloff", *SBR, "pressure", "velocity"]
    keys += ["poisson_ratio", "shift_factor", "gamma", "form"]
    return {key: scene[key] for key in keys} | columns(first)


def check_literally(answer):
    """Check one row (no narrow front) to 1e-5 by sums over grids of q and phi, written out."""
    s = answer
    q = np.geomspace(s["q0"], s["q1"], 4001)
    phi = (np.arange(2000) + 0.5) * 2 * np.pi / 2000
    modulus = np.full((q.size, phi.size), complex(s["equilibrium_modulus"]))
    for e, tau in zip(s["moduli"], s["relaxation_times"], strict=True):
        iwt = 1j * s["velocity"] * q[:, None] * np.cos(phi) * tau
        modulus += e * iwt / (1 + iwt)
    i1 = np.mean(np.cos(phi) * modulus.imag, axis=1) * 2 * np.pi
    i2 = np.mean(np.abs(modulus) ** 2, axis=1) * 2 * np.pi
    h = s["hurst"]
    c = h / np.pi * (s["rms_height"] / s["q0"]) ** 2 * (q / s["q0"]) ** (-2 * (h + 1))
    c /= 1 - (s["q1"] / s["q0"]) ** (-2 * h)
    load = (1 - s["poisson_ratio"] ** 2) * s["pressure"]
    g = cumulative_simpson(q**3 * c * i2 / 8 / load**2, x=q, initial=0)
    p = area_law(s["form"])(np.maximum(g, 1e-99))
    hysteresis = simpson(0.5 * q**3 * c * p * i1 / load, x=q)
    s_factor = s["gamma"] + (1 - s["gamma"]) * p**2
    hysteresis_s = simpson(0.5 * q**3 * c * p * s_factor * i1 / load, x=q)
    names = ("g", "contact_area", "hysteresis", "hysteresis_s")
    for name, value in zip(names, (g[-1], p[-1], hysteresis, hysteresis_s), strict=True):
        assert abs(value - s[name]) <= 1e-5 * s[name], (name, value, s[name])
    grid = np.linspace(0, s["g"], 20001)
    rate = 1 / (s["gamma"] + (1 - s["gamma"]) * area_law(s["form"])(np.maximum(grid, 1e-99)) ** 2)
    corrected = np.interp(s["g"], cumulative_simpson(rate, x=grid, initial=0), grid)
    assert abs(area_law(s["form"])(corrected) - s["contact_area_s"]) <= 1e-5


def main():
    """Write friction.csv."""
    rows = [row(case, changes) for case, changes in SCENES.items()]
    for answer in rows:
        if answer["case"] in ("near full contact", "full contact", "bandwidth 1.0001"):
            check_literally(answer)
    comments = [
        "Contact area and hysteretic friction: article Eqs 5-8 and 22, THEORY.md sections 3 to 5.",
        "Generated by make_friction.py in double precision, two methods agreeing to 1e-8.",
        "g = G(q1). contact_area = P(g). contact_area_s: S = gamma + (1 - gamma) P^2 inside G,",
        "self-consistent. hysteresis: no S. hysteresis_s: S of the uncorrected P in the integrand.",
        "form: exact, P = erf(1 / (2 sqrt G)); interpolated, P = (1 + (pi G)^1.5)^(-1/3).",
        "shift_factor p divides C by p^2; rolloff empty: none; moduli empty: elastic.",
        "Units: rms_height m; q0, q1, rolloff 1/m; moduli, pressure Pa; relaxation_times s;",
        "velocity m/s; the rest none.",
    ]
    tables.write("friction", comments, rows)


if __name__ == "__main__":
    main()
