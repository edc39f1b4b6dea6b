"""Pictures of mu: an axis on which all curves can be read, a legend of what can be seen."""

from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest

from asperity.plot import friction as plot_friction
from asperity.scene.model import Curves, Scene
from asperity.scene.scene import load_scene
from helpers.scenes import RUBBER, SURFACE

pytest.importorskip("matplotlib", reason="pictures need asperity[plot]")


@pytest.fixture
def scene(tmp_path: Path) -> Scene:
    path = tmp_path / "scene.toml"
    conditions = "[conditions]\npressure_pa = 81e3\nvelocity_m_s = [1e-3, 1e-2, 0.1]\n"
    path.write_text(SURFACE + RUBBER + conditions)
    return load_scene(path)


def drawn(scenes: list[Scene], curves: list[Curves], patch: pytest.MonkeyPatch) -> Any:
    """The figure of mu, before it is written."""
    figures: list[Any] = []
    patch.setattr(plot_friction, "picture", lambda figure, _: figures.append(figure) or b"")
    plot_friction.friction_figure(scenes, curves, Path("mu.svg"))
    return figures[0]


def times(curves: Curves, factor: float) -> Curves:
    return replace(curves, mu=factor * curves.mu, hysteresis=factor * curves.hysteresis)


@pytest.mark.parametrize(("factor", "scale"), [(29, "linear"), (31, "log"), (1 / 31, "log")])
def test_curves_that_are_far_apart_have_a_logarithmic_axis(
    scene: Scene, factor: float, scale: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    curves = scene.friction()
    other = replace(scene, path=scene.path.with_name("other.toml"))
    axes = drawn([scene, other], [curves, times(curves, factor)], monkeypatch).axes[0]
    assert axes.get_yscale() == scale
    low = axes.get_ylim()[0]
    assert (low == 0) == (scale == "linear")
    assert low < min(1, factor) * curves.mu.min()


@pytest.mark.parametrize(("width", "seen"), [(1e-4, False), (0.1, True)])
def test_a_band_that_cannot_be_seen_has_no_patch_in_the_legend(
    scene: Scene, width: float, seen: bool, monkeypatch: pytest.MonkeyPatch
) -> None:
    curves = scene.friction()
    banded = replace(curves, band=((1 - width) * curves.mu, (1 + width) * curves.mu))
    figure = drawn([scene], [banded], monkeypatch)
    (legend,) = [*figure.legends, *(one for a in figure.axes if (one := a.get_legend()))]
    label = "95 % of draws of the\nmeasured inputs' errors"
    names = [text.get_text() for text in legend.get_texts()]
    assert (label in names) == seen
    assert (f"{label},\ntoo narrow to see" in legend.get_title().get_text()) != seen
