"""A figure of the article as a picture and as a table of the numbers it shows."""

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from asperity.base.diagnostics import Note
from asperity.draw.figure import legend as legend_above
from asperity.draw.figure import picture
from asperity.draw.style import narrow
from asperity.io.table import Table
from asperity.spectrum import SelfAffineSpectrum
from asperity_scripts.article.inputs import PIXELS, SEEDS, SIDE, SKEWNESS, VELOCITY, Inputs, Tuned

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

LOG: dict[str, Any] = {"xscale": "log", "yscale": "log"}


def page(
    name: str,
    figure: "Figure",
    inputs: Mapping[str, Any],
    columns: Mapping[str, Sequence[Any]],
    *notes: str,
) -> dict[str, bytes]:
    """`name`.png and `name`.csv, which opens with the inputs and notes."""
    return {
        f"{name}.png": picture(figure, Path(f"{name}.png")),
        f"{name}.csv": Table(f"article {name}", [inputs], [*map(Note, notes)], columns)
        .csv()
        .encode(),
    }


def panel(axes: "Axes", title: str = "", legend: Any = None, **settings: Any) -> None:
    """Scales, limits and labels as `Axes.set` takes them, a title, and a legend at its place."""
    axes.set(**settings)
    axes.set_title(title, fontsize="medium")
    if legend is not None and narrow():  # where places of the wide picture may be taken
        legend_above(axes)
    elif legend is not None:
        axes.legend(loc=legend, fontsize="small")


def stacked(curves: Sequence[Mapping[str, Any]]) -> dict[str, list[Any]]:
    """Curves below one another: arrays of one length and labels; a cell is empty where not said."""
    names = list(dict.fromkeys(name for curve in curves for name in curve))
    columns: dict[str, list[Any]] = {name: [] for name in names}
    for curve in curves:
        rows = max(len(v) for v in curve.values() if not isinstance(v, str | float))
        for name in names:
            cells = curve.get(name, "")
            one = isinstance(cells, str | float)
            columns[name] += [cells] * rows if one else np.asarray(cells).tolist()
    return columns


def sandpaper_inputs(inputs: Inputs) -> dict[str, Any]:
    return {"surface": "120-grit sandpaper", **_band(inputs.sandpaper)}


def asphalt_inputs(inputs: Inputs) -> dict[str, Any]:
    return {"surface": "asphalt", **_band(inputs.asphalt)}


def scan_inputs(skewness: float = SKEWNESS) -> dict[str, Any]:
    return {"side_lambda0": SIDE, "pixels": PIXELS, "skewness": skewness, "seed": SEEDS[0]}


def tuned_inputs(tuned: Tuned) -> dict[str, Any]:
    return {
        "compound": "A, tuned",
        "reading": tuned.implied.reading,
        "tuned_by_decades": tuned.decades,
        "effective_modulus_pa": tuned.implied.effective_modulus,
        "at_velocity_m_s": VELOCITY,
        "z_max_m": tuned.implied.z_max,
        "z_min_m": tuned.implied.z_min,
    }


def _band(surface: SelfAffineSpectrum) -> dict[str, float]:
    return {
        "rms_height_m": surface.rms_height,
        "hurst": surface.hurst,
        "q0_per_m": surface.q0,
        "q1_per_m": surface.q1,
    }
