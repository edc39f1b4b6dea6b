"""Figures for a paper: what all have in common, and area over magnification (matplotlib)."""

import io
import textwrap
import warnings
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from asperity._core import InvalidInput
from asperity.base.extras import to_install
from asperity.plot.labels import MOST_NAMED, legend_with_room, name_curves
from asperity.plot.style import colours, fatal_notes, grey, narrow, palette, shades
from asperity.scene.model import Scene

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.cm import ScalarMappable
    from matplotlib.figure import Figure

FORMATS = (".png", ".svg", ".pdf")
MOST_ENTRIES = 8  # curves of a legend; a colour bar tells more
_MOST_LABELS = 24  # names beside a colour bar
_MOST_FATAL = 3  # notes below a picture
_LETTERS, _LETTERS_NARROW = 15, 18  # of a small font that fit an inch
_LINE = 0.17  # inches, of its height
COLUMN = 3.4  # inches, of a journal of two columns
_DASHES = ("-", "--", ":", "-.")
PRESSURE, VELOCITY = "Nominal pressure $\\sigma_0$ [Pa]", "Sliding velocity $v$ [m/s]"


def check_plot(path: Path) -> None:
    """Refuse, before any work, a picture that cannot be drawn."""
    if path.suffix.lower() not in FORMATS:
        raise InvalidInput(f"must end in {', '.join(FORMATS)}", where=path)
    try:
        import matplotlib  # noqa: F401
    except ModuleNotFoundError as error:
        raise InvalidInput(
            f"pictures are drawn by matplotlib: {to_install('plot')}", where=path
        ) from error


def area_figure(
    scene: Scene, wavenumber: NDArray[np.float64], area: NDArray[np.float64], path: Path
) -> bytes:
    """A/A0 over magnification, colours for the velocities and line styles for the pressures, or the
    other way where there are more pressures; beside it the distribution of the pressure at three
    magnifications, as in the article's Fig. 1. Of more than four line styles four are drawn."""
    figure, (axes, right) = new_figure(2)
    sweeps = [
        (scene.velocity, VELOCITY, "{:.3g} m/s".format),
        (scene.pressure, PRESSURE, pressure_text),
    ]
    if scene.pressure.size > scene.velocity.size:
        sweeps.reverse()
        area = area.swapaxes(0, 1)
    (coloured, title, colour_name), (dashed, _, dash_name) = sweeps
    drawn = np.unique(np.linspace(0, dashed.size - 1, len(_DASHES)).round().astype(int))
    entries = coloured.size + (drawn.size if dashed.size > 1 else 0)
    many = coloured.size > len(palette()) or entries > MOST_ENTRIES
    tints = shaded(axes, coloured, title) if many else palette()
    curves: list[tuple[Any, str]] = []
    for dash, row_of in zip(_DASHES, drawn, strict=False):
        for value, colour, row in zip(coloured, tints, area[row_of], strict=False):
            (line,) = axes.plot(wavenumber / wavenumber[0], row, dash, color=colour)
            curves.append((line, colour_name(float(value))))
    axes.set_xscale("log")
    axes.set_yscale("log")
    axes.set_xlabel("Magnification $q / q_0$ [-]")
    axes.set_ylabel("Relative contact area $A / A_0$ [-]")
    _draw_distributions(right, scene, float(area[0, 0, -1]))
    curves = curves[: coloured.size]  # those of the first line style
    if not many and not (coloured.size <= MOST_NAMED and name_curves(axes, curves)):
        for (_, name), colour in zip(curves, tints, strict=False):
            axes.plot([], [], color=colour, label=name)
    if dashed.size > 1:
        for value, dash in zip(dashed[drawn], _DASHES, strict=False):
            axes.plot([], [], dash, color=grey(0.3), label=dash_name(float(value)))
    if axes.get_legend_handles_labels()[1]:
        some = f"{drawn.size} of {dashed.size}" if drawn.size < dashed.size else None
        how = {"title": some, "title_fontsize": "small"}
        legend_with_room(axes, **how)
    return picture(figure, path)


def shaded(axes: "Axes", values: NDArray[np.float64], title: str) -> NDArray[np.float64]:
    """A colour a value, with a bar that tells them."""
    from matplotlib.cm import ScalarMappable
    from matplotlib.colors import LogNorm

    norm = LogNorm(float(values.min()), float(values.max()))
    _bar(axes, ScalarMappable(norm, shades()), label=title)
    return np.asarray(shades()(norm(values)))


def named(axes: "Axes", names: Sequence[str]) -> None:
    """A bar with a field a curve, in the order of `colours`, and their names beside it."""
    from matplotlib.cm import ScalarMappable
    from matplotlib.colors import BoundaryNorm, ListedColormap

    count = len(names)
    norm = BoundaryNorm(np.arange(count + 1) - 0.5, count)
    bar = _bar(axes, ScalarMappable(norm, ListedColormap(colours(count))))
    shown = range(0, count, -(-count // _MOST_LABELS))
    bar.set_ticks(list(shown), labels=[names[i] for i in shown], fontsize="small")
    bar.ax.minorticks_off()


def _bar(axes: "Axes", colours_of: "ScalarMappable", **how: Any) -> Any:
    figure = axes.get_figure()
    assert figure is not None
    return figure.colorbar(colours_of, ax=axes, **how)


def _draw_distributions(axes: "Axes", scene: Scene, smallest_area: float) -> None:
    """P(sigma) at magnifications that are a third, two thirds and all of the way in ln q."""
    q0, q1 = scene.spectrum.q0, scene.spectrum.q1
    nominal = float(scene.pressure[0])
    highest = 10 / max(smallest_area, 1e-12)  # mean pressure is 1 / area
    stress = np.geomspace(1e-2, highest, 900) * nominal
    for share, colour in zip((1 / 3, 2 / 3, 1.0), palette(), strict=False):
        q = q0 * (q1 / q0) ** share if share < 1 else q1
        density = scene.pressure_distribution(stress, q) * stress
        axes.plot(stress / nominal, density, color=colour, label=f"$q/q_0$ = {q / q0:.3g}")
    axes.axvline(1, color=grey(0.4), linestyle="--", linewidth=1, label="$q/q_0$ = 1")
    axes.set_xscale("log")
    axes.set_ylim(bottom=0)
    axes.ticklabel_format(axis="y", style="sci", scilimits=(-2, 3), useMathText=True)
    axes.set_xlabel("Local pressure $\\sigma / \\sigma_0$ [-]")
    # per ln(sigma), so that the area under a curve is the share in contact
    axes.set_ylabel("Pressure distribution $\\sigma\\, P(\\sigma)$ [-]")
    title = f"{pressure_text(nominal)}, {float(scene.velocity[0]):.3g} m/s"
    if scene.options["form"] != "exact":
        title += ", exact form"  # the other has no distribution
    axes.set_title(title, fontsize="medium")
    axes.legend(loc="upper left", fontsize="small")


def new_figure(panels: int) -> "tuple[Figure, Sequence[Axes]]":
    """A figure of one to three panels in a row, or of two rows of two to four; in a single column
    all of them under one another."""
    from matplotlib.figure import Figure

    rows = 1 if panels < 4 else 2
    columns = panels // rows
    width = {1: 6.6, 2: 9.0, 3: 13.0, 4: 10.0, 6: 13.0, 8: 16.0}[panels]
    size = (width, 3.5 if rows == 1 else 7.2)
    if narrow():
        rows, columns, size = panels, 1, (COLUMN, 2.6 * panels)
    figure = Figure(figsize=size, layout="constrained")
    _warn(figure)
    drawn = [figure.add_subplot(rows, columns, i + 1) for i in range(panels)]
    for axes in drawn:
        axes.tick_params(which="both", direction="in", top=True, right=True)
    return figure, drawn


def picture(figure: "Figure", path: Path) -> bytes:
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


def _warn(figure: "Figure") -> None:
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


def band_text(level: float) -> str:
    """What a band is, for a legend."""
    return f"{100 * level:.4g} % band of the\nmeasured inputs' errors"


def pressure_text(value: float) -> str:
    """A pressure [Pa] in a unit that suits it."""
    for factor, unit in ((1e6, "MPa"), (1e3, "kPa")):
        if value >= factor:
            return f"{value / factor:.4g} {unit}"
    return f"{value:.4g} Pa"
