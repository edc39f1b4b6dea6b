"""Styles of pictures: the width of a page or of one column on paper, and dark screens."""

from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from contextvars import ContextVar
from typing import TYPE_CHECKING, Any

import numpy as np

from asperity.base.codes import FATAL
from asperity.base.diagnostics import Note, fatal_first

if TYPE_CHECKING:
    from matplotlib.axes import Axes as Axes
    from matplotlib.cm import ScalarMappable as ScalarMappable
    from matplotlib.colors import Colormap
    from matplotlib.figure import Figure as Figure
else:  # matplotlib is imported where something is drawn
    Axes = Colormap = Figure = ScalarMappable = Any

STYLES = ("print", "single", "dark")

# Okabe and Ito's palette, told apart by colour-blind readers; more curves than it has take cividis.
COLOURS = ("#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9", "#000000")
# the same where black was white, bright ones first
_ON_DARK = ("#56B4E9", "#E69F00", "#2FC7A0", "#E29BC4", "#F0E442", "#E8703A", "#FFFFFF")
_PAPER, _INK = "#16191d", "#e6e6e6"  # of dark screens
_DARK_PAPER = 0.1  # the same as a grey
_PAPERS = ("figure.facecolor", "axes.facecolor", "savefig.facecolor", "legend.facecolor")
_INKS = ("text.color", "axes.edgecolor", "axes.labelcolor", "xtick.color", "ytick.color")
_SETTINGS: Mapping[str, Any] = {  # of matplotlib
    "print": {},
    "single": {"font.size": 8, "axes.linewidth": 0.6, "lines.markersize": 4},
    "dark": dict.fromkeys(_PAPERS, _PAPER) | dict.fromkeys(_INKS, _INK),
}
_style: ContextVar[str] = ContextVar("style", default="print")
_fatal: ContextVar[Sequence[Note]] = ContextVar("fatal", default=())


@contextmanager
def drawn_in(style: str | None, notes: Sequence[Note] = ()) -> Iterator[None]:
    """Let the pictures that are drawn meanwhile have a style, and below them the fatal ones of the
    notes: a picture goes on its way without the terminal that told them."""
    from matplotlib import rc_context

    style = style or _style.get()
    fatal = [note for note in fatal_first(notes) if note.severity == FATAL]
    tokens = _style.set(style), _fatal.set(fatal)
    try:
        with rc_context(_SETTINGS[style]):
            yield
    finally:
        _style.reset(tokens[0])
        _fatal.reset(tokens[1])


def fatal_notes() -> Sequence[Note]:
    """Those of the picture that is being drawn."""
    return _fatal.get()


def narrow() -> bool:
    """Whether the picture is as wide as one of two columns: its panels stand under one another."""
    return _style.get() == "single"


def palette() -> Sequence[str]:
    """Colours of single curves, the most different first."""
    return _ON_DARK if _style.get() == "dark" else COLOURS


def colours(count: int) -> Sequence[Any]:
    """As many as are asked for, told apart as well as can be."""
    if count <= len(palette()):
        return palette()[:count]
    return list(shades()(np.linspace(0, 1, count)))


def shades() -> Colormap:
    """Colours from dark to light, without the end that would not show on the paper: on a dark
    screen the darkest has three times its luminance."""
    from matplotlib import colormaps
    from matplotlib.colors import ListedColormap

    first, last = (0.4, 1.0) if _style.get() == "dark" else (0.0, 0.92)
    return ListedColormap(colormaps["cividis"](np.linspace(first, last, 256)))


def circle(turns: Any) -> Any:
    """Colours of one lightness around a circle of hues, alike after a whole turn: those of OKLab
    (B. Ottosson, 2020), of the largest chroma that all hues have."""
    light, chroma = (0.78, 0.12) if _style.get() == "dark" else (0.62, 0.115)
    hue = 2 * np.pi * (np.asarray(turns, dtype=np.float64) + 0.7)  # blue first
    a, b = chroma * np.cos(hue), chroma * np.sin(hue)
    to_cones = [
        [0.3963377774, 0.2158037573],
        [-0.1055613458, -0.0638541728],
        [-0.0894841775, -1.2914855480],
    ]
    cones = light + np.stack([a, b], axis=-1) @ np.transpose(to_cones)
    to_rgb = [
        [4.0767416621, -3.3077115913, 0.2309699292],
        [-1.2684380046, 2.6097574011, -0.3413193965],
        [-0.0041960863, -0.7034186147, 1.7076147010],
    ]
    linear = np.clip(cones**3 @ np.transpose(to_rgb), 0, 1)
    return np.where(linear > 0.0031308, 1.055 * linear ** (1 / 2.4) - 0.055, 12.92 * linear)


def grey(level: float) -> str:
    """A grey as it is on paper, 0 is ink; on a dark screen as far from the paper, of its range."""
    if _style.get() == "dark":
        level = 1 - level * (1 - _DARK_PAPER)
    return f"{level:.3g}"


def paper() -> str:
    return _PAPER if _style.get() == "dark" else "white"
