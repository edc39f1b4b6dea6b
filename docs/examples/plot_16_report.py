"""
A report of two scenes
======================

The same road and rubber with and without adhesion, written as one HTML file. From the shell it is
`asperity report dry.toml wet.toml --output report.html`.
"""

from pathlib import Path
from tempfile import TemporaryDirectory

import matplotlib.pyplot as plt

import asperity
from asperity.report.comparison import VERDICTS, compared
from asperity.scene.scene import load_scene

scene = """
[surface]
rms_height_m = 265.7e-6
hurst = 0.87
q0_per_m = 2000
q1_per_m = 1e6
slope_cutoff = 1.3
[rubber]
equilibrium_modulus_pa = 3e6
moduli_pa = [1e9, 3e8, 1e8, 3e7, 1e7]
relaxation_times_s = [1e-8, 1e-7, 1e-6, 1e-5, 1e-4]
[conditions]
pressure_pa = 81e3
velocity_m_s = { from = 1e-5, to = 1, points = 41 }
[correction]
kind = "partial-contact"
"""
adhesion = "[adhesion]\nshear_stress_pa = 2e6\n"

with TemporaryDirectory() as folder:
    names = {"dry.toml": scene + adhesion, "wet.toml": scene}
    for name, text in names.items():
        (Path(folder) / name).write_text(text)
    scenes = [load_scene(Path(folder) / name) for name in names]
    asperity.report([one.path for one in scenes], Path(folder) / "report.html")
    page = (Path(folder) / "report.html").read_text()

print(f"{len(page) / 1e6:.1f} MB, {page.count('<svg')} pictures")

# %%
# What it says of the two, point by point.

curves = [one.friction() for one in scenes]
(pair,) = compared(list(names), scenes, curves)
figure, axes = plt.subplots(layout="constrained")
for one, result, label in zip(scenes, curves, names, strict=True):
    axes.plot(one.velocity, result.mu[0], label=label)
for verdict, meaning in enumerate(VERDICTS):
    there = [one for one in pair.differences if one.verdict == verdict]
    if there:
        axes.plot(
            [one.velocity for one in there], [one.second for one in there], "o", ms=4, label=meaning
        )
axes.set(xscale="log", xlabel="sliding velocity [m/s]", ylabel="friction coefficient [-]")
axes.set_title("Points of wet.toml by how they differ", fontsize="medium")
figure.legend(loc="outside lower center", fontsize="small")
