"""Legends of few entries, colour bars of many curves, and pictures for dark screens."""

from pathlib import Path
from typing import Any

import numpy as np
import pytest

from asperity.base.diagnostics import Note
from asperity.cli.main import main
from asperity.scene.scene import load_scene
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


@pytest.mark.parametrize("verb", ["friction", "area"])
def test_many_curves_have_a_colour_bar_instead_of_a_legend(
    folder: Path, figures: list[Any], verb: str
) -> None:
    (folder / "scene.toml").write_text(MANY)
    assert main([verb, "scene.toml", "--plot", "a.svg", "--output", "a.csv"]) == 0
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
    loads = np.geomspace(1e4, 1e6, 40)
    if verb == "area":  # of which some are drawn, so that each can be followed
        loads = loads[np.linspace(0, 39, 9).round().astype(int)]
        assert figure.axes[0].get_legend().get_title().get_text().startswith("9 of 40")
    for line, load in zip(shown, loads, strict=True):
        assert tuple(line.get_color()) == pytest.approx(tuple(colours(norm(load))))


@pytest.mark.parametrize("verb", ["friction", "spectrum"])
def test_a_dark_picture_is_dark_and_the_next_one_is_not(folder: Path, verb: str) -> None:
    from matplotlib.image import imread

    scan = ["scan.npy", "--pixel-size", "2e-5,1e-5", "--unit", "m"]
    arguments = [verb, *(scan if verb == "spectrum" else ["scene.toml"])]
    for options, low, high in ((["--style", "dark"], 0, 0.15), ([], 0.99, 1)):
        assert main([*arguments, "--output", "a.csv", "--plot", "a.png", *options]) == 0
        corner = imread("a.png")[:3, :3, :3]
        assert low <= corner.min() <= corner.max() <= high


@pytest.mark.parametrize("count", range(1, 13))
def test_colours_show_on_what_is_drawn_on(count: int) -> None:
    """By the contrast of WCAG 2.1, 1.4.11: 3 on a dark screen."""
    from matplotlib.colors import to_rgb

    from asperity.draw import style

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
    from asperity.draw import style as styles
    from asperity.draw.figure import new_figure

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


def test_python_draws_what_the_shell_draws(folder: Path, figures: list[Any]) -> None:
    """One code: axis from 0, pressures in kPa, and whether it is hysteresis alone."""
    from matplotlib import pyplot

    assert main(["friction", "scene.toml", "--plot", "a.png", "--output", "a.csv"]) == 0
    result = load_scene("scene.toml").friction()
    axes = result.plot()
    (shell,) = figures[0].axes
    for one, other in zip(axes.lines, shell.lines, strict=True):
        np.testing.assert_array_equal(one.get_xydata(), other.get_xydata())
        assert (one.get_color(), one.get_label()) == (other.get_color(), other.get_label())
    assert axes.get_ylim()[0] == shell.get_ylim()[0] == 0
    assert axes.get_ylabel() == shell.get_ylabel() == "Friction coefficient $\\mu$ [-]"
    assert {"81 kPa", "200 kPa", "hysteresis"} <= {t.get_text() for t in axes.get_legend().texts}
    (folder / "dry.toml").write_text(SCENE.replace("[adhesion]\nshear_stress_pa = 8.3e6\n", ""))
    assert load_scene("dry.toml").friction().plot().get_ylabel().endswith("of hysteresis alone")
    pyplot.close("all")


def test_names_on_a_polar_picture_stand_free(folder: Path, figures: list[Any]) -> None:
    """The legend is above those of the angles, those of radii are where no curve is."""
    text = SCENE.replace("[surface]", "[surface]\naxis_ratio = 3.0")
    turned = "[conditions]\ndirection_deg = {from = 0, to = 150, points = 11}"
    (folder / "scene.toml").write_text(text.replace("[conditions]", turned))
    assert main(["friction", "scene.toml", "--plot", "a.svg", "--output", "a.csv"]) == 0
    (figure,) = figures
    axes = figure.axes[0]
    assert axes.name == "polar"
    assert bars(figure)
    above = axes.get_legend().get_window_extent()
    angles = [one.label1.get_window_extent() for one in axes.xaxis.get_major_ticks()]
    assert not any(above.overlaps(one) for one in angles)
    assert 150 < axes.get_rlabel_position() < 360
