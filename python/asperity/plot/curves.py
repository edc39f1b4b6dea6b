"""Figures for a paper: friction over velocity, area over magnification (matplotlib)."""

import io
import math
import warnings
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from asperity._core import InvalidInput
from asperity.plot.labels import MOST_NAMED, legend_beside, legend_inside, name_curves
from asperity.plot.style import colours, grey, narrow, palette, shades
from asperity.scene.scene import Curves, Scene

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.cm import ScalarMappable
    from matplotlib.figure import Figure

FORMATS = (".png", ".svg", ".pdf")
_MOST_SHADED = 3  # curves whose model error can be told apart
MOST_ENTRIES = 8  # curves of a legend; a colour bar tells more
_MOST_LABELS = 24  # names beside a colour bar
_COLUMN = 3.4  # inches, of a journal of two columns
_DASHES = ("-", "--", ":", "-.")
_PRESSURE, _VELOCITY = "Nominal pressure $\\sigma_0$ [Pa]", "Sliding velocity $v$ [m/s]"


def check_plot(path: Path) -> None:
    """Refuse, before any work, a picture that cannot be drawn."""
    if path.suffix.lower() not in FORMATS:
        raise InvalidInput(f"{path}: must end in {', '.join(FORMATS)}")
    try:
        import matplotlib  # noqa: F401
    except ModuleNotFoundError as error:
        raise InvalidInput(
            f"{path}: pictures are drawn by matplotlib: pip install asperity[plot]"
        ) from error


def friction_figure(scenes: Sequence[Scene], results: Sequence[Curves], path: Path) -> bytes:
    """mu over velocity (over pressure, where only that varies), a colour a pressure or scene; with
    heat also mu without it, and a panel of the rise of the temperature."""
    heated = any(result.mu_cold is not None for result in results)
    figure, (axes, *beside) = new_figure(2 if heated else 1)
    over_pressure = all(s.velocity.size == 1 and s.pressure.size > 1 for s in scenes)
    adhesive = any(scene.adhesion is not None for scene in scenes)
    kinds = {"total": "-", "hysteresis": "--", "adhesion": ":"} if adhesive else {"total": "-"}
    names = _names(scenes)
    curves: list[tuple[str, NDArray[np.float64], list[NDArray[np.float64]], Any]] = []
    off: list[NDArray[np.float64]] = []  # of each curve, how far the model may be
    numerical = max(float(np.max(r.error_estimate / np.fmax(r.mu, 1e-300))) for r in results)
    for name, scene, result in zip(names, scenes, results, strict=True):
        values = [result.mu, result.hysteresis, result.adhesion, *(result.band or ())]
        assert result.model_error is not None
        model = result.model_error * result.hysteresis
        off += list(model.T if over_pressure else model)
        loads = [pressure_text(float(pressure)) for pressure in scene.pressure]
        if over_pressure:
            values = [array.T for array in values]
            loads = [f"{float(scene.velocity[0]):.4g} m/s"]
        for row, load in enumerate(loads):
            label = f"{_plain(name)}, {load}" if name else load
            x = scene.pressure if over_pressure else scene.velocity
            lines = [array[row] for array in values]
            curves.append((label, x, lines[:3], lines[3:]))
    many = len(curves) > MOST_ENTRIES
    tints: Sequence[Any] = colours(len(curves))
    if many and len(scenes) == 1:
        tints = list(shaded(axes, scenes[0].pressure, _PRESSURE))
    elif many:
        named(axes, [label for label, *_ in curves])
    hatched = len(curves) <= _MOST_SHADED and any(np.isfinite(one).any() for one in off)
    for (label, x, lines, band), model, colour in zip(curves, off, tints, strict=True):
        order = np.argsort(x)
        if hatched:
            mu = lines[0][order]
            around = (np.fmax(mu - model[order], 0), mu + model[order])
            axes.fill_between(x[order], *around, **_hatch(colour))
        if band:
            low, high = (bound[order] for bound in band)
            axes.fill_between(x[order], low, high, color=colour, alpha=0.2, linewidth=0)
        for y, (kind, dashes) in zip(lines, kinds.items(), strict=False):
            axes.plot(
                x[order],
                y[order],
                dashes,
                color=colour,
                linewidth=1.8 if kind == "total" else 1.2,
                marker="o" if x.size == 1 else None,
                label=label if kind == "total" and not many else None,
            )
    for rise_axes in beside:
        _draw_heat(axes, rise_axes, scenes, results, tints, over_pressure)
    if adhesive:
        for kind, dashes in kinds.items():
            axes.plot([], [], dashes, color=grey(0.3), label=kind)
    drawn = zip(scenes, results, strict=True)
    for level in sorted({s.sampling["level"] for s, r in drawn if r.band is not None}):
        label = band_text(level)
        axes.fill_between([], [], color=grey(0.3), alpha=0.2, linewidth=0, label=label)
    if hatched:
        axes.fill_between(
            [], [], **_hatch(grey(0.3)), label="model error, from exact\nsliding contacts"
        )
        label = f"numerical error below {_power_above(numerical)},\ntoo small to see"
        axes.plot([], [], linestyle="", label=label)
    axes.set_xscale("log")
    axes.set_ylim(bottom=0)
    axes.set_xlabel(_PRESSURE if over_pressure else _VELOCITY)
    axes.set_ylabel("Friction coefficient $\\mu$ [-]")
    if axes.get_legend_handles_labels()[1]:
        legend_beside(figure)
    return picture(figure, path)


def _power_above(error: float) -> str:
    """The power of ten above an error."""
    return f"$10^{{{math.ceil(math.log10(max(error, 1e-16)))}}}$"


def _hatch(colour: Any) -> dict[str, Any]:
    return {"facecolor": "none", "edgecolor": colour, "hatch": "////", "alpha": 0.4, "linewidth": 0}


def _names(scenes: Sequence[Scene]) -> list[str]:
    """What tells scenes apart: their files, and temperatures where a file has several."""
    paths = {scene.path for scene in scenes}
    short = len({path.name for path in paths}) == len(paths)
    names = []
    for scene in scenes:
        file = [scene.path.name if short else f"{scene.path}"] if len(paths) > 1 else []
        several = sum(other.path == scene.path for other in scenes) > 1
        names.append(", ".join(file + ([f"{scene.temperature:.4g} K"] if several else [])))
    return names


def _draw_heat(
    axes: "Axes",
    beside: "Axes",
    scenes: Sequence[Scene],
    results: Sequence[Curves],
    tints: Sequence[Any],
    over_pressure: bool,
) -> None:
    """mu without heat, and the rise of the temperature beside it, in the colours of the curves."""
    row = iter(tints)
    for scene, result in zip(scenes, results, strict=True):
        x = scene.pressure if over_pressure else scene.velocity
        order = np.argsort(x)
        lines = scene.velocity.size if over_pressure else scene.pressure.size
        for i, colour in zip(range(lines), row, strict=False):
            if result.mu_cold is None or result.hot_temperature is None:
                continue
            rise = result.hot_temperature - (scene.temperature or 0.0)
            cold, risen = (a[:, i] if over_pressure else a[i] for a in (result.mu_cold, rise))
            axes.plot(x[order], cold[order], "-.", color=colour, linewidth=1.0)
            beside.plot(x[order], risen[order], color=colour, linewidth=1.8)
    axes.plot([], [], "-.", color=grey(0.3), linewidth=1.0, label="without heat")
    beside.set_xscale("log")
    beside.set_ylim(bottom=0)
    beside.set_xlabel(_PRESSURE if over_pressure else _VELOCITY)
    beside.set_ylabel("Rise of the temperature at $q_1$ [K]")


def area_figure(
    scene: Scene, wavenumber: NDArray[np.float64], area: NDArray[np.float64], path: Path
) -> bytes:
    """A/A0 over magnification, colours for the velocities and line styles for the pressures, or the
    other way where there are more pressures; beside it the distribution of the pressure at three
    magnifications, as in the article's Fig. 1. Of more than four line styles four are drawn."""
    figure, (axes, right) = new_figure(2)
    sweeps = [
        (scene.velocity, _VELOCITY, "{:.3g} m/s".format),
        (scene.pressure, _PRESSURE, pressure_text),
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
        if not legend_inside(axes, **how):
            axes.legend(loc="best", fontsize="small", **how)
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
        rows, columns, size = panels, 1, (_COLUMN, 2.6 * panels)
    figure = Figure(figsize=size, layout="constrained")
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


def _plain(name: str) -> str:
    """A file name as a legend shows it: no formula, not hidden, nothing that is no text."""
    name = name.encode(errors="backslashreplace").decode().replace("$", r"\$")
    return f"./{name}" if name.startswith("_") else name


def band_text(level: float) -> str:
    """What a band is, for a legend."""
    return f"{100 * level:.4g} % of draws of the\nmeasured inputs' errors"


def pressure_text(value: float) -> str:
    """A pressure [Pa] in a unit that suits it."""
    for factor, unit in ((1e6, "MPa"), (1e3, "kPa")):
        if value >= factor:
            return f"{value / factor:.4g} {unit}"
    return f"{value:.4g} Pa"
