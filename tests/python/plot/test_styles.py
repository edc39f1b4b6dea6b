"""Legends of few entries, colour bars of many curves, and pictures for dark screens."""

from pathlib import Path
from typing import Any

import numpy as np
import pytest

from asperity.cli.main import main
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
    assert len(shown) == 40
    for line, load in zip(shown, np.geomspace(1e4, 1e6, 40), strict=True):
        assert tuple(line.get_color()) == pytest.approx(tuple(colours(norm(load))))


def test_of_many_pressures_and_velocities_four_pressures_are_drawn_and_it_says_so(
    folder: Path, figures: list[Any]
) -> None:
    (folder / "scene.toml").write_text(MANY.replace("points = 5", "points = 60"))
    assert (
        main(["area", "scene.toml", "--points", "9", "--plot", "a.svg", "--output", "a.csv"]) == 0
    )
    legend = figures[0].axes[0].get_legend()
    assert legend.get_title().get_text() == "4 of 40"
    named = [text.get_text() for text in legend.get_texts()]
    assert (named[0], named[-1], len(named)) == ("10 kPa", "1 MPa", 4)


def test_many_scenes_have_their_names_beside_a_bar(folder: Path, figures: list[Any]) -> None:
    names = [f"road{i}.toml" for i in range(9)]
    for name in names:
        (folder / name).write_text(SCENE.replace("[81e3, 2e5]", "81e3"))
    assert main(["friction", *names, "--plot", "a.svg", "--output", "a.csv"]) == 0
    (bar,) = bars(figures[0])
    assert [text.get_text() for text in bar.get_yticklabels()] == [f"{n}, 81 kPa" for n in names]
    assert not any("road" in entry for entry in entries(figures[0]))


def test_few_curves_keep_their_legend(folder: Path, figures: list[Any]) -> None:
    assert main(["friction", "scene.toml", "--plot", "a.svg", "--output", "a.csv"]) == 0
    assert bars(figures[0]) == []
    assert entries(figures[0])[:2] == ["81 kPa", "200 kPa"]


def test_levels_of_a_map_are_labelled(folder: Path, figures: list[Any]) -> None:
    assert main(["map", "scene.toml", "--plot", "a.png", "--checked", "100"]) == 0
    labels = [float(text.get_text()) for text in figures[0].axes[0].texts]
    assert len(labels) >= 2
    ticks = bars(figures[0])[0].get_yticks()
    assert all(np.isclose(ticks, label, rtol=1e-2).any() for label in labels)


@pytest.mark.parametrize("verb", ["friction", "area", "map", "spectrum"])
def test_a_dark_picture_is_dark_and_the_next_one_is_not(folder: Path, verb: str) -> None:
    from matplotlib.image import imread

    scan = ["scan.npy", "--pixel-size", "2e-5,1e-5", "--unit", "m"]
    arguments = [verb, *(scan if verb == "spectrum" else ["scene.toml"])]
    arguments += ["--checked", "100"] if verb == "map" else ["--output", "a.csv"]
    for options, low, high in ((["--style", "dark"], 0, 0.15), ([], 0.99, 1)):
        assert main([*arguments, "--plot", "a.png", *options]) == 0
        corner = imread("a.png")[:3, :3, :3]
        assert low <= corner.min() <= corner.max() <= high


@pytest.mark.parametrize("verb", ["friction", "area", "map", "spectrum"])
def test_a_picture_of_a_single_column_is_as_wide_as_one(
    folder: Path, figures: list[Any], verb: str
) -> None:
    scan = ["scan.npy", "--pixel-size", "2e-5,1e-5", "--unit", "m"]
    arguments = [verb, *(scan if verb == "spectrum" else ["scene.toml"])]
    arguments += ["--checked", "100"] if verb == "map" else ["--output", "a.csv"]
    assert main([*arguments, "--plot", "a.png", "--style", "single"]) == 0
    (figure,) = figures
    assert figure.get_size_inches()[0] == pytest.approx(3.4)
    panels = [axes for axes in figure.axes if axes not in bars(figure)]
    lefts = [axes.get_position().x0 for axes in panels]
    assert max(lefts) - min(lefts) < 0.2
    for text in figure.findobj(lambda one: hasattr(one, "get_fontsize")):
        assert not text.get_text() or 4 <= text.get_fontsize() <= 10


def test_a_style_goes_with_a_picture(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["friction", "scene.toml", "--style", "dark"]) == 2
    assert "--style: goes with --plot" in capsys.readouterr().err
