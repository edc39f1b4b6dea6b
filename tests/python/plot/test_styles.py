"""Legends of few entries, colour bars of many curves, and pictures for dark screens."""

from pathlib import Path
from typing import Any

import numpy as np
import pytest

from asperity.base.diagnostics import Note
from asperity.cli.main import main
from helpers.dropped import dma_bytes
from helpers.scenes import SCENE

pytest.importorskip("matplotlib")

MANY = SCENE.replace("[81e3, 2e5]", "{from = 1e4, to = 1e6, points = 40}")


@pytest.fixture
def figures(monkeypatch: pytest.MonkeyPatch) -> list[Any]:
    """The figures that are drawn, as they go into files."""
    drawn: list[Any] = []
    from matplotlib.figure import Figure

    kept = Figure.savefig

    def savefig(self: Figure, *args: Any, **options: Any) -> None:
        drawn.append(self)
        kept(self, *args, **options)

    monkeypatch.setattr(Figure, "savefig", savefig)
    return drawn


def entries(figure: Any) -> list[str]:
    legends = [*figure.legends, *(axes.get_legend() for axes in figure.axes)]
    return [text.get_text() for legend in legends if legend for text in legend.get_texts()]


def bars(figure: Any) -> list[Any]:
    return [axes for axes in figure.axes if hasattr(axes, "_colorbar")]


def test_many_curves_have_a_colour_bar_instead_of_a_legend(
    folder: Path, figures: list[Any]
) -> None:
    (folder / "scene.toml").write_text(MANY)
    assert main(["friction", "scene.toml", "--plot", "a.svg", "--output", "a.csv"]) == 0
    (figure,) = figures
    (bar,) = bars(figure)
    assert bar.get_ylabel().startswith("Nominal pressure")
    assert bar.get_ylim() == pytest.approx((1e4, 1e6))
    first = [text.get_text() for legend in figure.legends for text in legend.get_texts()]
    if legend := figure.axes[0].get_legend():
        first += [text.get_text() for text in legend.get_texts()]
    assert 0 < len(first) <= 8
    # the colours of the curves are those of the bar
    norm, colours = bar._colorbar.norm, bar._colorbar.cmap
    solid = [line for line in figure.axes[0].lines if line.get_linestyle() == "-"]
    shown = [line for line in solid if len(line.get_xdata())]  # the others are entries of legends
    assert len(shown) == 40
    for line, load in zip(shown, np.geomspace(1e4, 1e6, 40), strict=True):
        assert tuple(line.get_color()) == pytest.approx(tuple(colours(norm(load))))


def test_many_scenes_have_their_names_beside_a_bar(folder: Path, figures: list[Any]) -> None:
    names = [f"road{i}.toml" for i in range(9)]
    for name in names:
        (folder / name).write_text(SCENE.replace("[81e3, 2e5]", "81e3"))
    assert main(["friction", *names, "--plot", "a.svg", "--output", "a.csv"]) == 0
    (bar,) = bars(figures[0])
    assert [text.get_text() for text in bar.get_yticklabels()] == [f"{n}, 81 kPa" for n in names]
    assert not any("road" in entry for entry in entries(figures[0]))


def written(axes: Any) -> dict[str, Any]:
    return {text.get_text(): text for text in axes.texts}


def touches(axes: Any, box: Any, apart: float = 0.0) -> list[str]:
    """The dashes and colours of the curves that pass through a box of the picture [pixels]."""
    found = []
    for line in axes.lines:
        if len(line.get_xdata()):
            corners = axes.transData.transform(np.column_stack(line.get_data()))
            x = np.linspace(box.x0 - apart, box.x1 + apart, 60)
            y = np.interp(x, *corners[np.argsort(corners[:, 0])].T, left=np.nan, right=np.nan)
            if np.any((y > box.y0 - apart) & (y < box.y1 + apart)):
                found.append(f"{line.get_linestyle()} {line.get_color()}")
    return found


def test_few_curves_have_their_names_beside_them(folder: Path, figures: list[Any]) -> None:
    """81 and 200 kPa each at its own curve, in its colour; dashes and no pressure in the legend."""
    assert main(["friction", "scene.toml", "--plot", "a.svg", "--output", "a.csv"]) == 0
    (axes,) = figures[0].axes
    assert entries(figures[0])[:3] == ["total", "hysteresis", "adhesion"]
    assert not any("kPa" in entry for entry in entries(figures[0]))
    names = written(axes)
    assert list(names) == ["81 kPa", "200 kPa"]
    totals = [x for x in axes.lines if x.get_linestyle() == "-" and len(x.get_xdata())]
    for text, line in zip(names.values(), totals, strict=True):
        assert text.get_color() == line.get_color()
        box = text.get_window_extent()
        assert touches(axes, box) == []
        assert f"- {line.get_color()}" in touches(axes, box, apart=2 * box.height)


SCAN = ["spectrum", "scan.npy", "--pixel-size", "2e-5,1e-5", "--unit", "m", "--output", "a.csv"]
VERBS = [["friction", "scene.toml", "--output", "a.csv"], SCAN]


@pytest.mark.parametrize("arguments", VERBS, ids=["friction", "spectrum"])
def test_a_dark_picture_is_dark_and_the_next_one_is_not(folder: Path, arguments: list[str]) -> None:
    from matplotlib.image import imread

    for options, low, high in ((["--style", "dark"], 0, 0.15), ([], 0.99, 1)):
        assert main([*arguments, "--plot", "a.png", *options]) == 0
        corner = imread("a.png")[:3, :3, :3]
        assert low <= corner.min() <= corner.max() <= high


@pytest.mark.parametrize("arguments", VERBS, ids=["friction", "spectrum"])
def test_a_picture_of_a_single_column_is_as_wide_as_one(
    folder: Path, figures: list[Any], arguments: list[str]
) -> None:
    assert main([*arguments, "--plot", "a.png", "--style", "single"]) == 0
    (figure,) = figures
    assert figure.get_size_inches()[0] == pytest.approx(3.4)
    panels = [axes for axes in figure.axes if axes not in bars(figure)]
    lefts = [axes.get_position().x0 for axes in panels]
    assert max(lefts) - min(lefts) < 0.2
    for text in figure.findobj(lambda one: hasattr(one, "get_fontsize")):
        assert not text.get_text() or 4 <= text.get_fontsize() <= 10


def test_levels_of_a_map_are_labelled(folder: Path, figures: list[Any]) -> None:
    assert main(["map", "scene.toml", "--plot", "a.png", "--checked", "100"]) == 0
    labels = [float(text.get_text()) for text in figures[0].axes[0].texts]
    assert len(labels) >= 2
    ticks = bars(figures[0])[0].get_yticks()
    assert all(np.isclose(ticks, label, rtol=1e-2).any() for label in labels)


def test_validate_of_a_single_column_is_as_wide_as_one(folder: Path, figures: list[Any]) -> None:
    from importlib.resources import files

    rows = files("asperity.validation").joinpath("bem_area.csv").read_text().splitlines()
    (folder / "few.csv").write_text("\n".join(rows[:12]))
    asked = ["validate", "--rows", "few.csv", "--output", "worth", "--style", "single"]
    assert main(asked) == 0
    assert len(figures) == 3
    for figure in figures:
        width, height = figure.get_size_inches() * figure.dpi
        assert width / figure.dpi == pytest.approx(3.4)
        figure.draw_without_rendering()
        axes = [one for one in figure.axes if one.axison]
        assert len({round(one.get_position().x0, 1) for one in axes}) <= 2
        boxes = [one.get_tightbbox() for one in figure.axes]
        boxes += [legend.get_window_extent() for one in axes if (legend := one.get_legend())]
        for box in boxes:
            assert -1 <= box.x0 <= box.x1 <= width + 1
            assert -1 <= box.y0 <= box.y1 <= height + 1


@pytest.mark.parametrize("count", range(1, 13))
def test_colours_show_on_what_is_drawn_on(count: int) -> None:
    """By the contrast of WCAG 2.1, 1.4.11: 3 on a dark screen."""
    from matplotlib.colors import to_rgb

    from asperity.plot import style

    def luminance(colour: Any) -> float:
        parts = [
            x / 12.92 if x <= 0.03928 else ((x + 0.055) / 1.055) ** 2.4 for x in to_rgb(colour)
        ]
        return 0.2126 * parts[0] + 0.7152 * parts[1] + 0.0722 * parts[2]

    with style.drawn_in("dark"):
        background = luminance(style.paper()) + 0.05
        for colour in style.colours(count):
            assert (luminance(colour) + 0.05) / background >= 3


@pytest.mark.parametrize("style", ["print", "single", "dark"])
def test_fatal_notes_stand_on_the_picture(style: str) -> None:
    """And no others do; they lie inside of it, below the panels, and say how many were left out."""
    from asperity.plot import style as styles
    from asperity.plot.curves import new_figure

    words = "which goes on at $length and _much_ " * 4
    notes = [Note(f"number {i}, {words}", severity="fatal") for i in range(5)]
    with styles.drawn_in(style, [Note("of no weight"), *notes]):
        figure, panels = new_figure(2)
    figure.draw_without_rendering()
    told = figure.get_supxlabel()
    assert "of no weight" not in told
    assert [f"number {i}" in told for i in range(5)] == [True, True, True, False, False]
    assert told.endswith("and 2 more fatal notes")
    box = figure._supxlabel.get_window_extent()  # type: ignore[attr-defined]
    assert box.x0 >= 0
    assert box.x1 <= figure.bbox.x1
    assert box.y1 < min(axes.get_tightbbox().y0 for axes in panels)  # type: ignore[union-attr]
    with styles.drawn_in(style):
        assert new_figure(2)[0].get_supxlabel() == ""


DMA = ["--columns", "frequency=Freq,temperature=Temperature,storage=G',loss=G\""]
DMA += ["--units", "frequency=Hz,temperature=C,modulus=MPa"]


@pytest.mark.parametrize(
    ("verb", "style"), [("area", "print"), ("spectrum", "single"), ("rubber", "single")]
)
def test_legends_cover_no_curve(folder: Path, figures: list[Any], verb: str, style: str) -> None:
    (folder / "scene.toml").write_text(MANY.replace("points = 5", "points = 20"))
    (folder / "dma.csv").write_bytes(dma_bytes())
    arguments = {
        "area": ["area", "scene.toml", "--points", "40", "--output", "a.csv"],
        "spectrum": SCAN,
        "rubber": ["rubber", "dma.csv", *DMA, "--modulus", "G", "--output", "a.csv"],
    }
    assert main([*arguments[verb], "--plot", "a.png", "--style", style]) == 0
    (figure,) = figures
    figure.draw_without_rendering()
    seen = 0
    for axes in figure.axes:
        if (legend := axes.get_legend()) is None or (verb == "area" and axes is figure.axes[1]):
            continue
        box = legend.get_window_extent()
        for line in axes.lines:
            with np.errstate(all="ignore"):
                points = line.get_transform().transform(line.get_xydata())
            points = points[np.isfinite(points).all(axis=1)]
            if len(points) == 0 or (verb == "spectrum" and len(points) == 2):  # the cut-off's line
                continue
            seen += 1
            over = (points > (box.x0, box.y0)) & (points < (box.x1, box.y1))
            assert not over.all(axis=1).any(), (axes.get_ylabel(), line.get_label())
    assert seen or figure.legends  # below all panels


@pytest.mark.parametrize(("style", "count"), [("single", 1), ("single", 3), ("print", 3)])
def test_a_legend_above_the_panels_takes_nothing_from_them(style: str, count: int) -> None:
    from asperity.plot import style as styles
    from asperity.plot.curves import new_figure
    from asperity.plot.labels import legend_where_room_is

    heights = []
    with styles.drawn_in(style):
        for legend in (False, True):
            figure, panels = new_figure(count)
            for axes in panels:
                for i in range(8):  # no room between them
                    curve = 1 + np.sin(np.linspace(0, 40, 99) + i)
                    axes.plot(curve, label=f"the {i}th of the curves")
            if legend:
                legend_where_room_is(figure, panels[0])
            figure.draw_without_rendering()
            heights.append(panels[0].get_window_extent().height)
    (legend_box,) = (one.get_window_extent() for one in figure.legends)
    assert heights[1] >= 0.95 * heights[0]
    for axes in panels:
        assert axes.get_tightbbox().y1 <= legend_box.y0  # type: ignore[union-attr]


def test_a_legend_covers_neither_steps_nor_lines_across() -> None:
    from asperity.plot.curves import new_figure
    from asperity.plot.labels import legend_inside

    figure, (axes,) = new_figure(1)
    axes.stairs([1, 9, 9, 1], [0, 1, 2, 3, 4], label="steps")
    axes.axhline(7, label="across")
    axes.set(xlim=(0, 12), ylim=(0, 10))
    assert legend_inside(axes)
    figure.draw_without_rendering()
    box = axes.transData.inverted().transform(axes.get_legend().get_window_extent())
    (x0, y0), (_, y1) = box
    assert not y0 <= 7 <= y1
    assert x0 > 4 or y0 > 9
