"""Draws the pictures that the README and the pages show but that no example of the gallery is.

python docs/draw.py           writes docs/mu.png by the example that it is of
"""

import runpy
import sys
from pathlib import Path

import matplotlib

HERE = Path(__file__).parent
PICTURES = {"mu.png": "examples/plot_14_hot_and_cold.py"}


def main() -> None:
    matplotlib.use("agg")
    from matplotlib import pyplot as plt

    sys.path.insert(0, str(HERE / "_extensions"))
    from gallery_style import style

    for picture, example in PICTURES.items():
        style(None, None)
        runpy.run_path(str(HERE / example))
        plt.gcf().savefig(HERE / picture, dpi=150, metadata={"Software": None})
        plt.close("all")


if __name__ == "__main__":
    main()
