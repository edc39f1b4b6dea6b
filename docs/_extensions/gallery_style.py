"""How the pictures of the gallery look: those of the package, so that one paper may have both."""

from typing import Any


def style(gallery_conf: Any, name: Any) -> None:
    """Before each example: the colours, ticks and size of the package's own pictures."""
    from cycler import cycler
    from matplotlib import rcParams

    from asperity.draw.style import COLOURS

    rcParams["axes.prop_cycle"] = cycler(color=COLOURS)
    rcParams["figure.figsize"] = (6.6, 3.6)
    rcParams["legend.fontsize"] = "small"
    for side in ("xtick", "ytick"):
        rcParams[f"{side}.direction"] = "in"
    rcParams["xtick.top"] = rcParams["ytick.right"] = True
