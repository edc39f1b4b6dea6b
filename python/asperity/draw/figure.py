"""Figures for a paper: their panels, legends beside or above them, colour bars, bytes of a file."""

import io
import textwrap
import warnings
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from asperity._core import InvalidInput
from asperity.base.table import to_install
from asperity.draw.style import (
    Axes,
    Figure,
    ScalarMappable,
    circle,
    colours,
    fatal_notes,
    narrow,
    palette,
    shades,
)

FORMATS = (".png", ".svg", ".pdf")
MOST_ENTRIES = 8  # curves of a legend; a colour bar tells more
_MOST_LABELS = 24  # names beside a colour bar
_MOST_FATAL = 3  # notes below a picture
_LETTERS, _LETTERS_NARROW = 15, 18  # of a small font that fit an inch
_LINE = 0.17  # inches, of its height
_KEY = 0.5  # inches, of a legend's entry without its letters
COLUMN = 3.4  # inches, of a journal of two columns
PRESSURE, VELOCITY = "Nominal pressure $\\sigma_0$ [Pa]", "Sliding velocity $v$ [m/s]"


def check_plot(path: Path) -> None:
    """Refuse, before any work, a picture that cannot be drawn."""
    if path.suffix.lower() not in FORMATS:
        raise InvalidInput(f"must end in {', '.join(FORMATS)}", where=path)
    try:
        import matplotlib  # noqa: F401
    except ModuleNotFoundError as error:
        problem = f"pictures are drawn by matplotlib: {to_install('plot')}"
        raise InvalidInput(problem, where=path) from error


def new_figure(panels: int, *, polar: bool = False) -> tuple[Figure, Sequence[Axes]]:
    """A figure of one to three panels in a row, or of two rows of two to four; in a single column
    all of them under one another. The first one may be polar."""
    from matplotlib.figure import Figure

    rows = 1 if panels < 4 else 2
    columns = panels // rows
    width = {1: 6.6, 2: 9.0, 3: 13.0, 4: 10.0, 6: 13.0, 8: 16.0}[panels]
    size = (width, 3.5 if rows == 1 else 7.2)
    if narrow():
        rows, columns, size = panels, 1, (COLUMN, 2.6 * panels)
    figure = Figure(figsize=size, layout="constrained")
    tell_fatal_notes(figure)
    kinds = ["polar" if polar and i == 0 else None for i in range(panels)]
    drawn = [figure.add_subplot(rows, columns, i + 1, projection=k) for i, k in enumerate(kinds)]
    for axes in drawn[polar:]:
        axes.tick_params(which="both", direction="in", top=True, right=True)
    return figure, drawn


def picture(figure: Figure, path: Path) -> bytes:
    """The figure as the bytes of a file of that ending, the same for the same figure."""
    from matplotlib import rc_context

    out = io.BytesIO()
    # text as text: Type 3 fonts and outlines are refused by many journals
    as_text = rc_context({"pdf.fonttype": 42, "svg.fonttype": "none", "svg.hashsalt": "asperity"})
    kind = path.suffix[1:].lower()
    undated = {"svg": {"Date": None}, "pdf": {"CreationDate": None}}.get(kind)
    with warnings.catch_warnings(), as_text:
        warnings.filterwarnings("ignore", "Glyph ")  # of a file name, in a font that lacks it
        figure.savefig(out, format=kind, dpi=300, metadata=undated)
    return out.getvalue()


def legend(axes: Axes, **how: Any) -> None:
    """A legend where it covers nothing: beside a single panel, else above its own, whose title
    becomes that of the legend. The panels keep their height: the figure grows by it.

    In a figure that lays nothing out, as one of a caller may be, it has matplotlib's best place.
    """
    figure: Any = axes.get_figure()
    handles, labels = axes.get_legend_handles_labels()
    if not labels:
        return
    how = {"fontsize": "small", "title_fontsize": "small", **how}
    if figure.get_layout_engine() is None:
        axes.legend(**how)
        return
    if len(figure.axes) == 1 and not narrow():
        axes.legend(loc="upper left", bbox_to_anchor=(1.01, 1), **how)
        return
    grid = axes.get_gridspec()
    width = figure.get_figwidth() / (grid.ncols if grid else 1)
    longest = max(len(line) for label in labels for line in label.split("\n"))
    columns = max(1, min(int(width / (_KEY + longest / _LETTERS)), len(labels), 3))
    drawn = axes.get_legend()  # before more was drawn, under the title of the panel
    above = axes.get_title() or (drawn.get_title().get_text() if drawn else "")
    title = "\n".join(filter(None, (above, how.pop("title", ""))))
    axes.set_title("")
    before = _lines_above(axes)
    top = 1.1 if axes.name == "polar" else 1.0  # the name of an angle stands between
    how |= {"bbox_to_anchor": (0.5, top), "ncols": columns, "title": title or None}
    axes.legend(handles, labels, loc="lower center", frameon=False, **how)
    grown = _LINE * (_lines_above(axes) - before)
    figure.set_figheight(figure.get_figheight() + grown)


def legend_outside(figure: Figure, handles: Sequence[Any], names: Any, **how: Any) -> None:
    """One legend of all panels: beside them, in a single column below."""
    where: Any = "outside lower center" if narrow() else "outside right upper"
    figure.legend(handles, names, loc=where, fontsize="small", **how)


def _lines_above(axes: Axes) -> int:
    """Lines of the highest legend in the row of some axes."""
    figure: Any = axes.get_figure()
    spec: Any = axes.get_subplotspec()
    highest = 0
    for one in figure.axes:
        drawn, other = one.get_legend(), one.get_subplotspec()
        if drawn is None or (spec and other and other.rowspan.start != spec.rowspan.start):
            continue
        lines = sorted(text.get_text().count("\n") + 1 for text in drawn.get_texts())
        title = drawn.get_title().get_text()
        above = title.count("\n") + 1 if title else 0
        highest = max(highest, above + sum(lines[len(lines) // -drawn._ncols :]))
    return highest


def shaded(
    axes: Axes | Sequence[Axes],
    values: NDArray[np.float64],
    title: str,
    *,
    linear: bool = False,
) -> NDArray[np.float64]:
    """A colour a value, with a bar that tells them."""
    from matplotlib.cm import ScalarMappable
    from matplotlib.colors import LogNorm, Normalize

    norm = (Normalize if linear else LogNorm)(float(values.min()), float(values.max()))
    bar(axes, ScalarMappable(norm, shades()), label=title)
    return np.asarray(shades()(norm(values)))


def turned(axes: Axes, degrees: NDArray[np.float64], title: str) -> NDArray[np.float64]:
    """A colour a direction, alike after half a turn; with a bar where that has a title."""
    from matplotlib.cm import ScalarMappable
    from matplotlib.colors import ListedColormap, Normalize

    if title:
        map_of = ListedColormap(circle(np.linspace(0, 1, 256)))
        drawn = bar(axes, ScalarMappable(Normalize(0, 180), map_of), label=title)
        drawn.set_ticks(range(0, 181, 45))
    return np.asarray(circle(degrees / 180))


def named(axes: Axes, names: Sequence[str]) -> None:
    """A bar with a field a curve, in the order of `colours`, and their names beside it."""
    from matplotlib.cm import ScalarMappable
    from matplotlib.colors import BoundaryNorm, ListedColormap

    count = len(names)
    norm = BoundaryNorm(np.arange(count + 1) - 0.5, count)
    drawn = bar(axes, ScalarMappable(norm, ListedColormap(colours(count))))
    shown = range(0, count, -(-count // _MOST_LABELS))
    drawn.set_ticks(list(shown), labels=[names[i] for i in shown], fontsize="small")
    drawn.ax.minorticks_off()


def bar(axes: Axes | Sequence[Axes], colours_of: ScalarMappable, **how: Any) -> Any:
    figure: Any = (axes[0] if isinstance(axes, Sequence) else axes).get_figure()
    return figure.colorbar(colours_of, ax=axes, **how)


def tell_fatal_notes(figure: Figure) -> None:
    """Write the fatal notes of the result below all panels."""
    notes = fatal_notes()
    if not notes:
        return
    shown: list[str] = [*notes[:_MOST_FATAL]]
    if len(notes) > len(shown):
        shown.append(f"and {len(notes) - len(shown)} more fatal notes")
    letters = int(figure.get_size_inches()[0] * (_LETTERS_NARROW if narrow() else _LETTERS))
    lines = [line for note in shown for line in textwrap.wrap(note, letters)]
    width, height = figure.get_size_inches()
    figure.set_size_inches(width, height + _LINE * len(lines))  # the panels keep theirs
    how = {"fontsize": "small", "color": palette()[1]}
    figure.supxlabel("\n".join(lines), x=0.01, ha="left", parse_math=False, **how)


def pressure_text(value: float) -> str:
    for factor, unit in ((1e6, "MPa"), (1e3, "kPa")):
        if value >= factor:
            return f"{value / factor:.4g} {unit}"
    return f"{value:.4g} Pa"
