"""A figure of the article with the numbers it shows, and how curves share one CSV."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from asperity.article.inputs import PIXELS, SEEDS, SIDE, SKEWNESS, VELOCITY, Inputs, Tuned
from asperity.io.table import Table

if TYPE_CHECKING:
    from matplotlib.figure import Figure


@dataclass(frozen=True, eq=False)
class Page:
    """`name`.png and `name`.csv."""

    name: str
    figure: "Figure"
    table: Table


def page(
    name: str,
    figure: "Figure",
    inputs: Mapping[str, Any],
    columns: Mapping[str, Sequence[Any]],
    *notes: str,
) -> Page:
    """A page whose CSV opens with the inputs and notes."""
    return Page(name, figure, Table(f"article {name}", [inputs], notes, columns))


def stacked(curves: Sequence[Mapping[str, Any]]) -> dict[str, list[Any]]:
    """Curves below one another: arrays of one length and labels; a cell is empty where not said."""
    names = list(dict.fromkeys(name for curve in curves for name in curve))
    columns: dict[str, list[Any]] = {name: [] for name in names}
    for curve in curves:
        rows = max(len(v) for v in curve.values() if not isinstance(v, str | float))
        for name in names:
            cells = curve.get(name, "")
            columns[name] += [cells] * rows if isinstance(cells, str | float) else _plain(cells)
    return columns


def sandpaper_inputs(inputs: Inputs) -> dict[str, Any]:
    """The sandpaper's analytic spectrum."""
    return {"surface": "120-grit sandpaper", **_band(inputs.sandpaper)}


def asphalt_inputs(inputs: Inputs) -> dict[str, Any]:
    """The asphalt's analytic spectrum."""
    return {"surface": "asphalt", **_band(inputs.asphalt)}


def scan_inputs(skewness: float = SKEWNESS) -> dict[str, Any]:
    """The synthetic scan that is shown."""
    return {"side_lambda0": SIDE, "pixels": PIXELS, "skewness": skewness, "seed": SEEDS[0]}


def tuned_inputs(tuned: Tuned) -> dict[str, Any]:
    """Compound A as tuned to a reading."""
    return {
        "compound": "A, tuned",
        "reading": tuned.implied.reading,
        "tuned_by_decades": tuned.decades,
        "effective_modulus_pa": tuned.implied.effective_modulus,
        "at_velocity_m_s": VELOCITY,
        "z_max_m": tuned.implied.z_max,
        "z_min_m": tuned.implied.z_min,
    }


def _band(surface: Any) -> dict[str, float]:
    return {
        "rms_height_m": surface.rms_height,
        "hurst": surface.hurst,
        "q0_per_m": surface.q0,
        "q1_per_m": surface.q1,
    }


def _plain(cells: Any) -> list[Any]:
    return list(cells.tolist()) if hasattr(cells, "tolist") else list(cells)
