"""Draws the pictures that the README and the pages show but that no example of the gallery is.

python docs/draw.py           docs/mu.png by the example that it is of, docs/tutorial.png by the
                              tutorial's own lines and scene, docs/explanation/heat.png
"""

import os
import re
import runpy
import sys
from contextlib import chdir
from pathlib import Path
from tempfile import TemporaryDirectory

import matplotlib

HERE = Path(__file__).parent
EXAMPLES = {"mu.png": "examples/plot_14_hot_and_cold.py"}
# the scene of tests/reference/flash.csv, which names the rubber's terms in its comments
HEAT = """
surface = {{ rms_height_m = 265.7e-6, hurst = 0.87, q0_per_m = 2000, q1_per_m = 23339.77 }}
conditions = {{ pressure_pa = 2e5, temperature_c = 20, \
velocity_m_s = {{ from = 1e-6, to = 10, points = 61 }} }}
heating = {{ density_kg_m3 = 1200, heat_capacity_j_kg_k = 1650, conductivity_w_m_k = 0.23, \
contact_diameter_m = 1e-3 }}
[rubber]
equilibrium_modulus_pa = 2e6
moduli_pa = {moduli}
relaxation_times_s = {relaxation_times}
wlf_c1 = 8.86
wlf_c2_k = 101.6
reference_temperature_c = 20
"""


def draw_examples() -> None:
    from matplotlib import pyplot as plt

    sys.path.insert(0, str(HERE / "_extensions"))
    from gallery_style import style

    for picture, example in EXAMPLES.items():
        style(None, None)
        runpy.run_path(str(HERE / example))
        plt.gcf().savefig(HERE / picture, dpi=150, metadata={"Software": None})
        plt.close("all")
    matplotlib.rcdefaults()


def draw_scene(text: str, picture: Path) -> None:
    from asperity.cli.main import main

    Path("scene.toml").write_text(text, encoding="utf-8")
    if main(["friction", "scene.toml", "--output", os.devnull, "--plot", str(picture)]):
        raise SystemExit(1)


def draw_tutorial() -> None:
    """Its Python makes the files that its scene names."""
    page = (HERE / "tutorial.md").read_text(encoding="utf-8")
    exec("\n".join(re.findall(r"```python\n(.*?)```", page, re.DOTALL)), {})
    (scene,) = re.findall(r"```toml\n(.*?)```", page, re.DOTALL)
    draw_scene(scene, HERE / "tutorial.png")


def draw_heat() -> None:
    comments = (HERE.parent / "tests/reference/flash.csv").read_text(encoding="utf-8")
    result = re.findall(r"^# (moduli|relaxation_times) (.*)", comments, re.MULTILINE)
    lists = {name: [float(term) for term in terms.split()] for name, terms in result}
    draw_scene(HEAT.format(**lists), HERE / "explanation/heat.png")


if __name__ == "__main__":
    matplotlib.use("agg")
    draw_examples()
    with TemporaryDirectory() as aside, chdir(aside):
        draw_tutorial()
        draw_heat()
