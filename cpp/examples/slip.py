"""The slip curve of the tire models in this folder: by the full theory and the map, cold and hot.

    cmake -S cpp/examples/brush_full -B build/brush_full \\
        -DASPERITY_SOURCE_DIR=$PWD -DCMAKE_BUILD_TYPE=Release
    cmake --build build/brush_full
    python cpp/examples/slip.py build/brush_full/brush_full docs/embedding/slip.png

Runs the built example, which takes some fifteen seconds, and draws what it prints. Needs NumPy and
matplotlib.
"""

import io
import re
import subprocess
import sys
import tempfile
from pathlib import Path

import matplotlib
import numpy as np

BLUE, ORANGE, GREEN = "#0072B2", "#D55E00", "#009E73"
# of `Tire` in brush.hpp: k L / (2 mean pressure), the slope over v_s / v_r = s / (1 - s)
STIFFNESS = 1e8 * 0.1 / (2 * 2.5e5)
STYLE = {
    "font.size": 8,
    "axes.linewidth": 0.6,
    "axes.spines.top": False,
    "lines.linewidth": 1.4,
    "legend.frameon": False,
    "xtick.direction": "in",
    "ytick.direction": "in",
}


def run(example: str) -> tuple[np.ndarray, float]:
    """Columns of the CSV that `brush_full` prints, and the relative difference it allows."""
    with tempfile.TemporaryDirectory() as folder:
        command = [example, str(Path(folder) / "road.fmap")]
        done = subprocess.run(command, capture_output=True, text=True, check=True)
    allowed = re.search(r"max_error (\S+)", done.stderr)
    if allowed is None:
        raise SystemExit(f"{example}: is not brush_full: {done.stderr}")
    return np.loadtxt(io.StringIO(done.stdout), delimiter=",", skiprows=1).T, float(allowed[1])


def draw(path: str, columns: np.ndarray, allowed: float) -> None:
    import matplotlib.pyplot as plt

    slip, force, _, by_map, hot, memory = columns
    percent = 100 * slip
    figure, (curve, apart) = plt.subplots(
        1, 2, figsize=(7, 2.8), width_ratios=(3, 2), layout="constrained"
    )
    for axes, name in ((curve, "(a)"), (apart, "(b)")):
        axes.set_title(name, loc="left", fontsize=8, fontweight="bold")
        axes.set_xlabel("slip [%]")
        axes.spines.right.set_visible(False)

    linear = np.linspace(0, 0.0475, 30)
    stiff = STIFFNESS * linear / (1 - linear)
    curve.plot(100 * linear, stiff, "--", color="0.5", lw=0.9, label="bristle stiffness")
    near = percent < 40
    ring = {"ms": 3.5, "mfc": "none", "mew": 0.9}
    curve.plot([0, *percent], [0, *force], color=BLUE, label="cold, full theory at every bristle")
    curve.plot(percent[near], by_map[near], "o", color=BLUE, label="cold, friction map", **ring)
    curve.plot([0, *percent], [0, *memory], color=GREEN, label="heats up as it slides, map")
    curve.plot([0, *percent], [0, *hot], "-.", color=ORANGE, label="hot from the start, map")
    curve.set(xlim=(0, 40), ylim=(0, 1), ylabel="braking force / load [-]")
    curve.legend(loc="lower right")

    off = np.abs(by_map / force - 1)
    apart.loglog(percent, off, "o-", color=BLUE, ms=3, lw=0.8, label="cold map against theory")
    apart.axhline(allowed, color="0.3", lw=0.9, ls="--", label="allowed by max_error")
    apart.set(ylabel="relative difference of the force [-]", ylim=(off.min() / 100, 5 * allowed))
    apart.xaxis.set_major_formatter("{x:g}")
    apart.legend(loc="lower right")
    Path(path).parent.mkdir(parents=True, exist_ok=True)
    figure.savefig(path, dpi=200)


if __name__ == "__main__":
    if len(sys.argv) != 3:
        raise SystemExit(f"usage: {sys.argv[0]} BRUSH_FULL PICTURE")
    matplotlib.use("Agg")
    with matplotlib.rc_context(STYLE):
        draw(sys.argv[2], *run(sys.argv[1]))
